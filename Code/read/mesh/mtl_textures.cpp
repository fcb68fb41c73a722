#include "read/mesh/read_mtl.h"

#include "base/text.h"
#include "desc/names.h"
#include "desc/range.h"

#include <algorithm>

namespace {

// -o -s -t: one to three numbers; those that are not there keep their value.
Vec2d readUpToThree(LineReader& in, std::string_view option, Vec2d value) {
    value.x = in.number<double>(option, kLargestLength);
    if (in.atNumber()) value.y = in.number<double>(option, kLargestLength);
    if (in.atNumber()) in.number<double>(option, kLargestLength); // of solid textures
    return value;
}

bool readOnOff(LineReader& in, std::string_view option) {
    const bool atEnd = in.atLineEnd();
    const std::size_t place = in.offset();
    const std::string found = in.nextWord();
    const std::string_view word = in.word();
    if (atEnd || (word != "on" && word != "off"))
        in.failAt(place, cat("expected 'on' or 'off' after '", option, "', got ", found));
    return word == "on";
}

} // namespace

MtlTextures::Map MtlTextures::read(LineReader& in, std::string_view keyword,
                                   TextureDesc::Space space) {
    Map map;
    TextureDesc texture;
    texture.space = space;
    while (true) {
        if (in.take("-s")) {
            texture.scale = readUpToThree(in, "-s", texture.scale);
        } else if (in.take("-o")) {
            texture.offset = readUpToThree(in, "-o", texture.offset);
        } else if (in.take("-t")) { // turbulence
            readUpToThree(in, "-t", {});
        } else if (in.take("-clamp")) {
            texture.extension = readOnOff(in, "-clamp") ? TextureDesc::Extension::Extend
                                                        : TextureDesc::Extension::Repeat;
        } else if (in.take("-bm")) {
            map.bumpStrength = in.number<double>("-bm", 1000.0);
        } else if (in.take("-mm")) { // base and gain
            in.number<double>("-mm", kLargestLength);
            in.number<double>("-mm", kLargestLength);
        } else if (in.take("-boost")) {
            in.number<double>("-boost", kLargestLength);
        } else if (in.take("-texres")) {
            in.number<double>("-texres", kLargestLength);
        } else if (in.take("-blendu")) {
            readOnOff(in, "-blendu");
        } else if (in.take("-blendv")) {
            readOnOff(in, "-blendv");
        } else if (in.take("-cc")) {
            readOnOff(in, "-cc");
        } else if (in.take("-imfchan") || in.take("-type")) {
            in.word();
        } else {
            break;
        }
        if (in.atLineEnd()) break; // the file is missing
    }
    const bool isMissing = in.atLineEnd();
    const std::size_t place = in.offset();
    const std::string_view file = in.rest();
    if (isMissing)
        in.failAt(place, cat("expected the name of a picture file after '", keyword, "'"));
    if (const std::size_t bad = findBadText(file); bad != std::string_view::npos)
        in.failAt(place + bad, cat("unexpected byte '", shown(file.substr(bad, 1)),
                                   "'; names are UTF-8 without control characters"));
    texture.file = file;
    std::replace(texture.file.begin(), texture.file.end(), '\\', '/');
    texture.loc = texture.fileLoc = {static_cast<std::uint32_t>(place)};
    map.texture = add(std::move(texture));
    return map;
}

Handle MtlTextures::add(TextureDesc texture) {
    const std::string key =
        cat(static_cast<int>(texture.space), ' ', static_cast<int>(texture.extension), ' ',
            shortest(texture.scale.x), ' ', shortest(texture.scale.y), ' ',
            shortest(texture.offset.x), ' ', shortest(texture.offset.y), ' ', texture.file);
    const auto [entry, isNew] = known_.try_emplace(key, static_cast<Handle>(textures.size()));
    if (isNew) {
        texture.name = names_.of(texture.file);
        textures.push_back(std::move(texture));
    }
    return entry->second;
}
