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

// Where a thing stands, or its keys if it moves: rows(part, fields) of the Part that read(fields,
// part) takes from its own fields and from those of each of its `keys`. What a key does not give is
// as in the thing itself.
inline constexpr std::size_t kMostKeys = 256;
template <class Part, class Read, class RowsFn>
Keys readJsonKeys(JsonFields& fields, const Read& read, const RowsFn& rows) {
    Part own;
    read(fields, own);
    const JsonValue* list = fields.take("keys");
    if (!list) return {rows(own, fields)};
    if (!list->isArray() || list->items().empty() || list->items().size() > kMostKeys) {
        fields.problems().error(list->loc(), [&] {
            return cat("expected an array of 1 to ", kMostKeys, " objects for 'keys', got ",
                       list->isArray() ? cat(list->items().size()) : described(*list));
        });
        return {rows(own, fields)};
    }
    Keys keys;
    for (const JsonValue& item : list->items()) {
        JsonFields key(item, "a key of " + fields.what(), fields.problems());
        Part part = own;
        read(key, part);
        keys.push_back(rows(part, key));
        key.reportUnknown();
    }
    return keys;
}

// Turns a thing that looks along its -Z from `eye` towards `target`, its +Y towards `up`. Notes an
// error at 'lookAt' or 'up' of the fields when they leave that open.
Rows lookingAt(Vec3d eye, Vec3d target, Vec3d up, const JsonFields& fields);

// a * b: with one key each, or one of them, or the same count. Two moving things with different
// counts have no product: empty.
Keys product(const Keys& a, const Keys& b);
