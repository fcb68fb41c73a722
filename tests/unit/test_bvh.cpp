// The tree over boxes: structure for friendly and hostile inputs, and that traversal loses nothing.
#include "accel/bvh.h"
#include "check.h"
#include "verify/meshes.h"

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>

using meshes::Random;

namespace {

using Boxes = std::vector<Bounds>;

constexpr std::uint32_t kAnyLeaf = std::numeric_limits<std::uint32_t>::max();

struct TreeSize {
    int depth = 0;
    std::uint32_t largestLeaf = 0;
};

// Checks what holds for every tree, and returns its size.
TreeSize checkTree(const Bvh& bvh, const Boxes& boxes, const char* name) {
    TreeSize out;
    if (boxes.empty()) {
        CHECK(bvh.nodes.empty() && bvh.primIds.empty());
        return out;
    }
    std::vector<int> seen(boxes.size(), 0), reached(bvh.nodes.size(), 0);
    std::size_t wrongBoxes = 0;
    const std::function<void(std::uint32_t, int)> visit = [&](std::uint32_t at, int depth) {
        const BvhNode& node = bvh.nodes[at];
        ++reached[at];
        out.depth = std::max(out.depth, depth);
        Bounds inside;
        if (node.isLeaf()) {
            out.largestLeaf = std::max(out.largestLeaf, node.count);
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
                ++seen[bvh.primIds[i]];
                inside.extend(boxes[bvh.primIds[i]]);
            }
        } else {
            for (const std::uint32_t child : {node.first, node.first + 1}) {
                visit(child, depth + 1);
                inside.extend(bvh.nodes[child].box);
            }
        }
        if (!(inside == node.box)) ++wrongBoxes; // the smallest box, so it contains what is inside
    };
    visit(0, 0);
    CHECK_INFO(wrongBoxes == 0, name << ": " << wrongBoxes << " boxes");
    CHECK_INFO(std::all_of(seen.begin(), seen.end(), [](int n) { return n == 1; }), name);
    CHECK_INFO(std::all_of(reached.begin(), reached.end(), [](int n) { return n == 1; }), name);
    CHECK_INFO(out.depth <= kMaxBvhDepth, name << ": depth " << out.depth);
    CHECK_EQUAL(bvh.nodes.size(), 2 * leafCount(bvh) - 1);
    return out;
}

Bounds boxAt(Vec3d centre, double half) {
    return {toFloat(centre - Vec3d{half, half, half}), toFloat(centre + Vec3d{half, half, half})};
}

Boxes randomBoxes(Random& random, std::size_t count) {
    Boxes boxes;
    for (std::size_t i = 0; i < count; ++i)
        boxes.push_back(boxAt(random.inBox(1), random.logUniform(1e-4, 0.1)));
    return boxes;
}

struct Named {
    const char* name;
    Boxes boxes;
};

std::vector<Named> hostile() {
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

Vec3 someDirection(Random& random) {
    Vec3 d = toFloat(random.direction());
    if (random.chance(0.2)) d[random.below(3)] = 0;
    if (random.chance(0.1)) d[random.below(3)] = random.chance(0.5) ? 0.0f : -0.0f;
    return maxAbs(d) > 0 ? d : Vec3{1, 0, 0};
}

} // namespace

TEST(bvh_structure) {
    Random random(1);
    for (const std::size_t count : {3u, 9u, 100u, 3000u}) {
        const Boxes boxes = randomBoxes(random, count);
        checkTree(buildBvh(boxes), boxes, "random");
    }
    for (const Named& input : hostile()) {
        const Bvh bvh = buildBvh(input.boxes);
        const TreeSize size = checkTree(bvh, input.boxes, input.name);
        CHECK_INFO(size.largestLeaf <= kUsualLeaf, input.name << ": leaf of " << size.largestLeaf);
        // Where a subtree that costs more than the list of its primitives may become one.
        const Bvh lists = buildBvh(input.boxes, 1, kAnyLeaf);
        checkTree(lists, input.boxes, input.name);
        CHECK_INFO(sahCost(lists) <= static_cast<double>(input.boxes.size()) * (1 + 1e-9) + 1,
                   input.name << ": cost " << sahCost(lists));
        std::printf("%-22s %6zu boxes: depth %d, largest leaf %u, cost %.1f\n", input.name,
                    input.boxes.size(), size.depth, size.largestLeaf, sahCost(bvh));
    }
}

