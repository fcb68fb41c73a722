// LobedMaterials: the materials of a scene as lists of weighted lobes, each number of which may be
// multiplied by textures. Made once from the description; what shading reads are rows of floats.
#pragma once

#include "desc/scene_desc.h"
#include "material/lobe_types.h"
#include "texture/texture.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

// A lobe of a material, before textures.
struct LobeRow {
    static constexpr std::size_t kValues = 3 + kLobeNumbers;
    std::uint8_t kind = 0;     // its number in lobeTypes()
    bool covers = false;       // lies on the lobes behind it
    float value[kValues] = {}; // its weight, then its numbers
};

// Values [first, first + count) of lobe number `lobe` are multiplied by a + b * texel: three by the
// colour, one by the grey value.
struct LobeFactor {
    std::uint8_t lobe, first, count;
    float a, b;
    const Texture* texture;
};

struct LobedMaterial {
    // Beside the lobes' flags.
    static constexpr std::uint32_t kEmits = 1u << 16, kAnisotropic = 1u << 17;
    std::uint32_t firstLobe = 0, firstFactor = 0;
    std::uint16_t factors = 0;
    std::uint8_t lobes = 0;
    std::uint16_t signature = 0; // equal where the kinds of all lobes are, and which of them cover
    std::uint32_t flags = 0;     // LobeFlags of all lobes together
};

// What a material scatters light by, in the order of the description and then the default one.
class LobedMaterials {
public:
    // One more. Returns false where the lobes reflect more than arrives and were scaled to what
    // does.
    bool add(const std::vector<LobeRow>& lobes, const std::vector<LobeFactor>& factors, bool emits);

    const LobedMaterial& operator[](std::size_t number) const { return materials_[number]; }
    std::size_t size() const { return materials_.size(); }
    std::span<const LobeRow> lobes(const LobedMaterial& of) const {
        return std::span(lobes_).subspan(of.firstLobe, of.lobes);
    }
    std::span<const LobeFactor> factors(const LobedMaterial& of) const {
        return std::span(factors_).subspan(of.firstFactor, of.factors);
    }

private:
    std::uint16_t signatureOf(const std::vector<LobeRow>& lobes);

    std::vector<LobedMaterial> materials_;
    std::vector<LobeRow> lobes_;
    std::vector<LobeFactor> factors_;
    std::vector<std::string> signatures_; // two bytes for each lobe
};

// The number of the lobe with this word, which there is.
std::uint8_t lobeNamed(std::string_view name);
