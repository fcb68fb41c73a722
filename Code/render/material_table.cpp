#include "render/material_table.h"

#include "base/for_each.h"

MaterialTable::MaterialTable(const Scene& scene, int threads) {
    constexpr std::size_t kTogether = 1 << 12;
    const std::span<const SceneMaterial> materials = scene.materials();
    traits_.resize(materials.size()), glow_.resize(materials.size());
    forEachPart(threads, materials.size(), kTogether, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            const SceneMaterial& of = materials[i];
            const auto trait = [](bool has, Trait which) { return has ? unsigned{which} : 0; };
            traits_[i] = static_cast<std::uint8_t>(
                trait(::answersLamps(of.base), AnswersLamps) |
                trait(!of.isLamp && !isBlack(of.base.mirror), Mirrors) |
                trait(of.litOutside, LitOutside) | trait(of.isTextured(), Textured));
            glow_[i] = glowOf(of.base, scene.ambient());
        }
    });
}
