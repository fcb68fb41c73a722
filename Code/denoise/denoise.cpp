#include "denoise/denoise.h"

#include "base/math.h"
#include "base/parallel.h"
#include "denoise/denoise_lanes.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

namespace {

// A pixel is first averaged with those near it, which is compared over the whole window then: less
// noise tells apart what differs by less.
constexpr int kPilotRadius = 3, kRadius = 10;
static_assert(kRadius <= DenoisePlanes::kBorderLeft);
// Means whose difference is larger than so many of its standard deviations are of different things.
// At 2.8 noise alone makes 0.5 % of the differences; what has been averaged has less noise, but as
// much of what is no noise.
constexpr float kPilotDeviations = 2.8f, kDeviations = 1;
// A pixel's noise is taken from so many pixels around it each way, without itself.
constexpr int kNoiseRadius = 2;
// A pixel is an outlier, and taken by no other, when its own noise has more than this many times the
// variance around it, and its parts are farther apart than this share of their sum.
constexpr float kOutlier = 30, kOneSided = 0.5f;
// Colours are compared and averaged per albedo, of which dark ones have so much more.
constexpr float kLeastAlbedo = 0.05f;
// From these distances on albedos and normals without noise are different things, and by so many
// standard deviations more where they have noise.
constexpr float kAlbedoDistance = 0.2f, kNormalDistance = 0.3f, kGuideDeviations = 3;
// Larger values would overflow when they are squared.
constexpr float kLargest = 1e15f;

constexpr std::size_t kChannels = 3;
float channelOf(const Rgb& c, std::size_t channel) {
    return channel == 0 ? c.r : channel == 1 ? c.g : c.b;
}

// Planes of one picture with borders.
class Plane {
public:
    Plane(int width, int height, float outside)
        : stride_(static_cast<std::size_t>(width + DenoisePlanes::kBorderLeft +
                                           DenoisePlanes::kBorderRight)),
          values_(stride_ * static_cast<std::size_t>(height), outside) {}
    float* row(int y) {
        return &values_[static_cast<std::size_t>(y) * stride_ + DenoisePlanes::kBorderLeft];
    }
    const float* row(int y) const {
        return &values_[static_cast<std::size_t>(y) * stride_ + DenoisePlanes::kBorderLeft];
    }
    std::size_t stride() const { return stride_; }

private:
    std::size_t stride_;
    std::vector<float> values_;
};

using Planes = std::array<Plane, kChannels>;
Planes planesOf(int width, int height, float outside) {
    const Plane one(width, height, outside);
    return {one, one, one};
}
void point(const float* (&to)[kChannels], const Planes& from) {
    for (std::size_t c = 0; c < kChannels; ++c) to[c] = from[c].row(0);
}

// The mean of `squares` around each pixel, without itself; of a picture of one pixel 0.
void meansAround(const Plane& squares, int width, int height, int y, float* to) {
    const int top = std::max(y - kNoiseRadius, 0), bottom = std::min(y + kNoiseRadius, height - 1);
    for (int x = 0; x < width; ++x) {
        const int left = std::max(x - kNoiseRadius, 0),
                  right = std::min(x + kNoiseRadius, width - 1);
        float sum = 0;
        for (int j = top; j <= bottom; ++j)
            for (int i = left; i <= right; ++i) sum += i == x && j == y ? 0 : squares.row(j)[i];
        const int count = (bottom - top + 1) * (right - left + 1) - 1;
        to[x] = count > 0 ? sum / static_cast<float>(count) : 0;
    }
}

class Denoiser {
public:
    Denoiser(const std::array<HalfPicture, 2>& halves, float brightest, const Isa& isa, int threads)
        : halves_(halves), brightest_(brightest), lanes_(*isa.denoise), pool_(threads), width_(halves[0][0].color.width()),
          height_(halves[0][0].color.height()) {}