// Above 2 * 4096 boxes there are several subtrees.
TEST(bvh_is_the_same_for_any_threads) {
    Random random(2);
    std::vector<Named> inputs = hostile();
    inputs.push_back({"random", randomBoxes(random, 30000)});
    for (const Named& input : inputs) {
        const Bvh a = buildBvh(input.boxes, 1, kAnyLeaf);
        for (const int threads : {1, 2, 3, 4, 8}) {
            const Bvh b = buildBvh(input.boxes, threads, kAnyLeaf);
            const auto sameBits = [](const BvhNode& x, const BvhNode& y) {
                // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): -0 is not 0
                return std::memcmp(&x, &y, sizeof x) == 0;
            };
            const bool same = std::equal(a.nodes.begin(), a.nodes.end(), b.nodes.begin(),
                                         b.nodes.end(), sameBits);
            CHECK_INFO(same && a.primIds == b.primIds, input.name << ", threads " << threads);
        }
    }
}

// Boxes that overlap nearly whole: no tree is better than lists of them.
TEST(bvh_in_vain_is_a_list) {
    Random random(5);
    Boxes boxes;
    for (int i = 0; i < 9000; ++i) {
        const Vec3d p = random.inBox(0.001);
        boxes.push_back({toFloat(p - Vec3d{1, 1, 1}), toFloat(p + Vec3d{1, 1, 1})});
    }
    const Bvh bvh = buildBvh(boxes, 1, kAnyLeaf);
    CHECK_INFO(bvh.nodes.size() < 32, bvh.nodes.size()); // 7 measured; else some 5000
    checkTree(bvh, boxes, "in vain");
}

// Long boxes, if few, have a tree of their own beside that of the short ones.
TEST(bvh_few_long_boxes_are_apart) {
    Random random(6);
    for (const std::uint32_t longOnes : {1u, 60u, 200u}) {
        Boxes boxes;
        for (int i = 0; i < 6000; ++i) boxes.push_back(boxAt(random.direction(), 0.005));
        for (std::uint32_t i = 0; i < longOnes; ++i) {
            Vec3 p = toFloat(random.inBox(0.5)), q = p;
            q[random.below(3)] += 0.5f;
            boxes.insert(boxes.begin() + random.below(6000), {p, q});
        }
        const Bvh bvh = buildBvh(boxes);
        checkTree(bvh, boxes, "long among short");
        std::vector<std::uint32_t> open{bvh.nodes[0].first + 1}, found;
        while (!open.empty()) {
            const BvhNode& node = bvh.nodes[open.back()];
            open.pop_back();
            if (!node.isLeaf()) open.insert(open.end(), {node.first, node.first + 1});
            for (std::uint32_t i = node.first; i < node.first + node.count; ++i)
                found.push_back(bvh.primIds[i]);
        }
        const auto isLong = [&](std::uint32_t i) {
            return maxAbs(boxes[i].hi - boxes[i].lo) > 0.4f;
        };
        const bool areApart =
            found.size() == longOnes && std::all_of(found.begin(), found.end(), isLong);
        CHECK_INFO(areApart == (longOnes < 100), longOnes << " long ones");
    }
}

// Separate triangles of a sphere: a good tree needs about 2 log2(n) steps for a ray; one that sorts
// nothing would need n.
TEST(bvh_is_worth_it) {
    Random random(3);
    Boxes boxes;
    for (int i = 0; i < 20000; ++i) boxes.push_back(boxAt(random.direction(), 0.005));
    const Bvh bvh = buildBvh(boxes);
    CHECK_INFO(sahCost(bvh) < 60, sahCost(bvh)); // 32 measured
    CHECK_NEAR(sahCost({}), 0, 0);
    CHECK_EQUAL(leafCount({}), 0u);
}

