#include "render/path/lobed_materials.h"

#include "base/math.h"

#include <algorithm>

std::uint8_t lobeNamed(std::string_view name) {
    const std::span<const LobeType> types = lobeTypes();
    const auto it = std::find_if(types.begin(), types.end(),
                                 [&](const LobeType& type) { return name == type.name; });
    return static_cast<std::uint8_t>(it - types.begin());
}

// Whether a lobe has a number of this name that is not 0; `otherwise`: if it has no such number.
// Pictures multiply the number, and so leave 0 as it is.
static bool has(const LobeRow& lobe, std::string_view number, bool otherwise) {
    const float* value = lobe.value + 3;
    for (const LobeField& field : lobeTypes()[lobe.kind].fields) {
        if (field.name == number) return *value != 0;
        value += field.count;
    }
    return otherwise;
}

std::uint16_t LobedMaterials::signatureOf(const std::vector<LobeRow>& lobes) {
    std::string word;
    for (const LobeRow& lobe : lobes)
        word += {static_cast<char>('a' + lobe.kind), lobe.covers        ? '+'
                                                     : lobe.isHighlight ? '*'
                                                                        : '.'};
    const auto it = std::find(signatures_.begin(), signatures_.end(), word);
    const auto number = static_cast<std::uint16_t>(it - signatures_.begin());
    if (it == signatures_.end()) signatures_.push_back(std::move(word));
    return number;
}

bool LobedMaterials::add(const std::vector<LobeRow>& lobes, const std::vector<LobeFactor>& factors,
                         std::uint32_t traits) {
    LobedMaterial& of = materials_.emplace_back();
    of.flags = traits;
    of.firstLobe = static_cast<std::uint32_t>(lobes_.size());
    of.firstFactor = static_cast<std::uint32_t>(factors_.size());
    of.lobes = static_cast<std::uint8_t>(lobes.size());
    of.factors = static_cast<std::uint16_t>(factors.size());
    of.signature = signatureOf(lobes);
    // What sends rays on and is no cover; pictures may keep their weights below 1.
    float sum[3] = {};
    for (std::size_t l = 0; l < lobes.size(); ++l) {
        const LobeRow& lobe = lobes[l];
        const bool isPainted =
            std::any_of(factors.begin(), factors.end(), [&](const LobeFactor& factor) {
                return factor.lobe == l && factor.first == 0;
            });
        const std::uint32_t flags = lobeTypes()[lobe.kind].flags;
        of.flags |= flags;
        if (has(lobe, "anisotropy", false)) of.flags |= LobedMaterial::kAnisotropic;
        if ((flags & (kSpawnsRays | kDiffuse)) == kSpawnsRays &&
            has(lobe, "roughness", (flags & kAnswersLights) != 0))
            of.flags |= LobedMaterial::kSpreads;
        if (lobe.covers || isPainted || (flags & kSpawnsRays) == 0) continue;
        for (std::size_t i = 0; i < 3; ++i) sum[i] += lobe.value[i];
    }
    lobes_.insert(lobes_.end(), lobes.begin(), lobes.end());
    factors_.insert(factors_.end(), factors.begin(), factors.end());
    constexpr float kRoundings = 1e-5f; // of weights that files write with six digits
    mostReflected_ = max(max(sum[0], sum[1]), sum[2]);
    return !(mostReflected_ > 1 + kRoundings);
}

void LobedMaterials::scaleDown() {
    for (std::size_t i = materials_.back().firstLobe; i < lobes_.size(); ++i)
        if (!lobes_[i].covers && (lobeTypes()[lobes_[i].kind].flags & kSpawnsRays) != 0)
            for (std::size_t c = 0; c < 3; ++c) lobes_[i].value[c] /= mostReflected_;
}