    Denoised run() {
        demodulate();
        findGuides();
        for (std::size_t h = 0; h < 2; ++h) filter(h);
        return joined();
    }

private:
    template <class Fn> void forEachRow(const Fn& fn) {
        const auto row = [&](std::size_t y, int) { fn(static_cast<int>(y)); };
        pool_.run(static_cast<std::size_t>(height_), row);
    }
    static std::span<const Rgb> rowOf(const Image& image, int y) {
        const auto width = static_cast<std::size_t>(image.width());
        return image.pixels().subspan(static_cast<std::size_t>(y) * width, width);
    }
    static float divisorOf(float albedo) { return max(albedo, 0.0f) + kLeastAlbedo; }

    // The mean of both parts of a half.
    static float meanOf(float a, float b) { return (a + b) * 0.5f; }
    float meanOf(std::size_t half, Image PartPicture::*of, int x, int y, std::size_t c) const {
        return meanOf(channelOf((halves_[half][0].*of).pixel(x, y), c),
                      channelOf((halves_[half][1].*of).pixel(x, y), c));
    }
    // The variance of the mean of two parts.
    static float varianceOf(float a, float b) { return sqr(a - b) * 0.25f; }

    // Light that arrives, whatever texture it falls on, and its noise.
    void demodulate() {
        for (std::size_t h = 0; h < 2; ++h) {
            Planes squares = planesOf(width_, height_, 0), sides = squares;
            forEachRow([&](int y) {
                for (std::size_t c = 0; c < kChannels; ++c)
                    for (int x = 0; x < width_; ++x) {
                        const float divisor = divisorOf(meanOf(h, &PartPicture::albedo, x, y, c));
                        const auto part = [&](std::size_t p) {
                            return clamp(channelOf(halves_[h][p].color.pixel(x, y), c) / divisor,
                                         -kLargest, kLargest);
                        };
                        const float a = part(0), b = part(1);
                        colors_[h][c].row(y)[x] = meanOf(a, b);
                        squares[c].row(y)[x] = varianceOf(a, b);
                        const bool isOneSided = std::fabs(a - b) > kOneSided * std::fabs(a + b);
                        sides[c].row(y)[x] = isOneSided ? 1 : 0;
                    }
            });
            forEachRow([&](int y) { findRooms(h, squares, sides, y); });
        }
    }

    void findRooms(std::size_t half, const Planes& squares, const Planes& sides, int y) {
        float* const trust = trusts_[half].row(y);
        std::fill_n(trust, width_, 1.0f);
        for (std::size_t c = 0; c < kChannels; ++c) {
            float *const room = rooms_[half][c].row(y), *const own = ownRooms_[half][c].row(y);
            meansAround(squares[c], width_, height_, y, room);
            const float *const square = squares[c].row(y), *const side = sides[c].row(y);
            for (int x = 0; x < width_; ++x) {
                if (square[x] > kOutlier * room[x] && side[x] > 0) trust[x] = 0;
                own[x] = sqr(kPilotDeviations) * max(square[x], room[x]);
                room[x] *= sqr(kPilotDeviations);
            }
        }
    }

    void findGuides() {
        findGuide(&PartPicture::albedo, kAlbedoDistance, albedos_, albedoScales_);
        findGuide(&PartPicture::normal, kNormalDistance, normals_, normalScales_);
    }
    void findGuide(Image PartPicture::*guide, float distance, std::array<Planes, 2>& to,
                   std::array<Plane, 2>& scales) {
        for (std::size_t h = 0; h < 2; ++h)
            forEachRow([&](int y) {
                const auto rowA = rowOf(halves_[h][0].*guide, y),
                           rowB = rowOf(halves_[h][1].*guide, y);
                for (std::size_t x = 0; x < rowA.size(); ++x) {
                    float variance = 0;
                    for (std::size_t c = 0; c < kChannels; ++c) {
                        const float a = clamp(channelOf(rowA[x], c), -kLargest, kLargest),
                                    b = clamp(channelOf(rowB[x], c), -kLargest, kLargest);
                        to[h][c].row(y)[x] = meanOf(a, b);
                        variance += varianceOf(a, b);
                    }
                    scales[h].row(y)[x] = 1 / (sqr(distance) + sqr(kGuideDeviations) * variance);
                }
            });
    }

