#include "read/json/shapes.h"

#include "base/text.h"
#include "base/transform.h"
#include "desc/names.h"
#include "read/json/placement.h"
#include "read/json/properties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace {

using ShapeKind = ObjectDesc::Kind;

struct Input {
    JsonFields& fields;
    const JsonRules& rules;
    JsonMeshes& meshes;
};

void placed(Input& in, JsonShape& shape) { shape.place = readJsonPlace(in.fields); }

// Native disks, cylinders and cones have the axis Z; in a world with Y up they stand up.
void upright(Input& in, JsonShape& shape) {
    constexpr Rows kYFromZ = {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0};
    shape.place = product(readJsonPlace(in.fields), {kYFromZ});
}

// Orders two corners; where they are level the box becomes a millionth of its size thick.
void makeSolid(Vec3d& lo, Vec3d& hi) {
    const double most = std::max(maxAbs(hi - lo), 1e-300);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (hi[axis] < lo[axis]) std::swap(lo[axis], hi[axis]);
        if (hi[axis] == lo[axis]) lo[axis] -= 0.5e-6 * most, hi[axis] += 0.5e-6 * most;
    }
}

// By its corners, or by size and centre; what 'rotation' says is ignored as in the course.
void box(Input& in, JsonShape& shape) {
    JsonFields& fields = in.fields;
    JsonProblems& problems = fields.problems();
    Vec3d size{2, 2, 2}, position, lo{-1, -1, -1}, hi{1, 1, 1}, rotation;
    const JsonValue* sizeValue = fields.read("size", size, kPositive);
    const bool isPlaced = in.rules.allArePlaced;
    const JsonValue* positionValue =
        isPlaced ? nullptr : fields.read("position", position, kAnyNumber);
    const JsonValue* loValue = fields.read("min", lo, kAnyNumber);
    const JsonValue* hiValue = fields.read("max", hi, kAnyNumber);
    const JsonValue* rotationValue = isPlaced ? nullptr : fields.read("rotation", rotation, kTurn);
    if (rotationValue && rotation != Vec3d{})
        problems.warn(rotationValue->loc(), [] {
            return "'rotation' of a box is ignored: its sides lie along the axes; turn a node "
                   "around it, or use the type cube";
        });
    if (sizeValue && (loValue || hiValue))
        problems.error(sizeValue->loc(), [] { return "give 'size' or 'min' and 'max', not both"; });
    if (sizeValue) {
        lo = position - size * 0.5;
        hi = position + size * 0.5;
    } else if (positionValue && position != Vec3d{}) {
        problems.warn(positionValue->loc(), [] {
            return "'position' of a box without 'size' is ignored: 'min' and 'max' place it";
        });
    }
    // (What could not be read was told already, and would only look wrong here.)
    if (!(lo.x < hi.x && lo.y < hi.y && lo.z < hi.z) && !problems.hasErrors()) {
        problems.error(hiValue ? hiValue->loc() : fields.loc(), [] {
            return "a box has a 'max' above its 'min' on each axis (left out: 1 and -1)";
        });
        makeSolid(lo, hi);
    }
    const Vec3d centre = (lo + hi) * 0.5, half = (hi - lo) * 0.5;
    shape.place = {(Transform::translate(centre) * Transform::scale(half)).rows()};
    if (isPlaced) shape.place = product(readJsonPlace(fields), shape.place);
}

// How the infinite plane z = 0 is placed for a plane that is given by a point and a normal.

Rows fromColumns(Vec3d x, Vec3d y, Vec3d z, Vec3d origin) {
    return {x.x, y.x, z.x, origin.x, x.y, y.y, z.y, origin.y, x.z, y.z, z.z, origin.z};
}

// An orthonormal frame with +Z along the unit normal, the origin at the point, and +X to the right
// of somebody who stands on the plane, or before it, and looks along -Z or down.
Rows planeRows(Vec3d point, Vec3d normal) {
    // For a floor +X is x; for a wall it is horizontal, so that +Y is up.
    const bool isFloor = std::fabs(normal.y) > 0.5;
    const Vec3d x =
        normalize(isFloor ? Vec3d{1, 0, 0} - normal * normal.x : cross(Vec3d{0, 1, 0}, normal));
    return fromColumns(x, cross(normal, x), normal, point);
}

// A vertical plane lies over no squares. Below, the shear would stretch by more than 1e6, and float
// could not tell the squares apart.
bool isVerticalPlane(Vec3d normal) { return std::fabs(normal.y) < 1e-6; }

