// What has to hold of everything that a reader accepts, and of every message when it does not.
#pragma once

#include "base/error.h"
#include "base/source.h"
#include "desc/scene_desc.h"
#include "image/image.h"
#include "read/mesh/mesh_file.h"

#include <stdexcept>
#include <string>
#include <string_view>

namespace fuzz {

struct Unsound : std::logic_error {
    using std::logic_error::logic_error;
};
inline void expect(bool isSound, const std::string& what) {
    if (!isSound) throw Unsound(what);
}

// "NAME...: error: what", printable.
void checkError(const Error& error, std::string_view fileName);
void checkWarnings(const Diagnostics& diagnostics, std::string_view fileName);

// Throws Error when validate() refuses the scene. What it accepts is written as native text and
// read back: it must be the same.
void checkScene(const SceneDesc& desc, const SourceFile& source);

// Indices, parts and materials fit the arrays; as the one object of a scene it passes checkScene().
void checkMesh(const MeshFile& file, const SourceFile& source);

// Dimensions, counts and values fit each other; Image takes it.
void checkPicture(const StoredImage& picture);

} // namespace fuzz
