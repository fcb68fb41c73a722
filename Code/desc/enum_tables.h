// The words for the enums of SceneDesc, as they stand in scene files and on the command line, each
// list in the order of its enum.
#pragma once

#include "base/enum_names.h"
#include "desc/scene_desc.h"

// The words of blocks, but for those of objects: these are their kinds.
constexpr auto wordsOf(BlockType) {
    return words("settings", "world", "camera", "texture", "material", "light", "mesh", "object");
}
constexpr auto wordsOf(TextureDesc::Space) { return words("srgb", "linear"); }
constexpr auto wordsOf(TextureDesc::Interpolation) { return words("bilinear", "nearest"); }
constexpr auto wordsOf(TextureDesc::Extension) { return words("repeat", "extend", "clip"); }
constexpr auto wordsOf(TextureDesc::Channel) { return words("color", "alpha"); }
constexpr auto wordsOf(MaterialDesc::SpecularModel) { return words("blinn", "ashikhmin", "phong"); }
constexpr auto wordsOf(MaterialDesc::Fresnel) { return words("none", "dielectric", "schlick"); }
constexpr auto wordsOf(MaterialDesc::LitSide) { return words("eye", "outside"); }
constexpr auto wordsOf(MaterialDesc::Sides) { return words("both", "front"); }
constexpr auto wordsOf(LightDesc::Kind) {
    return words("point", "spot", "sun", "rectangle", "disk", "sphere");
}
constexpr auto wordsOf(LightDesc::SeenBy) { return words("none", "camera", "reflections", "all"); }
constexpr auto wordsOf(CameraDesc::Kind) { return words("perspective", "orthographic"); }
constexpr auto wordsOf(CameraDesc::SensorFit) { return words("auto", "horizontal", "vertical"); }
// These words open the blocks of objects.
constexpr auto wordsOf(ObjectDesc::Kind) {
    return words("sphere", "cube", "plane", "infinite_plane", "disk", "cylinder", "cone",
                 "instance");
}
constexpr auto wordsOf(ObjectDesc::Sides) { return words("both", "front", "back"); }
constexpr auto wordsOf(WorldDesc::Up) { return words("z", "y"); }
constexpr auto wordsOf(SettingsDesc::Sampler) {
    return words("sobol", "stratified", "random", "grid", "corners", "zsobol");
}
constexpr auto wordsOf(SettingsDesc::Filter) {
    return words("box", "tent", "gaussian", "blackman-harris");
}
constexpr auto wordsOf(SettingsDesc::TextureFilter) { return words("mip", "none"); }
constexpr auto wordsOf(SettingsDesc::Transfer) { return words("srgb", "linear"); }
constexpr auto wordsOf(SettingsDesc::Integrator) {
    return words("whitted", "path", "ao", "normal", "depth", "albedo", "id", "uv");
}
