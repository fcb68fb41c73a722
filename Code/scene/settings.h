// RenderSettings: every choice that a picture depends on besides the scene itself. Made from
// SettingsDesc and the command line (cli/), read by the renderer.
#pragma once

#include "base/math.h"
#include "desc/scene_desc.h"
#include "image/image.h"
#include "isa/isa.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

using IntegratorKind = SettingsDesc::Integrator;
enum class AccelKind { Bvh, None };
// More pictures. Error: what is estimated of each pixel, where the picture has a refinement.
enum class Aov { Depth, Normal, Albedo, Position, Id, Samples, Error };

// The features that --no-x switches off. All true: the scene decides.
struct Switches {
    bool shadows = true, softShadows = true, reflection = true, refraction = true, glossy = true;
    bool textures = true, dof = true, motionBlur = true, fresnel = true, aa = true;
    bool operator==(const Switches&) const = default;
};

// What an error is told in. Display: the picture as it is shown, after exposure, clipping and transfer, 1 is
// full scale. Linear: its linear values with the exposure. Relative: those against what is right.
enum class ErrorUnit { Display, Linear, Relative };

// --error, --time, --passes: samples where they are needed, pass by pass, until an end is reached. --denoise
// alone: as many of every pixel, in passes whose differences show the noise.
struct Refinement {
    // Samples of every pixel before it is decided which get more; samplers that spread a known number of
    // samples spread so many, again and again.
    static constexpr int kFirstSamples = 16;

    std::optional<double> error = {}; // the RMSE of the picture is below this
    ErrorUnit unit = ErrorUnit::Display;
    bool ofWorstBlock = false;   // instead, that of 99 % of the blocks
    bool hasTime = false;        // the caller's clock ends it
    std::optional<int> passes = {}; // it has so many
    int mostSamples = 65536;     // per pixel, at least 2
    // Not 0: every pixel gets mostSamples in so many doublings, and errors decide nothing.
    int evenDoublings = 0;

    // The end may come at any time: the passes are short.
    bool hasShortPasses() const { return hasTime || passes; }
};

struct RenderSettings {
    // Resolution, crop, samples, integrator, depths, filter, exposure ...; --no-aa sets 1 sample.
    SettingsDesc picture;
    std::string camera; // name; empty: the first one of the scene
    Switches switches;
    // Then the samples of `picture` are those of the first look only.
    std::optional<Refinement> refinement;
    AccelKind accel = AccelKind::Bvh;
    const Isa* isa = &oneLane(); // whose kernels trace and shade
    int threads = 1;             // resolved, at least 1
    std::optional<Rgbd> background;
    std::vector<Aov> aovs;
    // Picture::codes is to take the place of Picture::color where it can: all that is wanted of it
    // is a file of 8 bits, with the exposure as it is.
    bool onlyCodes = false;
    // Off: every step is done for every scene, needed or not (the yardstick of T17 and of timings).
    bool specialise = true;
    std::string textureFolder; // --textures DIR; searched after the scene's own folder
    // A picture that cannot be read is a warning of the scene, and its texture is left out.
    bool picturesMayMiss = false;
    // How the work is cut, which no picture may depend on; at least 1. A tile is what one worker
    // does at a time. A chunk of its samples is traced together: enough rays for a wave, few enough
    // for the cache.
    int tileSide = 16;
    int chunkSamples = 4096;
    // Instances are copied into the scene, where rays are faster, as long as the copies have no
    // more triangles than this together.
    std::uint64_t copiedTriangles = 1 << 18;
};

// Returns what a file of the picture is to be, as far as the settings say. Pictures of one sample
// per pixel are drafts: they are made in milliseconds, and a file as small as can be would take up
// to a third longer to write.
inline Encoding encodingOf(const RenderSettings& settings, int bits) {
    const bool isSrgb = settings.picture.transfer == SettingsDesc::Transfer::Srgb;
    return {isSrgb ? Encoding::Transfer::Srgb : Encoding::Transfer::Linear, bits,
            settings.picture.samplesPerPixel == 1};
}
