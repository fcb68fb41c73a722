// Writes OpenEXR pictures as one part of scan lines, whose blocks are packed by ZIP (OpenEXR File
// Layout, "Scan lines").
#include "base/error.h"
#include "base/for_each.h"
#include "base/text.h"
#include "image/bits.h"
#include "image/exr_blocks.h"
#include "image/exr_half.h"
#include "image/formats.h"
#include "image/zlib.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

namespace {

using ExrBuffer = std::vector<std::uint8_t>;

// Appends numbers and texts as the header of a file has them.
class ExrHeaderWriter {
public:
    template <class Number> void number(Number value) {
        out_.resize(out_.size() + sizeof value);
        storeLittle(out_.data() + out_.size() - sizeof value, value);
    }
    void text(std::string_view text) { // and a zero byte
        out_.insert(out_.end(), text.begin(), text.end());
        out_.push_back(0);
    }
    // Begins an attribute; its value follows, which has `size` bytes.
    void attribute(std::string_view name, std::string_view type, std::size_t size) {
        text(name);
        text(type);
        number(static_cast<std::uint32_t>(size));
    }
    void floats(std::string_view name, std::string_view type, std::span<const float> values) {
        attribute(name, type, 4 * values.size());
        for (const float value : values) number(std::bit_cast<std::uint32_t>(value));
    }
    void byte(std::string_view name, std::string_view type, std::uint8_t value) {
        attribute(name, type, 1);
        number(value);
    }
    ExrBuffer result() && { return std::move(out_); }

private:
    ExrBuffer out_;
};

// Makes the pieces of a file out of the layers.
class ExrEncoder {
public:
    ExrEncoder(std::span<const ExrLayer> layers, int width, int height, bool half)
        : width_(static_cast<std::size_t>(width)), height_(static_cast<std::size_t>(height)),
          half_(half) {
        for (const ExrLayer& layer : layers) {
            const std::size_t step = layer.channels.size();
            if (layer.values.size() != width_ * height_ * step)
                cannot(cat("the layer '", printable(layer.name), "' has ", layer.values.size(),
                           " values; ", width_, "x", height_, " pixels of ", step,
                           " channels need ", width_ * height_ * step));
            for (std::size_t i = 0; i < step; ++i)
                channels_.push_back({layer.name.empty() ? layer.channels[i]
                                                        : cat(layer.name, ".", layer.channels[i]),
                                     layer.values.subspan(i < layer.values.size() ? i : 0), step});
        }
        std::sort(channels_.begin(), channels_.end(),
                  [](const Channel& a, const Channel& b) { return a.name < b.name; });
        checkNames();
        rowBytes_ = width_ * channels_.size() * (half ? 2 : 4);
        if (rowBytes_ * kExrZipLines > std::numeric_limits<std::int32_t>::max())
            cannot(cat("there are too many channels (", channels_.size(), ") for the width ",
                       width_, ": 16 rows have more than 2^31 bytes"));
    }

    std::size_t blockCount() const { return (height_ + kExrZipLines - 1) / kExrZipLines; }

    // Returns everything before the table of offsets.
    ExrBuffer header() const {
        ExrHeaderWriter out;
        out.number(kExrMagic);
        std::size_t longest = 0, listBytes = 1;
        for (const Channel& channel : channels_) {
            longest = std::max(longest, channel.name.size());
            listBytes += channel.name.size() + 17;
        }
        out.number(kExrVersion | (longest > kExrShortName ? std::uint32_t{kExrLongNames} : 0u));
        out.attribute("channels", "chlist", listBytes);
        for (const Channel& channel : channels_) {
            out.text(channel.name);
            out.number(std::uint32_t{half_ ? kExrHalf : kExrFloat});
            out.number(std::uint32_t{0}); // pLinear is only for B44; three bytes are reserved
            out.number(std::uint32_t{1}); // the samplings
            out.number(std::uint32_t{1});
        }
        out.number(std::uint8_t{0});
        out.byte("compression", "compression", kExrZip);
        for (const char* window : {"dataWindow", "displayWindow"}) {
            out.attribute(window, "box2i", 16);
            out.number(std::uint64_t{0}); // the upper left corner
            out.number(static_cast<std::uint32_t>(width_ - 1));
            out.number(static_cast<std::uint32_t>(height_ - 1));
        }
        out.byte("lineOrder", "lineOrder", 0); // from the top
        const float zeros[2] = {0, 0}, one[1] = {1};
        out.floats("pixelAspectRatio", "float", one);
        out.floats("screenWindowCenter", "v2f", zeros);
        out.floats("screenWindowWidth", "float", one);
        out.number(std::uint8_t{0});
        return std::move(out).result();
    }

