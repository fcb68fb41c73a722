// Boxes for the tests of trees over boxes: friendly ones, and some that builders are afraid of.
#pragma once

#include "base/bounds.h"
#include "verify/meshes.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace hostile_boxes {

using meshes::Random;
using Boxes = std::vector<Bounds>;

inline Bounds boxAt(Vec3d centre, double half) {
    return {toFloat(centre - Vec3d{half, half, half}), toFloat(centre + Vec3d{half, half, half})};
}

inline Boxes randomBoxes(Random& random, std::size_t count) {
    Boxes boxes;
    for (std::size_t i = 0; i < count; ++i)
        boxes.push_back(boxAt(random.inBox(1), random.logUniform(1e-4, 0.1)));
    return boxes;
}

struct Named {
    const char* name;
    Boxes boxes;
};

inline std::vector<Named> all() {
    Random random(11);
    std::vector<Named> out;
    out.push_back({"identical", Boxes(20000, boxAt({0.3, -0.2, 0.1}, 0.1))});
    out.push_back({"identical points", Boxes(20000, boxAt({0.3, -0.2, 0.1}, 0))});
    // Every split of bins puts one of these apart; without the halving the depth is their number.
    Boxes exponential, both;
    for (int i = 0; i < 250; ++i) {
        const double x = std::ldexp(1.0, i - 125);
        for (int k = 0; k < 20; ++k) exponential.push_back(boxAt({x, 0, 0}, x * 0.1));
        both.push_back(boxAt({x, -x, x}, x * 0.01));
        both.push_back(boxAt({-x, x, x}, x * 2));
    }
    // Ratio 17: every split of 16 bins takes off one, on one axis after the other.
    Boxes peeled;
    for (int i = -30; i <= 30; ++i) {
        const double x = std::pow(17.0, i);
        for (const Vec3d p : {Vec3d{x, 0, 0}, Vec3d{0, x, 0}, Vec3d{0, 0, x}})
            for (int k = 0; k < 9; ++k) peeled.push_back(boxAt(p, x * 1e-3));
    }
    out.push_back({"exponential on 3 axes", peeled});
    out.push_back({"exponential spacing", exponential});
    out.push_back({"exponential both ways", both});
    Boxes nested;
    for (int i = 0; i < 20000; ++i) nested.push_back(boxAt({0, 0, 0}, 1.0 / (1 + i)));
    out.push_back({"equal centroids", nested});
    Boxes stadium = randomBoxes(random, 20000);
    for (Bounds& box : stadium) box = {box.lo * 1e-6f, box.hi * 1e-6f};
    stadium.push_back(boxAt({0, 0, 0}, 1));
    stadium.push_back(boxAt({1e6, 1e6, 1e6}, 1));
    out.push_back({"huge and tiny", stadium});
    Boxes sorted;
    for (int i = 0; i < 20000; ++i) sorted.push_back(boxAt({i * 1e-3, 0, 0}, 4e-4));
    out.push_back({"sorted", sorted});
    std::reverse(sorted.begin(), sorted.end());
    out.push_back({"sorted backwards", sorted});
    Boxes diagonals;
    for (int i = 0; i < 5000; ++i) {
        const Vec3d p = random.inBox(0.01);
        diagonals.push_back({toFloat(p - Vec3d{1, 1, 1}), toFloat(p + Vec3d{1, 1, 1})});
    }
    out.push_back({"overlapping", diagonals});
    Boxes ulps; // neighbours in the last place: the bin width rounds
    for (int i = 0; i < 3000; ++i) {
        const float x = meshes::stepped(1.0f, i % 100);
        ulps.push_back({{x, 1, 1}, {meshes::stepped(x, 1), 1, 1}});
    }
    out.push_back({"neighbouring floats", ulps});
    out.push_back({"one", Boxes(1, boxAt({1, 2, 3}, 1))});
    out.push_back({"two", Boxes(2, boxAt({1, 2, 3}, 1))});
    out.push_back({"none", {}});
    return out;
}

} // namespace hostile_boxes
