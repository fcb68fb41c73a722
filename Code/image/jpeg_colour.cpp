// Makes pixels of the planes of a JPEG picture: planes of another size are resampled, and YCbCr
// becomes RGB.
#include "image/jpeg_parts.h"

#include <algorithm>

namespace {

// Gives the rows of one component with as many samples as the picture has.
class JpegPlane {
public:
    JpegPlane(const JpegComponent& component, const JpegFrame& frame)
        : component_(component), frame_(frame) {
        const bool isDoubled = frame.mostHorizontal == 2 * component.horizontal;
        const bool isTwiceAsHigh = frame.mostVertical == 2 * component.vertical;
        const bool hasWidth = frame.mostHorizontal == component.horizontal;
        const bool hasHeight = frame.mostVertical == component.vertical;
        if (hasWidth && hasHeight) return;
        // Rows of one or two samples are repeated, as other decoders do it.
        if ((isDoubled && component.width > 2 && (hasHeight || isTwiceAsHigh)) ||
            (hasWidth && isTwiceAsHigh)) {
            kind_ = Kind::Linear;
            sums_.resize(component.width);
            row_.resize(2 * component.width);
            return;
        }
        kind_ = Kind::Repeated;
        row_.resize(frame.width);
        columns_.resize(frame.width);
        for (std::size_t x = 0; x < frame.width; ++x)
            columns_[x] = x * component.horizontal / frame.mostHorizontal;
    }

    // Returns row y of the picture, which is valid until the next call.
    const std::uint8_t* row(std::size_t y) {
        if (kind_ == Kind::Linear) {
            interpolate(y);
            return row_.data();
        }
        const std::uint8_t* from = stored(y * component_.vertical / frame_.mostVertical);
        if (kind_ == Kind::Same) return from;
        for (std::size_t x = 0; x < columns_.size(); ++x) row_[x] = from[columns_[x]];
        return row_.data();
    }

private:
    enum class Kind { Same, Linear, Repeated };

    const std::uint8_t* stored(std::size_t y) const {
        return component_.samples.data() + y * component_.stride();
    }

    // The centres of the two samples that replace one lie a quarter of its width beside its own:
    // each is three quarters of this one and a quarter of the neighbour on its side. At the border
    // the sample is its own neighbour. What is added before shifting rounds halves up and down in
    // turn.
    void interpolate(std::size_t y) {
        const bool isTwiceAsHigh = frame_.mostVertical != component_.vertical;
        if (!isTwiceAsHigh) {
            std::copy_n(stored(y), sums_.size(), sums_.begin());
        } else {
            const std::size_t near = y / 2, last = component_.height - 1;
            const std::size_t far = y % 2 != 0 ? std::min(near + 1, last) : near - (near > 0);
            const std::uint8_t *a = stored(near), *b = stored(far);
            for (std::size_t x = 0; x < sums_.size(); ++x) sums_[x] = 3 * a[x] + b[x];
        }
        if (frame_.mostHorizontal == component_.horizontal) {
            const int half = y % 2 != 0 ? 2 : 1;
            for (std::size_t x = 0; x < sums_.size(); ++x) row_[x] = byteOf(sums_[x] + half, 2);
        } else if (isTwiceAsHigh) {
            widen(8, 7, 4);
        } else {
            widen(1, 2, 2);
        }
    }
    void widen(int leftHalf, int rightHalf, int shift) {
        const std::size_t last = sums_.size() - 1;
        for (std::size_t x = 0; x <= last; ++x) {
            const int left = sums_[x - (x > 0)], right = sums_[std::min(x + 1, last)];
            row_[2 * x] = byteOf(3 * sums_[x] + left + leftHalf, shift);
            row_[2 * x + 1] = byteOf(3 * sums_[x] + right + rightHalf, shift);
        }
    }
    static std::uint8_t byteOf(int sum, int shift) {
        return static_cast<std::uint8_t>(sum >> shift);
    }

    const JpegComponent& component_;
    const JpegFrame& frame_;
    Kind kind_ = Kind::Same;
    std::vector<int> sums_;            // Linear: a weighted sum of one or two rows
    std::vector<std::size_t> columns_; // Repeated: which sample a pixel has
    std::vector<std::uint8_t> row_;
};

// Computes RGB from YCbCr (T.871, clause 7); the factors have 16 bits behind the point.
void putJpegYcc(int y, int blue, int red, std::uint8_t* out) {
    constexpr int kBits = 16, kHalf = 1 << (kBits - 1), kMiddle = 128;
    constexpr int kRedFromRed = 91881, kBlueFromBlue = 116130;   // 1.402, 1.772
    constexpr int kGreenFromRed = 46802, kGreenFromBlue = 22554; // 0.71414, 0.34414
    blue -= kMiddle;
    red -= kMiddle;
    const auto code = [](int value) {
        return static_cast<std::uint8_t>(std::clamp(value, 0, 255));
    };
    out[0] = code(y + ((kRedFromRed * red + kHalf) >> kBits));
    out[1] = code(y + ((kHalf - kGreenFromRed * red - kGreenFromBlue * blue) >> kBits));
    out[2] = code(y + ((kBlueFromBlue * blue + kHalf) >> kBits));
}

} // namespace

StoredImage jpegPicture(const JpegFrame& frame, bool isYcc) {
    const std::size_t channels = frame.components.size();
    StoredImage image = blankPicture(frame.width, frame.height, channels);
    std::vector<JpegPlane> planes;
    for (const JpegComponent& component : frame.components) planes.emplace_back(component, frame);
    std::uint8_t* out = image.bytes.data();
    for (std::size_t y = 0; y < frame.height; ++y) {
        const std::uint8_t* first = planes[0].row(y);
        if (channels == 1) {
            out = std::copy_n(first, frame.width, out);
            continue;
        }
        const std::uint8_t *second = planes[1].row(y), *third = planes[2].row(y);
        for (std::size_t x = 0; x < frame.width; ++x, out += 3) {
            if (isYcc) {
                putJpegYcc(first[x], second[x], third[x], out);
            } else {
                out[0] = first[x];
                out[1] = second[x];
                out[2] = third[x];
            }
        }
    }
    return image;
}
