// T24: trees over triangles that builders are afraid of. They are no deeper than the traversal's
// stack, lose nothing, are built about as fast as others, and a ray through them costs at most
// about what it costs to try every triangle.
#include "base/parallel.h"
#include "base/text.h"
#include "shape/mesh.h"
#include "verify/groups.h"
#include "verify/hostile_trees.h"
#include "verify/specimens.h"
#include "verify/timing.h"

#include <algorithm>

namespace battery {

namespace {

using meshes::Random;

// A million at effort 100.
std::size_t triangleCount(const Effort& effort) {
    return static_cast<std::size_t>(clamp(1e4 * effort.factor, 1e3, 1e6));
}

// The sets side by side, each with its own random numbers.
Tally inSets(const Effort& effort, std::uint64_t seed,
             FunctionRef<void(const HostileTree&, Random&, Tally&)> trial) {
    const auto sets = hostileTrees();
    std::vector<Tally> tallies(sets.size());
    ThreadPool pool(effort.threads);
    pool.run(sets.size(), [&](std::size_t i, int) {
        Random random(seed + i);
        trial(sets[i], random, tallies[i]);
    });
    Tally sum;
    for (const Tally& tally : tallies) sum += tally;
    return sum;
}

constexpr int kWidth = 8;

struct Size {
    std::size_t depth = 0;
    std::uint64_t wrongBoxes = 0, found = 0; // found: primitives in leaves
};

Size sizeOf(const WideTree& tree, std::span<const Bounds> boxes) {
    Size size;
    struct Entry {
        WideRef ref;
        Bounds box;
        std::size_t depth;
    };
    std::vector<Entry> open;
    const auto openChildren = [&](WideRef ref, std::size_t depth) {
        const auto& node = tree.at<WideNode<kWidth>>(ref);
        size.depth = std::max(size.depth, depth);
        for (std::size_t i = 0; i < kWidth; ++i)
            if (!node.box(i).isEmpty()) open.push_back({node.child[i], node.box(i), depth});
    };
    openChildren(tree.root, 1);
    std::vector<bool> seen(boxes.size());
    while (!open.empty()) {
        const Entry at = open.back();
        open.pop_back();
        const auto check = [&](const Bounds& inner) {
            if (!at.box.contains(inner.lo) || !at.box.contains(inner.hi)) ++size.wrongBoxes;
        };
        if (kindOf(at.ref) == WideKind::Node) {
            const auto& node = tree.at<WideNode<kWidth>>(at.ref);
            for (std::size_t i = 0; i < kWidth; ++i)
                if (!node.box(i).isEmpty()) check(node.box(i));
            openChildren(at.ref, at.depth + 1);
            continue;
        }
        const auto& leaf = tree.at<WideLeaf<kWidth>>(at.ref);
        for (std::uint32_t i = leaf.first; i < leaf.first + leaf.count; ++i) {
            const std::uint32_t triangle = tree.triangleIds[i];
            check(boxes[triangle]);
            if (!seen[triangle]) ++size.found;
            seen[triangle] = true;
        }
    }
    return size;
}

std::vector<Bounds> boxesOf(const Triangles& triangles) {
    std::vector<Bounds> boxes(triangles.size());
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const Vec3 p : triangles[i]) boxes[i].extend(p);
    return boxes;
}

Tally treeDepths(const Effort& effort) {
    return inSets(effort, 24, [&](const HostileTree& set, Random& random, Tally& tally) {
        const Triangles triangles = set.make(random, triangleCount(effort));
        const std::vector<Bounds> boxes = boxesOf(triangles);
        const MeshGeometry g = meshes::geometryOf(triangles, false);
        const WideTree tree = buildWide(kWidth, g.points, g.triangles, 3);
        const Size size = sizeOf(tree, boxes);
        tally.cases += boxes.size();
        const auto text = [&] { return std::string(set.name); };
        if (size.wrongBoxes > 0 || size.found != boxes.size() ||
            tree.triangleIds.size() != boxes.size())
            tally.fail(text);
        tally.measure(static_cast<double>(size.depth), text);
    });
}

// From about the triangles at one of them, or past it.
Ray someRay(Random& random, const Triangles& triangles) {
    const auto& t = triangles[random.below(triangles.size())];
    Bounds box;
    for (const Vec3 p : t) box.extend(p);
    const double size = max(1e-12, static_cast<double>(maxAbs(box.size())));
    const double away = size * random.logUniform(0.1, 1e3);
    const Vec3d target = toDouble(t[0]) * 0.4 + toDouble(t[1]) * 0.3 + toDouble(t[2]) * 0.3;
    const Vec3d from = target + random.direction() * away;
    return {toFloat(from), toFloat(target + random.inBox(size * 0.5) - from)};
}

bool agree(const Mesh& a, const Mesh& b, const Ray& ray) {
    Hit atA, atB;
    return a.intersect(ray, atA) == b.intersect(ray, atB) && atA == atB &&
           a.occludes(ray) == b.occludes(ray);
}

// Of at most 1e5 triangles, as each ray has to try them all; T24d compares a few rays of all sizes.
Tally hits(const Effort& effort) {
    const std::size_t count = std::min<std::size_t>(triangleCount(effort), 100000);
    const int rays = static_cast<int>(30 * clamp(effort.factor / 10, 1.0, 100.0));
    return inSets(effort, 240, [&](const HostileTree& set, Random& random, Tally& tally) {
        const Triangles triangles = set.make(random, count);
        const MeshGeometry tree = meshes::geometryOf(triangles, true);
        const MeshGeometry list = meshes::geometryOf(triangles, false);
        const Mesh withTree(tree, {0}, {{0, 0}}), without(list, {0}, {{0, 0}});
        for (int i = 0; i < rays; ++i) {
            const Ray ray = someRay(random, triangles);
            ++tally.cases;
            if (!agree(withTree, without, ray))
                tally.fail([&] { return cat(set.name, ", ray ", textOf(ray)); });
        }
    });
}

constexpr int kTurns = 3;

// One after the other: what runs beside it would be timed too.
Tally buildTimes(const Effort& effort) {
    Tally tally;
    Random random(241);
    const Triangles even = evenTriangles(random, triangleCount(effort));
    const MeshGeometry evenMesh = meshes::geometryOf(even, false);
    const auto build = [](const MeshGeometry& g) { buildWide(kWidth, g.points, g.triangles); };
    for (const HostileTree& set : hostileTrees()) {
        const MeshGeometry mesh = meshes::geometryOf(set.make(random, even.size()), false);
        tally.cases += mesh.triangles.size();
        tally.measure(timeRatio(
                          kTurns, [&] { build(mesh); }, [&] { build(evenMesh); }),
                      [&] { return set.name; });
    }
    return tally;
}

// Where all triangles are in the way, a tree is in vain, and the builder has to see that: boxes and
// leaves out of the order of memory once cost 5.9 times the list of 'long diagonals'.
Tally traceTimes(const Effort& effort) {
    Tally tally;
    Random random(242);
    for (const HostileTree& set : hostileTrees()) {
        const Triangles triangles = set.make(random, triangleCount(effort));
        const MeshGeometry tree = meshes::geometryOf(triangles, true);
        const MeshGeometry list = meshes::geometryOf(triangles, false);
        const Mesh withTree(tree, {0}, {{0, 0}}), without(list, {0}, {{0, 0}});
        std::vector<Ray> rays;
        for (int i = 0; i < 6; ++i) {
            rays.push_back(someRay(random, triangles));
            if (!agree(withTree, without, rays.back()))
                tally.fail([&] { return cat(set.name, ", ray ", textOf(rays.back())); });
        }
        const auto trace = [&](const Mesh& mesh) {
            for (const Ray& ray : rays) {
                Hit hit;
                mesh.intersect(ray, hit);
            }
        };
        tally.cases += rays.size();
        tally.measure(timeRatio(
                          kTurns, [&] { trace(withTree); }, [&] { trace(without); }),
                      [&] { return set.name; });
    }
    return tally;
}

constexpr Row kTreesRows[] = {
    {"T24a", "depth of hostile trees; each triangle once, in its boxes", "levels", kMaxTreeDepth,
     true, treeDepths},
    {"T24b", "rays through them that find other than the plain list", "", 0, true, hits},
    timed({"T24c", "time to build them", "of even ones", 4, false, buildTimes}),
    timed({"T24d", "time of a ray through them", "of the list", 4, false, traceTimes}),
};

} // namespace

std::span<const Row> treeRows() { return kTreesRows; }

} // namespace battery
