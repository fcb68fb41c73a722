#include "fuzz/sound.h"

#include "base/text.h"
#include "desc/validate.h"
#include "desc/write_txt.h"
#include "read/txt/read_txt.h"

#include <algorithm>
#include <cmath>

namespace fuzz {

namespace {

// Text for a terminal: no control character of the input may reach it.
void checkMessage(std::string_view message, std::string_view fileName, std::string_view severity) {
    expect(message.starts_with(fileName), cat("a message without the file's name: ", message));
    expect(message.find(cat(": ", severity, ": ")) != std::string_view::npos,
           cat("a message without '", severity, "': ", message));
    for (const char c : message)
        expect((c < 0 || c >= ' ' || c == '\n') && c != 127,
               cat("a message with the byte ", static_cast<int>(c), ": ", message));
    expect(message.size() < 100'000, cat("a message of ", message.size(), " bytes"));
}

} // namespace

void checkError(const Error& error, std::string_view fileName) {
    expect(error.kind() == ErrorKind::Input, cat("not an error of input: ", error.what()));
    checkMessage(error.what(), fileName, "error");
}

void checkWarnings(const Diagnostics& diagnostics, std::string_view fileName) {
    for (const std::string& warning : diagnostics.warnings)
        checkMessage(warning, fileName, "warning");
}

void checkScene(const SceneDesc& desc, const SourceFile& source) {
    Diagnostics diagnostics;
    validate(desc, source, diagnostics);
    checkWarnings(diagnostics, source.name);
    // A few lines of JSON can stand for 2^20 objects: those only take longer.
    constexpr std::size_t kWritten = 1000;
    if (desc.objects.size() > kWritten) return;
    const SourceFile again{"again.txt", writeTxt(desc)};
    try {
        const SceneDesc back = readTxt(again);
        expect(back == desc, cat("reads back differently:\n", again.text));
        validate(back, again, diagnostics);
    } catch (const Error& error) {
        throw Unsound(cat("does not read back: ", error.what(), "\n", again.text));
    }
}

void checkMesh(const MeshFile& file, const SourceFile& source) {
    const MeshDesc& mesh = file.mesh;
    expect(file.materialLocs.size() == file.materials.size(),
           cat(file.materials.size(), " materials, ", file.materialLocs.size(), " places"));
    for (const std::uint32_t slot : mesh.triangleMaterials)
        expect(slot < file.materials.size(), cat("slot ", slot, " of ", file.materials.size()));
    const auto isNotAfter = [](const MeshFile::Part& a, const MeshFile::Part& b) {
        return a.firstTriangle >= b.firstTriangle;
    };
    expect(std::adjacent_find(file.parts.begin(), file.parts.end(), isNotAfter) ==
                   file.parts.end() &&
               (file.parts.empty() || file.parts.back().firstTriangle < mesh.triangles.size()),
           "a part without triangles");
    SceneDesc desc;
    desc.cameras.emplace_back().name = "camera";
    desc.meshes = {mesh};
    desc.meshes[0].name = "mesh";
    ObjectDesc& object = desc.objects.emplace_back();
    object.name = "object";
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    try {
        checkScene(desc, source);
    } catch (const Error& error) {
        if (!mesh.triangles.empty()) throw Unsound(error.what());
        throw;
    }
}

void checkPicture(const StoredImage& picture) {
    using Depth = StoredImage::Depth;
    expect(picture.width >= 1 && picture.width <= Image::kMaxSide && picture.height >= 1 &&
               picture.height <= Image::kMaxSide && picture.channels >= 1 && picture.channels <= 4,
           cat("a picture of ", picture.width, "x", picture.height, "x", picture.channels));
    const std::size_t count = static_cast<std::size_t>(picture.width) *
                              static_cast<std::size_t>(picture.height) *
                              static_cast<std::size_t>(picture.channels);
    const auto has = [&](std::size_t size, Depth depth) {
        return size == (picture.depth == depth ? count : 0);
    };
    expect(has(picture.bytes.size(), Depth::Bits8) && has(picture.words.size(), Depth::Bits16) &&
               has(picture.floats.size(), Depth::Float),
           cat(picture.bytes.size(), " bytes, ", picture.words.size(), " words and ",
               picture.floats.size(), " floats for ", count, " samples"));
    const auto isFinite = [](float value) { return std::isfinite(value); };
    expect(std::all_of(picture.floats.begin(), picture.floats.end(), isFinite),
           "a sample is not finite");
    constexpr std::size_t kDecoded = 1 << 20; // larger ones only take longer
    if (count > kDecoded) return;
    const Image image(picture);
    for (const Rgb& pixel : image.pixels())
        expect(isFinite(pixel.r) && isFinite(pixel.g) && isFinite(pixel.b),
               "a pixel is not finite");
}

} // namespace fuzz
