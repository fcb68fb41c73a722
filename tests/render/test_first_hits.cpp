// What camera rays meet, found in waves: the same as asking each ray for its point alone.
#include "check.h"
#include "shot.h"

#include "integrate/integrator.h"
#include "render/camera_rays.h"

#include <algorithm>
#include <bit>

namespace test_first_hits {

namespace {

// Shapes of all kinds of surfaces, some bent and with pictures on them; the camera moves and turns.
std::string someScene() {
    shot::writeTexture("first.pfm", 4, 4, [](double u, double v) {
        return Rgb{static_cast<float>(u), static_cast<float>(v), 0.3f};
    });
    return "settings {\n resolution 40 30\n samples 2\n}\n"
           "camera c {\n lens 30\n look_at 0 -9 2  0 0 1.2  0 0 1\n"
           " key\n look_at 1 -8 3  0.3 0 1.2  0.1 0 1\n}\n"
           "light l {\n translate 1 2 5\n color 80 80 80\n}\n"
           "texture t {\n file first.pfm\n}\n"
           "material plain {\n diffuse 1 0.5 0.2\n}\n"
           "material painted {\n diffuse 0.9 0.8 0.7\n diffuse_texture t\n}\n"
           "material bent {\n diffuse 0.2 0.3 0.4\n bump_map t\n bump_strength 0.2\n}\n"
           "infinite_plane floor {\n material plain\n}\n"
           "sphere a {\n translate -1.5 0 1\n material painted\n}\n"
           "sphere b {\n translate 1.2 0.5 0.7\n radius 0.7\n material bent\n}\n"
           "sphere d {\n translate 0.2 -1 0.3\n radius 0.3\n material plain\n}\n"
           "cube e {\n translate 2.8 1 0.5\n scale 0.5 0.5 0.5\n material painted\n}\n"
           "cylinder f {\n translate -3 1 1\n scale 0.5 0.5 1\n material plain\n}\n";
}

Rgb albedoAt(const SceneMaterial& of, Vec2 uv) {
    return of.pictures->diffuse ? of.diffuse * of.pictures->diffuse->color(uv) : of.diffuse;
}

FirstHit alone(const Scene& scene, const Ray& ray) {
    const Hit hit = scene.shapes().closest(ray);
    if (!hit.isHit()) return {};
    const Surface surface = scene.shapes().shapes[hit.shape]->surface(ray, hit);
    const SceneMaterial& of = scene.materials()[surface.material];
    const Vec3 bent =
        of.bendsNormals() ? shading::bentNormal(scene, ray, hit, surface) : surface.ns;
    const float side = dot(ray.dir, surface.ng) <= 0 ? 1.0f : -1.0f;
    const ShadedPoint::Side eyeSide{surface.ng * side, surface.ns * side, bent * side};
    const Vec3 toEye = -normalize(ray.dir);
    const Vec3d position = toDouble(surface.p);
    const Camera::Axes axes = scene.camera().axesAt(ray.time);
    return {.hit = true,
            .depth =
                static_cast<float>(dot(position - axes.eye, axes.forward) / scene.frame().scale),
            .normal = dot(eyeSide.n, toEye) > 0 ? eyeSide.n : shading::turnedAway(toEye, eyeSide),
            .position = toFloat(scene.frame().worldPoint(position)),
            .albedo = albedoAt(of, surface.uv),
            .object = surface.object + 1,
            .uv = surface.uv};
}

bool sameBits(float a, float b) {
    return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}
bool sameBits(Vec3 a, Vec3 b) {
    return sameBits(a.x, b.x) && sameBits(a.y, b.y) && sameBits(a.z, b.z);
}
bool same(const FirstHit& a, const FirstHit& b) {
    if (a.hit != b.hit) return false;
    return !a.hit || (sameBits(a.depth, b.depth) && sameBits(a.normal, b.normal) &&
                      sameBits(a.position, b.position) &&
                      sameBits(Vec3{a.albedo.r, a.albedo.g, a.albedo.b},
                               Vec3{b.albedo.r, b.albedo.g, b.albedo.b}) &&
                      a.object == b.object);
}

} // namespace

TEST(firstHitsAreThoseOfSingleRays) {
    const SceneDesc desc = shot::parse(someScene());
    for (const Isa& kernel : allIsas()) {
        if (!kernel.supported()) continue;
        for (const IntegratorKind kind : {IntegratorKind::Normal, IntegratorKind::Uv})
            for (const bool textures : {true, false}) { // without them lanes find surfaces
                RenderSettings settings;
                settings.picture = desc.settings;
                settings.textureFolder = shot::textureFolder();
                settings.isa = &kernel, settings.picture.integrator = kind;
                settings.switches.textures = textures;
                settings.specialise = !textures || kind == IntegratorKind::Uv;
                const Scene scene(desc, {"scene", ""}, settings);
                const IntegratorContext context(scene, settings);
                SampleChunk chunk;
                CameraRays(context).make({0, 0, 40, 30}, 0, 2, chunk);
                chunk.first.assign(chunk.cameraRays.size(), FirstHit{});
                chunk.radiance.assign(chunk.cameraRays.size(), Rgb{});
                WaveMemory memory;
                RayCounts counts;
                std::uint64_t cameraHits = 0, hits = 0;
                memory.points.at.setMaterials(scene.materials());
                integrateFirstHit(context, chunk, memory, counts, cameraHits);
                int wrong = 0;
                std::vector<bool> seen(desc.objects.size() + 1);
                for (std::size_t k = 0; k < chunk.cameraRays.size(); ++k) {
                    const FirstHit wanted = alone(scene, chunk.cameraRays.ray(k));
                    hits += wanted.hit, seen[wanted.object] = true;
                    bool isRight = same(chunk.first[k], wanted);
                    if (kind == IntegratorKind::Uv && wanted.hit)
                        isRight &= sameBits(chunk.first[k].uv.x, wanted.uv.x) &&
                                   sameBits(chunk.first[k].uv.y, wanted.uv.y);
                    wrong += !isRight;
                }
                CHECK_INFO(wrong == 0,
                           kernel.name << ": " << wrong << " rays, textures " << textures);
                CHECK_EQUAL(cameraHits, hits);
                CHECK_EQUAL(std::count(seen.begin(), seen.end(), true),
                            static_cast<std::ptrdiff_t>(seen.size()));
            }
    }
}

} // namespace test_first_hits
