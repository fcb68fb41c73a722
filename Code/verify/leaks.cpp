// T1 to T3: no ray gets out of a closed mesh. Truth is the solid itself: what is inside is known
// when the mesh is made, and a ray from there crosses it an odd number of times.
#include "base/text.h"
#include "verify/groups.h"
#include "verify/placed_solid.h"

#include <algorithm>
#include <optional>

namespace battery {

namespace {

using meshes::Random;

constexpr double kBatchesOfLeaks = 24; // at effort 1, each a solid in a place of its own
constexpr int kRaysAtSolids = 4096;    // of a batch

using Place = PlacedSolid (*)(Random&, const Solid&);

const Solid& someSolid(Random& random) { return solids()[random.below(solids().size())]; }

// Moves each coordinate by up to `k` floats.
Vec3 beside(Random& random, Vec3 v, int k) {
    for (std::size_t i = 0; i < 3; ++i) {
        const auto steps = random.below(2 * static_cast<std::size_t>(k) + 1);
        v[i] = meshes::stepped(v[i], static_cast<int>(steps) - k);
    }
    return v;
}

enum class Aim { Anywhere, Vertex, Edge };

// A ray from inside. Rays at an edge or a vertex go there as exactly as floats can, or up to 8
// floats beside; a few lie in an axis plane.
Ray rayFromInside(Random& random, const PlacedSolid& at, Aim aim) {
    Vec3d from = at.sceneFromSolid.point(inside(random, at.solid));
    const std::uint32_t n = at.someTriangle(random);
    const std::size_t c = random.below(3);
    // In a convex solid also from close to the surface.
    if (at.solid.isConvex && random.chance(0.3))
        from = lerp(at.onTriangle(random, n), from, random.logUniform(1e-3, 1));
    Vec3d to;
    switch (aim) {
    case Aim::Anywhere: to = from + random.direction(); break;
    case Aim::Vertex: to = at.corner(n, c); break;
    case Aim::Edge: to = lerp(at.corner(n, c), at.corner(n, (c + 1) % 3), random.unit()); break;
    }
    Ray ray;
    ray.org = toFloat(from);
    Vec3 target = toFloat(to);
    const bool isExact = random.chance(0.4);
    if (!isExact) target = beside(random, target, random.chance(0.5) ? 1 : 8);
    ray.dir = target - ray.org;
    if (random.chance(0.4)) ray.dir = normalize(ray.dir);
    if (random.chance(0.3)) ray.dir = beside(random, ray.dir, 3);
    if (random.chance(0.03)) ray.dir[random.below(3)] = 0;
    return ray;
}

Tally fromInside(const Effort& effort, std::uint64_t seed, Place place, Aim aim) {
    return inBatches(effort, seed, kBatchesOfLeaks, [&](Random& random, Tally& tally) {
        const PlacedSolid at = place(random, someSolid(random));
        for (int i = 0; i < kRaysAtSolids; ++i) {
            const Ray ray = rayFromInside(random, at, aim);
            if (!isTraceable(ray)) continue;
            ++tally.cases;
            if (!at.set.closest(ray).isHit())
                tally.fail([&] { return cat("nothing met: ", at.name, ", ", shown(ray)); });
            else if (!at.set.occluded(ray))
                tally.fail([&] { return cat("not occluded: ", at.name, ", ", shown(ray)); });
        }
    });
}

template <std::uint64_t Seed, Aim aim> Tally near(const Effort& effort) {
    return fromInside(effort, Seed, placedNear, aim);
}
template <std::uint64_t Seed, Aim aim> Tally far(const Effort& effort) {
    return fromInside(effort, Seed, placedFar, aim);
}

// Shadow rays to points inside, from lamps 4 to 1e4 extents away.
Tally fromLamps(const Effort& effort) {
    return inBatches(effort, 14, kBatchesOfLeaks, [](Random& random, Tally& tally) {
        const Solid& solid = someSolid(random);
        const PlacedSolid at =
            random.chance(0.5) ? placedNear(random, solid) : placedFar(random, solid);
        // The end of the ray, rounded to 2^-24 of its length, must still be inside.
        const bool isThin = solid.tube > 0 && solid.tube < 0.01;
        const bool isSmall = maxAbs(at.set.boxes[0].size()) < 0.1f;
        const double furthest = isThin ? 30 : isSmall ? 100 : 1e4;
        // Few from very far: their pads open many boxes.
        for (int i = 0; i < kRaysAtSolids / 2; ++i) {
            const Vec3d target = at.sceneFromSolid.point(inside(random, solid));
            const double most = random.chance(0.95) ? min(furthest, 30.0) : furthest;
            const Vec3 lamp = toFloat(random.direction() * random.logUniform(4, most));
            const Ray ray{lamp, toFloat(target) - lamp, 0, 1, 0};
            ++tally.cases;
            if (!at.set.occluded(ray)) tally.fail([&] { return cat(at.name, ", ", shown(ray)); });
        }
    });
}

// Crossings in front of the origin: what each way of counting them finds, or nothing where it
// contradicts itself.
using Crossings = std::optional<std::size_t>;

// All at once.
Crossings collected(const PlacedSolid& at, Ray ray) {
    thread_local std::vector<Hit> hits;
    hits.clear();
    at.shape().collect(ray, hits);
    return hits.size();
}

// One place after the other, each behind the last. A ray that cuts through an edge crosses two
// triangles within less than a float of t: these are one place, which a ray that goes on from its t
// leaves behind, and two crossings. So a place counts as often as there are crossings with its t,
// and every crossing must have been at a place.
Crossings walked(const PlacedSolid& at, Ray ray) {
    thread_local std::vector<Hit> hits;
    hits.clear();
    at.shape().collect(ray, hits);
    std::size_t count = 0;
    for (Hit hit = at.set.closest(ray); hit.isHit(); hit = at.set.closest(ray)) {
        const auto isHere = [&](const Hit& other) { return other.t == hit.t; };
        const auto crossings = std::count_if(hits.begin(), hits.end(), isHere);
        if (crossings == 0 || !(hit.t > ray.tMin)) return std::nullopt;
        count += static_cast<std::size_t>(crossings);
        ray.tMin = hit.t;
    }
    return count == hits.size() ? Crossings(count) : std::nullopt;
}

// Odd from inside, even from outside.
template <Crossings (*count)(const PlacedSolid&, Ray)>
Tally parity(const Effort& effort, std::uint64_t seed) {
    return inBatches(effort, seed, kBatchesOfLeaks, [&](Random& random, Tally& tally) {
        const Solid& solid = someSolid(random);
        const PlacedSolid at =
            random.chance(0.5) ? placedNear(random, solid) : placedFar(random, solid);
        for (int i = 0; i < kRaysAtSolids; ++i) {
            constexpr Aim kAims[] = {Aim::Anywhere, Aim::Vertex, Aim::Edge};
            Ray ray = rayFromInside(random, at, kAims[random.below(std::size(kAims))]);
            if (!isTraceable(ray)) continue;
            // Backwards from beyond the box of all places is from outside.
            const bool fromOutside = random.chance(0.5);
            if (fromOutside) ray.org = ray.org - normalize(ray.dir) * 8.0f;
            ++tally.cases;
            const Crossings crossings = count(at, ray);
            if (!crossings || (*crossings % 2 == 1) == fromOutside)
                tally.fail([&] {
                    return cat(crossings ? cat(*crossings, " crossings") : "crossings passed over",
                               " from ", fromOutside ? "outside" : "inside", ": ", at.name, ", ",
                               shown(ray));
                });
        }
    });
}

Tally parityOfAll(const Effort& effort) { return parity<collected>(effort, 31); }
Tally parityOfRestarts(const Effort& effort) { return parity<walked>(effort, 32); }

constexpr Row kLeaksRows[] = {
    {"T1a", "rays from inside closed meshes, anywhere", "", 0, true, near<11, Aim::Anywhere>,
     "2e5 rays in a sphere of 39600 triangles: Embree 3.13 0, tinybvh 1.6.7 0"},
    {"T1b", "the same, at vertices", "", 0, true, near<12, Aim::Vertex>,
     "Embree 28 %, its robust mode 1.1 %, tinybvh 31 %"},
    {"T1c", "the same, at edges and a few floats beside", "", 0, true, near<13, Aim::Edge>,
     "Embree 5.9 %, robust 0, tinybvh 16 %"},
    {"T1d", "shadow rays to inside from lamps 4 to 1e4 extents away", "", 0, true, fromLamps},
    {"T2a", "T1a at (148376,1234,-223423) and 1e6", "", 0, true, far<21, Aim::Anywhere>,
     "Embree 2.2 % and 31 %, robust 0, tinybvh 2.6 % and 28 %"},
    {"T2b", "T1b there", "", 0, true, far<22, Aim::Vertex>,
     "Embree 0 and 1.3 %, robust 0, tinybvh 49 % and 42 %"},
    {"T2c", "T1c there", "", 0, true, far<23, Aim::Edge>,
     "Embree 10 % and 30 %, robust 0, tinybvh 21 % and 39 %"},
    {"T3a", "parity of crossings, also on edges and at vertices", "", 0, true, parityOfAll},
    {"T3b", "the same of rays that go on where they hit", "", 0, true, parityOfRestarts},
};

} // namespace

std::span<const Row> leakRows() { return kLeaksRows; }

} // namespace battery
