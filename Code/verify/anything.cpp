#include "verify/anything.h"

#include "desc/enum_tables.h"
#include "verify/stage.h"

#include <utility>

namespace scenes {

namespace {

using Kind = ObjectDesc::Kind;

// All at once, as nobody would put it together: what scenes.cpp leaves apart meets here.
class Anything : public Stage {
public:
    explicit Anything(meshes::Random& random)
        : Stage(random, 1 + static_cast<int>(random.below(6))) {
        desc.settings.maxDepth = static_cast<int>(below(7));
        desc.settings.lightSamples = 1 + static_cast<int>(below(3));
        desc.settings.cutoff = chance(0.5) ? 0 : uniform(0, 0.02);
        useCamera(desc.cameras[0]);
        for (std::size_t more = 1 + below(8); more > 0; --more) anyMaterial();
        for (std::size_t more = below(6); more > 0; --more) anyLamp();
        for (MeshDesc& shape : anyMeshes()) mesh(std::move(shape));
        // None, a handful without a tree, or a tree.
        for (std::size_t more = below(chance(0.5) ? 5 : 60); more > 0; --more) anyObject();
    }

private:
    bool chance(double part) { return random_.chance(part); }
    std::size_t below(std::size_t count) { return random_.below(count); }
    template <class Enum> Enum anyOf() {
        return static_cast<Enum>(below(kNamesByValue<Enum>.size()));
    }
    Handle someMaterial() { return static_cast<Handle>(below(desc.materials.size())); }

    // As the first key, a little way on, turned, and grown: each or not.
    template <class Keys> void move(Keys& keys, bool grows) {
        const Transform first = Transform::fromRows(keys[0]);
        const bool turns = chance(0.5), walks = chance(0.8);
        for (std::size_t more = 1 + below(3); more > 0; --more) {
            Transform next = first;
            if (turns) {
                const Vec3d axis = random_.direction();
                next = next * Transform::rotate(axis, uniform(-1, 1));
            }
            if (grows) next = next * Transform::scale(uniform(0.7, 1.4));
            if (walks) next = Transform::translate(random_.inBox(0.3)) * next;
            keys.push_back(next.rows());
        }
    }

    void useCamera(CameraDesc& camera) {
        camera.kind = anyOf<CameraDesc::Kind>();
        camera.orthoScale = uniform(2, 8);
        if (chance(0.3)) camera.shiftX = uniform(-0.2, 0.2), camera.shiftY = uniform(-0.2, 0.2);
        if (chance(0.3)) camera.clipStart = uniform(0, 5);
        if (chance(0.4)) {
            camera.apertureRadius = uniform(0, 0.2);
            camera.focusDistance = uniform(3, 8);
            camera.apertureBlades = static_cast<int>(below(8)); // below 3: round
            camera.apertureRotationDeg = uniform(0, 90);
            camera.apertureRatio = chance(0.5) ? 1 : uniform(0.5, 2);
        }
        if (chance(0.2)) move(camera.worldFromCamera, false);
    }

    void anyMaterial() {
        MaterialDesc& m = at(material(colour(0, 0.8)));
        m.specularModel = anyOf<MaterialDesc::SpecularModel>();
        m.fresnel = anyOf<MaterialDesc::Fresnel>();
        m.litSide = anyOf<MaterialDesc::LitSide>();
        if (chance(0.4)) m.specular = colour(0, 0.6), m.exponent = uniform(1, 300);
        if (chance(0.4)) m.mirror = colour(0, 0.9);
        if (chance(0.3)) m.transmission = colour(0, 1), m.ior = uniform(0.6, 2.4);
        if (chance(0.3)) m.roughness = uniform(0, 0.5);
        if (chance(0.2)) m.emission = colour(0, 1);
        if (chance(0.3)) m.opacity = uniform(0, 1), m.filter = colour(0, 1);
    }

    void anyLamp() {
        const auto kind = anyOf<LightDesc::Kind>();
        const Vec3d from = place(uniform(1, 5));
        LightDesc& light = lamp(kind, from, uniform(0.5, 20));
        light.size = {uniform(0.1, 2), uniform(0.1, 2)};
        const bool isPoint = kind != LightDesc::Kind::Sphere && chance(0.3);
        light.radius = isPoint ? 0 : uniform(0.01, 0.5);
        light.angleDeg = chance(0.3) ? 0 : uniform(0, 20);
        light.coneAngleDeg = uniform(10, 170);
        light.blend = uniform(0, 1);
        light.cosineFalloff = chance(0.5);
        light.spreadDeg = chance(0.5) ? 180 : uniform(20, 180);
        light.shadows = chance(0.8);
        light.visible = chance(0.4);
        if (chance(0.3)) light.attenuation = {uniform(0, 1), uniform(0, 1), uniform(0.1, 1)};
    }

    static std::vector<MeshDesc> anyMeshes() {
        return {meshes::cube(), meshes::icosphere(2), meshes::torus(0.3, 12, 6),
                meshes::uvSphere(12, 6)};
    }

    void anyObject() {
        const auto kind = anyOf<ObjectDesc::Kind>();
        const double height = uniform(0, 2), size = uniform(0.1, 0.8);
        ObjectDesc& object = scatter(kind, height, size, someMaterial());
        if (kind == Kind::Mesh) object.mesh = static_cast<Handle>(below(desc.meshes.size()));
        object.sides = chance(0.6) ? ObjectDesc::Sides::Both : anyOf<ObjectDesc::Sides>();
        object.caps = chance(0.5);
        object.radius = uniform(0.5, 1.2);
        object.topRadius = chance(0.4) ? 0 : uniform(0, 1.2);
        if (kind == Kind::InfinitePlane) { // below the rest, or it would hide it
            object.worldFromObject = {
                (Transform::translate({0, 0, -3}) * Transform::rotate({1, 0, 0}, uniform(-1, 1)))
                    .rows()};
            object.materials.push_back(someMaterial());
        }
        if (chance(0.3)) move(object.worldFromObject, chance(0.3));
    }
};

} // namespace

SceneDesc anything(meshes::Random& random) { return Anything(random).desc; }

} // namespace scenes