// Boxes as primitives, hit where the ray enters them: the nearest of the tree is the nearest of
// all, ties by number, though leaves that start behind the best are skipped.
TEST(bvh_traversal_finds_the_nearest) {
    std::size_t rays = 0, wrong = 0;
    std::vector<Named> inputs = hostile();
    Random random(4);
    inputs.push_back({"random", randomBoxes(random, 2000)});
    for (Named& input : inputs) {
        Boxes& boxes = input.boxes;
        if (boxes.empty()) continue;
        if (boxes.size() > 600) { // for the brute force
            for (std::size_t i = boxes.size() - 1; i > 0; --i)
                std::swap(boxes[i], boxes[random.below(i + 1)]);
            boxes.resize(600);
        }
        const Bvh bvh = buildBvh(boxes);
        const double extent = maxAbs(merge(bvh.nodes[0].box, {}).hi);
        for (int i = 0; i < 2000; ++i) {
            const Bounds& aim = boxes[random.below(boxes.size())];
            const Vec3 org =
                toFloat(toDouble(aim.centre()) +
                        random.inBox(max(1e-3, static_cast<double>(maxAbs(aim.size())) * 4)));
            Vec3 dir = someDirection(random);
            if (random.chance(0.5) && maxAbs(aim.centre() - org) > 0) dir = aim.centre() - org;
            const Ray ray{org, dir};
            if (!isTraceable(ray)) continue;
            const RaySetup setup(org, dir, static_cast<float>(extent));
            const auto nearest = [&](auto&& forEach) {
                float best = kInfinityF;
                std::uint32_t prim = 0xffffffffu;
                forEach([&](std::uint32_t id, float& zCut) {
                    float z = 0;
                    if (!setup.enters(boxes[id], kInfinityF, z)) return false;
                    if (z < best || (z == best && id < prim)) {
                        best = z, prim = id;
                        zCut = min(zCut, best); // exact: entry depths are monotone
                    }
                    return false;
                });
                return std::pair(best, prim);
            };
            const auto fromTree =
                nearest([&](auto&& leaf) { traverse(bvh, setup, kInfinityF, leaf); });
            const auto fromAll = nearest([&](auto&& leaf) {
                float unused = kInfinityF;
                for (std::uint32_t id = 0; id < boxes.size(); ++id) leaf(id, unused);
            });
            ++rays;
            if (fromTree != fromAll) ++wrong;
            // And without a cut: everything that can be entered is called exactly once.
            if (i % 4 == 0) {
                std::vector<int> calls(boxes.size(), 0);
                traverse(bvh, setup, kInfinityF, [&](std::uint32_t id, float&) {
                    ++calls[id];
                    return false;
                });
                float z = 0;
                for (std::size_t id = 0; id < boxes.size(); ++id) {
                    if (calls[id] > 1) ++wrong;
                    if (calls[id] == 0 && setup.enters(boxes[id], kInfinityF, z)) ++wrong;
                }
            }
        }
    }
    std::printf("%zu rays, seed 4\n", rays);
    CHECK(rays > 20000);
    CHECK_EQUAL(wrong, 0u);
}

// Boxes of a grid with gaps wider than the pads: each leaf's box is left before the next is
// entered, so leaves come in the order of their entry. (Overlapping nodes have no such order.) true
// stops.
TEST(bvh_traversal_is_front_to_back) {
    Random random(5);
    Boxes boxes;
    for (int x = -5; x <= 5; ++x)
        for (int y = -5; y <= 5; ++y)
            for (int z = -5; z <= 5; ++z)
                boxes.push_back(boxAt(Vec3d{x * 1.0, y * 1.0, z * 1.0} * 0.1, 0.04));
    const Bvh bvh = buildBvh(boxes);
    std::vector<std::uint32_t> leafOf(boxes.size());
    for (std::uint32_t n = 0; n < bvh.nodes.size(); ++n)
        for (std::uint32_t i = 0; i < bvh.nodes[n].count; ++i)
            leafOf[bvh.primIds[bvh.nodes[n].first + i]] = n;
    std::size_t disorder = 0, calls = 0, afterStop = 0, behindCut = 0;
    for (int i = 0; i < 10000; ++i) {
        const Vec3 org = toFloat(random.inBox(1)), dir = someDirection(random);
        const RaySetup setup(org, dir, 1);
        const auto entry = [&](std::uint32_t id) {
            float z = -1;
            setup.enters(bvh.nodes[leafOf[id]].box, kInfinityF, z);
            return z;
        };
        float last = 0;
        traverse(bvh, setup, kInfinityF, [&](std::uint32_t id, float&) {
            ++calls;
            if (entry(id) < last) ++disorder;
            last = entry(id);
            return false;
        });
        int after = 0;
        traverse(bvh, setup, kInfinityF, [&](std::uint32_t, float&) { return ++after == 1; });
        if (after > 1) ++afterStop;
        // Leaves behind the cut are not called, also when it comes down on the way.
        float cut = static_cast<float>(random.uniform(0, 1));
        traverse(bvh, setup, cut, [&](std::uint32_t id, float& zCut) {
            if (entry(id) > cut) ++behindCut;
            if (random.chance(0.2)) cut = zCut = min(zCut, entry(id) + 0.1f);
            return false;
        });
    }
    std::printf("%zu calls, seed 5\n", calls);
    CHECK(calls > 20000);
    CHECK_EQUAL(disorder, 0u);
    CHECK_EQUAL(afterStop, 0u);
    CHECK_EQUAL(behindCut, 0u);
}
