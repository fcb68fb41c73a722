// Reads the headers of OpenEXR files (OpenEXR File Layout, "Version Field", "Header").
#include "image/exr_header.h"

#include "base/text.h"
#include "image/bits.h"

#include <algorithm>
#include <utility>

namespace {

class ExrHeaderReader {
public:
    ExrHeaderReader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    ExrHeaders read() {
        if (number("magic number") != kExrMagic)
            broken("this is no OpenEXR file; it must begin with the bytes 76 2F 31 01");
        takeVersion();
        do {
            headers_.parts.push_back(takePart());
        } while (headers_.isMultiPart && !isAtZero());
        if (headers_.isMultiPart) ++at_; // an empty header is the last one
        headers_.end = at_;
        return std::move(headers_);
    }

private:
    [[noreturn]] void broken(const std::string& what) const { failPicture(name_, what); }
    Bytes take(std::size_t count, std::string_view what) {
        if (count > file_.size() - at_)
            broken(cat("the file ends in the middle of the header (", what,
                       "); it is cut off or damaged"));
        const Bytes bytes = file_.subspan(at_, count);
        at_ += count;
        return bytes;
    }
    std::uint32_t number(std::string_view what) {
        return loadLittle<std::uint32_t>(take(4, what).data());
    }
    bool isAtZero() const {
        if (at_ == file_.size())
            broken("the file ends in the middle of the header; it is cut off or damaged");
        return file_[at_] == 0;
    }
    // Returns the text before the next zero byte of `bytes` from `at`, which moves behind that.
    std::string_view textIn(Bytes bytes, std::size_t& at, std::string_view what) const {
        const Bytes rest = bytes.subspan(at, std::min(bytes.size() - at, kExrLongName + 1));
        const auto end = std::find(rest.begin(), rest.end(), std::uint8_t{0});
        if (end == rest.end())
            broken(cat("the ", what, " at byte ", at, " does not end; at most ", kExrLongName,
                       " bytes and a zero"));
        const auto length = static_cast<std::size_t>(end - rest.begin());
        at += length + 1;
        return {reinterpret_cast<const char*>(rest.data()), length};
    }

    void takeVersion() {
        const std::uint32_t field = number("version");
        if ((field & 0xFF) != kExrVersion)
            broken(cat("the version of OpenEXR is ", field & 0xFF, "; only 2 is read"));
        const std::uint32_t flags = field & ~std::uint32_t{0xFF};
        const std::uint32_t known = kExrTiled | kExrLongNames | kExrDeep | kExrMultiPart;
        if ((flags & ~known) != 0)
            broken(cat("the version field has the unknown flags ", flags & ~known,
                       "; known are 512, 1024, 2048, 4096"));
        headers_.isMultiPart = (flags & kExrMultiPart) != 0;
        if (headers_.isMultiPart) return; // there each part says what it is
        isTiled_ = (flags & kExrTiled) != 0;
        isDeep_ = (flags & kExrDeep) != 0;
    }

    ExrPart takePart() {
        ExrPart part;
        part.isTiled = isTiled_;
        part.isDeep = isDeep_;
        while (!isAtZero()) {
            const std::string_view attribute = textIn(file_, at_, "name of an attribute");
            const std::string_view type = textIn(file_, at_, "type of an attribute");
            const std::uint32_t size = number("the size of an attribute");
            takeAttribute(part, attribute, type, take(size, printable(attribute)));
        }
        ++at_;
        return part;
    }

    void takeAttribute(ExrPart& part, std::string_view attribute, std::string_view type,
                       Bytes value) {
        const auto need = [&](std::string_view rightType, std::size_t rightSize) {
            if (type != rightType || value.size() != rightSize)
                broken(cat("the attribute ", attribute, " is a ", printable(type), " of ",
                           value.size(), " bytes; it must be a ", rightType, " of ", rightSize));
        };
        const auto wordAt = [&](std::size_t at) {
            return loadLittle<std::uint32_t>(value.data() + at);
        };
        if (attribute == "channels") {
            need("chlist", value.size());
            part.channels = channelsIn(value);
        } else if (attribute == "compression") {
            need("compression", 1);
            part.compression = value[0];
        } else if (attribute == "dataWindow") {
            need("box2i", 16);
            const auto side = [&](std::size_t at) { return static_cast<std::int32_t>(wordAt(at)); };
            part.dataWindow = ExrWindow{side(0), side(4), side(8), side(12)};
        } else if (attribute == "tiles") {
            need("tiledesc", 9);
            part.tiles = ExrTileSize{wordAt(0), wordAt(4)};
        } else if (attribute == "chunkCount") {
            need("int", 4);
            part.chunkCount = wordAt(0);
        } else if (attribute == "type") {
            need("string", value.size());
            takeType(part, {reinterpret_cast<const char*>(value.data()), value.size()});
        }
    }

    void takeType(ExrPart& part, std::string_view type) const {
        part.isDeep = type == "deepscanline" || type == "deeptile";
        // In a file of one part the flag counts: its type need not be there.
        if (headers_.isMultiPart) part.isTiled = type == "tiledimage";
        if (!part.isDeep && type != "scanlineimage" && type != "tiledimage")
            broken(cat("a part has the type ", printable(type.substr(0, kExrLongName)),
                       "; it must be scanlineimage, tiledimage, deepscanline or deeptile"));
    }

    // Reads a list of channels. Each has a name, the pixel type, a byte for pLinear, three reserved
    // bytes, and both samplings. Their values are sorted by name, even if the list is not.
    std::vector<ExrChannel> channelsIn(Bytes list) const {
        std::vector<ExrChannel> channels = unsortedChannels(list);
        std::sort(channels.begin(), channels.end(),
                  [](const ExrChannel& a, const ExrChannel& b) { return a.name < b.name; });
        for (std::size_t i = 1; i < channels.size(); ++i)
            if (channels[i].name == channels[i - 1].name)
                broken(cat("two channels are called ", printable(channels[i].name),
                           "; each needs its own name"));
        return channels;
    }
    std::vector<ExrChannel> unsortedChannels(Bytes list) const {
        std::vector<ExrChannel> channels;
        for (std::size_t at = 0;;) {
            const std::string_view channel = textIn(list, at, "name of a channel");
            if (channel.empty()) return channels; // the end of the list
            constexpr std::size_t kBytes = 16;
            if (list.size() - at < kBytes)
                broken("the list of channels ends too early; the file is damaged");
            const std::uint8_t* entry = list.data() + at;
            const auto type = loadLittle<std::uint32_t>(entry);
            if (type > kExrFloat)
                broken(cat("the channel ", printable(channel), " has the type ", type,
                           "; it must be 0 (UINT), 1 (HALF) or 2 (FLOAT)"));
            const bool isWhole = loadLittle<std::uint32_t>(entry + 8) == 1 &&
                                 loadLittle<std::uint32_t>(entry + 12) == 1;
            channels.push_back({std::string(channel), type, !isWhole});
            at += kBytes;
        }
    }

    Bytes file_;
    const std::string& name_;
    std::size_t at_ = 0;
    bool isTiled_ = false, isDeep_ = false; // the only part of the file
    ExrHeaders headers_;
};

} // namespace

ExrHeaders readExrHeaders(Bytes file, const std::string& name) {
    return ExrHeaderReader(file, name).read();
}
