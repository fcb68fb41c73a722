#include "desc/properties.h"

#include <algorithm>
#include <type_traits>

namespace {

using Corners = decltype(ObjectDesc::corners);
using Crop = decltype(SettingsDesc::crop);

template <class T>
constexpr FieldKind kKindOf = std::is_enum_v<T> && sizeof(T) == 1 ? FieldKind::Choice
                                                                  : FieldKind::None;
template <> constexpr FieldKind kKindOf<double> = FieldKind::Number;
template <> constexpr FieldKind kKindOf<Vec2d> = FieldKind::Pair;
template <> constexpr FieldKind kKindOf<Vec3d> = FieldKind::Triple;
template <> constexpr FieldKind kKindOf<Rgbd> = FieldKind::Color;
template <> constexpr FieldKind kKindOf<Corners> = FieldKind::Corners;
template <> constexpr FieldKind kKindOf<int> = FieldKind::Int;
template <> constexpr FieldKind kKindOf<std::uint32_t> = FieldKind::Unsigned;
template <> constexpr FieldKind kKindOf<Crop> = FieldKind::Crop;
template <> constexpr FieldKind kKindOf<bool> = FieldKind::Flag;
template <> constexpr FieldKind kKindOf<std::string> = FieldKind::Text;

template <auto member> struct Member;
template <class Block, class T, T Block::*member> struct Member<member> {
    using Type = T;
    static const void* in(const void* b) { return &(static_cast<const Block*>(b)->*member); }
};

template <auto member> constexpr Field field() {
    using T = typename Member<member>::Type;
    static_assert(kKindOf<T> != FieldKind::None);
    Field field{kKindOf<T>, Member<member>::in, {}, {}};
    if constexpr (kKindOf<T> == FieldKind::Choice) field.names = kNamesByValue<T>;
    return field;
}
template <auto member> constexpr Field name(BlockType target) {
    static_assert(std::is_same_v<typename Member<member>::Type, Handle>);
    return {FieldKind::Name, Member<member>::in, {}, target};
}
template <auto member> constexpr Field texture() { return name<member>(BlockType::Texture); }
constexpr Field materials(FieldKind kind) {
    return {kind, Member<&ObjectDesc::materials>::in, {}, BlockType::Material};
}

constexpr Range kDepth{0, 1024};
constexpr auto kSettings = std::to_array<Property>({
    {"resolution", field<&SettingsDesc::width>(), field<&SettingsDesc::height>(), {1, 65535}},
    {"pixel_aspect", field<&SettingsDesc::pixelAspect>(), {}, {0, 1000, true}},
    {"crop", field<&SettingsDesc::crop>(), {}, {0, 65535}},
    {"samples", field<&SettingsDesc::samplesPerPixel>(), {}, {1, 1 << 24}},
    {"light_samples", field<&SettingsDesc::lightSamples>(), {}, {1, 4096}},
    {"integrator", field<&SettingsDesc::integrator>(), {}, {}},
    {"max_depth", field<&SettingsDesc::maxDepth>(), {}, kDepth},
    {"diffuse_depth", field<&SettingsDesc::diffuseDepth>(), {}, kDepth},
    {"glossy_depth", field<&SettingsDesc::glossyDepth>(), {}, kDepth},
    {"transmission_depth", field<&SettingsDesc::transmissionDepth>(), {}, kDepth},
    {"transparent_depth", field<&SettingsDesc::transparentDepth>(), {}, kDepth},
    {"filter_glossy", field<&SettingsDesc::filterGlossy>(), {}, {0, 100}},
    {"clamp_indirect", field<&SettingsDesc::clampIndirect>(), {}, kColor},
    {"caustics", field<&SettingsDesc::caustics>(), {}, {}},
    {"cutoff", field<&SettingsDesc::cutoff>(), {}, kUnit},
    {"denoise", field<&SettingsDesc::denoise>(), {}, {}},
    {"sampler", field<&SettingsDesc::sampler>(), {}, {}},
    {"jitter", field<&SettingsDesc::jitter>(), {}, {}},
    {"seed", field<&SettingsDesc::seed>(), {}, kAnyUnsigned},
    {"filter", field<&SettingsDesc::filter>(), field<&SettingsDesc::filterWidth>(), {0, 32, true}},
    {"texture_filter", field<&SettingsDesc::textureFilter>(), {}, {}},
    {"exposure", field<&SettingsDesc::exposureEv>(), {}, {-64, 64}},
    {"transfer", field<&SettingsDesc::transfer>(), {}, {}},
});

constexpr auto kWorld = std::to_array<Property>({
    {"background", field<&WorldDesc::background>(), {}, kColor},
    {"ambient", field<&WorldDesc::ambient>(), {}, kColor},
    {"environment", texture<&WorldDesc::environment>(), {}, {}},
    {"environment_up", field<&WorldDesc::environmentUp>(), {}, {}},
    {"environment_rotation", field<&WorldDesc::rotationDeg>(), {}, kTurn},
    {"environment_lights", field<&WorldDesc::environmentLights>(), {}, {}},
    {"ambient_occlusion", field<&WorldDesc::ambientOcclusion>(), {}, kMaybeEndless},
});

constexpr auto kCamera = std::to_array<Property>({
    {"type", field<&CameraDesc::kind>(), {}, {}},
    {"lens", field<&CameraDesc::lensMm>(), {}, kPositive},
    {"sensor", field<&CameraDesc::sensorWidthMm>(), field<&CameraDesc::sensorHeightMm>(),
     kPositive},
    {"sensor_fit", field<&CameraDesc::sensorFit>(), {}, {}},
    {"shift", field<&CameraDesc::shiftX>(), field<&CameraDesc::shiftY>(), kAnyNumber},
    {"ortho_scale", field<&CameraDesc::orthoScale>(), {}, kPositive},
    {"clip_start", field<&CameraDesc::clipStart>(), {}, kNotNegative},
    {"aperture_radius", field<&CameraDesc::apertureRadius>(), {}, kNotNegative},
    {"focus_distance", field<&CameraDesc::focusDistance>(), {}, kPositive},
    {"aperture_blades", field<&CameraDesc::apertureBlades>(), {}, {0, 256}},
    {"aperture_rotation", field<&CameraDesc::apertureRotationDeg>(), {}, kTurn},
    {"aperture_ratio", field<&CameraDesc::apertureRatio>(), {}, kPositive},
});

constexpr auto kTexture = std::to_array<Property>({
    {"file", field<&TextureDesc::file>(), {}, {}},
    {"space", field<&TextureDesc::space>(), {}, {}},
    {"interpolation", field<&TextureDesc::interpolation>(), {}, {}},
    {"extension", field<&TextureDesc::extension>(), {}, {}},
    {"channel", field<&TextureDesc::channel>(), {}, {}},
    {"scale", field<&TextureDesc::scale>(), {}, kAnyNumber},
    {"rotation", field<&TextureDesc::rotationDeg>(), {}, kTurn},
    {"offset", field<&TextureDesc::offset>(), {}, kAnyNumber},
});

constexpr auto kMaterial = std::to_array<Property>({
    {"diffuse", field<&MaterialDesc::diffuse>(), {}, kColor},
    {"diffuse_texture", texture<&MaterialDesc::diffuseTexture>(), {}, {}},
    {"specular", field<&MaterialDesc::specular>(), {}, kColor},
    {"specular_texture", texture<&MaterialDesc::specularTexture>(), {}, {}},
    {"specular_model", field<&MaterialDesc::specularModel>(), {}, {}},
    {"exponent", field<&MaterialDesc::exponent>(), {}, {0, 1e9}},
    {"lit_side", field<&MaterialDesc::litSide>(), {}, {}},
    {"mirror", field<&MaterialDesc::mirror>(), {}, kColor},
    {"transmission", field<&MaterialDesc::transmission>(), {}, kColor},
    {"ior", field<&MaterialDesc::ior>(), {}, {0, 1000, true}},
    {"fresnel", field<&MaterialDesc::fresnel>(), {}, {}},
    {"roughness", field<&MaterialDesc::roughness>(), {}, kUnit},
    {"emission", field<&MaterialDesc::emission>(), {}, kColor},
    {"emission_texture", texture<&MaterialDesc::emissionTexture>(), {}, {}},
    {"emission_lights", field<&MaterialDesc::emissionLights>(), {}, {}},
    {"emission_sides", field<&MaterialDesc::emissionSides>(), {}, {}},
    {"opacity", field<&MaterialDesc::opacity>(), {}, kUnit},
    {"opacity_texture", texture<&MaterialDesc::opacityTexture>(), {}, {}},
    {"filter", field<&MaterialDesc::filter>(), {}, kColor},
    {"normal_map", texture<&MaterialDesc::normalMap>(), {}, {}},
    {"normal_strength", field<&MaterialDesc::normalStrength>(), {}, {0, 1000}},
    {"bump_map", texture<&MaterialDesc::bumpMap>(), {}, {}},
    {"bump_strength", field<&MaterialDesc::bumpStrength>(), {}, {-1000, 1000}},
    {"bump_distance", field<&MaterialDesc::bumpDistance>(), {}, kAnyNumber},
});
static_assert(kMaterial.size() == kMostProperties);

constexpr auto kLight = [] {
    using enum LightDesc::Kind;
    return std::to_array<Property>({
        {"type", field<&LightDesc::kind>(), {}, {}},
        {"color", field<&LightDesc::color>(), {}, kColor},
        {"attenuation", field<&LightDesc::attenuation>(), {}, kNotNegative, only(Point, Spot)},
        {"radius", field<&LightDesc::radius>(), {}, kNotNegative, only(Point, Spot, Sphere)},
        {"size", field<&LightDesc::size>(), {}, kNotNegative, only(Rectangle, Disk)},
        {"cone_angle", field<&LightDesc::coneAngleDeg>(), {}, {0, 180, true}, only(Spot)},
        {"blend", field<&LightDesc::blend>(), {}, kUnit, only(Spot)},
        {"cosine_falloff", field<&LightDesc::cosineFalloff>(), {}, {}, only(Spot)},
        {"angle", field<&LightDesc::angleDeg>(), {}, {0, 180}, only(Sun)},
        {"spread", field<&LightDesc::spreadDeg>(), {}, {0, 180, true}, only(Rectangle, Disk)},
        {"shadows", field<&LightDesc::shadows>(), {}, {}},
        {"visible", field<&LightDesc::visible>(), {}, {}, only(Rectangle, Disk, Sphere)},
        {"seen_by", field<&LightDesc::seenBy>(), {}, {}},
    });
}();

// Instead of arrays.
constexpr auto kMesh = std::to_array<Property>({
    {"file", field<&MeshDesc::file>(), {}, {}},
    {"smooth_angle", field<&MeshDesc::smoothAngleDeg>(), {}, {-1, 180}},
});

constexpr auto kObject = [] {
    using enum ObjectDesc::Kind;
    return std::to_array<Property>({
        {"material", materials(FieldKind::Material), {}, {}},
        {"radius", field<&ObjectDesc::radius>(), {}, kPositive, only(Sphere, Disk, Cylinder)},
        {"radius", field<&ObjectDesc::radius>(), {}, kNotNegative, only(Cone)},
        {"top_radius", field<&ObjectDesc::topRadius>(), {}, kNotNegative, only(Cone)},
        {"caps", field<&ObjectDesc::caps>(), {}, {}, only(Cylinder, Cone)},
        {"corners", field<&ObjectDesc::corners>(), {}, kAnyNumber, only(Plane)},
        {"mesh", name<&ObjectDesc::mesh>(BlockType::Mesh), {}, {}, only(Mesh)},
        {"materials", materials(FieldKind::Materials), {}, {}, only(Mesh, InfinitePlane)},
        {"sides", field<&ObjectDesc::sides>(), {}, {}},
    });
}();

const auto& allOf(const Corners& corners) { return *corners; }
auto& allOf(Corners& corners) { return corners.own(); }

// Calls with every number of a field, in the order of the file; of a crop only if it is there.
template <class Data, class Call>
void forEachNumber(const Field& field, Data* block, const Call& call) {
    switch (field.kind) {
    case FieldKind::Number: return call(at<double>(field, block));
    case FieldKind::Int: return call(at<int>(field, block));
    case FieldKind::Unsigned: return call(at<std::uint32_t>(field, block));
    case FieldKind::Pair: {
        auto& v = at<Vec2d>(field, block);
        return call(v.x), call(v.y);
    }
    case FieldKind::Triple: {
        auto& v = at<Vec3d>(field, block);
        return call(v.x), call(v.y), call(v.z);
    }
    case FieldKind::Color: {
        auto& color = at<Rgbd>(field, block);
        return call(color.r), call(color.g), call(color.b);
    }
    case FieldKind::Corners:
        for (auto& p : allOf(at<Corners>(field, block))) call(p.x), call(p.y), call(p.z);
        return;
    case FieldKind::Crop:
        if (auto& crop = at<Crop>(field, block))
            for (auto& edge : *crop) call(edge);
        return;
    default: return;
    }
}

} // namespace

