#include "spd.h"

#include "base/math.h"
#include "base/transform.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace spd {

namespace {

// As the original programs print them: six digits.
std::string numbers(std::initializer_list<double> values) {
    std::string out;
    for (const double value : values) {
        char text[32];
        static_cast<void>(std::snprintf(text, sizeof text, " %g", value));
        out += text;
    }
    return out;
}
std::string place(Vec3d p) { return numbers({p.x, p.y, p.z}); }

void addTetra(std::string& out, Vec3d centre, double half, int levels) {
    const std::array<Vec3d, 4> corners = {Vec3d{1, 1, 1}, Vec3d{1, -1, -1}, Vec3d{-1, 1, -1},
                                          Vec3d{-1, -1, 1}};
    if (levels > 0) {
        for (const Vec3d c : corners) addTetra(out, centre + c * (half / 2), half / 2, levels - 1);
        return;
    }
    for (const auto& [a, b, c] :
         {std::array{0u, 1u, 2u}, {0u, 2u, 3u}, {0u, 3u, 1u}, {1u, 3u, 2u}}) {
        const Vec3d pa = corners[a], pb = corners[b], pc = corners[c];
        const bool outward = dot(cross(pb - pa, pc - pa), pa) > 0;
        out += "p 3\n" + place(centre + pa * half) + "\n" +
               place(centre + (outward ? pb : pc) * half) + "\n" +
               place(centre + (outward ? pc : pb) * half) + "\n";
    }
}

// The nine directions of a ball's children around +z: three of them, three times around.
std::array<Vec3d, 9> childDirections() {
    const double d = 1 / std::sqrt(2.0);
    const std::array<Vec3d, 3> trio = {Vec3d{d, d, 0}, Vec3d{d, 0, -d}, Vec3d{0, d, -d}};
    const Transform tilt = Transform::rotate({1, -1, 0}, std::asin(2 / std::sqrt(6.0)));
    std::array<Vec3d, 9> out;
    for (std::size_t i = 0; i < 9; ++i)
        out[i] = Transform::rotate({0, 0, 1}, static_cast<double>(i / 3) * kTwoPi / 3)
                     .vector(tilt.vector(trio[i % 3]));
    return out;
}

void addBall(std::string& out, Vec3d centre, double radius, Vec3d direction, int levels) {
    out += "s" + place(centre) + numbers({radius}) + "\n";
    if (levels == 0) return;
    static const std::array<Vec3d, 9> kChildren = childDirections();
    const Vec3d axis = cross(Vec3d{0, 0, 1}, direction);
    const Transform turn = length(axis) > 0
                               ? Transform::rotate(axis, std::acos(std::fmin(direction.z, 1.0)))
                               : Transform();
    for (const Vec3d child : kChildren) {
        const Vec3d way = turn.vector(child);
        addBall(out, centre + way * (radius * 4 / 3), radius / 3, way, levels - 1);
    }
}

struct Ring {
    const char* color;
    std::array<Vec3d, 5> joints; // about the centre of the knot
};
const std::array<Ring, 6> kKnot = {{{"1 0 0",
                                     {{{0.930995, 0, 0},
                                       {0.287693, 0.885424, 0},
                                       {-0.753191, 0.547222, 0},
                                       {-0.753191, -0.547226, 0},
                                       {0.287693, -0.885426, 0}}}},
                                    {"0 1 0",
                                     {{{0.753191, 0.547224, 0},
                                       {0, 0.489454, 0.791951},
                                       {-0.753191, -0.244726, 0.489453},
                                       {-0.465497, -0.640706, -0.489453},
                                       {0.465497, -0.151246, -0.791951}}}},
                                    {"0 0 1",
                                     {{{-0.287693, 0.885424, 0},
                                       {-0.465497, 0.151254, 0.791951},
                                       {0, -0.791956, 0.489453},
                                       {0.465497, -0.640706, -0.489453},
                                       {0.287693, 0.395974, -0.791951}}}},
                                    {"0 1 1",
                                     {{{-0.930995, 0, 0},
                                       {-0.287693, -0.395976, 0.791951},
                                       {0.753191, -0.244726, 0.489453},
                                       {0.753191, 0.244724, -0.489453},
                                       {-0.287693, 0.395974, -0.791951}}}},
                                    {"1 0 1",
                                     {{{-0.287693, -0.885426, 0},
                                       {0.287693, -0.395976, 0.791951},
                                       {0.465497, 0.640704, 0.489453},
                                       {0, 0.791954, -0.489453},
                                       {-0.465497, -0.151246, -0.791951}}}},
                                    {"1 1 0",
                                     {{{0.753191, -0.547226, 0},
                                       {0.465497, 0.151254, 0.791951},
                                       {-0.465497, 0.640704, 0.489453},
                                       {-0.753191, 0.244724, -0.489453},
                                       {0, -0.489456, -0.791951}}}}}};

void addKnot(std::string& out, Vec3d centre) {
    const std::string radius = numbers({0.07412});
    for (const Ring& ring : kKnot) {
        out += std::string("f ") + ring.color + " 0.5 0.2 3.0827 0 0\n";
        for (std::size_t i = 0; i < 5; ++i) {
            const std::string here = place(centre + ring.joints[i]) + radius;
            out += "c" + here + place(centre + ring.joints[(i + 4) % 5]) + radius + "\n";
            out += "s" + here + "\n";
        }
    }
}

} // namespace

std::string tetra(int size) {
    std::string out =
        "b 0.078 0.361 0.753\nv\nfrom 1.02285 -3.17715 -2.17451\nat -0.004103 -0.004103 0.216539\n"
        "up -0.816497 -0.816497 0.816497\nangle 45\nhither 1\nresolution 512 512\nl 2 -18 -5\n"
        "f 1 0.2 0.2 1 0 100000 0 0\n";
    addTetra(out, {}, 1, size - 1);
    return out;
}

std::string balls(int size) {
    std::string out =
        "b 0.078 0.361 0.753\nv\nfrom 2.1 1.3 1.7\nat 0 0 0\nup 0 0 1\nangle 45\nhither 0.01\n"
        "resolution 512 512\nl 4 3 2\nl 1 -4 4\nl -3 1 5\nf 1 0.75 0.33 0.8 0 100000 0 1\n"
        "p 4\n12 12 -0.5\n-12 12 -0.5\n-12 -12 -0.5\n12 -12 -0.5\nf 1 0.9 0.7 0.5 0.5 3.0827 0 1\n";
    addBall(out, {}, 0.5, {0, 0, 1}, size);
    return out;
}

std::string rings(int size) {
    const double height = std::sqrt(4 + 2 * std::sqrt(2.0)); // between the layers
    std::string out =
        "b 0.078 0.361 0.753\nv\nfrom -1 -2.61313 0.5\nat -1 -1.61313 0.5\nup 0 0 1\n"
        "angle 45\nhither 1\nresolution 512 512\nl 3 -2.61313 3\nl -4 -2.61313 1\n"
        "l 2 -2.61313 -4\nf 1 1 1 1 0 100000 0 0\np 4\n8.83895 20.905 10.3389\n"
        "-10.8389 20.905 10.3389\n-10.8389 20.905 -9.33895\n8.83895 20.905 -9.33895\n";
    for (int layer = 0; layer < size; ++layer)
        for (int z = 0; z <= layer; ++z)
            for (int x = 0; x <= layer; ++x)
                addKnot(out, {2.0 * x - layer, height * (layer + 1), 2.0 * z - layer});
    return out;
}

} // namespace spd
