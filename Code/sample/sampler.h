// Sampler: random numbers as a pure function of (seed, pixel, sample, dimension).
// No state, no order of calls: any thread may ask for any number and gets the same bits.
#pragma once

#include "base/vec.h"
#include "sample/z_order.h"

#include <bit>
#include <cstdint>

enum class SamplerKind {
    Sobol,      // hash-based Owen-scrambled Sobol (Burley 2020), 2D pairs padded by shuffling
    Stratified, // jittered cells, n x m of them for pairs, cells shuffled per pair of dimensions
    Random,     // independent numbers, for proofs
    Grid,       // the pixel dimensions in regular order of cells, all others as Stratified
    ZSobol,     // one Owen-scrambled Sobol sequence along the Z-order of the pixels, see zsobol.h
};

class Sampler {
public:
    // sampleCount >= 1 samples per pixel: a power of two for Sobol and ZSobol, n x m for Stratified
    // and Grid. Others work, less evenly; sample indices beyond the count go on with fresh patterns,
    // those of ZSobol begin again.
    // `jitter` concerns the pixel dimensions only: without it Stratified and Grid use the centres
    // of the cells, and with one sample every kind uses the centre of the pixel.
    Sampler(SamplerKind kind, int sampleCount, std::uint32_t seed, bool jitter = true);

    // A number in [0,1). `pixel` may be any number that tells pixels apart, of ZSobol it is their
    // zNumber(): counted in the whole picture, a crop repeats the same pixels. Dimensions:
    // dimensions.h.
    float get1D(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) const;
    // Dimensions `dimension` (even) and dimension + 1, evenly spread in the square over the samples
    // of a pixel. Its x is not the number of get1D in the same dimension.
    Vec2 get2D(std::uint32_t pixel, std::uint32_t sample, std::uint32_t dimension) const;

    // Whether lanes draw its pairs.
    bool isInLanes() const { return kind_ == SamplerKind::Sobol || kind_ == SamplerKind::ZSobol; }
    // What the pairs of a pixel are shuffled and scrambled by, of a sampler in lanes; of ZSobol
    // `index` is the number of the pixel's first sample.
    struct PairSeeds {
        std::uint32_t index, x, y;
    };
    PairSeeds pairSeeds(std::uint32_t pixel, std::uint32_t dimension) const;
    // Returns how a sampler of the kind ZSobol numbers its samples for a pair.
    ZOrder zOrder(std::uint32_t dimension) const;
    // Returns how many bits the numbers of a pixel's samples have.
    int sampleBits() const { return static_cast<int>(std::bit_width(count_ - 1)); }
    // Of its pair, the x is what get1D() gives of `dimension`; of a sampler in lanes, too.
    static constexpr std::uint32_t alone(std::uint32_t dimension) {
        return dimension | 0x80000000u; // keeps the hashes of a number and of a pair apart
    }

    // An independent sampler of the same kind, for the n-th thing of a loop inside a sample, such
    // as a light with `repeats` light samples each: ask it for sample = sample * repeats + k, so
    // all sampleCount * repeats numbers of a pixel are spread evenly together. The id is hashed
    // into the seed. Build it once per light, not per hit. Its pixel dimensions are not special.
    Sampler stream(std::uint32_t id, int repeats = 1) const;

    SamplerKind kind() const { return kind_; }
    int sampleCount() const { return static_cast<int>(count_); }
    std::uint32_t seed() const { return seed_; }

private:
    Vec2 otherPair(std::uint64_t bits, std::uint64_t more, std::uint32_t sample,
                   bool isPixel) const;

    SamplerKind kind_;
    bool jitter_;
    bool isStream_ = false;
    std::uint32_t seed_, count_;
    std::uint32_t columns_, rows_; // columns_ * rows_ == count_, as square as it goes
};
