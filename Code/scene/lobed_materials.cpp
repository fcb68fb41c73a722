#include "scene/lobed_materials.h"

#include "base/math.h"
#include "desc/lobes.h"
#include "scene/frame.h"

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
    // What sends rays on, covers apart; pictures may keep their weights below 1.
    float sum[3] = {}, cover = 0;
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
        if (isPainted || (flags & kSpawnsRays) == 0) continue;
        for (std::size_t i = 0; i < 3; ++i)
            if (lobe.covers)
                cover = max(cover, lobe.value[i]);
            else
                sum[i] += lobe.value[i];
    }
    lobes_.insert(lobes_.end(), lobes.begin(), lobes.end());
    for (LobeFactor factor : factors) {
        const LobeRow& lobe = lobes[factor.lobe];
        factor.most = max(1.0f, max(max(lobe.value[0], lobe.value[1]), lobe.value[2]));
        std::size_t first = 3;
        for (const LobeField& field : lobeTypes()[lobe.kind].fields) {
            if (first == factor.first) factor.least = field.least, factor.most = field.most;
            first += static_cast<std::size_t>(field.count);
        }
        factors_.push_back(factor);
    }
    flagsOfAll_ |= of.flags;
    constexpr float kRoundings = 1e-5f; // of weights that files write with six digits
    mostReflected_ = max(max(sum[0], sum[1]), max(sum[2], 1.0f));
    return !(max(mostReflected_, cover) > 1 + kRoundings);
}

void LobedMaterials::scaleDown() {
    for (std::size_t i = materials_.back().firstLobe; i < lobes_.size(); ++i)
        if ((lobeTypes()[lobes_[i].kind].flags & kSpawnsRays) != 0)
            for (float& weight : std::span(lobes_[i].value).first(3))
                weight = lobes_[i].covers ? min(weight, 1.0f) : weight / mostReflected_;
}

namespace {

Rgb grey(double v) {
    const float f = toFloat(v);
    return {f, f, f};
}

// The index of refraction whose boundary reflects so much at normal incidence.
double iorOf(float reflected) {
    const double root = std::sqrt(min(static_cast<double>(reflected), 0.99));
    return (1 + root) / (1 - root);
}

std::string_view modelName(MaterialDesc::SpecularModel model) {
    switch (model) {
    case MaterialDesc::SpecularModel::Ashikhmin: return "ashikhmin";
    case MaterialDesc::SpecularModel::Phong: return "phong";
    case MaterialDesc::SpecularModel::Blinn: break;
    }
    return "blinn";
}

// Changes a lobe that is written as such to what it is with these switches. Returns whether it is
// still there.
bool isSwitchedOn(LobeRow& lobe, const Switches& on) {
    const LobeType& type = lobeTypes()[lobe.kind];
    if (type.isMirror() && !on.reflection) return false;
    if (type.isGlass() && !on.refraction && !setField(lobe, "transmit_tint", {})) return false;
    if (type.isGlass() && !on.reflection) setField(lobe, "reflect_tint", {});
    if (!on.glossy && (type.isMirror() || type.isGlass()) && !setField(lobe, "roughness", {}) &&
        (type.flags & kAnswersLights) != 0)
        lobe.kind = lobeNamed("mirror");
    return true;
}

} // namespace

bool LobeList::variesBoundaries() const {
    return std::any_of(factors.begin(), factors.end(), [&](const LobeFactor& factor) {
        return factor.first == 3 && (lobeTypes()[lobes[factor.lobe].kind].flags & kHasSides) != 0;
    });
}

LobeRow lobeRow(std::string_view kind, Rgb weight) {
    LobeRow row;
    row.kind = lobeNamed(kind);
    float* value = row.value;
    *value++ = weight.r, *value++ = weight.g, *value++ = weight.b;
    for (const LobeField& field : lobeTypes()[row.kind].fields)
        for (int i = 0; i < field.count; ++i) *value++ = field.start[i];
    return row;
}

bool setField(LobeRow& lobe, std::string_view name, Rgb value) {
    float* to = lobe.value + 3;
    for (const LobeField& field : lobeTypes()[lobe.kind].fields) {
        if (name != field.name) {
            to += field.count;
            continue;
        }
        to[0] = value.r;
        if (field.count == 3) to[1] = value.g, to[2] = value.b;
        return true;
    }
    return false;
}

