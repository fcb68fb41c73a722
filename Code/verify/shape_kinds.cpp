#include "verify/shape_kinds.h"

#include "base/math.h"
#include "shape/cone.h"
#include "shape/cube.h"
#include "shape/cylinder.h"
#include "shape/disk.h"
#include "shape/infinite_plane.h"
#include "shape/sphere.h"

#include <stdexcept>

namespace kit {

namespace {

using meshes::Random;

// Any numbers but 0, to be found again in the hits.
constexpr std::uint32_t kMaterial = 3, kObject = 5;

Kind coneKind(const std::string& name, double radius, double topRadius, bool caps) {
    return {name, caps, false,
            [=](const MovingTransform& m) {
                return std::make_unique<Cone>(m, radius, topRadius, caps, kMaterial, kObject);
            },
            [=](Random& r) {
                return r.chance(0.5) ? onCircle(r, radius, -1) : onCircle(r, topRadius, 1);
            }};
}

Kind cylinderKind(const std::string& name, double radius, bool caps) {
    return {name, caps, false,
            [=](const MovingTransform& m) {
                return std::make_unique<Cylinder>(m, radius, caps, kMaterial, kObject);
            },
            [=](Random& r) { return onCircle(r, radius, r.chance(0.5) ? -1 : 1); }};
}

// A shape that takes its place, what `arguments` say, its material and its object.
template <class T, class... Arguments> auto maker(const Arguments&... arguments) {
    return [=](const MovingTransform& m) {
        return std::make_unique<T>(m, arguments..., kMaterial, kObject);
    };
}

} // namespace

const std::vector<Kind>& kinds() {
    static const std::vector<Kind> all = {
        {"sphere", true, false, maker<Sphere>(1.0), [](Random& r) { return r.direction(); }},
        {"cube", true, false, maker<Cube>(),
         [](Random& r) {
             return BoundsD{{-1, -1, -1}, {1, 1, 1}}.corner(static_cast<int>(r.unit() * 8));
         }},
        cylinderKind("cylinder", 1, true),
        cylinderKind("tube", 0.5, false),
        coneKind("cone", 1, 0, true),
        coneKind("inverted cone", 0, 0.25, true),
        coneKind("cut cone", 0.5, 1.5, true),
        coneKind("open cone", 1, 0.5, false),
        {"disk", false, true, maker<Disk>(1.0), [](Random& r) { return onCircle(r, 1, 0); }},
        {"plane", false, true, maker<Plane>(kQuad),
         [](Random& r) { return kQuad[static_cast<std::size_t>(r.unit() * 4)]; }},
        {"infinite plane", false, true, maker<InfinitePlane>(),
         [](Random& r) { return onCircle(r, r.logUniform(0.1, 100), 0); }},
    };
    return all;
}

const Kind& kindNamed(const std::string& name) {
    for (const Kind& kind : kinds())
        if (kind.name == name) return kind;
    throw std::runtime_error("no kind " + name);
}

Vec3d onCircle(Random& random, double radius, double z) {
    const double angle = random.uniform(0, kTwoPi);
    return {radius * exact::cos(angle), radius * exact::sin(angle), z};
}

Transform placed(Random& random, Vec3d factors, Vec3d offset) {
    const auto turn = [&] {
        const Vec3d axis = random.direction();
        return Transform::rotate(axis, random.uniform(0, kTwoPi));
    };
    const Transform first = turn(), second = turn();
    return Transform::translate(offset) * first * Transform::scale(factors) * second;
}

Vec3d randomFactors(Random& random, double size) {
    Vec3d f;
    for (std::size_t i = 0; i < 3; ++i) {
        const double factor = size * random.logUniform(1e-2, 1e2);
        f[i] = random.chance(0.5) ? factor : -factor;
    }
    return f;
}

} // namespace kit
