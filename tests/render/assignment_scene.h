// What the oracle of assignment.h draws: the JSON of any dialect as a flat list of objects.
#pragma once

#include "base/vec.h"
#include "read/json/json.h"

#include <array>
#include <string>
#include <variant>
#include <vector>

namespace assignment {

// (a, b, c) -> x a + y b + z c + origin.
struct Affine {
    Vec3d x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, origin{};
    Vec3d vector(Vec3d v) const { return x * v.x + y * v.y + z * v.z; }
    Vec3d point(Vec3d p) const { return vector(p) + origin; }
    // The transposed linear part: inverse().transposed(n) places normals.
    Vec3d transposed(Vec3d v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
    Affine operator*(const Affine& b) const {
        return {vector(b.x), vector(b.y), vector(b.z), point(b.origin)};
    }
    Affine inverse() const;
};

struct Material {
    Vec3d diffuse, specular;
    double exponent = 0;
};
struct Light {
    bool isPoint = true;
    Vec3d place; // position, or the unit vector to the light
    Vec3d colour;
    Vec3d attenuation; // of d^2, d, 1
};

struct Sphere {
    Vec3d centre;
    double radius;
};
struct Plane {
    Vec3d point, normal;
};
struct Box {
    Vec3d low, high;
};
struct Mesh {
    std::vector<std::array<Vec3d, 3>> triangles;
};
struct Object {
    Affine worldFromObject, objectFromWorld;
    std::variant<Sphere, Plane, Box, Mesh> shape;
    std::vector<Material> materials; // one or two
};

struct SceneData {
    int width = 0, height = 0, samples = 1; // samples * samples per pixel
    Vec3d ambient;
    Vec3d eye, lookAt, up;
    double fovDeg = 0;
    std::vector<Light> lights;
    std::vector<Object> objects;
};

SceneData interpret(const JsonValue& scene, const std::string& folder);

} // namespace assignment
