// Reads the scanlines of a Radiance HDR picture (RGBE): flat, and both run-length codes.
#include "image/formats.h"

#include "base/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

namespace {

constexpr std::size_t kHdrBytes = 4; // of a pixel: three mantissas and the exponent they share

// Takes one scanline after the other.
class HdrScanlines {
public:
    HdrScanlines(Bytes data, std::size_t length, const std::string& name)
        : data_(data), length_(length), name_(name) {}

    // Writes the next scanline as four planes of `length` bytes: all of red, green, blue and of the
    // exponents. Only checks the scanline when `planes` is empty.
    void next(std::span<std::uint8_t> planes) {
        ++line_;
        const Bytes head = left(kHdrBytes);
        if (length_ >= kShortestPacked && length_ <= kLongestPacked && head[0] == 2 &&
            head[1] == 2 && head[2] < 128) {
            const std::size_t promised = std::size_t{head[2]} << 8 | head[3];
            if (promised != length_)
                broken(cat("says that it has ", promised, " pixels; ", length_));
            at_ += kHdrBytes;
            for (std::size_t c = 0; c < kHdrBytes; ++c)
                takePlane(planes.empty() ? planes : planes.subspan(c * length_, length_));
        } else {
            takePixels(planes);
        }
    }

private:
    // Scanlines of other lengths are never packed by channel.
    static constexpr std::size_t kShortestPacked = 8, kLongestPacked = 0x7FFF;

    [[noreturn]] void broken(const std::string& what) const {
        failPicture(name_, cat("the scanline ", line_, " ", what));
    }
    // The next bytes, which are not taken yet.
    Bytes left(std::size_t count) const {
        if (data_.size() - at_ < count)
            broken(cat("is cut off: the file ends too early; ", count, " bytes must follow"));
        return data_.subspan(at_, count);
    }

    // One channel: a number up to 128 and as many bytes, or 128 more than a count and the byte that
    // comes so many times.
    void takePlane(std::span<std::uint8_t> plane) {
        constexpr std::size_t kRun = 128;
        for (std::size_t i = 0; i < length_;) {
            const std::size_t code = left(1)[0];
            const bool isRun = code > kRun;
            const std::size_t count = isRun ? code - kRun : code;
            if (count == 0 || count > length_ - i)
                broken(cat("has ", count, " pixels where ", length_ - i,
                           " are left; it must be from 1 to these"));
            const Bytes values = left(1 + (isRun ? 1 : count)).subspan(1);
            if (!plane.empty()) {
                const auto to = plane.begin() + static_cast<std::ptrdiff_t>(i);
                if (isRun)
                    std::fill_n(to, count, values[0]);
                else
                    std::copy(values.begin(), values.end(), to);
            }
            at_ += 1 + values.size();
            i += count;
        }
    }

    // Whole pixels. One with three mantissas of 1 stands for more of the pixel before it: its
    // exponent is how many, or the higher digits of this number where it follows another such one.
    void takePixels(std::span<std::uint8_t> planes) {
        constexpr unsigned kDigit = 8, kMostShift = 24; // more digits than any scanline needs
        unsigned shift = 0;
        for (std::size_t i = 0; i < length_;) {
            const Bytes pixel = left(kHdrBytes);
            at_ += kHdrBytes;
            if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
                for (std::size_t c = 0; c < planes.size() / length_; ++c)
                    planes[c * length_ + i] = pixel[c];
                ++i;
                shift = 0;
                continue;
            }
            const std::size_t count = std::size_t{pixel[3]} << shift;
            if (i == 0) broken("begins with a run; there must be a pixel that it repeats");
            if (count > length_ - i)
                broken(cat("has a run of ", count, " pixels; at most ", length_ - i, " are left"));
            for (std::size_t c = 0; c < planes.size() / length_; ++c) {
                const auto plane = planes.subspan(c * length_ + i - 1, count + 1);
                std::fill(plane.begin(), plane.end(), plane[0]);
            }
            i += count;
            shift = std::min(shift + kDigit, kMostShift);
        }
    }

    Bytes data_;
    std::size_t length_;
    const std::string& name_;
    std::size_t at_ = 0;
    long long line_ = 0; // counted from 1
};

// For each channel and exponent what a mantissa is multiplied by.
using HdrFactors = std::array<std::array<double, 256>, 3>;
HdrFactors hdrFactors(const HdrHeader& header) {
    constexpr int kBias = 128 + 8; // a mantissa is a fraction of 256
    HdrFactors factors{};
    for (std::size_t c = 0; c < factors.size(); ++c)
        for (std::size_t e = 1; e < factors[c].size(); ++e)
            factors[c][e] = std::ldexp(1 / header.exposure[c], static_cast<int>(e) - kBias);
    return factors;
}

} // namespace

StoredImage decodeHdr(Bytes file, const std::string& name) {
    constexpr std::size_t kChannels = 3;
    const HdrHeader header = readHdrHeader(file, name);
    const Bytes data = file.subspan(header.dataStart);
    HdrScanlines checked(data, header.length, name);
    for (std::size_t i = 0; i < header.lines; ++i) checked.next({});

    const HdrFactors factors = hdrFactors(header);
    StoredImage image =
        blankPicture(static_cast<std::size_t>(header.width),
                     static_cast<std::size_t>(header.height), kChannels, StoredImage::Depth::Float);
    HdrScanlines scanlines(data, header.length, name);
    std::vector<std::uint8_t> planes(kHdrBytes * header.length);
    const std::uint8_t* exponents = planes.data() + kChannels * header.length;
    for (std::size_t i = 0; i < header.lines; ++i) {
        scanlines.next(planes);
        for (std::size_t j = 0; j < header.length; ++j) {
            const std::ptrdiff_t pixel = header.start +
                                         static_cast<std::ptrdiff_t>(i) * header.lineStep +
                                         static_cast<std::ptrdiff_t>(j) * header.pixelStep;
            for (std::size_t c = 0; c < kChannels; ++c) {
                const double value = planes[c * header.length + j] * factors[c][exponents[j]];
                if (value > static_cast<double>(std::numeric_limits<float>::max()))
                    failPicture(
                        name,
                        cat("the pixel ", pixel % header.width, ",", pixel / header.width, " is ",
                            value,
                            ", which no float can hold; EXPOSURE or COLORCORR must be larger"));
                image.floats[kChannels * static_cast<std::size_t>(pixel) + c] =
                    static_cast<float>(value);
            }
        }
    }
    return image;
}
