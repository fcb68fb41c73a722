// The words on the command line for the enums of RenderSettings and Options.
#pragma once

#include "base/enum_names.h"
#include "cli/options.h"
#include "scene/settings.h"

template <>
inline constexpr auto kEnumNames<AccelKind> =
    std::to_array<EnumName<AccelKind>>({{AccelKind::Bvh, "bvh"}, {AccelKind::None, "none"}});
template <>
inline constexpr auto kEnumNames<Aov> = std::to_array<EnumName<Aov>>({{Aov::Depth, "depth"},
                                                                      {Aov::Normal, "normal"},
                                                                      {Aov::Albedo, "albedo"},
                                                                      {Aov::Position, "position"},
                                                                      {Aov::Id, "id"},
                                                                      {Aov::Samples, "samples"}});
template <>
inline constexpr auto kEnumNames<Options::Progress> =
    std::to_array<EnumName<Options::Progress>>({{Options::Progress::Auto, "auto"},
                                                {Options::Progress::Plain, "plain"},
                                                {Options::Progress::None, "none"}});

static_assert(isInOrder<AccelKind>() && isInOrder<Aov>() && isInOrder<Options::Progress>());
