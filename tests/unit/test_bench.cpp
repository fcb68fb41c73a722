// What build/release/bench measures: its sets of rays, who traces them, how visits are counted, and
// the file for other programs. No times.
#include "base/parallel.h"
#include "bench/file.h"
#include "bench/trace.h"
#include "bench/walk.h"
#include "check.h"
#include "verify/meshes.h"

#include <bit>
#include <cstring>

namespace test_bench {

namespace {

struct Bench {
    SceneFrame frame;
    MeshDesc desc;
    MeshGeometry geometry;
    std::vector<BenchRays> sets;

    explicit Bench(const MeshDesc& mesh)
        : frame(meshes::frameFor(mesh, {})), desc(mesh), geometry(toGeometry(mesh, frame)) {
        geometry.finish(true, bestIsa());
        sets = benchRays(geometry);
    }
};

// A ring: some rays pass through it, some bounces meet it again.
const Bench& ring() {
    static const Bench bench(meshes::torus(0.4, 40, 20));
    return bench;
}

std::size_t hitsOf(const Bench& bench, const BenchRays& set, int threads, bool uv) {
    ThreadPool pool(threads);
    BenchTracer tracer(bench.geometry, set, pool);
    tracer.trace(uv);
    return tracer.hitCount();
}

} // namespace

TEST(bench_rays_of_every_set) {
    const auto& sets = ring().sets;
    CHECK_EQUAL(sets.size(), 4u);
    const BenchRays &primary = sets[0], &shadow = sets[1], &bounce = sets[2], &any = sets[3];
    CHECK_EQUAL(primary.size(), 1024u * 1024);
    CHECK_EQUAL(hitsOf(ring(), primary, 1, false), shadow.size());
    CHECK(shadow.size() == bounce.size() && bounce.org == any.org && bounce.dir == any.dir);
    CHECK(!primary.anyHit && shadow.anyHit && !bounce.anyHit && any.anyHit);
    for (const BenchRays& set : sets) {
        CHECK(set.batches.front() == 0 && set.batches.back() == set.size());
        for (std::size_t b = 0; b < set.batchCount(); ++b)
            CHECK(set.batches[b] <= set.batches[b + 1]);
    }
    // A shadow ray ends where the bounce of the same point starts, to the rounding of p - light.
    for (std::size_t i = 0; i < shadow.size(); ++i) {
        CHECK(shadow.org[i] == shadow.org[0] && shadow.tMax[i] == 1);
        CHECK_INFO(maxAbs(shadow.org[i] + shadow.dir[i] - bounce.org[i]) < 1e-6f, "ray " << i);
        CHECK_NEAR(length(bounce.dir[i]), 1, 1e-6);
    }
}

// Neighbours in a batch are neighbours in the picture: 16, 64 and 256 rays are squares of 4, 8 and
// 16 pixels.
TEST(bench_rays_are_in_squares) {
    const BenchRays& primary = ring().sets[0];
    const double pixel = 2 * 0.41421 / 1024; // of 2 tan(22.5 degrees)
    for (const std::size_t side : {4u, 8u, 16u}) {
        double widest = 0;
        for (std::size_t i = 0; i < primary.size(); ++i) {
            const Vec3 from = primary.dir[i / (side * side) * side * side];
            widest = max(widest, static_cast<double>(length(primary.dir[i] - from)));
        }
        // The diagonal, a hundredth less for the rounding of directions.
        const double diagonal = static_cast<double>(side - 1) * 1.41421 * pixel;
        CHECK_INFO(widest < diagonal * 1.001 && widest > diagonal * 0.99, side << ": " << widest);
    }
}

TEST(bench_hits_for_any_number_of_threads) {
    for (const BenchRays& set : ring().sets) {
        const std::size_t hits = hitsOf(ring(), set, 1, false);
        CHECK_INFO(hits > 0 && hits < set.size(), set.name);
        CHECK_INFO(hits == hitsOf(ring(), set, 64, false), set.name);
        CHECK_INFO(hits == hitsOf(ring(), set, 2, true), set.name);
    }
}

// A ray that meets nothing visits every node whose box it enters; others visit some of those.
TEST(bench_walk_against_all_boxes) {
    Bench plain(meshes::torus(0.4, 40, 20));
    plain.geometry.finish(true, oneLane());
    struct Child {
        Bounds box;
        bool isLeaf;
    };
    std::vector<Child> children; // of all nodes
    const WideTree& tree = plain.geometry.wide;
    for (std::vector<WideRef> open{tree.root}; !open.empty();) {
        const auto& node = tree.at<WideNode<8>>(open.back());
        open.pop_back();
        for (std::size_t i = 0; i < 8; ++i) {
            if (node.box(i).isEmpty()) continue;
            children.push_back({node.box(i), kindOf(node.child[i]) == WideKind::Leaf});
            if (!children.back().isLeaf) open.push_back(node.child[i]);
        }
    }
    std::size_t misses = 0;
    double entered = 0, visited = 0; // leaves, of the rays that hit
    const BenchRays& all = plain.sets[0];
    const Mesh mesh(plain.geometry, {0}, {{0, 0}});
    for (std::size_t i = 0; i < all.size(); i += 997) {
        BenchRays one;
        one.push(all.org[i], all.dir[i], kInfinityF);
        const RaySetup setup(all.org[i], all.dir[i], plain.geometry.extent);
        double nodes = 1, leaves = 0; // all rays visit the root
        for (const Child& child : children) {
            float z = 0;
            if (setup.enters(child.box, depthCut(0), z)) ++(child.isLeaf ? leaves : nodes);
        }
        const BenchWalk nearest = meanWalk(plain.geometry, one);
        one.anyHit = true;
        const BenchWalk any = meanWalk(plain.geometry, one);
        Hit hit;
        if (!mesh.intersect({all.org[i], all.dir[i]}, hit)) {
            ++misses;
            CHECK_INFO(nearest.nodes == nodes, "ray " << i << ": " << nearest.nodes);
            CHECK_INFO(nearest.leaves == leaves, "ray " << i << ": " << nearest.leaves);
        } else {
            CHECK_INFO(nearest.leaves >= 1 && nearest.leaves <= leaves, "ray " << i);
            CHECK_INFO(any.leaves >= 1 && any.leaves <= nearest.leaves, "ray " << i);
            entered += leaves, visited += nearest.leaves;
        }
    }
    CHECK(misses > 100);
    // A ray meets the ring twice or four times, and stops where it met it first: 0.379 of the
    // leaves. Without order it would be half of them, with children that wait behind the hit 0.405.
    CHECK_INFO(visited < 0.39 * entered, visited << " of " << entered);
}

// A ray visits fewer nodes of the wider tree.
TEST(bench_walk_of_wide_trees) {
    Bench bench(meshes::torus(0.4, 40, 20));
    double before = kInfinity;
    for (const int width : {8, 16}) {
        bench.geometry.wide = buildWide(width, bench.geometry.points, bench.geometry.triangles);
        const BenchWalk wide = meanWalk(bench.geometry, bench.sets[2]);
        CHECK_INFO(wide.nodes > 0.5 && wide.nodes < before, width << ": " << wide.nodes);
        CHECK_INFO(wide.leaves > 0.05 && wide.leaves < 3, width << ": " << wide.leaves);
        before = wide.nodes;
    }
    bench.geometry.wide = {};
    const BenchWalk none = meanWalk(bench.geometry, bench.sets[2]);
    CHECK(none.nodes == 0 && none.leaves == 0);
}

// The file has the mesh where the scene has it, and rays that meet it there.
TEST(bench_file_in_the_space_of_the_mesh) {
    MeshDesc far = meshes::icosphere(2);
    for (Vec3d& p : far.points) p = p * 10.0 + Vec3d{300, -20, 7};
    const Bench bench(far);
    const auto bytes = encodeBenchFile(bench.geometry, bench.frame, bench.sets);
    std::size_t at = 8;
    const auto whole = [&] {
        std::uint32_t value = 0;
        for (int shift = 0; shift < 32; shift += 8) value |= std::uint32_t{bytes[at++]} << shift;
        return value;
    };
    const auto number = [&] { return std::bit_cast<float>(whole()); };
    const auto vector = [&] {
        const float x = number(), y = number(), z = number();
        return Vec3d{x, y, z};
    };
    CHECK(std::memcmp(bytes.data(), "RTRAYS01", 8) == 0);
    CHECK_EQUAL(whole(), far.points.size());
    CHECK_EQUAL(whole(), far.triangles.size());
    CHECK_EQUAL(whole(), 4u);
    for (const Vec3d& p : far.points) CHECK(maxAbs(vector() - p) < 3e-5); // an ulp of 300
    for (const auto& corners : far.triangles)
        for (const std::uint32_t corner : corners) CHECK_EQUAL(whole(), corner);
    for (const BenchRays& set : bench.sets) {
        CHECK(std::memcmp(&bytes[at], set.name.c_str(), set.name.size() + 1) == 0);
        at += 16;
        CHECK_EQUAL(whole(), set.size());
        CHECK_EQUAL(whole(), set.anyHit ? 1u : 0u);
        for (std::size_t i = 0; i < set.size(); ++i) {
            const Vec3d org = vector();
            const float tMin = number();
            const Vec3d dir = vector();
            const float tMax = number();
            if (i % 1009 != 0) continue;
            const Vec3 end = set.org[i] + set.dir[i];
            CHECK_INFO(maxAbs(bench.frame.point(org + dir) - toDouble(end)) < 4e-6, set.name << i);
            CHECK(tMin == set.tMin[i] && tMax == set.tMax[i]);
        }
    }
    CHECK_EQUAL(at, bytes.size());
}

} // namespace test_bench