    // Returns a block of 16 rows, the last one of those that are left: the number of its first row,
    // its size, and its bytes, which are packed where that makes them fewer.
    ExrBuffer block(std::size_t index) const {
        const std::size_t y = index * kExrZipLines;
        const std::size_t size = std::min(kExrZipLines, height_ - y) * rowBytes_;
        thread_local ExrBuffer raw, split; // the system need not clear them every time
        raw.resize(size);
        split.resize(size);
        putRows(y, raw);
        splitExrBytes(raw, split);
        ExrBuffer out(8);
        out.insert(out.end(), kZlibHeader.begin(), kZlibHeader.end());
        // Looking for matches costs no more time than trying whether it is worth it.
        out = deflatePiece(split, true, Packing::Matches, std::move(out));
        const auto end = zlibEnd(adler32(split));
        out.insert(out.end(), end.begin(), end.end());
        if (out.size() - 8 >= size) {
            out.resize(8);
            out.insert(out.end(), raw.begin(), raw.end());
        }
        storeLittle(out.data(), static_cast<std::uint32_t>(y));
        storeLittle(out.data() + 4, static_cast<std::uint32_t>(out.size() - 8));
        return out;
    }

private:
    struct Channel {
        std::string name;              // in the file
        std::span<const float> values; // each step-th one belongs to it
        std::size_t step;
    };

    [[noreturn]] static void cannot(const std::string& what) {
        fail(ErrorKind::Output, cat("error: this OpenEXR picture cannot be written: ", what));
    }

    void checkNames() const {
        if (channels_.empty()) cannot("it has no channels");
        const std::string* before = nullptr;
        for (const Channel& channel : channels_) {
            const std::string& name = channel.name;
            if (name.empty() || name.size() > kExrLongName || name.find('\0') != std::string::npos)
                cannot(cat("the name '", printable(name), "' of a channel is not possible; 1 to ",
                           kExrLongName, " bytes, none of them zero"));
            if (before && *before == name)
                cannot(cat("two channels are called '", printable(name), "'"));
            before = &name;
        }
    }

    // Fills `out` with rows from y downwards.
    void putRows(std::size_t y, ExrBuffer& out) const {
        std::uint8_t* to = out.data();
        for (; to != out.data() + out.size(); ++y) {
            for (const Channel& channel : channels_) {
                std::size_t from = y * width_ * channel.step;
                for (std::size_t x = 0; x < width_; ++x, from += channel.step) {
                    const float value = channel.values[from];
                    if (half_)
                        storeLittle(to, halfFromFloat(value));
                    else
                        storeLittle(to, std::bit_cast<std::uint32_t>(value));
                    to += half_ ? 2 : 4;
                }
            }
        }
    }

    std::size_t width_, height_, rowBytes_ = 0;
    bool half_;
    std::vector<Channel> channels_; // by name
};

} // namespace

void encodeExr(std::span<const ExrLayer> layers, int width, int height, bool half, int threads,
               ByteSink use) {
    if (width < 1 || height < 1 || width > Image::kMaxSide || height > Image::kMaxSide)
        fail(ErrorKind::Output, cat("error: the size ", width, "x", height,
                                    " is not possible; both sides must be 1 to ", Image::kMaxSide));
    const ExrEncoder encoder(layers, width, height, half);
    std::vector<ExrBuffer> blocks(encoder.blockCount());
    forEachOn(threads, blocks.size(), [&](std::size_t i) { blocks[i] = encoder.block(i); });

    const ExrBuffer header = encoder.header();
    ExrBuffer offsets(8 * blocks.size());
    std::uint64_t offset = header.size() + offsets.size();
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        storeLittle(offsets.data() + 8 * i, offset);
        offset += blocks[i].size();
    }
    use(header);
    use(offsets);
    for (ExrBuffer& block : blocks) {
        use(block);
        block = {}; // its memory is free again
    }
}
