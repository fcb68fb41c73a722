// Reads TGA: the header, the colour map, and pixels as they are or run-length encoded.
#include "image/formats.h"

#include "base/text.h"
#include "image/bits.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace {

constexpr std::size_t kTgaHeaderBytes = 18;

// How a colour is stored: in a pixel, or in the colour map.
struct TgaColour {
    unsigned bits = 0;
    bool isGrey = false, hasAlpha = false;

    std::size_t bytes() const { return (bits + 7) / 8; }
    std::size_t channels() const { return (isGrey ? 1u : 3u) + (hasAlpha ? 1u : 0u); }
    void convert(const std::uint8_t* from, std::uint8_t* to) const {
        if (isGrey) {
            std::copy_n(from, channels(), to);
        } else if (bits <= 16) { // alpha, red, green, blue from the highest bit
            const unsigned word = loadLittle<std::uint16_t>(from);
            const auto byteOf = [](unsigned five) {
                return static_cast<std::uint8_t>(five * 255 / 31);
            };
            to[0] = byteOf(word >> 10 & 31);
            to[1] = byteOf(word >> 5 & 31);
            to[2] = byteOf(word & 31);
            if (hasAlpha) to[3] = word >> 15 ? 255 : 0;
        } else { // blue, green, red, alpha
            to[0] = from[2];
            to[1] = from[1];
            to[2] = from[0];
            if (hasAlpha) to[3] = from[3];
        }
    }
};

// The fields of the header (specification, fields 1 to 5).
struct TgaHeader {
    enum Kind : unsigned { kMapped = 1, kTrueColour = 2, kGrey = 3 };
    static constexpr unsigned kPacked = 8; // is added to the kind

    unsigned idBytes, mapType, type;
    unsigned mapFirst, mapLength, mapBits;
    unsigned width, height, bits, descriptor;

    explicit TgaHeader(Bytes file) // kTgaHeaderBytes at least
        : idBytes(file[0]), mapType(file[1]), type(file[2]),
          mapFirst(loadLittle<std::uint16_t>(&file[3])),
          mapLength(loadLittle<std::uint16_t>(&file[5])), mapBits(file[7]),
          width(loadLittle<std::uint16_t>(&file[12])), height(loadLittle<std::uint16_t>(&file[14])),
          bits(file[16]), descriptor(file[17]) {}

    unsigned kind() const { return type & ~kPacked; }
    bool isKnownType() const { return kind() >= kMapped && kind() <= kGrey; }
    bool isPacked() const { return (type & kPacked) != 0; }
    bool isMapped() const { return kind() == kMapped; }
    bool isFromRight() const { return (descriptor & 0x10) != 0; }
    bool isFromTop() const { return (descriptor & 0x20) != 0; }
    bool isInterleaved() const { return descriptor >> 6 != 0; }

    std::size_t pixelBytes() const { return (bits + 7) / 8; }
    std::size_t mapBytes() const {
        return mapType == 1 ? std::size_t{mapLength} * ((mapBits + 7) / 8) : 0;
    }
    static bool isColourSize(unsigned size) {
        return size == 15 || size == 16 || size == 24 || size == 32;
    }
    bool hasPossibleBits() const {
        return kind() == kTrueColour ? isColourSize(bits) : bits == 8 || bits == 16;
    }
    bool hasPossibleMap() const { return mapType == 1 && mapLength > 0 && isColourSize(mapBits); }
    TgaColour colour() const {
        const unsigned size = isMapped() ? mapBits : bits, attributeBits = descriptor & 15;
        const bool isGrey = kind() == kGrey;
        const bool hasAlpha = size == 32   ? attributeBits == 8
                              : size == 16 ? attributeBits == (isGrey ? 8 : 1)
                                           : false;
        return {size, isGrey, hasAlpha};
    }
};

class TgaReader {
public:
    TgaReader(Bytes file, const std::string& name)
        : file_(file), name_(name), header_(headerOf()), colour_(header_.colour()) {}

    StoredImage read() {
        check();
        at_ = kTgaHeaderBytes + header_.idBytes;
        takeMap();
        const std::size_t count = std::size_t{header_.width} * header_.height;
        // 128 pixels may be packed into one, and a byte in front of it.
        needs(header_.isPacked() ? (count + kMostInPacket - 1) / kMostInPacket * (1 + pixelBytes_)
                                 : count * pixelBytes_,
              "for its pixels");
        StoredImage image = blankPicture(header_.width, header_.height, colour_.channels());
        to_ = image.bytes.data();
        if (header_.isPacked())
            takePackets(count);
        else
            takePixels(count);
        turn(image.bytes);
        return image;
    }

private:
    static constexpr std::size_t kMostInPacket = 128;

    [[noreturn]] void broken(const std::string& what) const { failPicture(name_, what); }
    void needs(std::size_t bytes, std::string_view why) const {
        if (at_ > file_.size() || file_.size() - at_ < bytes)
            broken(cat("the file is too short ", why, ": it has ", file_.size(), " bytes; ", bytes,
                       " must follow byte ", at_));
    }
    TgaHeader headerOf() const {
        needs(kTgaHeaderBytes, "for a TGA header");
        return TgaHeader(file_);
    }