std::span<const Property> propertiesOf(BlockType type) {
    static constexpr std::span<const Property> kTables[] = {kSettings, kWorld, kCamera, kTexture,
                                                            kMaterial, kLight, kMesh,   kObject};
    return kTables[static_cast<std::size_t>(type)];
}

const Property& propertyNamed(BlockType type, std::string_view keyword) {
    const auto rows = propertiesOf(type);
    return *std::find_if(rows.begin(), rows.end(),
                         [&](const Property& row) { return row.keyword == keyword; });
}

std::size_t getNumbers(const Property& property, const void* block, double* numbers) {
    double* next = numbers;
    const auto get = [&](const auto& number) { *next++ = static_cast<double>(number); };
    forEachNumber(property.first, block, get);
    forEachNumber(property.second, block, get);
    return static_cast<std::size_t>(next - numbers);
}

void setNumbers(const Property& property, void* block, const double* numbers) {
    const auto set = [&](auto& number) {
        number = static_cast<std::remove_reference_t<decltype(number)>>(*numbers++);
    };
    if (property.first.kind == FieldKind::Crop) at<Crop>(property.first, block).emplace();
    forEachNumber(property.first, block, set);
    forEachNumber(property.second, block, set);
}

bool isSame(const Property& property, const void* a, const void* b) {
    std::array<double, kMostNumbers> ofA, ofB;
    const std::size_t count = getNumbers(property, a, ofA.data());
    if (getNumbers(property, b, ofB.data()) != count ||
        !std::equal(ofA.begin(), ofA.begin() + count, ofB.begin()))
        return false;
    const Field& field = property.first;
    const auto same = [&]<class T>(const T&) { return at<T>(field, a) == at<T>(field, b); };
    switch (field.kind) {
    case FieldKind::Flag: return same(bool{});
    case FieldKind::Text: return same(std::string{});
    case FieldKind::Choice: return same(std::uint8_t{});
    case FieldKind::Name: return same(Handle{});
    case FieldKind::Material:
    case FieldKind::Materials: return same(OneOrMore<Handle>{});
    default: return true;
    }
}
