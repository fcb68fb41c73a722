// Points listed by what finds their surfaces: each list keeps its own, in the order they came.
#include "check.h"
#include "integrate/point_lists.h"

#include <algorithm>
#include <vector>

namespace test_point_lists {

namespace {

struct Expected {
    std::vector<std::uint32_t> rays, points;
    std::vector<const StillShape*> shapes;
};

} // namespace

TEST(point_lists_keep_what_comes) {
    constexpr std::uint32_t kTogether = 16;
    const StillShape some{}, other{};
    PointLists lists;
    std::uint32_t seed = 1;
    const auto below = [&](std::uint32_t end) {
        seed = seed * 1664525 + 1013904223;
        return (seed >> 8) % end;
    };
    for (const std::uint32_t most : {32u, 256u, 48u, 1024u, 1024u}) { // larger, smaller, again
        std::vector<Expected> expected(PointLists::kLists);
        lists.clear(most);
        std::uint32_t point = 0;
        while (point < most) {
            const std::size_t list = below(PointLists::kLists);
            Expected& to = expected[list];
            const StillShape* const shape = below(2) == 0 ? &some : &other;
            std::vector<std::uint32_t> rays(below(2) == 0 && point + kTogether <= most ? kTogether
                                                                                       : 1);
            for (std::uint32_t& ray : rays) ray = below(5000);
            for (const std::uint32_t ray : rays)
                to.rays.push_back(ray), to.points.push_back(point++), to.shapes.push_back(shape);
            if (rays.size() == kTogether)
                lists.pushAlike(list, rays.data(), point - kTogether, kTogether, shape);
            else
                lists.push(list, rays[0], point - 1, shape);
        }
        for (std::size_t list = 0; list < PointLists::kLists; ++list) {
            const Expected& all = expected[list];
            CHECK(std::ranges::equal(lists.rays(list), all.rays));
            CHECK(std::ranges::equal(lists.points(list), all.points));
            if (list < PointLists::kOnOthers)
                CHECK(std::ranges::equal(lists.shapes(list), all.shapes));
        }
    }
    lists.clear(1024);
    for (std::size_t list = 0; list < PointLists::kLists; ++list) CHECK(lists.rays(list).empty());
}

} // namespace test_point_lists
