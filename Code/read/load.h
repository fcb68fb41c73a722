// Lists that a text fills, block by block.
#pragma once

#include "base/error.h"
#include "base/function_ref.h"
#include "base/source.h"
#include "desc/scene_desc.h"
#include "read/read_context.h"

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

// Room for `more` things in a list of those that a text says from its byte `first` on. Doubling
// touches memory twice, which for many things costs as much as reading them; the text that those so
// far took, and others between them, `here` bytes from its start, says how many there will be up to
// `last`. Memory that is not touched costs nothing.
template <class List>
void makeRoomByText(List& list, std::size_t more, std::size_t first, std::size_t here,
                    std::size_t last) {
    constexpr std::size_t kMany = 1000;
    constexpr double kMargin = 1.1, kLeast = 1.5, kMost = 256;
    if (list.size() + more <= list.capacity() || list.size() < kMany || here <= first) return;
    const double left = here < last ? static_cast<double>(last - here) : 0;
    const double growth = 1 + kMargin * left / static_cast<double>(here - first);
    const double wanted = static_cast<double>(list.size()) * std::clamp(growth, kLeast, kMost);
    list.reserve(static_cast<std::size_t>(wanted));
}

// One block more, `here` bytes from the start of the text.
template <class Block>
Block& addedByText(std::vector<Block>& blocks, std::size_t here, std::size_t last) {
    if (!blocks.empty()) makeRoomByText(blocks, 1, blocks.front().loc.offset, here, last);
    return blocks.emplace_back();
}

// What a scene in JSON has that cannot be rendered, and does without under --lenient.

// Takes out what validate() would refuse: lights, objects, meshes that could not be read, and a
// crop. Warns of each. The scene has its meshes.
void leaveOutWrong(SceneDesc& desc, const SourceFile& source, const ReadContext& context);

// A message as a warning, with what follows from it.
std::string asWarning(std::string message, std::string_view consequence);

// The files that a scene names for its meshes, and mesh files that are to be seen by themselves.

// Extensions of the files below, lower case, with their dots.
std::vector<std::string> meshFileExtensions();

// Reads every mesh that names a file and empties the name: relative to the scene's folder, then to
// the working directory, then to the folder around the scene's. Material slots are in the order in
// which the file uses its materials. Fails at the place of the name.
void loadMeshFiles(SceneDesc& desc, const SourceFile& scene, const ReadContext& context);

// A scene around a mesh file, with the materials of the libraries beside it.
SceneDesc readMeshScene(const SourceFile& source, const ReadContext& context);

// From a file name to a scene that is known to be sound: the one way in for main().

struct LoadedScene {
    SourceFile source; // for messages about places in desc
    SceneDesc desc;
    // Pictures that cannot be read are left out with a warning, and are no error: those of meshes,
    // which often come without them, and of JSON under --lenient.
    bool picturesMayMiss = false;
};

// The reader is chosen by the extension; "-" is native text on stdin. The meshes that the scene
// keeps in files are read as well. Throws Error (Input).
// foreseen(desc, name of the scene's file): what is known of it so far and may still be wrong, for
// who can begin something with that. Called once or more often, and does not throw.
using Foreseen = FunctionRef<void(const SceneDesc& desc, const std::string& sceneFile)>;
LoadedScene load(const std::string& fileName, Diagnostics& diagnostics,
                 const ReadOptions& options = {}, Foreseen foreseen = {});
