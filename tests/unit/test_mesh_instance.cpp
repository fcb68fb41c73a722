// An instance is its copy: MeshInstance against a Mesh of the same triangles placed in the scene,
// to the last bit, whatever lies between the mesh and the scene.
#include "shape/mesh_instance.h"

#include "check.h"
#include "scene/shape_set.h"
#include "verify/hostile_rays.h"

#include <algorithm>

namespace test_mesh_instance {

using meshes::Random;

namespace {

MeshDesc soupMesh(Random& random, std::size_t count) {
    MeshDesc mesh;
    for (const auto& triangle : meshes::soup(random, count)) {
        const auto n = static_cast<std::uint32_t>(mesh.points.size());
        for (const Vec3 p : triangle) mesh.points.push_back(toDouble(p));
        mesh.triangles.push_back({n, n + 1, n + 2});
    }
    return mesh;
}

MeshDesc someMesh(Random& random) {
    switch (random.below(5)) {
    case 0: return meshes::uvSphere(24, 12);
    case 1: return meshes::icosphere(2);
    case 2: return meshes::cube();
    case 3: return meshes::torus(0.02, 32, 6);
    default: return soupMesh(random, 300);
    }
}

// Turned, stretched, mirrored, sheared; flat now and then; 1e-3 to 1e3 in size; the mesh may lie
// far from its own origin, and the object far from the world's.
Transform someMap(Random& random) {
    Transform map = random.affine(random.chance(0.3) ? 100 : 3, 1);
    if (random.chance(0.3)) {
        const double s = random.uniform(-3, 3), t = random.uniform(-3, 3);
        map = map * Transform::fromRows({1, s, t, 0, 0, 1, s, 0, 0, 0, 1, 0});
    }
    if (random.chance(0.1))
        map =
            map * Transform::scale({1, random.chance(0.3) ? 0 : random.logUniform(1e-12, 1e-3), 1});
    map = Transform::scale(random.logUniform(1e-3, 1e3)) * map;
    if (random.chance(0.3)) map = Transform::translate(random.inBox(1e6)) * map;
    return map;
}

// An instance and its copy in the scene's space.
struct Pair {
    meshes::Ready instance, copy;
    std::vector<std::uint32_t> number; // in the instance, of a triangle of the copy

    Pair(const MeshDesc& mesh, const Transform& map, const SceneFrame& frame)
        : instance(meshes::instance(mesh, map, frame)), copy(meshes::baked(mesh, map, frame)) {
        // The copy has no triangles whose corners have become one.
        for (std::uint32_t n = 0; n < instance.geometry->triangles.size(); ++n) {
            const Vec3 a = corner(n, 0), b = corner(n, 1), c = corner(n, 2);
            if (a != b && b != c && c != a) number.push_back(n);
        }
    }
    Vec3 corner(std::uint32_t n, std::size_t c) const { return instance.corner(n, c); }

