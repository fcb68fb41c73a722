// What a run says beside its errors: on stderr, but for statistics as JSON.
#pragma once

#include "base/error.h"
#include "cli/options.h"
#include "cli/stats_output.h"
#include "render/render.h"
#include "scene/scene.h"
#include "scene/settings.h"
#include "scene/stats.h"

#include <string>
#include <string_view>

// Complete lines in one call, so that they are not torn apart by a bar or another program.
// Nothing can be done about a message that does not arrive.
void writeStderr(std::string_view text);

void printWarnings(const Diagnostics& diagnostics);
// True when --strict ends the program here.
bool isTooStrict(const Options& options, const Diagnostics& diagnostics);
void printAdvice(const RenderSettings& settings, const Options& options);
// What was asked for was not reached, because --spp allows no more.
void printShortfall(const Stats& stats, const RenderSettings& settings, const Options& options);
// What adviceOn() has to say of a picture of light; a warning, but the picture is there all the
// same: it is no reason for --strict.
void printExposure(const Picture& picture, const Scene& scene, const RenderSettings& settings,
                   const std::string& output);
void printPreview(const Picture& picture, const RenderSettings& settings);
void printStats(const Stats& stats, const RunFacts& run, const Options& options);
