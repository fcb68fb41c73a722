// Stage: a floor, a lamp, a sky and a camera that looks at the origin from some side. Scenes of the
// battery are made by adding to it, at places that random numbers choose.
#pragma once

#include "base/math.h"
#include "base/text.h"
#include "verify/meshes.h"

namespace scenes {

inline constexpr Vec3d kUp{0, 0, 1};

class Stage {
public:
    explicit Stage(meshes::Random& random, int samples) : random_(random) {
        SettingsDesc& settings = desc.settings;
        settings.width = 32;
        settings.height = 24;
        settings.samplesPerPixel = samples;
        settings.seed = random.below(1u << 31);
        desc.world.background = {0.2, 0.3, 0.5};
        desc.world.ambient = {0.05, 0.05, 0.05};
        CameraDesc& camera = desc.cameras.emplace_back();
        camera.name = "camera";
        const double azimuth = random.uniform(0, kTwoPi);
        eye = {6 * exact::cos(azimuth), 6 * exact::sin(azimuth), random.uniform(1, 5)};
        camera.worldFromCamera = {Transform::lookAt(eye, {0, 0, 0.6}, kUp).rows()};
        lamp(LightDesc::Kind::Point, {eye.x - 2, eye.y + 1, 5}, 60);
        add(ObjectDesc::Kind::Plane, Transform::scale({6, 6, 1}), material(colour(0.4, 0.8)));
    }

    double uniform(double lo, double hi) { return random_.uniform(lo, hi); }
    Rgbd colour(double lo, double hi) {
        const double r = uniform(lo, hi), g = uniform(lo, hi);
        return {r, g, uniform(lo, hi)};
    }
    Vec3d place(double height) { // above the floor, in sight
        const double x = uniform(-2.2, 2.2);
        return {x, uniform(-2.2, 2.2), height};
    }

    Handle material(Rgbd diffuse) {
        MaterialDesc& m = desc.materials.emplace_back();
        m.name = cat("material ", desc.materials.size());
        m.diffuse = diffuse;
        return static_cast<Handle>(desc.materials.size() - 1);
    }
    MaterialDesc& at(Handle handle) { return desc.materials[static_cast<std::size_t>(handle)]; }
    Handle shiny() {
        const Handle handle = material(colour(0.1, 0.8));
        at(handle).specular = colour(0.2, 0.6);
        at(handle).exponent = uniform(10, 200);
        return handle;
    }
    Handle glass(double ior) {
        const Handle handle = material({0, 0, 0});
        at(handle).mirror = {1, 1, 1};
        at(handle).transmission = colour(0.8, 1);
        at(handle).ior = ior;
        at(handle).fresnel = MaterialDesc::Fresnel::Dielectric;
        return handle;
    }
    Handle mirror() {
        const Handle handle = material({0.05, 0.05, 0.05});
        at(handle).mirror = colour(0.6, 0.9);
        return handle;
    }

    ObjectDesc& add(ObjectDesc::Kind kind, const Transform& place, Handle surface) {
        ObjectDesc& object = desc.objects.emplace_back();
        object.name = cat("object ", desc.objects.size());
        object.kind = kind;
        object.worldFromObject = {place.rows()};
        object.materials = {surface};
        return object;
    }
    // Somewhere at a height, turned, scaled along the axes, mirrored half of the time.
    ObjectDesc& scatter(ObjectDesc::Kind kind, double height, double size, Handle surface) {
        Vec3d scale{1, 1, 1};
        for (std::size_t i = 0; i < 3; ++i) scale[i] = size * uniform(0.7, 1.4);
        if (random_.chance(0.5)) scale.x = -scale.x;
        const Transform there = Transform::translate(place(height));
        const Vec3d axis = random_.direction();
        const Transform turned = Transform::rotate(axis, uniform(0, kTwoPi));
        return add(kind, there * turned * Transform::scale(scale), surface);
    }
    ObjectDesc& scatterMesh(Handle mesh, double height, double size, Handle surface) {
        ObjectDesc& object = scatter(ObjectDesc::Kind::Mesh, height, size, surface);
        object.mesh = mesh;
        return object;
    }
    Handle mesh(MeshDesc mesh) {
        desc.meshes.push_back(std::move(mesh));
        desc.meshes.back().name = cat("mesh ", desc.meshes.size());
        return static_cast<Handle>(desc.meshes.size() - 1);
    }
    LightDesc& lamp(LightDesc::Kind kind, Vec3d place, double brightness) {
        LightDesc& light = desc.lights.emplace_back();
        light.name = cat("light ", desc.lights.size());
        light.kind = kind;
        light.worldFromLight = Transform::lookAt(place, {0, 0, 0}, kUp).rows();
        light.color = colour(0.7 * brightness, brightness);
        return light;
    }

    SceneDesc desc;
    Vec3d eye;

protected:
    meshes::Random& random_;
};

} // namespace scenes
