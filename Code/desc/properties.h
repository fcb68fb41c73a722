// The properties of every kind of block, one row each: keyword, where it is stored, what it may be.
// Reader, writer, validation and tests walk these tables, so a new property is a new row (and its
// line in ASCII/README.md). Transforms and the arrays of meshes are not properties.
#pragma once

#include "desc/property.h"

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

inline constexpr auto kSettingsProperties = std::to_array<Property<SettingsDesc>>({
    {"resolution", &SettingsDesc::width, &SettingsDesc::height, {1, 65535}},
    {"pixel_aspect", &SettingsDesc::pixelAspect, {}, {0, 1000, true}},
    {"crop", &SettingsDesc::crop, {}, {0, 65535}},
    {"samples", &SettingsDesc::samplesPerPixel, {}, {1, 1 << 24}},
    {"light_samples", &SettingsDesc::lightSamples, {}, {1, 4096}},
    {"max_depth", &SettingsDesc::maxDepth, {}, {0, 1024}},
    {"cutoff", &SettingsDesc::cutoff, {}, kUnit},
    {"sampler", choice<&SettingsDesc::sampler>(), {}, {}},
    {"jitter", &SettingsDesc::jitter, {}, {}},
    {"seed", &SettingsDesc::seed, {}, kAnyUnsigned},
    {"filter", choice<&SettingsDesc::filter>(), &SettingsDesc::filterWidth, {0, 32, true}},
    {"exposure", &SettingsDesc::exposureEv, {}, {-64, 64}},
    {"transfer", choice<&SettingsDesc::transfer>(), {}, {}},
});

inline constexpr auto kWorldProperties = std::to_array<Property<WorldDesc>>({
    {"background", &WorldDesc::background, {}, kColor},
    {"ambient", &WorldDesc::ambient, {}, kColor},
    {"environment", Reference<WorldDesc>{&WorldDesc::environment, Target::Texture}, {}, {}},
    {"environment_up", choice<&WorldDesc::environmentUp>(), {}, {}},
    {"environment_rotation", &WorldDesc::rotationDeg, {}, kTurn},
});

inline constexpr auto kCameraProperties = std::to_array<Property<CameraDesc>>({
    {"type", choice<&CameraDesc::kind>(), {}, {}},
    {"lens", &CameraDesc::lensMm, {}, kPositive},
    {"sensor", &CameraDesc::sensorWidthMm, &CameraDesc::sensorHeightMm, kPositive},
    {"sensor_fit", choice<&CameraDesc::sensorFit>(), {}, {}},
    {"shift", &CameraDesc::shiftX, &CameraDesc::shiftY, kAnyNumber},
    {"ortho_scale", &CameraDesc::orthoScale, {}, kPositive},
    {"clip_start", &CameraDesc::clipStart, {}, kNotNegative},
    {"aperture_radius", &CameraDesc::apertureRadius, {}, kNotNegative},
    {"focus_distance", &CameraDesc::focusDistance, {}, kPositive},
    {"aperture_blades", &CameraDesc::apertureBlades, {}, {0, 256}},
    {"aperture_rotation", &CameraDesc::apertureRotationDeg, {}, kTurn},
    {"aperture_ratio", &CameraDesc::apertureRatio, {}, kPositive},
});

inline constexpr auto kTextureProperties = std::to_array<Property<TextureDesc>>({
    {"file", &TextureDesc::file, {}, {}},
    {"space", choice<&TextureDesc::space>(), {}, {}},
    {"interpolation", choice<&TextureDesc::interpolation>(), {}, {}},
    {"extension", choice<&TextureDesc::extension>(), {}, {}},
    {"channel", choice<&TextureDesc::channel>(), {}, {}},
    {"scale", &TextureDesc::scale, {}, kAnyNumber},
    {"rotation", &TextureDesc::rotationDeg, {}, kTurn},
    {"offset", &TextureDesc::offset, {}, kAnyNumber},
});

constexpr Reference<MaterialDesc> textureOf(Handle MaterialDesc::*handle) {
    return {handle, Target::Texture};
}
inline constexpr auto kMaterialProperties = std::to_array<Property<MaterialDesc>>({
    {"diffuse", &MaterialDesc::diffuse, {}, kColor},
    {"diffuse_texture", textureOf(&MaterialDesc::diffuseTexture), {}, {}},
    {"specular", &MaterialDesc::specular, {}, kColor},
    {"specular_texture", textureOf(&MaterialDesc::specularTexture), {}, {}},
    {"specular_model", choice<&MaterialDesc::specularModel>(), {}, {}},
    {"exponent", &MaterialDesc::exponent, {}, {0, 1e9}},
    {"lit_side", choice<&MaterialDesc::litSide>(), {}, {}},
    {"mirror", &MaterialDesc::mirror, {}, kColor},
    {"transmission", &MaterialDesc::transmission, {}, kColor},
    {"ior", &MaterialDesc::ior, {}, {0, 1000, true}},
    {"fresnel", choice<&MaterialDesc::fresnel>(), {}, {}},
    {"roughness", &MaterialDesc::roughness, {}, kUnit},
    {"emission", &MaterialDesc::emission, {}, kColor},
    {"emission_texture", textureOf(&MaterialDesc::emissionTexture), {}, {}},
    {"opacity", &MaterialDesc::opacity, {}, kUnit},
    {"opacity_texture", textureOf(&MaterialDesc::opacityTexture), {}, {}},
    {"filter", &MaterialDesc::filter, {}, kColor},
    {"normal_map", textureOf(&MaterialDesc::normalMap), {}, {}},
    {"normal_strength", &MaterialDesc::normalStrength, {}, {0, 1000}},
    {"bump_map", textureOf(&MaterialDesc::bumpMap), {}, {}},
    {"bump_strength", &MaterialDesc::bumpStrength, {}, {-1000, 1000}},
    {"bump_distance", &MaterialDesc::bumpDistance, {}, kAnyNumber},
});

