// renderDenoised(): pictures of a quarter of the samples each, two of one seed and two of another, and what
// denoise() makes of them.
#pragma once

#include "render/render.h"

// Renders as render() does, for settings that ask for a denoised picture, and fills in stats.denoisedError.
Picture renderDenoised(const Scene& scene, const RenderSettings& settings,
                       const RenderControl& control, Stats& stats);
