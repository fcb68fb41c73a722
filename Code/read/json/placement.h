// Where things in a JSON scene stand: position, rotation and scale, and keys of these for motion.
#pragma once

#include "desc/scene_desc.h"
#include "read/json/fields.h"

struct JsonPlace {
    Vec3d position, rotationDeg, scale{1, 1, 1};
};

// The course's order: M = T * Rx * Ry * Rz * S.
Rows rowsOf(const JsonPlace& place);

// Takes position, rotation, scale (a number or three) and keys. `rows` says what a place means: the
// rule above, or another one.
Keys readJsonPlace(JsonFields& fields, Rows (*rows)(const JsonPlace&) = rowsOf);

// Calls with the fields of each of the `keys` of a moving thing; what a key does not give is as in
// the thing itself. Without keys, false.
inline constexpr std::size_t kMostKeys = 256;
template <class ReadKey> bool forEachJsonKey(JsonFields& fields, ReadKey&& readKey) {
    const JsonValue* list = fields.take("keys");
    if (!list) return false;
    if (!list->isArray() || list->items().empty() || list->items().size() > kMostKeys) {
        fields.problems().error(list->loc(), [&] {
            return cat("expected an array of 1 to ", kMostKeys, " objects for 'keys', got ",
                       list->isArray() ? cat(list->items().size()) : described(*list));
        });
        return false;
    }
    for (const JsonValue& item : list->items()) {
        JsonFields key(item, "a key of " + fields.what(), fields.problems());
        readKey(key);
        key.reportUnknown();
    }
    return true;
}

// Turns a thing that looks along its -Z from `eye` towards `target`, its +Y towards `up`. Notes an
// error at 'lookAt' or 'up' of the fields when they leave that open.
Rows lookingAt(Vec3d eye, Vec3d target, Vec3d up, const JsonFields& fields);

// a * b: with one key each, or one of them, or the same count. Two moving things with different
// counts have no product: empty.
Keys product(const Keys& a, const Keys& b);
