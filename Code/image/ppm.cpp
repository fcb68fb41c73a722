// PPM and PGM (netpbm): P6 and P5 binary, P3 and P2 as text; 8 or 16 bits, any maxval.
#include "base/text.h"
#include "image/bits.h"
#include "image/netpbm.h"

#include <algorithm>

namespace {

constexpr std::uint32_t kMaxval8 = 255, kMaxval16 = 65535;

// Samples 0 .. maxval rounded to codes 0 .. mostCode.
template <class Code, class NextSample>
std::vector<Code> scaledCodes(std::size_t count, std::uint32_t maxval, std::uint32_t mostCode,
                              NextSample nextSample) {
    std::vector<Code> codes(count);
    for (Code& code : codes)
        code = static_cast<Code>((nextSample() * mostCode + maxval / 2) / maxval);
    return codes;
}

} // namespace

StoredImage decodePpm(Bytes file, const std::string& name) {
    NetpbmHeader header(file, name);
    const bool isText = header.magic() == "P3" || header.magic() == "P2";
    const bool isGrey = header.magic() == "P2" || header.magic() == "P5";
    const long long width = header.number("width"), height = header.number("height");
    checkSize(width, height, name);
    const long long promised = header.number("maxval");
    if (promised < 1 || promised > kMaxval16)
        header.failHere(cat("the maxval is ", promised, "; it must be 1 to ", kMaxval16));
    const auto maxval = static_cast<std::uint32_t>(promised);
    StoredImage image;
    image.width = static_cast<int>(width);
    image.height = static_cast<int>(height);
    image.channels = isGrey ? 1 : 3;
    const std::size_t count = static_cast<std::size_t>(width * height * image.channels);

    // Where 255 is a multiple of maxval 8 bits are exact; else 16 are exact or much closer.
    const auto store = [&](auto nextSample) {
        if (kMaxval8 % maxval == 0) {
            image.bytes = scaledCodes<std::uint8_t>(count, maxval, kMaxval8, nextSample);
        } else {
            image.depth = StoredImage::Depth::Bits16;
            image.words = scaledCodes<std::uint16_t>(count, maxval, kMaxval16, nextSample);
        }
    };
    if (isText) {
        // A digit and a space each, the last without the space.
        if (header.left() < 2 * count)
            failPicture(name, cat("the file ends too early: the header promises ", count,
                                  " samples, only ", header.left(), " bytes follow it"));
        store([&] { return header.sample(maxval); });
        if (header.hasMore())
            header.failHere(cat("more samples than ", width, "x", height, "x", image.channels));
        return image;
    }
    const std::size_t sampleBytes = maxval > kMaxval8 ? 2 : 1;
    const std::uint8_t* next = header.data(count * sampleBytes).data();
    const auto checked = [&](std::uint32_t sample) {
        if (sample > maxval)
            failPicture(name, cat("the sample ", sample, " is larger than the maxval ", maxval));
        return sample;
    };
    if (sampleBytes == 1)
        store([&] { return checked(*next++); });
    else
        store([&] {
            const std::uint32_t sample = loadBig<std::uint16_t>(next);
            next += 2;
            return checked(sample);
        });
    return image;
}

void encodePpm(const PixelSource& picture, int threads, ByteSink use) {
    const std::string header = cat("P6\n", picture.width, " ", picture.height, "\n",
                                   picture.encoding.bits == 8 ? kMaxval8 : kMaxval16, "\n");
    makeRawFile(header, picture.count(), picture.pixelBytes(), threads, use,
                [&](std::size_t first, std::size_t count, std::span<std::uint8_t> out) {
                    picture.encode(first, count, out);
                });
}
