// What a finished picture tells about its exposure: that hardly anything is to be seen in it, or
// that most of it is white, and the way out.
#pragma once

#include "render/render.h"
#include "scene/settings.h"

#include <cstddef>
#include <optional>
#include <string>

// A picture as its 8-bit file has it.
struct PictureLevels {
    // The largest linear value of a channel, at most 1; or any one of at least 0.02.
    float brightest = 0;
    // Pixels with a channel that is as bright as the file can tell.
    std::size_t pixels = 0, clipped = 0;
};

// Measures a picture with the exposure applied. Pixels of the colour `white` are not counted as
// clipped: a background of 1 is there because a white one is wanted.
PictureLevels levelsOf(const Picture& picture, const RenderSettings& settings,
                       std::optional<Rgb> white = {});

// A line without its end when no value is 0.02 or more, or when more than half of the pixels are
// clipped; else nothing. `keepsBright`: the file is one that tells values above 1 (.exr, .pfm), and
// nothing is clipped in it.
std::optional<std::string> adviceOn(const PictureLevels& levels, double exposureEv,
                                    bool keepsBright);
