#include "denoise/denoise.h"

#include "base/math.h"
#include "base/parallel.h"
#include "denoise/denoise_lanes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace {

// A pixel is first averaged with those near it, which is compared over the whole window then: less
// noise tells apart what differs by less.
constexpr int kPilotRadius = 2, kRadius = 7;
static_assert(kRadius <= DenoisePlanes::kBorderLeft);
// Means whose difference is larger than so many of its standard deviations are of different things.
// At 3.5 noise alone makes one difference of 2000; what has been averaged has less noise, but as
// much of what is no noise.
constexpr float kPilotDeviations = 3.5f, kDeviations = 1.5f;
// A pixel's noise is taken from so many pixels around it each way, without itself.
constexpr int kNoiseRadius = 2;
// A half of a pixel is an outlier, and taken by no other pixel, when the square of the difference of the
// halves has more than this many times the mean around it, and this share of the square of their sum.
constexpr float kOutlier = 15, kOneSided = 0.25f;
// Colours are compared and averaged per albedo, of which dark ones have so much more.
constexpr float kLeastAlbedo = 0.1f;
// From these distances on albedos and normals without noise are different things, and by so many
// standard deviations more where they have noise.
constexpr float kAlbedoDistance = 0.1f, kNormalDistance = 0.3f, kGuideDeviations = 3;
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

// Writes twice the mean of `squares` around each pixel of a row: the variance of a half, of whose difference
// to the other half they are quarters. Only pixels of the other colour of a chessboard count, so that a pixel
// does not choose its own noise. Of a picture of one pixel they are 0.
void findVariances(const Plane& squares, int width, int height, int y, float* to) {
    const int top = std::max(y - kNoiseRadius, 0), bottom = std::min(y + kNoiseRadius, height - 1);
    for (int x = 0; x < width; ++x) {
        const int left = std::max(x - kNoiseRadius, 0),
                  right = std::min(x + kNoiseRadius, width - 1);
        float sum = 0;
        int count = 0;
        for (int j = top; j <= bottom; ++j)
            for (int i = left + ((left + j + x + y + 1) & 1); i <= right; i += 2, ++count)
                sum += squares.row(j)[i];
        to[x] = count > 0 ? 2 * sum / static_cast<float>(count) : 0;
    }
}

class Denoiser {
public:
    Denoiser(const HalvedPicture& picture, const Isa& isa, int threads)
        : picture_(picture), lanes_(*isa.denoise), pool_(threads), width_(picture.color.mean.width()),
          height_(picture.color.mean.height()) {}

    std::array<Image, 2> run() {
        demodulate();
        for (std::size_t h = 0; h < 2; ++h) {
            findGuide(picture_.albedo, h, kAlbedoDistance, albedos_, albedoScale_);
            findGuide(picture_.normal, h, kNormalDistance, normals_, normalScale_);
            filter(h);
        }
        return std::move(filtered_);
    }

private:
    template <class Fn> void forEachRow(const Fn& fn) {
        const auto row = [&](std::size_t y, int) { fn(static_cast<int>(y)); };
        pool_.run(static_cast<std::size_t>(height_), row);
    }
    // Colours are those of light that arrives, whatever texture it falls on, times this.
    float divisorAt(std::size_t half, int x, int y, std::size_t c) const {
        return max(channelOf(picture_.albedo.half(half, x, y), c), 0.0f) + kLeastAlbedo;
    }

    void demodulate() {
        Planes squares = planesOf(width_, height_, 0);
        forEachRow([&](int y) {
            for (std::size_t c = 0; c < kChannels; ++c)
                for (int x = 0; x < width_; ++x) {
                    float light[2];
                    for (std::size_t h = 0; h < 2; ++h) {
                        const float color = channelOf(picture_.color.half(h, x, y), c);
                        light[h] = clamp(color / divisorAt(h, x, y, c), -kLargest, kLargest);
                        colors_[h][c].row(y)[x] = light[h];
                    }
                    squares[c].row(y)[x] = sqr(light[0] - light[1]) * 0.25f;
                }
        });
        forEachRow([&](int y) { findRooms(squares, y); });
    }

