// T15: scenes full of triangles that are none. They are counted and left out, the picture has a
// value everywhere, and the good ones cost what they cost alone.
#include "accel/kernels/kernels.h"
#include "base/error.h"
#include "base/text.h"
#include "desc/validate.h"
#include "render/render.h"
#include "scene/scene.h"
#include "verify/groups.h"
#include "verify/timing.h"

#include <limits>

namespace battery {

namespace {

using meshes::Random;

constexpr int kHostileSide = 40; // of the pictures, in pixels

SceneDesc ballUnderSun(int segments, int rings) {
    SceneDesc desc;
    desc.settings.width = desc.settings.height = kHostileSide;
    desc.settings.samplesPerPixel = 1;
    CameraDesc& camera = desc.cameras.emplace_back();
    camera.worldFromCamera = {Transform::lookAt({0.3, -4, 1}, {0, 0, 0}, {0, 0, 1}).rows()};
    LightDesc& sun = desc.lights.emplace_back();
    sun.kind = LightDesc::Kind::Sun;
    sun.worldFromLight = Transform::lookAt({1, -2, 2}, {0, 0, 0}, {0, 0, 1}).rows();
    desc.meshes.push_back(meshes::uvSphere(segments, rings));
    MaterialDesc& shiny = desc.materials.emplace_back();
    shiny.mirror = {0.3, 0.3, 0.3};
    ObjectDesc& object = desc.objects.emplace_back();
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    object.materials = {0};
    return desc;
}

// The mesh gets a triangle of corners of its own, with the normals and uvs of the first one.
void addTriangle(MeshDesc& mesh, Vec3d a, Vec3d b, Vec3d c) {
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    mesh.points.insert(mesh.points.end(), {a, b, c});
    mesh.triangles.push_back({first, first + 1, first + 2});
    if (!mesh.normalTriangles.empty()) mesh.normalTriangles.push_back(mesh.normalTriangles[0]);
    if (!mesh.uvTriangles.empty()) mesh.uvTriangles.push_back(mesh.uvTriangles[0]);
}

// Triangles without area after rounding to float as well: points, segments, three on a line of an
// axis, and what is smaller than any float. Within [-1,1]^3.
void addFlat(MeshDesc& mesh, Random& random) {
    const Vec3d p = random.inBox(1), q = random.inBox(1);
    switch (random.below(4)) {
    case 0: return addTriangle(mesh, p, p, p);
    case 1: return random.chance(0.5) ? addTriangle(mesh, p, p, q) : addTriangle(mesh, p, q, p);
    case 2: {
        const std::uint32_t axis = random.below(3);
        Vec3d a = p, b = p;
        a[axis] = random.uniform(-1, 1), b[axis] = random.uniform(-1, 1);
        return addTriangle(mesh, p, a, b);
    }
    default: {
        const auto denormal = [&] { return 4.9e-324 * random.below(1000); };
        return addTriangle(mesh, {denormal(), denormal(), denormal()},
                           {denormal(), denormal(), denormal()},
                           {denormal(), denormal(), denormal()});
    }
    }
}

struct Hostile {
    SceneDesc desc;
    std::string what;
    std::uint64_t flat = 0; // triangles without area
};

Hostile someHostile(Random& random) {
    Hostile out{ballUnderSun(16, 8), {}, 0};
    MeshDesc& mesh = out.desc.meshes[0];
    const std::size_t clean = mesh.triangles.size(), added = 1 + random.below(200);
    switch (random.below(5)) {
    case 0:
        out.what = "flat ones";
        for (std::size_t i = 0; i < added; ++i) addFlat(mesh, random);
        out.flat = added;
        break;
    case 1: // next to which all others are a point, but not for a camera that is near them
        out.what = "one of 1e38";
        addTriangle(mesh, {1e38, 3e38, 1e38}, {3e38, 2e38, 3e38}, {2e38, 1e38, 2e38});
        break;
    case 2:
        out.what = "all of 1e38";
        for (Vec3d& p : mesh.points) p = p * 1e38;
        out.desc.cameras[0].worldFromCamera = {
            Transform::lookAt({0.3e38, -4e38, 1e38}, {0, 0, 0}, {0, 0, 1}).rows()};
        break;
    case 3:
        out.what = "all of 1e-300";
        for (Vec3d& p : mesh.points) p = p * 1e-300;
        out.desc.cameras[0].worldFromCamera = {
            Transform::lookAt({0.3e-300, -4e-300, 1e-300}, {0, 0, 0}, {0, 0, 1}).rows()};
        break;
    default:
        out.what = "duplicates, some of them turned over";
        for (std::size_t i = 0; i < added; ++i) {
            const MeshDesc::Corners c = mesh.triangles[random.below(clean)];
            const Vec3d p = mesh.points[c[0]], q = mesh.points[c[1]], r = mesh.points[c[2]];
            random.chance(0.5) ? addTriangle(mesh, p, q, r) : addTriangle(mesh, r, q, p);
        }
    }
    // A second use makes it an instance, in a frame of its own.
    if (random.chance(0.3)) {
        out.desc.objects.push_back(out.desc.objects[0]);
        if (out.what == "one of 1e38") out.flat = clean;
        out.what += ", twice";
    }
    return out;
}

bool isFinite(const Image& image) {
    for (const Rgb& c : image.pixels())
        if (!(std::fabs(c.r) + std::fabs(c.g) + std::fabs(c.b) < kInfinityF)) return false;
    return true;
}

Picture rendered(const SceneDesc& desc, AccelKind accel, Stats& stats, const Isa& isa = oneLane()) {
    RenderSettings settings;
    settings.picture = desc.settings;
    settings.accel = accel;
    settings.isa = &isa;
    settings.copiedTriangles = 0; // what is used twice is an instance
    const Scene scene(desc, {}, settings);
    scene.describe(stats);
    return render(scene, settings, {}, stats);
}

// NaN and infinite corners are no scene at all: the checks of every reader refuse them.
bool isRefused(SceneDesc desc, Random& random) {
    const double bad[] = {std::numeric_limits<double>::quiet_NaN(), kInfinity, -kInfinity};
    auto& points = desc.meshes[0].points;
    points[random.below(points.size())][random.below(3)] = bad[random.below(3)];
    Diagnostics diagnostics;
    try {
        validate(desc, {"hostile", ""}, diagnostics);
    } catch (const Error&) {
        return true;
    }
    return false;
}

Tally pictures(const Effort& effort) {
    return inBatches(effort, 15, 15, [](Random& random, Tally& tally) {
        const Hostile scene = someHostile(random);
        Stats stats, plainStats;
        const Picture picture = rendered(scene.desc, AccelKind::Bvh, stats);
        const Picture plain = rendered(scene.desc, AccelKind::None, plainStats);
        const auto failIf = [&](bool wrong, const std::string& why) {
            ++tally.cases;
            if (wrong) tally.fail([&] { return cat(scene.what, ": ", why); });
        };
        failIf(!isFinite(picture.color), "a pixel has no value");
        failIf(stats.nanSamples > 0, cat(stats.nanSamples, " samples have no value"));
        failIf(stats.degeneratePrimitives != scene.flat,
               cat(stats.degeneratePrimitives, " counted of ", scene.flat));
        failIf(!(picture.color == plain.color), "another picture without the tree");
        failIf(!isRefused(scene.desc, random), "a corner at NaN or infinity is let through");
    });
}

// A tenth of the triangles more, all of them bad: with the kernel that pictures are made with here,
// and as many rays as a small picture has.
Tally hostileTime(const Effort& effort) {
    SceneDesc clean = ballUnderSun(100, 51);
    clean.settings.width = clean.settings.height = 300;
    SceneDesc dirty = clean;
    Random random(151);
    MeshDesc& mesh = dirty.meshes[0];
    const std::size_t count = mesh.triangles.size();
    for (std::size_t i = 0; i < count / 20; ++i) {
        addFlat(mesh, random);
        const MeshDesc::Corners c = mesh.triangles[random.below(count)];
        addTriangle(mesh, mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]);
    }
    const int turns = static_cast<int>(clamp(24 * effort.factor, 24.0, 200.0));
    Tally tally;
    tally.cases = mesh.triangles.size();
    const auto render = [&isa = bestIsa()](const SceneDesc& desc) {
        Stats stats;
        rendered(desc, AccelKind::Bvh, stats, isa);
    };
    tally.measure(timeRatio(
                      turns, [&] { render(dirty); }, [&] { render(clean); }),
                  [] { return std::string("a ball of 10,000 triangles"); });
    return tally;
}

constexpr Row kHostileRows[] = {
    {"T15b", "hostile meshes: values, counts, the same without tree", "", 0, true, pictures},
    timed({"T15c", "time with a tenth more of bad triangles", "of clean", 1.2, false, hostileTime}),
};

} // namespace

std::span<const Row> hostileRows() { return kHostileRows; }

} // namespace battery
