// T25: where light ends on a coarse mesh with smooth normals. Facets that face away from the light
// while their normals still see it make a jagged black edge; the shading should run out as on the
// curved surface that the normals stand for.
#include "base/math.h"
#include "base/text.h"
#include "verify/groups.h"
#include "verify/scene_trials.h"

#include <algorithm>

namespace battery {

namespace {

constexpr int kTerminatorSide = 96; // of the pictures, in pixels

// A ball of radius 1, as a mesh of 16 x 8 patches or as a sphere, under a sun at an angle to the
// view.
SceneDesc ball(bool asMesh, double sunDeg) {
    SceneDesc desc;
    desc.settings.width = desc.settings.height = kTerminatorSide;
    desc.settings.samplesPerPixel = 1;
    desc.settings.jitter = false;
    CameraDesc& camera = desc.cameras.emplace_back();
    camera.kind = CameraDesc::Kind::Orthographic;
    camera.orthoScale = 2;
    camera.worldFromCamera = {Transform::lookAt({0, -5, 0}, {0, 0, 0}, {0, 0, 1}).rows()};
    LightDesc& sun = desc.lights.emplace_back();
    sun.kind = LightDesc::Kind::Sun;
    const double a = radians(sunDeg);
    sun.worldFromLight =
        Transform::lookAt({exact::sin(a), -exact::cos(a), 0.3}, {0, 0, 0}, {0, 0, 1}).rows();
    MaterialDesc& white = desc.materials.emplace_back();
    white.diffuse = {1, 1, 1};
    ObjectDesc& object = desc.objects.emplace_back();
    object.materials = {0};
    // Turned, so that no edge of the mesh runs along the edge of the light.
    object.worldFromObject = {
        (Transform::rotate({0, 0, 1}, 0.3) * Transform::rotate({1, 0, 0}, 0.25)).rows()};
    if (!asMesh) return desc;
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    desc.meshes.push_back(meshes::uvSphere(16, 8));
    return desc;
}

struct Step {
    double height = 0;
    int x = 0, y = 0;
};

// The largest difference of neighbours whose normals are those of a ball inside 0.9 of its outline.
// The normals of the mesh reach as far as that nearer to its middle: by their place, a crescent
// that is all but out of sight on the ball would be compared with one that is in full view on the
// mesh.
Step steepest(const SceneDesc& desc) {
    const Picture picture = scenes::render(desc, [](RenderSettings& s) { s.aovs = {Aov::Normal}; });
    const Image &image = picture.color, &normals = picture.aovs[0].image;
    const auto isInside = [&](int x, int y) { // the camera looks along +y
        return -normals.pixel(x, y).g > std::sqrt(1 - 0.81f);
    };
    Step worst;
    for (int y = 0; y + 1 < kTerminatorSide; ++y)
        for (int x = 0; x + 1 < kTerminatorSide; ++x)
            for (const auto& [nx, ny] : {std::pair{x + 1, y}, std::pair{x, y + 1}}) {
                if (!isInside(x, y) || !isInside(nx, ny)) continue;
                const double d = std::fabs(static_cast<double>(image.pixel(x, y).g) -
                                           static_cast<double>(image.pixel(nx, ny).g));
                if (d > worst.height) worst = {d, x, y};
            }
    return worst;
}

Tally terminator(const Effort& effort) {
    return inBatches(effort, 25, 12, [](meshes::Random& random, Tally& tally) {
        const double sunDeg = random.uniform(0, 180);
        const Step mesh = steepest(ball(true, sunDeg));
        const Step sphere = steepest(ball(false, sunDeg));
        if (sphere.height < 1e-3) return; // the lit side is not to be seen
        ++tally.cases;
        tally.measure(mesh.height / sphere.height, [&] {
            return cat("sun at ", sunDeg, " degrees, pixel ", mesh.x, " ", mesh.y);
        });
    });
}

constexpr Row kTerminatorRows[] = {
    {"T25", "steepest step of the light on a 16x8 ball with smooth normals", "of the sphere's", 3,
     true, terminator},
};

} // namespace

std::span<const Row> terminatorRows() { return kTerminatorRows; }

} // namespace battery
