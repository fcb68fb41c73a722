// The words for the enums of SceneDesc, as they stand in scene files and on the command line.
#pragma once

#include "base/enum_names.h"
#include "desc/scene_desc.h"

// The words of blocks, but for those of objects: these are their kinds.
template <>
inline constexpr auto kEnumNames<BlockType> = std::to_array<EnumName<BlockType>>({
    {BlockType::Settings, "settings"},
    {BlockType::World, "world"},
    {BlockType::Camera, "camera"},
    {BlockType::Texture, "texture"},
    {BlockType::Material, "material"},
    {BlockType::Light, "light"},
    {BlockType::Mesh, "mesh"},
    {BlockType::Object, "object"},
});

template <>
inline constexpr auto kEnumNames<TextureDesc::Space> = std::to_array<EnumName<TextureDesc::Space>>({
    {TextureDesc::Space::Srgb, "srgb"},
    {TextureDesc::Space::Linear, "linear"},
});
template <>
inline constexpr auto
    kEnumNames<TextureDesc::Interpolation> = std::to_array<EnumName<TextureDesc::Interpolation>>({
        {TextureDesc::Interpolation::Bilinear, "bilinear"},
        {TextureDesc::Interpolation::Nearest, "nearest"},
    });
template <>
inline constexpr auto
    kEnumNames<TextureDesc::Extension> = std::to_array<EnumName<TextureDesc::Extension>>({
        {TextureDesc::Extension::Repeat, "repeat"},
        {TextureDesc::Extension::Extend, "extend"},
        {TextureDesc::Extension::Clip, "clip"},
    });
template <>
inline constexpr auto
    kEnumNames<TextureDesc::Channel> = std::to_array<EnumName<TextureDesc::Channel>>({
        {TextureDesc::Channel::Color, "color"},
        {TextureDesc::Channel::Alpha, "alpha"},
    });

template <>
inline constexpr auto
    kEnumNames<MaterialDesc::SpecularModel> = std::to_array<EnumName<MaterialDesc::SpecularModel>>({
        {MaterialDesc::SpecularModel::Blinn, "blinn"},
        {MaterialDesc::SpecularModel::Ashikhmin, "ashikhmin"},
        {MaterialDesc::SpecularModel::Phong, "phong"},
    });
template <>
inline constexpr auto
    kEnumNames<MaterialDesc::Fresnel> = std::to_array<EnumName<MaterialDesc::Fresnel>>({
        {MaterialDesc::Fresnel::None, "none"},
        {MaterialDesc::Fresnel::Dielectric, "dielectric"},
        {MaterialDesc::Fresnel::Schlick, "schlick"},
    });

template <>
inline constexpr auto
    kEnumNames<MaterialDesc::LitSide> = std::to_array<EnumName<MaterialDesc::LitSide>>({
        {MaterialDesc::LitSide::Eye, "eye"},
        {MaterialDesc::LitSide::Outside, "outside"},
    });

template <>
inline constexpr auto
    kEnumNames<MaterialDesc::Sides> = std::to_array<EnumName<MaterialDesc::Sides>>({
        {MaterialDesc::Sides::Both, "both"},
        {MaterialDesc::Sides::Front, "front"},
    });

template <>
inline constexpr auto kEnumNames<LightDesc::Kind> = std::to_array<EnumName<LightDesc::Kind>>({
    {LightDesc::Kind::Point, "point"},
    {LightDesc::Kind::Spot, "spot"},
    {LightDesc::Kind::Sun, "sun"},
    {LightDesc::Kind::Rectangle, "rectangle"},
    {LightDesc::Kind::Disk, "disk"},
    {LightDesc::Kind::Sphere, "sphere"},
});

template <>
inline constexpr auto kEnumNames<LightDesc::SeenBy> = std::to_array<EnumName<LightDesc::SeenBy>>({
    {LightDesc::SeenBy::None, "none"},
    {LightDesc::SeenBy::Camera, "camera"},
    {LightDesc::SeenBy::Reflections, "reflections"},
    {LightDesc::SeenBy::All, "all"},
});

template <>
inline constexpr auto kEnumNames<CameraDesc::Kind> = std::to_array<EnumName<CameraDesc::Kind>>({
    {CameraDesc::Kind::Perspective, "perspective"},
    {CameraDesc::Kind::Orthographic, "orthographic"},
});
template <>
inline constexpr auto
    kEnumNames<CameraDesc::SensorFit> = std::to_array<EnumName<CameraDesc::SensorFit>>({
        {CameraDesc::SensorFit::Auto, "auto"},
        {CameraDesc::SensorFit::Horizontal, "horizontal"},
        {CameraDesc::SensorFit::Vertical, "vertical"},
    });

