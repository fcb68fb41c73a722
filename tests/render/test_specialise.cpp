// What a scene does not need is left out, and nothing of it shows: parts of surfaces, empty tiles,
// shadow rays without light.
#include "check.h"
#include "shot.h"

#include "render/empty_tiles.h"
#include "verify/scenes.h"

#include <cstring>

namespace test_specialise {

namespace {

const shot::TopView kView{.pixels = 24, .side = 4, .samples = 2};
const std::string kBall =
    "sphere s {\n material m\n}\nsphere t {\n translate 1.2 0 0.3\n radius 0.5\n}\n";
const std::string kPoint = "light l {\n translate 1 2 5\n color 80 80 80\n}\n";
const std::string kPlain = "material m {\n diffuse 1 0.5 0.2\n specular 0.3 0.3 0.3\n}\n";

bool sameBits(const Image& a, const Image& b) {
    return a.width() == b.width() && a.height() == b.height() &&
           std::memcmp(a.pixels().data(), b.pixels().data(), a.pixels().size_bytes()) == 0;
}

shot::Shot general(const std::string& text) {
    return shot::render(text, [](RenderSettings& s) { s.specialise = false; });
}

// Renders both ways; the specialised shot.
shot::Shot checkedShot(const std::string& text) {
    shot::Shot special = shot::render(text);
    const shot::Shot all = general(text);
    CHECK_INFO(sameBits(special.color, all.color), "differs from the general form:\n" << text);
    CHECK_EQUAL(special.stats.rays.camera, all.stats.rays.camera);
    CHECK_EQUAL(special.stats.cameraHits, all.stats.cameraHits);
    CHECK_EQUAL(special.stats.rays.shadow, all.stats.rays.shadow);
    CHECK_EQUAL(special.stats.rays.tracedShadow, all.stats.rays.tracedShadow);
    return special;
}

} // namespace

// Scenes of every kind: the bits are those of the general form.
TEST(specialisedFormsGiveTheSameBits) {
    shot::writeTexture("spots.pfm", 2, 2, [](double u, double v) {
        return Rgb{static_cast<float>(u), static_cast<float>(v), 0.5f};
    });
    const auto rectangle = [](const std::string& visible) {
        return "light k {\n type rectangle\n visible " + visible +
               "\n look_at -2 0 4 0 0 0 0 1 0\n size 1 1\n color 9 9 9\n}\n";
    };
    const std::string mirror = "material m {\n diffuse 0.2 0.2 0.2\n mirror 0.7 0.7 0.7\n}\n";
    const std::string textured =
        "texture t {\n file spots.pfm\n}\nmaterial m {\n diffuse_texture t\n diffuse 1 1 1\n";
    const std::string pane = "material m {\n diffuse 1 1 1\n opacity 0.5\n";
    const std::string kCases[] = {
        kPlain + kPoint,
        kPlain + rectangle("false"),
        kPlain + kPoint + rectangle("true"),
        mirror + kPoint,
        mirror.substr(0, mirror.size() - 2) + " roughness 0.1\n}\n" + kPoint,
        textured + "}\n" + kPoint,
        pane + "}\n" + kPoint,
        textured + " mirror 0.5 0.5 0.5\n}\n" + rectangle("true"),
        pane + " mirror 0.2 0.2 0.2\n}\n" + kPoint + rectangle("true"),
    };
    for (const std::string& text : kCases) {
        const std::string whole = kView.text() + kBall + text;
        CHECK_INFO(shot::largest(checkedShot(whole).color) > 0.1, whole);
    }
}

struct TileCounts {
    int empty = 0, blank = 0;
};

// No tile of `side` by `side` pixels may be called empty of which a ray meets anything.
void checkEmptyTiles(const SceneDesc& desc, int side, const std::string& which,
                     TileCounts& counts) {
    RenderSettings settings;
    settings.picture = desc.settings;
    const Scene scene(desc, {"scene", ""}, settings);
    const IntegratorContext context(scene, settings);
    const CameraRays rays(context);
    const EmptyTiles tiles(context, rays);
    for (int y = 0; y + side <= kView.pixels; y += side)
        for (int x = 0; x + side <= kView.pixels; x += side) {
            SampleChunk chunk;
            rays.make({x, y, x + side, y + side}, 0, settings.picture.samplesPerPixel, chunk);
            bool isBlank = true;
            for (std::size_t k = 0; k < chunk.cameraRays.size(); ++k)
                isBlank &= !scene.shapes().closest(chunk.cameraRays.ray(k)).isHit();
            const bool isEmpty = tiles.isEmpty({x, y, x + side, y + side});
            CHECK_INFO(isBlank || !isEmpty, which << ", tile " << x << " " << y);
            counts.empty += isEmpty, counts.blank += isBlank;
        }
}

// A tile is called empty only if no ray of its places meets anything; and most of those are found
// whose neighbourhood shows nothing.
TEST(emptyTilesAreEmpty) {
    meshes::Random random(603);
    TileCounts counts;
    for (int i = 0; i < check::scaled(40); ++i) {
        SceneDesc desc = shot::parse(kView.text() + kPlain + kBall);
        for (ObjectDesc& object : desc.objects) {
            const Transform there = Transform::translate(random.inBox(2));
            object.worldFromObject = {(there * random.affine(4, 0.1)).rows()};
        }
        CameraDesc& camera = desc.cameras[0];
        camera.kind =
            random.chance(0.5) ? CameraDesc::Kind::Orthographic : CameraDesc::Kind::Perspective;
        camera.orthoScale = random.uniform(2, 12);
        camera.lensMm = random.logUniform(10, 90);
        camera.clipStart = 0;
        const Vec3d eye = random.direction() * random.uniform(3, 9);
        camera.worldFromCamera = {Transform::lookAt(eye, random.inBox(2), {0, 0, 1}).rows()};
        desc.settings.filterWidth = random.uniform(0, 3);
        desc.settings.samplesPerPixel = 4;
        if (random.chance(0.3)) desc.settings.sampler = SettingsDesc::Sampler::Corners;
        const int side = 1 + static_cast<int>(random.below(6));
        checkEmptyTiles(desc, side, "scene " + std::to_string(i) + " of seed 603", counts);
    }
    CHECK_INFO(counts.empty > counts.blank / 2, // boxes are larger than spheres
               counts.empty << " of " << counts.blank);
}

// From far away, where pixels are as small as what rays are rounded to, a ball may be seen by a
// tile whose view it misses by as much.
TEST(emptyTilesOfTelescopesAreEmpty) {
    meshes::Random random(604);
    TileCounts counts;
    for (int i = 0; i < check::scaled(40); ++i) {
        SceneDesc desc = shot::parse(kView.text() + kPlain + "sphere s {\n material m\n}\n");
        const double away = random.logUniform(1e3, 1e5),
                     wide = away * random.logUniform(1e-5, 1e-2);
        desc.objects[0].worldFromObject = {(Transform::translate(random.inBox(wide / 2)) *
                                            Transform::scale(wide * random.logUniform(0.005, 0.1)))
                                               .rows()};
        CameraDesc& camera = desc.cameras[0];
        camera.kind =
            random.chance(0.5) ? CameraDesc::Kind::Orthographic : CameraDesc::Kind::Perspective;
        camera.orthoScale = wide;
        camera.lensMm = camera.sensorWidthMm * away / wide;
        camera.clipStart = 0;
        const Vec3d eye = random.direction() * away;
        camera.worldFromCamera = {Transform::lookAt(eye, {}, {0, 0, 1}).rows()};
        desc.settings.samplesPerPixel = 4;
        checkEmptyTiles(desc, 1 + static_cast<int>(random.below(6)),
                        "scene " + std::to_string(i) + " of seed 604", counts);
    }
    CHECK_INFO(counts.empty > counts.blank / 10, counts.empty << " of " << counts.blank);
}

// Whatever is in the way of telling: surfaces without end, lenses, moving cameras, environments.
TEST(emptyTilesNeedAClearView) {
    const auto isEmpty = [](const std::string& text) {
        const SceneDesc desc = shot::parse(kView.text() + text);
        RenderSettings settings;
        settings.picture = desc.settings;
        settings.textureFolder = shot::textureFolder();
        const Scene scene(desc, {"scene", ""}, settings);
        const IntegratorContext context(scene, settings);
        const CameraRays rays(context);
        return EmptyTiles(context, rays).isEmpty({0, 0, 4, 4});
    };
    CHECK(isEmpty(kPlain + kBall));
    CHECK(!isEmpty(kPlain + "infinite_plane s {\n material m\n}\n"));
    CHECK(!isEmpty(kPlain + "sphere s {\n radius 5\n}\n"));
    const std::string picture = "texture t {\n file sky.pfm\n}\nworld {\n environment t\n}\n";
    shot::writeTexture("sky.pfm", 2, 1, [](double, double) { return Rgb{1, 1, 1}; });
    CHECK(!isEmpty(picture + kPlain + kBall));
}

// No light in the place of a sample, no ray: outside of a spot's cone, behind the horizon, from a
// black lamp.
TEST(shadowRaysThatCannotMatter) {
    const auto shadowRays = [](const std::string& text) {
        return checkedShot(kView.text() + text).stats.rays.tracedShadow;
    };
    const std::string floor = kPlain + "plane p {\n scale 3 3 1\n material m\n}\n";
    const std::string block = "cube c {\n translate 0 0 2\n scale 0.2 0.2 0.2\n}\n";
    const auto spot = [](const std::string& target) {
        return "light l {\n type spot\n cone_angle 20\n color 9 9 9\n look_at 0 0 4 " + target +
               " 0 1 0\n}\n";
    };
    CHECK(shadowRays(floor + block + spot("0 0 0")) > 20);
    CHECK_EQUAL(shadowRays(floor + block + spot("9 0 4")), 0u); // over the floor
    CHECK_EQUAL(shadowRays(floor + block + "light l {\n translate 0 0 -4\n}\n"), 0u);
    CHECK_EQUAL(shadowRays(floor + block + "light l {\n translate 0 0 4\n color 0 0 0\n}\n"), 0u);
}

} // namespace test_specialise