    void filter(std::size_t half) {
        DenoisePlanes planes = planesOfHalf(half);
        Planes pilot = planesOf(width_, height_, DenoisePlanes::kOutside);
        Plane left = trusts_[half];
        planes.radius = kPilotRadius;
        point(planes.compared, colors_[half]);
        point(planes.room, rooms_[half]), point(planes.ownRoom, ownRooms_[half]);
        forEachRow([&](int y) {
            lanes_.row(planes, y, {pilot[0].row(y), pilot[1].row(y), pilot[2].row(y)},
                       left.row(y));
            for (std::size_t c = 0; c < kChannels; ++c)
                std::fill_n(pilot[c].row(y) + width_, DenoisePlanes::kBorderRight,
                            DenoisePlanes::kOutside);
        });
        Planes rooms = rooms_[half];
        forEachRow([&](int y) {
            for (std::size_t c = 0; c < kChannels; ++c)
                for (int x = 0; x < width_; ++x)
                    rooms[c].row(y)[x] *= (left.row(y)[x] * sqr(kDeviations / kPilotDeviations));
        });
        planes.radius = kRadius;
        point(planes.compared, pilot), point(planes.room, rooms), point(planes.ownRoom, rooms);
        Planes& to = filtered_[half];
        forEachRow([&](int y) {
            lanes_.row(planes, y, {to[0].row(y), to[1].row(y), to[2].row(y)}, left.row(y));
        });
    }

    DenoisePlanes planesOfHalf(std::size_t half) {
        DenoisePlanes planes;
        planes.width = width_, planes.height = height_, planes.stride = trusts_[half].stride();
        point(planes.color, colors_[half]);
        point(planes.albedo, albedos_[half]), point(planes.normal, normals_[half]);
        planes.albedoScale = albedoScales_[half].row(0), planes.normalScale = normalScales_[half].row(0);
        planes.trust = trusts_[half].row(0);
        return planes;
    }

    // With F and G the filtered halves A and B of a true M, (A - F)(B - G) is (M - F)(M - G) in the
    // mean, as the noise of A knows nothing of B and G; a quarter of (F - G)^2 more is the square of
    // M - (F + G) / 2.
    Denoised joined() {
        Denoised out{Image(width_, height_), Image(width_, height_)};
        forEachRow([&](int y) {
            for (int x = 0; x < width_; ++x) {
                float mean[kChannels], error[kChannels];
                for (std::size_t c = 0; c < kChannels; ++c) {
                    float raw[2], smooth[2];
                    for (std::size_t h = 0; h < 2; ++h) {
                        raw[h] = meanOf(h, &PartPicture::color, x, y, c);
                        smooth[h] = filtered_[h][c].row(y)[x] *
                                    divisorOf(meanOf(h, &PartPicture::albedo, x, y, c));
                    }
                    mean[c] = (smooth[0] + smooth[1]) * 0.5f;
                    const auto apart = [&](std::size_t h) {
                        return min(raw[h], brightest_) - min(smooth[h], brightest_);
                    };
                    error[c] = sqr(min(smooth[0], brightest_) - min(smooth[1], brightest_)) * 0.25f +
                               apart(0) * apart(1);
                }
                out.color.setPixel(x, y, {mean[0], mean[1], mean[2]});
                out.squaredError.setPixel(x, y, {error[0], error[1], error[2]});
            }
        });
        return out;
    }

    const std::array<HalfPicture, 2>& halves_;
    float brightest_;
    const DenoiseLanes& lanes_;
    ThreadPool pool_;
    int width_, height_;
    std::array<Planes, 2> colors_{planesOf(width_, height_, DenoisePlanes::kOutside),
                                  planesOf(width_, height_, DenoisePlanes::kOutside)};
    std::array<Planes, 2> albedos_{planesOf(width_, height_, 0), planesOf(width_, height_, 0)},
        normals_{albedos_}, filtered_{albedos_};
    std::array<Planes, 2> rooms_{albedos_}, ownRooms_{albedos_};
    std::array<Plane, 2> albedoScales_{Plane{width_, height_, 0}, Plane{width_, height_, 0}},
        normalScales_{albedoScales_}, trusts_{albedoScales_};
};

} // namespace

Denoised denoise(const std::array<HalfPicture, 2>& halves, float brightest, const Isa& isa,
                 int threads) {
    return Denoiser(halves, brightest, isa, threads).run();
}
