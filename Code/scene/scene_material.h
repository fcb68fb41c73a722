// SceneMaterial: what a material says besides its lobes (scene/lobed_materials.h).
#pragma once

#include "base/math.h"
#include "texture/texture.h"

// Pictures that change a material's numbers from place to place, or bend normals.
struct MaterialPictures {
    const Texture* diffuse = nullptr;
    const Texture* emission = nullptr;
    const Texture* opacity = nullptr;
    const Texture* normalMap = nullptr;
    const Texture* bumpMap = nullptr;
    float normalStrength = 1;
    float bumpHeight = 0; // strength times distance, in normalised units
};
inline constexpr MaterialPictures kNoPictures;

// In one line of the cache, as there may be thousands of them.
struct alignas(64) SceneMaterial {
    Rgb diffuse{0.8f, 0.8f, 0.8f}; // for the AOV albedo
    Rgb emission;
    Rgb filter{1, 1, 1}; // of light that goes straight through what is not opaque
    float opacity = 1;
    float ior = 1;             // of what is within
    bool transmits = false;    // rays can enter what is within
    bool litOutside = false;   // answers lamps outside of it, whichever side is seen
    bool lightsOthers = false; // Whitted pictures: its emission does
    bool emitsFront = false;   // its emission leaves to the outside only
    bool isLamp = false;       // the visible body of an area light; flat ones have no back
    bool isPainted = false;    // lobes have pictures
    const MaterialPictures* pictures = &kNoPictures;

    bool seeThrough() const { return opacity < 1 || pictures->opacity != nullptr; }
    bool bendsNormals() const {
        return pictures->normalMap != nullptr || pictures->bumpMap != nullptr;
    }
    bool wantsUv() const { return isPainted || pictures != &kNoPictures; }
};
static_assert(sizeof(SceneMaterial) == 64);

// What any of some materials has; each is looked at once, as there may be more than a cache holds.
struct AnyMaterial {
    bool transmits = false;
    bool pictures = false;   // asks for texture coordinates
    bool seeThrough = false; // lets light straight through

    AnyMaterial& operator|=(const SceneMaterial& m) {
        return *this |= AnyMaterial{m.transmits, m.wantsUv(), m.seeThrough()};
    }
    AnyMaterial& operator|=(const AnyMaterial& other) {
        transmits |= other.transmits, pictures |= other.pictures, seeThrough |= other.seeThrough;
        return *this;
    }
};
