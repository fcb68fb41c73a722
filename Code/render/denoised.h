// renderDenoised(): pictures of a quarter of the samples each, two of one seed and two of another, and what
// denoise() makes of them.
#pragma once

#include "render/render.h"

// As render(), of settings that ask for it; stats.denoisedError is known then.
Picture renderDenoised(const Scene& scene, const RenderSettings& settings,
                       const RenderControl& control, Stats& stats);
