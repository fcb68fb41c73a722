#include "render/material_table.h"

MaterialTable::MaterialTable(const Scene& scene) {
    traits_.reserve(scene.materials().size()), glow_.reserve(scene.materials().size());
    for (const SceneMaterial& of : scene.materials()) {
        const auto trait = [](bool has, Trait which) { return has ? unsigned{which} : 0; };
        traits_.push_back(static_cast<std::uint8_t>(
            trait(::answersLamps(of.base), AnswersLamps) |
            trait(!of.isLamp && !isBlack(of.base.mirror), Mirrors) |
            trait(of.litOutside, LitOutside) | trait(of.isTextured(), Textured)));
        glow_.push_back(glowOf(of.base, scene.ambient()));
    }
}