    void findRooms(const Planes& squares, int y) {
        for (Plane& trust : trusts_) std::fill_n(trust.row(y), width_, 1.0f);
        for (std::size_t c = 0; c < kChannels; ++c) {
            float *const room = rooms_[c].row(y), *const own = ownRooms_[c].row(y);
            findVariances(squares[c], width_, height_, y, room);
            for (int x = 0; x < width_; ++x) {
                const float square = 2 * squares[c].row(y)[x];
                const float first = colors_[0][c].row(y)[x], second = colors_[1][c].row(y)[x];
                if (square > kOutlier * room[x] && sqr(first - second) > kOneSided * sqr(first + second))
                    trusts_[std::fabs(first) > std::fabs(second) ? 0 : 1].row(y)[x] = 0;
                own[x] = sqr(kPilotDeviations) * max(square, room[x]);
                room[x] *= sqr(kPilotDeviations);
            }
        }
    }

    void findGuide(const HalvedImage& guide, std::size_t half, float distance, Planes& to, Plane& scale) {
        forEachRow([&](int y) {
            for (int x = 0; x < width_; ++x) {
                const Rgb value = guide.half(half, x, y), difference = guide.difference.pixel(x, y);
                float variance = 0;
                for (std::size_t c = 0; c < kChannels; ++c) {
                    to[c].row(y)[x] = clamp(channelOf(value, c), -kLargest, kLargest);
                    variance += 2 * sqr(clamp(channelOf(difference, c), -kLargest, kLargest));
                }
                scale.row(y)[x] = 1 / (sqr(distance) + sqr(kGuideDeviations) * variance);
            }
        });
    }

    void filter(std::size_t half) {
        DenoisePlanes planes = planesOfHalf(half);
        Planes pilot = planesOf(width_, height_, DenoisePlanes::kOutside);
        Plane left = trusts_[half];
        planes.radius = kPilotRadius;
        point(planes.compared, colors_[half]);
        point(planes.room, rooms_), point(planes.ownRoom, ownRooms_);
        forEachRow([&](int y) {
            lanes_.row(planes, y, {pilot[0].row(y), pilot[1].row(y), pilot[2].row(y)},
                       left.row(y));
            for (std::size_t c = 0; c < kChannels; ++c)
                std::fill_n(pilot[c].row(y) + width_, DenoisePlanes::kBorderRight,
                            DenoisePlanes::kOutside);
        });
        Planes rooms = rooms_;
        forEachRow([&](int y) {
            for (std::size_t c = 0; c < kChannels; ++c)
                for (int x = 0; x < width_; ++x)
                    rooms[c].row(y)[x] *= (left.row(y)[x] * sqr(kDeviations / kPilotDeviations));
        });
        planes.radius = kRadius;
        point(planes.compared, pilot), point(planes.room, rooms), point(planes.ownRoom, rooms);
        Planes out = planesOf(width_, height_, 0);
        forEachRow([&](int y) {
            lanes_.row(planes, y, {out[0].row(y), out[1].row(y), out[2].row(y)}, left.row(y));
            for (int x = 0; x < width_; ++x) {
                const auto color = [&](std::size_t c) { return out[c].row(y)[x] * divisorAt(half, x, y, c); };
                filtered_[half].setPixel(x, y, {color(0), color(1), color(2)});
            }
        });
    }

    DenoisePlanes planesOfHalf(std::size_t half) const {
        DenoisePlanes planes;
        planes.width = width_, planes.height = height_, planes.stride = trusts_[half].stride();
        point(planes.color, colors_[half]);
        point(planes.albedo, albedos_), point(planes.normal, normals_);
        planes.albedoScale = albedoScale_.row(0), planes.normalScale = normalScale_.row(0);
        planes.trust = trusts_[half].row(0);
        return planes;
    }

    const HalvedPicture& picture_;
    const DenoiseLanes& lanes_;
    ThreadPool pool_;
    int width_, height_;
    std::array<Image, 2> filtered_{Image(width_, height_), Image(width_, height_)};
    std::array<Planes, 2> colors_{planesOf(width_, height_, DenoisePlanes::kOutside),
                                  planesOf(width_, height_, DenoisePlanes::kOutside)};
    std::array<Plane, 2> trusts_{Plane(width_, height_, 0), Plane(width_, height_, 0)};
    // These hold for both halves.
    Planes rooms_{planesOf(width_, height_, 0)}, ownRooms_{rooms_};
    // These hold for the half that is filtered.
    Planes albedos_{rooms_}, normals_{rooms_};
    Plane albedoScale_{width_, height_, 0}, normalScale_{albedoScale_};
};

} // namespace

std::array<Image, 2> denoise(const HalvedPicture& picture, const Isa& isa, int threads) {
    return Denoiser(picture, isa, threads).run();
}