inline constexpr auto kLightProperties = [] {
    using enum LightDesc::Kind;
    return std::to_array<Property<LightDesc>>({
        {"type", choice<&LightDesc::kind>(), {}, {}},
        {"color", &LightDesc::color, {}, kColor},
        {"attenuation", &LightDesc::attenuation, {}, kNotNegative, only(Point, Spot)},
        {"radius", &LightDesc::radius, {}, kNotNegative, only(Point, Spot, Sphere)},
        {"size", &LightDesc::size, {}, kPositive, only(Rectangle, Disk)},
        {"cone_angle", &LightDesc::coneAngleDeg, {}, {0, 180, true}, only(Spot)},
        {"blend", &LightDesc::blend, {}, kUnit, only(Spot)},
        {"cosine_falloff", &LightDesc::cosineFalloff, {}, {}, only(Spot)},
        {"angle", &LightDesc::angleDeg, {}, {0, 180}, only(Sun)},
        {"spread", &LightDesc::spreadDeg, {}, {0, 180, true}, only(Rectangle, Disk)},
        {"shadows", &LightDesc::shadows, {}, {}},
        {"visible", &LightDesc::visible, {}, {}, only(Rectangle, Disk, Sphere)},
    });
}();

inline constexpr auto kObjectProperties = [] {
    using enum ObjectDesc::Kind;
    return std::to_array<Property<ObjectDesc>>({
        {"material", MaterialList<ObjectDesc>{&ObjectDesc::materials, false}, {}, {}},
        {"radius", &ObjectDesc::radius, {}, kPositive, only(Sphere, Disk, Cylinder)},
        {"radius", &ObjectDesc::radius, {}, kNotNegative, only(Cone)},
        {"top_radius", &ObjectDesc::topRadius, {}, kNotNegative, only(Cone)},
        {"caps", &ObjectDesc::caps, {}, {}, only(Cylinder, Cone)},
        {"corners", &ObjectDesc::corners, {}, kAnyNumber, only(Plane)},
        {"mesh", Reference<ObjectDesc>{&ObjectDesc::mesh, Target::Mesh}, {}, {}, only(Mesh)},
        {"materials",
         MaterialList<ObjectDesc>{&ObjectDesc::materials, true},
         {},
         {},
         only(Mesh, InfinitePlane)},
        {"sides", choice<&ObjectDesc::sides>(), {}, {}},
    });
}();

// Instead of the arrays below.
inline constexpr auto kMeshProperties = std::to_array<Property<MeshDesc>>({
    {"file", &MeshDesc::file, {}, {}},
    {"smooth_angle", &MeshDesc::smoothAngleDeg, {}, {-1, 180}},
});

// What differs between blocks: the word for it, its table, its kind (0 when all are alike).
template <class Block> constexpr std::span<const Property<Block>> propertiesOf() {
    if constexpr (std::is_same_v<Block, SettingsDesc>)
        return kSettingsProperties;
    else if constexpr (std::is_same_v<Block, WorldDesc>)
        return kWorldProperties;
    else if constexpr (std::is_same_v<Block, CameraDesc>)
        return kCameraProperties;
    else if constexpr (std::is_same_v<Block, TextureDesc>)
        return kTextureProperties;
    else if constexpr (std::is_same_v<Block, MaterialDesc>)
        return kMaterialProperties;
    else if constexpr (std::is_same_v<Block, LightDesc>)
        return kLightProperties;
    else if constexpr (std::is_same_v<Block, MeshDesc>)
        return kMeshProperties;
    else
        return kObjectProperties;
}
template <class Block> constexpr std::string_view wordOf(const Block& block) {
    if constexpr (std::is_same_v<Block, SettingsDesc>)
        return "settings";
    else if constexpr (std::is_same_v<Block, WorldDesc>)
        return "world";
    else if constexpr (std::is_same_v<Block, CameraDesc>)
        return "camera";
    else if constexpr (std::is_same_v<Block, TextureDesc>)
        return "texture";
    else if constexpr (std::is_same_v<Block, MaterialDesc>)
        return "material";
    else if constexpr (std::is_same_v<Block, LightDesc>)
        return "light";
    else if constexpr (std::is_same_v<Block, MeshDesc>)
        return "mesh";
    else
        return nameOf(block.kind);
}
template <class Block> constexpr KindMask kindOf(const Block& block) {
    if constexpr (requires { block.kind; })
        return only(block.kind);
    else
        return kAllKinds;
}

