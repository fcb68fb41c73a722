// Where pictures go: names of files, whether they can be written, and writing them.
#pragma once

#include "base/source.h"
#include "cli/options.h"
#include "desc/scene_desc.h"
#include "image/image.h"
#include "render/render.h"
#include "scene/scene.h"
#include "scene/settings.h"

#include <span>
#include <string>
#include <string_view>
#include <vector>

// To stdout, all of it at once. Fails with ErrorKind::Output when it does not take everything.
void writeStdout(std::string_view data);

// Returns "room.png" for "scenes/room.txt", in the working folder; "stdin.png" for "-".
std::string defaultOutput(const std::string& scene);

// Tells whether a file of this name is there that keeps nothing: /dev/null, a pipe. A PPM is
// written to it.
bool isDevice(const std::string& fileName);

// .ppm, .png, .pfm or .exr, in any case.
bool hasPictureExtension(const std::string& fileName);

// Fails with ErrorKind::Output when a file of this name cannot be written: better now than after an
// hour of rendering.
void checkWritable(const std::string& fileName);

// "out.depth.pfm" for "out.png"
std::string aovFileName(const std::string& output, Aov aov);
// Returns the names of all files of a picture: `output`, and one for each AOV unless they are
// layers of an OpenEXR file.
std::vector<std::string> filesOf(const std::string& output, std::span<const Aov> aovs);

// The whole picture: black around the crop.
Image padded(const Image& crop, const SettingsDesc& picture);

// Times 2^EV; what would be infinite becomes the largest float.
void expose(Image& image, double ev);

// Is RenderSettings::onlyCodes all that writePicture() needs?
bool needsOnlyCodes(const RenderSettings& settings, const Options& options,
                    const std::string& output);

// Exposure and padding are applied, then the files of filesOf() are written, each atomically; "-"
// writes a PPM to stdout.
void writePicture(Picture picture, const RenderSettings& settings, const Options& options,
                  const std::string& output);

// A picture as text for a terminal: two pixels per cell, by the upper half block and 24-bit
// colours.

// At most `columns` wide and `rows` high, the shape of the picture kept; every cell is the mean of
// the pixels below it. Cells are taken as twice as high as wide.
std::string previewText(const Image& image, int columns, int rows);

// What a scene contains, for --info and --check.

// Several lines: picture, cameras, counts per kind, triangles, bounds, lights with units, textures
// with sizes, features, memory. Fails when a texture cannot be read.
std::string infoText(const SourceFile& source, const SceneDesc& desc,
                     const RenderSettings& settings, const Scene& scene);

// "12 objects, 3 lights, 4 materials, 34567 triangles": the same in one line.
std::string summaryText(const SceneDesc& desc);
