// LobedMaterials: the materials of a scene as lists of weighted lobes, each number of which may be
// multiplied by textures. Made once from the description; what shading reads are rows of floats.
#pragma once

#include "desc/scene_desc.h"
#include "material/lobe_types.h"
#include "scene/settings.h"
#include "texture/texture.h"

#include <cstdint>
#include <functional>
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
    bool isHighlight = false;  // Whitted pictures don't follow its rays
    float value[kValues] = {}; // its weight, then its numbers
};

// Values [first, first + count) of lobe number `lobe` are multiplied by a + b * texel: three by the
// colour, one by the grey value. They stay in the range of numbers that are written.
struct LobeFactor {
    std::uint8_t lobe, first, count;
    float a, b;
    const Texture* texture;
    float least = 0, most = 0; // add() sets them
};

struct LobedMaterial {
    // Beside the lobes' flags.
    static constexpr std::uint32_t kEmits = 1u << 16, kAnisotropic = 1u << 17,
                                   kSeeThrough = 1u << 18, kLitOutside = 1u << 19,
                                   kSpreads = 1u << 20; // some rays of lobes are random
    std::uint32_t firstLobe = 0, firstFactor = 0;
    std::uint16_t factors = 0;
    std::uint8_t lobes = 0;
    std::uint16_t signature = 0; // equal where the kinds of all lobes are, and which of them cover
    std::uint32_t flags = 0;     // LobeFlags of all lobes together
};

// What a material scatters light by, in the order of the description and then the default one.
class LobedMaterials {
public:
    // One more. Returns whether the lobes reflect no more than arrives; scaleDown() mends the last
    // material where they do.
    // `traits`: kEmits, kSeeThrough and kLitOutside.
    bool add(const std::vector<LobeRow>& lobes, const std::vector<LobeFactor>& factors,
             std::uint32_t traits);
    void scaleDown();

    const LobedMaterial& operator[](std::size_t number) const { return materials_[number]; }
    std::size_t size() const { return materials_.size(); }
    // The flags that some material has.
    std::uint32_t flagsOfAll() const { return flagsOfAll_; }
    std::size_t signatures() const { return signatures_.size(); }
    std::span<const LobeRow> lobes(const LobedMaterial& of) const {
        return std::span(lobes_).subspan(of.firstLobe, of.lobes);
    }
    std::span<const LobeFactor> factors(const LobedMaterial& of) const {
        return std::span(factors_).subspan(of.firstFactor, of.factors);
    }

private:
    std::uint16_t signatureOf(const std::vector<LobeRow>& lobes);

    float mostReflected_ = 0; // of the last material
    std::uint32_t flagsOfAll_ = 0;
    std::vector<LobedMaterial> materials_;
    std::vector<LobeRow> lobes_;
    std::vector<LobeFactor> factors_;
    std::vector<std::string> signatures_; // two bytes for each lobe
};

// The number of the lobe with this word, which there is.
std::uint8_t lobeNamed(std::string_view name);

// The lobes of a material's description, those that its short keywords mean among them.

struct LobeList {
    std::vector<LobeRow> lobes;
    std::vector<LobeFactor> factors;

    // Whether a picture is to multiply the ior of a lobe that asks for both sides of its surface,
    // which is one number for all that is within.
    bool variesBoundaries() const;
};
// A lobe of this kind whose fields are as if they were left out.
LobeRow lobeRow(std::string_view kind, Rgb weight);
// Sets a number or colour of a lobe. Returns false where the lobe has no field of this name.
bool setField(LobeRow& lobe, std::string_view name, Rgb value);

// Texture of a handle; null: none, or its picture misses.
using TextureOf = std::function<const Texture*(Handle)>;
// All lobes of a material: those that are written as such, and those that the short keywords mean.
// A rough mirror shows lamps by itself, so that it takes the place of a specular highlight.
LobeList lobesOf(const MaterialDesc& desc, const TextureOf& textureOf, const Switches& on);
