#include "verify/scenes.h"

#include "verify/stage.h"

#include <array>

namespace scenes {

namespace {

using meshes::Random;
using Kind = ObjectDesc::Kind;

// Every kind of shape, some seen from one side only, over a checkered plane without end.
SceneDesc shapes(Random& random) {
    Stage s(random, 4);
    for (const Kind kind : {Kind::Sphere, Kind::Cube, Kind::Plane, Kind::Disk, Kind::Cylinder,
                            Kind::Cylinder, Kind::Cone, Kind::Cone}) {
        ObjectDesc& object = s.scatter(kind, 0.8, 0.5, s.shiny());
        object.radius = s.uniform(0.5, 1.2);
        object.topRadius = random.chance(0.5) ? 0 : s.uniform(0.2, 1);
        object.caps = random.chance(0.5);
        object.sides = static_cast<ObjectDesc::Sides>(random.below(3));
    }
    const Handle dark = s.material({0.1, 0.1, 0.1}), light = s.material({0.8, 0.8, 0.7});
    const Transform below =
        Transform::translate({0, 0, -0.5}) * Transform::rotate(kUp, s.uniform(0, 1));
    s.add(Kind::InfinitePlane, below, dark).materials.push_back(light);
    return s.desc;
}

// Meshes that are merged, one with smooth normals and one with two materials, beside instances.
SceneDesc meshesAndInstances(Random& random) {
    Stage s(random, 4);
    s.scatterMesh(s.mesh(meshes::uvSphere(16, 8)), 0.8, 0.8, s.shiny());
    MeshDesc ring = meshes::torus(0.3, 24, 12); // its points are places in the world
    for (Vec3d& point : ring.points) point = point * 0.7 + Vec3d{0.3, -0.4, 0.6};
    s.add(Kind::Mesh, {}, s.shiny()).mesh = s.mesh(ring);
    MeshDesc two = meshes::icosphere(2);
    for (std::size_t i = 0; i < two.triangles.size(); ++i)
        two.triangleMaterials.push_back(random.below(2));
    s.scatterMesh(s.mesh(two), 0.8, 0.5, s.shiny()).materials.push_back(s.shiny());
    const Handle ball = s.mesh(meshes::icosphere(2)), box = s.mesh(meshes::cube());
    for (int i = 0; i < 10; ++i)
        s.scatterMesh(i % 2 ? ball : box, 0.5, 0.3, s.shiny()).sides =
            static_cast<ObjectDesc::Sides>(random.below(3));
    return s.desc;
}

// Glass in glass, of spheres and of meshes, and mirrors that show it again.
SceneDesc glassAndMirrors(Random& random) {
    Stage s(random, 4);
    s.desc.settings.maxDepth = 10;
    const Vec3d centre = s.place(1);
    const Transform inner = Transform::scale(s.uniform(0.3, 0.8));
    s.add(Kind::Sphere, Transform::translate(centre), s.glass(1.5));
    s.add(Kind::Sphere, Transform::translate(centre) * inner, s.glass(1.33));
    s.scatterMesh(s.mesh(meshes::cube()), 0.9, 0.5, s.glass(1.7));
    s.scatter(Kind::Cylinder, 0.8, 0.4, s.glass(1.4));
    s.scatter(Kind::Sphere, 0.6, 0.5, s.mirror());
    const Handle chrome = s.mirror();
    s.at(chrome).fresnel = MaterialDesc::Fresnel::Schlick;
    s.scatter(Kind::Cube, 0.8, 0.4, chrome);
    s.scatter(Kind::Sphere, 0.5, 0.5, s.shiny());
    return s.desc;
}

// Every kind of lamp that casts soft shadows; some can be seen.
SceneDesc softLights(Random& random) {
    Stage s(random, 4);
    s.desc.settings.lightSamples = 2;
    s.scatter(Kind::Sphere, 0.8, 0.7, s.shiny());
    s.scatter(Kind::Cone, 0.8, 0.6, s.shiny());
    s.scatterMesh(s.mesh(meshes::torus(0.3, 16, 8)), 0.8, 0.6, s.shiny());
    using Lamp = LightDesc::Kind;
    LightDesc& panel = s.lamp(Lamp::Rectangle, {-3, -2, 4}, 15);
    panel.size = {1.5, 1};
    panel.visible = true;
    LightDesc& disk = s.lamp(Lamp::Disk, {1.5, 2, 3}, 12);
    disk.size = {1, 0.5};
    disk.spreadDeg = 120;
    LightDesc& ball = s.lamp(Lamp::Sphere, {2.5, -1, 1.6}, 20);
    ball.radius = 0.3;
    ball.visible = true;
    s.lamp(Lamp::Sun, {2, 1, 4}, 0.5).angleDeg = 8;
    LightDesc& spot = s.lamp(Lamp::Spot, {0, -4, 4}, 40);
    spot.coneAngleDeg = 40;
    spot.blend = 0.4;
    spot.radius = 0.2;
    return s.desc;
}

// Camera, shapes and instances move, along lines and around corners.
SceneDesc motion(Random& random) {
    Stage s(random, 8);
    s.desc.cameras[0].worldFromCamera.push_back(
        Transform::lookAt(s.eye + Vec3d{0.05, 0, 0}, {0, 0, 0.6}, kUp).rows());
    const Handle ball = s.mesh(meshes::icosphere(2));
    const auto move = [&](ObjectDesc& object, int keys) {
        const Transform first = Transform::fromRows(object.worldFromObject[0]);
        for (int i = 1; i < keys; ++i) {
            const Transform there = Transform::translate(random.inBox(0.3));
            const Vec3d axis = random.direction();
            const Transform turned = Transform::rotate(axis, s.uniform(0, 1));
            object.worldFromObject.push_back((there * first * turned).rows());
        }
    };
    for (const Kind kind : {Kind::Sphere, Kind::Cube, Kind::Cylinder, Kind::Disk})
        move(s.scatter(kind, 0.8, 0.5, s.shiny()), 2);
    for (const int keys : {1, 2, 3}) move(s.scatterMesh(ball, 0.6, 0.4, s.shiny()), keys);
    return s.desc;
}

// A lens, round or with blades, before rough mirrors and rough glass.
SceneDesc lensAndGlossy(Random& random) {
    Stage s(random, 8);
    CameraDesc& camera = s.desc.cameras[0];
    camera.apertureRadius = 0.1;
    camera.focusDistance = 6;
    camera.apertureRotationDeg = s.uniform(0, 60);
    camera.apertureBlades = camera.apertureRotationDeg < 30 ? 0 : 6; // 0: round
    const Handle brushed = s.mirror(), frosted = s.glass(1.5), metal = s.shiny();
    s.at(brushed).roughness = 0.3;
    s.at(frosted).roughness = 0.25;
    s.at(metal).specularModel = MaterialDesc::SpecularModel::Ashikhmin;
    s.scatter(Kind::Sphere, 0.8, 0.7, brushed);
    s.scatter(Kind::Sphere, 0.8, 0.6, frosted);
    s.scatter(Kind::Cube, 0.7, 0.4, metal);
    s.scatter(Kind::Cylinder, 0.7, 0.4, brushed);
    return s.desc;
}

// Foils, one before the other, of shapes and of meshes; a thing that glows.
SceneDesc transparent(Random& random) {
    Stage s(random, 4);
    const Handle ball = s.mesh(meshes::icosphere(2));
    const auto foil = [&] {
        const Handle handle = s.material(s.colour(0.1, 0.4));
        s.at(handle).opacity = s.uniform(0.1, 0.6);
        s.at(handle).filter = s.colour(0.3, 1);
        return handle;
    };
    for (const Kind kind : {Kind::Plane, Kind::Sphere, Kind::Cylinder, Kind::Disk})
        s.scatter(kind, 1, 0.7, foil());
    for (int i = 0; i < 3; ++i) s.scatterMesh(ball, 0.8, 0.5, i == 1 ? s.shiny() : foil());
    s.scatterMesh(s.mesh(meshes::torus(0.3, 16, 8)), 0.8, 0.6, foil());
    const Handle glow = s.material({0.1, 0.1, 0.1});
    s.at(glow).emission = s.colour(0.2, 0.9);
    s.scatter(Kind::Cone, 0.8, 0.4, glow);
    return s.desc;
}

// The other camera, with the other samplers, filters, specular models and lit sides.
SceneDesc orthographic(Random& random) {
    Stage s(random, 4);
    SettingsDesc& settings = s.desc.settings;
    constexpr std::array samplers = {SettingsDesc::Sampler::Stratified,
                                     SettingsDesc::Sampler::Random, SettingsDesc::Sampler::Grid,
                                     SettingsDesc::Sampler::Corners};
    settings.sampler = samplers[random.below(samplers.size())];
    settings.filter = static_cast<SettingsDesc::Filter>(random.below(4));
    settings.jitter = random.chance(0.5);
    CameraDesc& camera = s.desc.cameras[0];
    camera.kind = CameraDesc::Kind::Orthographic;
    camera.orthoScale = s.uniform(5, 8);
    camera.shiftX = 0.05;
    camera.clipStart = 0.5;
    for (const Kind kind : {Kind::Sphere, Kind::Cube, Kind::Cone}) {
        const Handle handle = s.shiny();
        s.at(handle).specularModel = MaterialDesc::SpecularModel::Phong;
        if (random.chance(0.5)) s.at(handle).litSide = MaterialDesc::LitSide::Outside;
        s.scatter(kind, 0.8, 0.6, handle);
    }
    LightDesc& spot = s.lamp(LightDesc::Kind::Spot, {3, -3, 4}, 2);
    spot.attenuation = {0, 0, 1};
    spot.cosineFalloff = true;
    return s.desc;
}

constexpr Maker kMakers[] = {
    {"shapes", shapes},           {"meshes", meshesAndInstances},
    {"glass", glassAndMirrors},   {"soft lights", softLights},
    {"motion", motion},           {"lens", lensAndGlossy},
    {"transparent", transparent}, {"orthographic", orthographic},
};

} // namespace

std::span<const Maker> makers() { return kMakers; }

} // namespace scenes