// These words open the blocks of objects.
template <>
inline constexpr auto kEnumNames<ObjectDesc::Kind> = std::to_array<EnumName<ObjectDesc::Kind>>({
    {ObjectDesc::Kind::Sphere, "sphere"},
    {ObjectDesc::Kind::Cube, "cube"},
    {ObjectDesc::Kind::Plane, "plane"},
    {ObjectDesc::Kind::InfinitePlane, "infinite_plane"},
    {ObjectDesc::Kind::Disk, "disk"},
    {ObjectDesc::Kind::Cylinder, "cylinder"},
    {ObjectDesc::Kind::Cone, "cone"},
    {ObjectDesc::Kind::Mesh, "instance"},
});
template <>
inline constexpr auto kEnumNames<ObjectDesc::Sides> = std::to_array<EnumName<ObjectDesc::Sides>>({
    {ObjectDesc::Sides::Both, "both"},
    {ObjectDesc::Sides::Front, "front"},
    {ObjectDesc::Sides::Back, "back"},
});

template <>
inline constexpr auto kEnumNames<WorldDesc::Up> = std::to_array<EnumName<WorldDesc::Up>>({
    {WorldDesc::Up::Z, "z"},
    {WorldDesc::Up::Y, "y"},
});

template <>
inline constexpr auto
    kEnumNames<SettingsDesc::Sampler> = std::to_array<EnumName<SettingsDesc::Sampler>>({
        {SettingsDesc::Sampler::Sobol, "sobol"},
        {SettingsDesc::Sampler::Stratified, "stratified"},
        {SettingsDesc::Sampler::Random, "random"},
        {SettingsDesc::Sampler::Grid, "grid"},
        {SettingsDesc::Sampler::Corners, "corners"},
    });
template <>
inline constexpr auto
    kEnumNames<SettingsDesc::Filter> = std::to_array<EnumName<SettingsDesc::Filter>>({
        {SettingsDesc::Filter::Box, "box"},
        {SettingsDesc::Filter::Tent, "tent"},
        {SettingsDesc::Filter::Gaussian, "gaussian"},
        {SettingsDesc::Filter::BlackmanHarris, "blackman-harris"},
    });
template <>
inline constexpr auto
    kEnumNames<SettingsDesc::Transfer> = std::to_array<EnumName<SettingsDesc::Transfer>>({
        {SettingsDesc::Transfer::Srgb, "srgb"},
        {SettingsDesc::Transfer::Linear, "linear"},
    });
template <>
inline constexpr auto
    kEnumNames<SettingsDesc::Integrator> = std::to_array<EnumName<SettingsDesc::Integrator>>({
        {SettingsDesc::Integrator::Whitted, "whitted"},
        {SettingsDesc::Integrator::Path, "path"},
        {SettingsDesc::Integrator::Ao, "ao"},
        {SettingsDesc::Integrator::Normal, "normal"},
        {SettingsDesc::Integrator::Depth, "depth"},
        {SettingsDesc::Integrator::Albedo, "albedo"},
        {SettingsDesc::Integrator::Id, "id"},
        {SettingsDesc::Integrator::Uv, "uv"},
    });

static_assert(isInOrder<BlockType>() && isInOrder<TextureDesc::Space>() &&
              isInOrder<TextureDesc::Interpolation>() && isInOrder<TextureDesc::Extension>() &&
              isInOrder<TextureDesc::Channel>() && isInOrder<MaterialDesc::SpecularModel>() &&
              isInOrder<MaterialDesc::Fresnel>() && isInOrder<MaterialDesc::LitSide>() &&
              isInOrder<MaterialDesc::Sides>() && isInOrder<LightDesc::Kind>() &&
              isInOrder<LightDesc::SeenBy>() && isInOrder<CameraDesc::Kind>() &&
              isInOrder<CameraDesc::SensorFit>() && isInOrder<ObjectDesc::Kind>() &&
              isInOrder<ObjectDesc::Sides>() && isInOrder<WorldDesc::Up>() &&
              isInOrder<SettingsDesc::Sampler>() && isInOrder<SettingsDesc::Filter>() &&
              isInOrder<SettingsDesc::Transfer>() && isInOrder<SettingsDesc::Integrator>());
