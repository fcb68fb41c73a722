// MaterialTable: what waves ask of a material before they look at its numbers. Of thousands of
// materials the nearest caches hold few, but these few bytes of each.
#pragma once

#include "base/raw_vector.h"
#include "render/scene.h"

#include <cstdint>

class MaterialTable {
public:
    enum Trait : std::uint8_t {
        AnswersLamps = 1, // if it is not textured
        Mirrors = 2,      // and is no lamp
        LitOutside = 4,
        Textured = 8
    };

    MaterialTable(const Scene& scene, int threads);

    std::uint8_t traits(std::uint32_t material) const { return traits_[material]; }
    void prefetchGlow(std::uint32_t material) const { __builtin_prefetch(&glow_[material]); }
    // Light that comes from the surface itself to where its point is seen, if it is not textured.
    Rgb glow(std::uint32_t material) const { return glow_[material]; }

private:
    RawVector<std::uint8_t> traits_; // by number of the material
    RawVector<Rgb> glow_;
};

inline bool answersLamps(const Material& material) {
    return !isBlack(material.diffuse) || !isBlack(material.specular);
}
// `ambient`: radiance from everywhere.
inline Rgb glowOf(const Material& material, Rgb ambient) {
    return material.emission + material.diffuse * ambient;
}