    void check() const {
        const TgaHeader& header = header_;
        if (header.type == 0)
            broken("this is a TGA file without a picture (type 0); the type must be 1, 2, 3, 9, 10 "
                   "or 11");
        if (header.type == 32 || header.type == 33)
            broken(cat("this is a TGA picture with Huffman, delta and run-length codes (type ",
                       header.type, "); what can be read: types 1, 2, 3, 9, 10, 11"));
        if (!header.isKnownType())
            broken(cat("the TGA type is ", header.type, "; it must be 1, 2, 3, 9, 10 or 11"));
        if (!header.hasPossibleBits())
            broken(cat("pixels of TGA type ", header.type, " have ", header.bits,
                       " bits; it must be ",
                       header.kind() == TgaHeader::kTrueColour ? "15, 16, 24 or 32" : "8 or 16"));
        if (header.mapType > 1)
            broken(cat("the colour map type is ", header.mapType, "; it must be 0 or 1"));
        if (header.isMapped() && !header.hasPossibleMap())
            broken(cat("the colour map has ", header.mapType == 1 ? header.mapLength : 0,
                       " entries of ", header.mapBits,
                       " bits; there must be entries, and 15, 16, 24 or 32 bits in each"));
        if (header.isInterleaved())
            broken("the rows of this TGA picture are interleaved; they must follow each other");
        checkSize(header.width, header.height, name_);
    }

    // A true-colour picture may have a colour map for the screen, which is skipped.
    void takeMap() {
        needs(header_.mapBytes(), "for its colour map");
        if (header_.isMapped()) {
            map_.resize(header_.mapLength * colour_.channels());
            for (std::size_t i = 0; i < header_.mapLength; ++i)
                colour_.convert(&file_[at_ + i * colour_.bytes()], &map_[i * colour_.channels()]);
        }
        at_ += header_.mapBytes();
    }

    // One pixel at the current place of the file and of the picture.
    void takePixel() {
        const std::uint8_t* from = &file_[at_];
        at_ += pixelBytes_;
        if (header_.isMapped()) {
            const unsigned index = pixelBytes_ == 1 ? *from : loadLittle<std::uint16_t>(from);
            if (index < header_.mapFirst || index - header_.mapFirst >= header_.mapLength)
                broken(cat("a pixel has colour ", index, ", but the colour map has only ",
                           header_.mapFirst, " to ", header_.mapFirst + header_.mapLength - 1,
                           "; it must be one of these"));
            const std::size_t entry = index - header_.mapFirst;
            std::copy_n(&map_[entry * colour_.channels()], colour_.channels(), to_);
        } else {
            colour_.convert(from, to_);
        }
        to_ += colour_.channels();
    }
    void takePixels(std::size_t count) {
        for (std::size_t i = 0; i < count; ++i) takePixel();
    }

    // A packet is one byte, one less than the count of its pixels, and these pixels; where the
    // highest bit is set, there is one pixel that comes so many times.
    void takePackets(std::size_t count) {
        while (count > 0) {
            needs(1, "for a packet");
            const std::uint8_t head = file_[at_++];
            const bool isRun = head >= kMostInPacket;
            const std::size_t pixels = head % kMostInPacket + 1;
            if (pixels > count)
                broken(cat("a packet has ", pixels, " pixels; at most ", count, " are left"));
            needs((isRun ? 1 : pixels) * pixelBytes_, "for a packet");
            takePixels(isRun ? 1 : pixels);
            if (isRun) {
                const std::size_t channels = colour_.channels();
                const std::uint8_t* first = to_ - channels;
                for (std::size_t i = 1; i < pixels; ++i) to_ = std::copy_n(first, channels, to_);
            }
            count -= pixels;
        }
    }

    // From the order of the file to rows from the top, each from the left.
    void turn(std::vector<std::uint8_t>& bytes) const {
        const std::size_t channels = colour_.channels(), row = channels * header_.width;
        if (!header_.isFromTop())
            for (std::size_t y = 0; y < header_.height / 2; ++y)
                std::swap_ranges(&bytes[y * row], &bytes[y * row] + row,
                                 &bytes[(header_.height - 1 - y) * row]);
        if (header_.isFromRight())
            for (std::size_t y = 0; y < header_.height; ++y)
                for (std::size_t x = 0; x < header_.width / 2; ++x) {
                    std::uint8_t* pixel = &bytes[y * row + x * channels];
                    std::swap_ranges(pixel, pixel + channels,
                                     &bytes[y * row + (header_.width - 1 - x) * channels]);
                }
    }

    Bytes file_;
    const std::string& name_;
    std::size_t at_ = 0;
    TgaHeader header_;
    TgaColour colour_;
    std::size_t pixelBytes_ = header_.pixelBytes();
    std::vector<std::uint8_t> map_; // colours as in the picture
    std::uint8_t* to_ = nullptr;
};

} // namespace

bool looksLikeTga(Bytes file) {
    if (file.size() < kTgaHeaderBytes) return false;
    constexpr std::string_view kSignature("TRUEVISION-XFILE.\0", 18);
    const std::string_view text(reinterpret_cast<const char*>(file.data()), file.size());
    if (text.ends_with(kSignature)) return true;
    const TgaHeader header(file);
    return header.isKnownType() && header.hasPossibleBits() && header.mapType <= 1 &&
           (!header.isMapped() || header.hasPossibleMap()) && !header.isInterleaved() &&
           header.width > 0 && header.height > 0;
}

StoredImage decodeTga(Bytes file, const std::string& name) { return TgaReader(file, name).read(); }