// The checkerboard has squares of 1 x 1 of the x and z of its surroundings, counted from their
// origin and not from the point: so x and y of the plane are x and z of the surroundings, sheared
// up to the plane.
Rows checkerboardRows(Vec3d point, Vec3d normal) {
    const double alongX = -normal.x / normal.y, alongZ = -normal.z / normal.y;
    const double height = dot(normal, point) / normal.y;
    // The cross product of X and Y is -normal / normal.y: for a floor the map mirrors, and still
    // takes the normal +Z to `normal`, as normals go by the inverse transpose.
    return fromColumns({1, alongX, 0}, {0, alongZ, 1}, normal, {0, height, 0});
}

void plane(Input& in, JsonShape& shape) {
    JsonFields& fields = in.fields;
    Vec3d position, normal{0, 1, 0};
    const bool isPlaced = in.rules.allArePlaced;
    if (!isPlaced) fields.read("position", position, kAnyNumber);
    const JsonValue* normalValue = fields.read("normal", normal, kAnyNumber);
    if (normal == Vec3d{}) {
        fields.problems().error(normalValue->loc(), [] { return "'normal' of a plane is 0 0 0"; });
        normal = {0, 1, 0};
    }
    const Vec3d unit = normalize(normal / maxAbs(normal));
    shape.place = {planeRows(position, unit)};
    shape.checkerboard =
        isVerticalPlane(unit) ? shape.place : Keys{checkerboardRows(position, unit)};
    if (!isPlaced) return;
    const Keys place = readJsonPlace(fields);
    shape.place = product(place, shape.place);
    shape.checkerboard = product(place, shape.checkerboard);
}

// The course's: (v + position) * scale.
Rows movedFirst(const JsonPlace& place) {
    return (Transform::scale(place.scale) * Transform::translate(place.position)).rows();
}
void mesh(Input& in, JsonShape& shape) {
    shape.object.mesh = in.meshes.read(in.fields);
    const JsonValue* scale = in.fields.find("scale");
    const bool isPlain = !in.fields.has("rotation") && (!scale || scale->isNumber());
    const bool movesFirst = in.rules.meshMovesFirst && isPlain;
    shape.place = readJsonPlace(in.fields, movesFirst ? movedFirst : rowsOf);
}

struct ShapeType {
    std::string_view word;
    ShapeKind kind;
    void (*place)(Input&, JsonShape&);
};
constexpr auto kShapeTypes = std::to_array<ShapeType>({
    {"sphere", ShapeKind::Sphere, placed},
    {"box", ShapeKind::Cube, box},
    {"plane", ShapeKind::InfinitePlane, plane},
    {"mesh", ShapeKind::Mesh, mesh},
    {"cube", ShapeKind::Cube, placed},
    {"quad", ShapeKind::Plane, placed},
    {"disk", ShapeKind::Disk, upright},
    {"cylinder", ShapeKind::Cylinder, upright},
    {"cone", ShapeKind::Cone, upright},
});

} // namespace

Handle JsonMeshes::read(JsonFields& fields) {
    std::string file;
    double smoothAngleDeg = 0;
    const JsonValue* value = fields.read("filepath", file);
    fields.read("smooth_angle", smoothAngleDeg, Range{0, 180});
    if (file.empty() || findBadText(file) != std::string::npos) {
        fields.problems().error(value ? value->loc() : fields.loc(), [] {
            return "a mesh needs a 'filepath': the name of a file, without control characters";
        });
        return kNone;
    }
    const auto handle = static_cast<Handle>(meshes_.size());
    const auto [known, isNew] = known_.try_emplace({file, smoothAngleDeg}, handle);
    if (!isNew) return known->second;
    MeshDesc& mesh = meshes_.emplace_back();
    mesh.loc = fields.loc();
    mesh.file = file;
    mesh.fileLoc = value ? value->loc() : fields.loc();
    mesh.smoothAngleDeg = smoothAngleDeg;
    const std::string baseName = afterLast(file, "/\\");
    const std::string stem = baseName.substr(0, baseName.find_last_of('.'));
    mesh.name = names_.of(stem.empty() ? "mesh" : stem);
    return handle;
}

std::vector<std::string> jsonShapeWords() {
    std::vector<std::string> words;
    words.reserve(kShapeTypes.size());
    for (const ShapeType& type : kShapeTypes) words.emplace_back(type.word);
    return words;
}

std::optional<JsonShape> readJsonShape(std::string_view type, JsonFields& fields,
                                       const JsonRules& rules, const JsonNames& textures,
                                       JsonMeshes& meshes) {
    const auto row = std::find_if(kShapeTypes.begin(), kShapeTypes.end(),
                                  [&](const ShapeType& t) { return t.word == type; });
    if (row == kShapeTypes.end()) return {};
    JsonShape shape;
    shape.object.loc = fields.loc();
    shape.object.kind = row->kind;
    Input in{fields, rules, meshes};
    row->place(in, shape);
    readJsonProperties(fields, textures, shape.object, {"material", "materials", "mesh"});
    return shape;
}