// The lobes that are written as such.
static LobeList writtenLobes(const MaterialDesc& desc, const TextureOf& textureOf,
                             const Switches& on) {
    LobeList out;
    for (const LobeDesc& lobe : desc.lobes) {
        const LobeForm& form = lobeForms()[lobe.kind];
        LobeRow row;
        row.kind = static_cast<std::uint8_t>(lobe.kind), row.covers = lobe.covers;
        const Rgb weight = toRgb(lobe.weight);
        row.value[0] = weight.r, row.value[1] = weight.g, row.value[2] = weight.b;
        for (std::size_t i = 0; i < LobeDesc::kNumbers; ++i)
            row.value[3 + i] = toFloat(lobe.numbers[i]);
        if (!isSwitchedOn(row, on)) continue;
        for (const LobeDesc::Factor& factor : lobe.factors) {
            const Texture* const texture = textureOf(factor.texture);
            const bool isOfWeight = factor.field == LobeDesc::Factor::kWeight;
            if (texture == nullptr || (!isOfWeight && row.kind != lobe.kind)) continue;
            LobeFactor of{static_cast<std::uint8_t>(out.lobes.size()), 0, 3, 0, 1, texture};
            if (!isOfWeight) {
                const auto& field = form.fields[static_cast<std::size_t>(factor.field)];
                of.first = static_cast<std::uint8_t>(3 + field.first);
                of.count = static_cast<std::uint8_t>(field.count);
            }
            if (factor.without) of.a = 1, of.b = -toFloat(factor.strength);
            out.factors.push_back(of);
        }
        out.lobes.push_back(row);
    }
    return out;
}

LobeList lobesOf(const MaterialDesc& desc, const TextureOf& textureOf, const Switches& on) {
    LobeList out = writtenLobes(desc, textureOf, on);
    const Rgb white{1, 1, 1};
    const auto add = [&](LobeRow lobe, Handle picture = kNone) {
        if (lobe.value[0] == 0 && lobe.value[1] == 0 && lobe.value[2] == 0) return;
        if (const Texture* const texture = picture == kNone ? nullptr : textureOf(picture))
            out.factors.push_back(
                {static_cast<std::uint8_t>(out.lobes.size()), 0, 3, 0, 1, texture});
        out.lobes.push_back(lobe);
    };
    const Rgb mirror = on.reflection ? toRgb(desc.mirror) : Rgb{};
    const Rgb transmission = on.refraction ? toRgb(desc.transmission) : Rgb{};
    const auto fresnel = on.fresnel ? desc.fresnel : MaterialDesc::Fresnel::None;
    const double roughness = on.glossy ? desc.roughness : 0;
    const bool isRough = roughness > 0;

    const auto refraction = [&](Rgb weight) {
        LobeRow lobe = lobeRow("refraction", weight);
        setField(lobe, "ior", grey(desc.ior)), setField(lobe, "roughness", grey(roughness));
        return lobe;
    };
    const auto metal = [&](Rgb weight, Rgb color) {
        LobeRow lobe = lobeRow("conductor", weight);
        setField(lobe, "color", color), setField(lobe, "edge_tint", white);
        setField(lobe, "roughness", grey(roughness));
        return lobe;
    };
    const auto layer = [&](double ior, Rgb tint) {
        LobeRow lobe = lobeRow("glossy_dielectric", white);
        setField(lobe, "ior", grey(ior)), setField(lobe, "roughness", grey(roughness));
        const float most = maxChannel(tint);
        setField(lobe, "tint",
                 fresnel == MaterialDesc::Fresnel::Schlick && most > 0 ? tint * (1 / most) : tint);
        return lobe;
    };
    switch (fresnel) {
    case MaterialDesc::Fresnel::None:
        add(isRough ? metal(mirror, white) : lobeRow("mirror", mirror));
        add(refraction(transmission));
        break;
    case MaterialDesc::Fresnel::Schlick: {
        if (isBlack(mirror) && isBlack(transmission)) break;
        const bool hasBelow = !isBlack(transmission) || !isBlack(toRgb(desc.diffuse));
        LobeRow lobe = isRough && hasBelow ? layer(iorOf(maxChannel(mirror)), mirror)
                       : isRough           ? metal(white, mirror)
                                           : lobeRow("schlick_mirror", white);
        if (!isRough) setField(lobe, "color", mirror);
        lobe.covers = hasBelow;
        add(lobe);
        // What is behind it gets (1 - mirror)(1 - rise) of its light.
        const auto over = [](float t, float m) { return m < 1 ? t / (1 - m) : 0.0f; };
        add(refraction({over(transmission.r, mirror.r), over(transmission.g, mirror.g),
                        over(transmission.b, mirror.b)}));
        break;
    }
    case MaterialDesc::Fresnel::Dielectric: {
        if (isBlack(mirror) && isBlack(transmission)) break;
        LobeRow lobe = lobeRow("dielectric", white);
        if (isBlack(transmission)) {
            lobe = layer(desc.ior, mirror);
            lobe.covers = !isBlack(toRgb(desc.diffuse));
        } else {
            setField(lobe, "ior", grey(desc.ior)), setField(lobe, "roughness", grey(roughness));
            setField(lobe, "reflect_tint", mirror), setField(lobe, "transmit_tint", transmission);
        }
        add(lobe);
        break;
    }
    }
    add(lobeRow("diffuse", toRgb(desc.diffuse)), desc.diffuseTexture);
    if (!isRough || isBlack(mirror)) {
        LobeRow lobe = lobeRow(modelName(desc.specularModel), toRgb(desc.specular));
        setField(lobe, "exponent", grey(desc.exponent));
        lobe.isHighlight = true;
        add(lobe, desc.specularTexture);
    }
    return out;
}
