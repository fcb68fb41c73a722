#include "fuzz/targets.h"

#include "fuzz/png_parts.h"
#include "fuzz/sound.h"
#include "read/read_txt.h"

#include <algorithm>
#include <array>
#include <string>

namespace fuzz {

namespace {

constexpr std::string_view kName = "input"; // what messages call the file

SourceFile sourceOf(Bytes file) { return {std::string(kName), {file.begin(), file.end()}}; }

void readNative(Bytes file) {
    const SourceFile source = sourceOf(file);
    checkScene(readTxt(source), source);
}

void readPicture(Bytes file) { checkPicture(decodeImage(file, std::string(kName))); }
void readPng(Bytes file) { readPicture(withRightChecksums(file)); }
void readPngRows(Bytes file) { readPicture(withPackedRows(file)); }

constexpr auto kTargets = std::to_array<Target>({
    {"txt", readNative},
    {"ppm", readPicture},
    {"pfm", readPicture},
    {"png", readPng},
    {"png_rows", readPngRows},
});

} // namespace

std::span<const Target> targets() { return kTargets; }

const Target* findTarget(std::string_view name) {
    const auto found = std::find_if(kTargets.begin(), kTargets.end(),
                                    [&](const Target& target) { return target.name == name; });
    return found == kTargets.end() ? nullptr : &*found;
}

Outcome run(const Target& target, Bytes file) {
    try {
        target.read(file);
        return Outcome::Read;
    } catch (const Error& error) {
        checkError(error, kName);
        return Outcome::Refused;
    }
}

} // namespace fuzz