// Calls with the position of every row of the block's table, as a constant: so the compiler knows
// what a row is like, and files of many blocks are walked over in a fraction of the time.
template <class Block, class Call> constexpr void forEachRow(Call&& call) {
    [&]<std::size_t... i>(std::index_sequence<i...>) {
        (call(std::integral_constant<std::size_t, i>{}), ...);
    }
    (std::make_index_sequence<propertiesOf<Block>().size()>());
}

inline const Corners4& allOf(const SeldomCorners& corners) { return *corners; }
inline Corners4& allOf(SeldomCorners& corners) { return corners.own(); }

// Calls with every number of a field (a reference to double, int or std::uint32_t) in the order of
// the file. A crop that is not there has no numbers. `f` is one of the alternatives of Field.
template <class Block, class Member, class Call>
void forEachNumberOf(Block& block, const Member& f, Call&& call) {
    if constexpr (requires { block.*f; }) {
        auto& value = block.*f;
        using Value = std::remove_cvref_t<decltype(value)>;
        if constexpr (std::is_same_v<Value, bool>)
            return;
        else if constexpr (std::is_arithmetic_v<Value>)
            call(value);
        else if constexpr (std::is_same_v<Value, Vec2d>)
            call(value.x), call(value.y);
        else if constexpr (std::is_same_v<Value, Vec3d>)
            call(value.x), call(value.y), call(value.z);
        else if constexpr (std::is_same_v<Value, Rgbd>)
            call(value.r), call(value.g), call(value.b);
        else if constexpr (std::is_same_v<Value, SeldomCorners>)
            for (auto& p : allOf(value)) call(p.x), call(p.y), call(p.z);
        else if constexpr (std::is_same_v<Value, Crop>)
            if (value)
                for (auto& edge : *value) call(edge);
    }
}
template <class Block, class FieldOfBlock, class Call>
void forEachNumber(Block& block, const FieldOfBlock& field, Call&& call) {
    std::visit([&](const auto& f) { forEachNumberOf(block, f, call); }, field);
}

// Does the field hold the same in both blocks?
template <class Block> bool sameField(const Block& a, const Block& b, const Field<Block>& field) {
    return std::visit(
        [&](const auto& f) {
            if constexpr (requires { a.*f; })
                return a.*f == b.*f;
            else if constexpr (requires { f.handle; })
                return a.*(f.handle) == b.*(f.handle);
            else if constexpr (requires { f.handles; })
                return a.*(f.handles) == b.*(f.handles);
            else
                return f.get(a) == f.get(b);
        },
        field);
}

// Calls with every reference of a block and what it names: call(Handle&, Target, keyword).
template <class Block, class Call> void forEachReference(Block& block, Call&& call) {
    using Plain = std::remove_const_t<Block>;
    forEachRow<Plain>([&](auto row) {
        constexpr const Property<Plain>& property = propertiesOf<Plain>()[decltype(row)::value];
        if constexpr (std::holds_alternative<Reference<Plain>>(property.first)) {
            constexpr auto one = std::get<Reference<Plain>>(property.first);
            call(block.*(one.handle), one.target, property.keyword);
        }
        if constexpr (std::holds_alternative<MaterialList<Plain>>(property.first)) {
            constexpr auto list = std::get<MaterialList<Plain>>(property.first);
            if constexpr (list.many)
                for (auto& handle : block.*(list.handles))
                    call(handle, Target::Material, "materials");
        }
    });
}

// Calls with every block that has properties.
template <class Scene, class Call> void forEachBlock(Scene& desc, Call&& call) {
    call(desc.settings);
    call(desc.world);
    for (auto& camera : desc.cameras) call(camera);
    for (auto& texture : desc.textures) call(texture);
    for (auto& material : desc.materials) call(material);
    for (auto& light : desc.lights) call(light);
    for (auto& mesh : desc.meshes) call(mesh);
    for (auto& object : desc.objects) call(object);
}

// The number arrays of a mesh: keyword, the array, what a group of them is called.
struct MeshArray {
    using Member =
        std::variant<RawVector<Vec3d> MeshDesc::*, RawVector<Vec3> MeshDesc::*,
                     RawVector<Vec2> MeshDesc::*, RawVector<MeshDesc::Corners> MeshDesc::*,
                     RawVector<std::uint32_t> MeshDesc::*>;
    std::string_view keyword;
    Member member;
    // Index arrays: the keyword of what they index; empty for the others.
    std::string_view indexes;
};
inline constexpr auto kMeshArrays = std::to_array<MeshArray>({
    {"points", &MeshDesc::points, ""},
    {"triangles", &MeshDesc::triangles, "points"},
    {"normals", &MeshDesc::normals, ""},
    {"normal_triangles", &MeshDesc::normalTriangles, "normals"},
    {"uvs", &MeshDesc::uvs, ""},
    {"uv_triangles", &MeshDesc::uvTriangles, "uvs"},
    {"triangle_materials", &MeshDesc::triangleMaterials, ""},
});