    bool areEqual(const Hit& hit, const Hit& ofCopy) const {
        return hit.t == ofCopy.t && hit.u == ofCopy.u && hit.v == ofCopy.v &&
               hit.prim == number[ofCopy.prim];
    }
    bool lookEqual(const Ray& ray, const Hit& hit, const Hit& ofCopy) const {
        const Surface a = instance.shape->surface(ray, hit);
        const Surface b = copy.shape->surface(ray, ofCopy);
        const SurfaceDerivatives c = instance.shape->derivatives(ray, hit);
        const SurfaceDerivatives d = copy.shape->derivatives(ray, ofCopy);
        return a.p == b.p && a.ng == b.ng && a.ns == b.ns && a.uv == b.uv && a.error == b.error &&
               a.lift == b.lift && a.material == b.material && a.object == b.object &&
               c.dpdu == d.dpdu && c.dpdv == d.dpdv &&
               instance.shape->tieOrder(ray, hit) == copy.shape->tieOrder(ray, ofCopy);
    }
    // Empty when all that can be asked about the ray has the same answer.
    std::string difference(const Ray& ray, Random& random) const {
        Hit a, b;
        if (random.chance(0.3)) a.t = b.t = static_cast<float>(random.uniform(0.5, 1.5));
        const bool hitA = instance.shape->intersect(ray, a), hitB = copy.shape->intersect(ray, b);
        if (hitA != hitB) return hitA ? "a hit too many" : "a hit is missing";
        if (hitA && !areEqual(a, b)) return "another hit";
        if (hitA && !lookEqual(ray, a, b)) return "another surface";
        if (instance.shape->occludes(ray) != copy.shape->occludes(ray)) return "another shadow";
        std::vector<Hit> all, allOfCopy;
        instance.shape->collect(ray, all);
        copy.shape->collect(ray, allOfCopy);
        if (all.size() != allOfCopy.size()) return "other crossings";
        const auto byNumber = [](const Hit& x, const Hit& y) { return x.prim < y.prim; };
        std::sort(all.begin(), all.end(), byNumber);
        std::sort(allOfCopy.begin(), allOfCopy.end(), byNumber);
        for (std::size_t i = 0; i < all.size(); ++i)
            if (!areEqual(all[i], allOfCopy[i])) return "another crossing";
        return {};
    }
};

// At corners, along edges, in the planes of triangles, anywhere; from everywhere up to 1e4 away.
Ray someRay(Random& random, const Pair& pair) {
    const std::uint32_t n = random.below(pair.instance.geometry->triangles.size());
    const std::size_t c = random.below(3);
    const Vec3d p = toDouble(pair.corner(n, c)), q = toDouble(pair.corner(n, (c + 1) % 3)),
                r = toDouble(pair.corner(n, (c + 2) % 3));
    const double u = random.unit(), v = random.unit() * (1 - u);
    Ray ray;
    Vec3d to = p;
    switch (random.below(4)) {
    case 0: break;
    case 1: to = lerp(p, q, random.unit()); break;
    default: to = p * (1 - u - v) + q * u + r * v;
    }
    switch (random.below(6)) {
    case 0: ray.org = toFloat(random.inBox(1)); break;
    case 1: ray.org = toFloat(random.direction() * random.logUniform(1, 1e4)); break;
    case 2: ray.org = toFloat(to + (q - p) * random.uniform(-3, 3)); break; // in the plane
    case 3: {                                                               // and nearly
        const double off = random.logUniform(1e-9, 1e-2);
        ray.org = toFloat(to + (q - p) * random.uniform(-3, 3) + (r - p) * random.uniform(-3, 3) +
                          random.direction() * off);
        break;
    }
    case 4: ray.org = toFloat(to + random.direction() * random.logUniform(1e-7, 1e-3)); break;
    default: ray.org = toFloat(lerp(toDouble(ray.org), to, random.uniform(0, 1.2)));
    }
    Vec3 target = toFloat(to);
    if (random.chance(0.4))
        for (std::size_t k = 0; k < 3; ++k)
            target[k] = meshes::stepped(target[k], static_cast<int>(random.below(7)) - 3);
    ray.dir = random.chance(0.1) ? toFloat(random.direction()) : target - ray.org;
    if (random.chance(0.03)) ray.dir[random.below(3)] = 0;
    if (random.chance(0.3)) ray.tMin = static_cast<float>(random.uniform(0, 1.1));
    if (random.chance(0.3)) ray.tMax = static_cast<float>(random.uniform(0.9, 1.5));
    return ray;
}

std::string shown(const Ray& ray, std::uint64_t seed, int n, int i) {
    std::ostringstream out;
    out << ", seed " << seed << ", pair " << n << ", ray " << i << ": " << std::hexfloat
        << ray.org.x << ' ' << ray.org.y << ' ' << ray.org.z << " along " << ray.dir.x << ' '
        << ray.dir.y << ' ' << ray.dir.z;
    return out.str();
}

} // namespace

TEST(instance_is_its_copy) {
    constexpr std::uint64_t kSeed = 61;
    Random random(kSeed);
    long long rays = 0, hits = 0;
    for (int n = 0; n < check::scaled(400); ++n) {
        MeshDesc mesh = someMesh(random);
        if (random.chance(0.2)) {
            const Vec3d away = random.inBox(random.logUniform(1, 1e12));
            for (Vec3d& p : mesh.points) p += away;
        }
        const Transform map = someMap(random);
        SceneFrame frame = meshes::frameFor(mesh, map);
        if (random.chance(0.3)) { // small in a large scene, beside its middle
            frame.scale *= random.logUniform(1e-4, 1);
            frame.centre += random.inBox(0.5 / frame.scale);
        }
        const Pair pair(mesh, map, frame);
        if (pair.number.empty()) continue;
        for (int i = 0; i < 250; ++i) {
            const Ray ray = someRay(random, pair);
            const std::string difference = pair.difference(ray, random);
            ++rays;
            Hit hit;
            hits += pair.copy.shape->intersect(ray, hit);
            CHECK_INFO(difference.empty(), difference << shown(ray, kSeed, n, i));
        }
    }
    std::printf("%lld rays, %lld hits, seed %d\n", rays, hits, static_cast<int>(kSeed));
    CHECK(hits * 4 > rays);
}

// The same through the wide trees of the kernels.
TEST(instance_in_batches_is_its_copy) {
    constexpr std::uint64_t kSeed = 64;
    Random random(kSeed);
    long long rays = 0, hits = 0;
    for (int n = 0; n < check::scaled(150); ++n) {
        const MeshDesc mesh = someMesh(random);
        const Transform map = someMap(random);
        const SceneFrame frame = meshes::frameFor(mesh, map);
        Pair pair(mesh, map, frame);
        if (pair.number.empty()) continue;
        battery::RayList list;
        for (int i = 0; i < 150; ++i) list.push(someRay(random, pair));
        const RaySpan batch = list.span();
        ShapeSet copy;
        copy.add(std::move(pair.copy.shape), ShapeSet::Shadow::Opaque);
        copy.finish(false);
        for (const Isa& kernel : allIsas()) {
            if (!kernel.supported()) continue;
            pair.instance.geometry->finish(true, kernel);
            ShapeSet set;
            set.add(std::make_unique<MeshInstance>(*pair.instance.geometry,
                                                   MovingTransform(pair.instance.sceneFromMesh),
                                                   std::vector<std::uint32_t>{7}, 5),
                    ShapeSet::Shadow::Opaque);
            set.finish(true, kernel);
            std::vector<Hit> found;
            std::vector<std::uint8_t> hidden;
            set.closest(batch, found);
            set.occluded(batch, hidden);
            for (std::size_t i = 0; i < batch.size(); ++i) {
                Hit hit = copy.closest(batch[i]);
                if (hit.isHit()) hit.prim = pair.number[hit.prim];
                CHECK_INFO(found[i] == hit && (hidden[i] != 0) == copy.occluded(batch[i]),
                           kernel.name << ": other hits"
                                       << shown(batch[i], kSeed, n, static_cast<int>(i)));
                ++rays;
                hits += hit.isHit();
            }
            pair.instance.geometry->wide = {};
        }
    }
    std::printf("%lld rays, %lld hits, seed %d\n", rays, hits, static_cast<int>(kSeed));
    CHECK(hits * 4 > rays);
}

// At the time of a ray a moving mesh is the copy that stands where the mesh is then, also where it
// turns itself inside out.
TEST(instance_moves_like_its_copy) {
    constexpr std::uint64_t kSeed = 62;
    Random random(kSeed);
    long long rays = 0, hits = 0, mirrored = 0;
    for (int n = 0; n < check::scaled(100); ++n) {
        MeshDesc mesh = someMesh(random);
        for (Vec3d& p : mesh.points) p = p * 0.25;
        const Transform keys[2] = {random.affine(1.5, 0.3), random.affine(1.5, 0.3)};
        const MovingTransform motion{std::span<const Transform>(keys)};
        MeshGeometry shared = toSharedGeometry(mesh);
        shared.dropDegenerate();
        shared.finish(true);
        const MeshInstance moving(shared, motion, {7}, 5);
        // What moves out of the scene, such as the huge triangles of a soup, has pads of its own.
        const Bounds box = moving.bounds();
        if (max(maxAbs(box.lo), maxAbs(box.hi)) > kSceneExtent) continue;
        for (int k = 0; k < 12; ++k) {
            const auto time = static_cast<float>(random.unit());
            const Transform now = motion.at(static_cast<double>(time));
            mirrored += now.mirrors();
            const Pair pair(mesh, now, {});
            if (pair.number.empty()) continue;
            for (int i = 0; i < 50; ++i) {
                Ray ray = someRay(random, pair);
                ray.time = time;
                Hit a, b;
                const bool hit = moving.intersect(ray, a);
                const bool same = hit == pair.copy.shape->intersect(ray, b) &&
                                  moving.occludes(ray) == pair.copy.shape->occludes(ray) &&
                                  (!hit || pair.areEqual(a, b));
                CHECK_INFO(same, "other hits" << shown(ray, kSeed, n, i));
                ++rays;
                hits += hit;
                if (!hit) continue;
                const Surface s = moving.surface(ray, a), t = pair.copy.shape->surface(ray, b);
                CHECK_INFO(s.p == t.p && s.ng == t.ng && s.ns == t.ns && s.lift == t.lift,
                           "other surfaces" << shown(ray, kSeed, n, i));
                CHECK(box.contains(pair.corner(a.prim, static_cast<std::size_t>(i % 3))));
            }
        }
    }
    std::printf("%lld rays, %lld hits, %lld places mirrored, seed %d\n", rays, hits, mirrored,
                static_cast<int>(kSeed));
    CHECK(hits * 4 > rays && mirrored > 100);
}

} // namespace test_mesh_instance
