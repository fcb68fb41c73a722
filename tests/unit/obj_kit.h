// What the tests of the OBJ reader share: reading a text, and what to look at in the result.
#pragma once

#include "base/text.h"
#include "check.h"
#include "read/mesh/mesh_file.h"

#include <cstddef>
#include <string>
#include <utility>
#include <vector>

namespace obj_kit {

using Corners = MeshDesc::Corners;
using Triangles = std::vector<Corners>;

struct Result : MeshFile {
    std::vector<std::string> warnings;
};
inline Result readText(const std::string& text) {
    Diagnostics diagnostics;
    MeshFile file = readObj({"t.obj", text}, {{}, diagnostics});
    return {std::move(file), diagnostics.warnings};
}
// Four points of a square, for the statements that follow.
inline const std::string kSquare = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";
inline Result readBody(const std::string& body) { return readText(kSquare + body); }
inline std::string messageOf(const std::string& body) {
    return check::thrown([&] { readBody(body); });
}
inline bool warns(const Result& result, const std::string& words) {
    for (const std::string& warning : result.warnings)
        if (warning.find(words) != std::string::npos) return true;
    return false;
}
inline std::string partsOf(const MeshFile& file) {
    std::string text;
    for (const MeshFile::Part& part : file.parts)
        text += cat(part.name, "@", part.firstTriangle, " ");
    return text;
}
inline Vec3 normalAt(const MeshDesc& mesh, std::size_t triangle, std::size_t corner) {
    return mesh.normals.at(mesh.normalTriangles.at(triangle)[corner]);
}
inline Vec2 uvAt(const MeshDesc& mesh, std::size_t triangle, std::size_t corner) {
    return mesh.uvs.at(mesh.uvTriangles.at(triangle)[corner]);
}

} // namespace obj_kit
