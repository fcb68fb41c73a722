// Chooses which channels of an OpenEXR file are its picture: other layers and parts hold depth,
// normals and the like.
#include "image/exr_header.h"

#include "base/text.h"

#include <algorithm>
#include <map>
#include <string_view>

namespace {

// Finds the channels of a part that can be read by their names.
class ExrNames {
public:
    explicit ExrNames(const ExrPart& part) {
        for (std::size_t i = 0; i < part.channels.size(); ++i)
            if (part.channels[i].type != kExrUint) indices_.emplace(part.channels[i].name, i);
    }

    // Returns R, G, B, and A if it is there, of the layer that decodeExr() takes; nothing if there
    // is no such layer.
    std::vector<std::size_t> rgb() const {
        if (hasRgb("")) return withAlpha("", {"R", "G", "B"});
        std::string first;
        for (const auto& [channel, index] : indices_) {
            if (!channel.ends_with(".R")) continue;
            const std::string prefix(channel.substr(0, channel.size() - 1));
            // The dot does not count: "a" is before "a-b".
            const auto bare = [](std::string_view text) { return text.substr(0, text.size() - 1); };
            if ((first.empty() || bare(prefix) < bare(first)) && hasRgb(prefix)) first = prefix;
        }
        if (first.empty()) return {};
        return withAlpha(first, {"R", "G", "B"});
    }
    // Returns Y, and A if it is there; nothing if there is no Y.
    std::vector<std::size_t> grey() const {
        if (!has("Y")) return {};
        return withAlpha("", {"Y"});
    }
    bool hasChroma() const { return has("RY") || has("BY"); }

private:
    bool has(std::string_view channel) const { return indices_.contains(channel); }
    bool hasRgb(const std::string& prefix) const {
        return has(prefix + "R") && has(prefix + "G") && has(prefix + "B");
    }
    std::vector<std::size_t> withAlpha(const std::string& prefix,
                                       std::vector<std::string_view> channels) const {
        if (has(prefix + "A")) channels.emplace_back("A");
        std::vector<std::size_t> chosen;
        chosen.reserve(channels.size());
        for (const std::string_view channel : channels)
            chosen.push_back(indices_.at(cat(prefix, channel)));
        return chosen;
    }

    std::map<std::string_view, std::size_t, std::less<>> indices_;
};

[[noreturn]] void failWithoutColour(const ExrHeaders& headers, const std::string& name) {
    constexpr std::size_t kShown = 12;
    std::vector<std::string> channels;
    for (const ExrPart& part : headers.parts)
        for (const ExrChannel& channel : part.channels)
            if (channels.size() <= kShown) channels.push_back(printable(channel.name));
    if (channels.size() > kShown) channels.back() = "...";
    failPicture(name, cat("there is no colour; R, G and B or Y of type HALF or FLOAT are needed, "
                          "and the channels are: ",
                          channels.empty() ? "none" : join(channels)));
}

} // namespace

ExrColour chooseExrColour(const ExrHeaders& headers, const std::string& name) {
    ExrColour grey;
    bool hasDeep = false, hasChroma = false;
    for (std::size_t i = 0; i < headers.parts.size(); ++i) {
        const ExrPart& part = headers.parts[i];
        hasDeep = hasDeep || part.isDeep;
        if (part.isDeep) continue;
        const ExrNames names(part);
        if (std::vector<std::size_t> rgb = names.rgb(); !rgb.empty()) return {i, std::move(rgb)};
        hasChroma = hasChroma || names.hasChroma();
        if (grey.channels.empty() && !names.hasChroma()) grey = {i, names.grey()};
    }
    if (!grey.channels.empty()) return grey;
    if (hasChroma)
        failPicture(name, "the picture is luminance-chroma (Y, RY, BY), which is not read; it must "
                          "be R, G, B or Y");
    if (hasDeep)
        failPicture(name,
                    "the picture is deep data, which is not read; it must be of scan lines or "
                    "tiles");
    failWithoutColour(headers, name);
}
