// Rays travel in batches, as a structure of arrays: a tile's camera rays, then wave after wave what
// they spawn. Ray i of a batch is element i of every array. The arrays grow and are kept: a batch
// that is cleared has room for as many rays as it ever had.
#pragma once

#include "base/ray.h"
#include "scene/medium_tree.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

// Geometry of the rays, where their light is added, and what it is multiplied with.
struct RayBatch {
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;
    std::vector<std::uint32_t> sample; // slot of the camera sample that the ray belongs to
    std::vector<Rgb> weight;

    std::size_t size() const { return count_; }
    bool empty() const { return count_ == 0; }
    Ray ray(std::size_t i) const { return {org[i], dir[i], tMin[i], tMax[i], time[i]}; }
    RaySpan span() const {
        return {{org.data(), count_},
                {dir.data(), count_},
                {tMin.data(), count_},
                {tMax.data(), count_},
                {time.data(), count_}};
    }
    void push(const Ray& ray, std::uint32_t slot, Rgb rayWeight) {
        if (count_ == org.size()) makeRoom(std::max<std::size_t>(64, 2 * count_));
        const std::size_t i = count_++;
        org[i] = ray.org;
        dir[i] = ray.dir;
        tMin[i] = ray.tMin;
        tMax[i] = ray.tMax;
        time[i] = ray.time;
        sample[i] = slot;
        weight[i] = rayWeight;
    }
    void clear() { count_ = 0; }
    // So many more rays, which are then written into the arrays from the place returned.
    std::size_t extend(std::size_t rays) {
        const std::size_t first = count_;
        count_ += rays;
        if (count_ > org.size()) makeRoom(std::max<std::size_t>(64, 2 * count_));
        return first;
    }
    // Without the last ones, so that so many are left.
    void shrink(std::size_t rays) { count_ = rays; }

protected:
    void makeRoom(std::size_t rays) {
        org.resize(rays), dir.resize(rays), tMin.resize(rays), tMax.resize(rays);
        time.resize(rays), sample.resize(rays), weight.resize(rays);
    }

    std::size_t count_ = 0; // the arrays may be longer
};

// Rays that look for surfaces; shadow rays need no more than a RayBatch.
struct PathBatch : RayBatch {
    std::vector<MediumTree::Inside> medium;
    std::vector<std::uint32_t> stream; // which random numbers: one number per branch of the tree
    // How the ray sees lamps (PathLights::kSeesAsCamera); 0: the highlight has counted them
    // already.
    std::vector<std::uint8_t> seesLights;

    void push(const Ray& ray, std::uint32_t slot, Rgb rayWeight, MediumTree::Inside inside,
              std::uint32_t branch, std::uint8_t seesLamps) {
        RayBatch::push(ray, slot, rayWeight);
        makeRoomForMore();
        const std::size_t i = count_ - 1;
        medium[i] = inside;
        stream[i] = branch;
        seesLights[i] = seesLamps;
    }
    std::size_t extend(std::size_t rays) {
        const std::size_t first = RayBatch::extend(rays);
        makeRoomForMore();
        return first;
    }
    // So many rays, which are then written into the arrays; those in use keep what they were.
    void setSize(std::size_t rays) {
        if (org.size() < rays) makeRoom(rays);
        makeRoomForMore();
        count_ = rays;
    }

private:
    void makeRoomForMore() {
        if (medium.size() >= org.size()) return;
        medium.resize(org.size()), stream.resize(org.size()), seesLights.resize(org.size());
    }
};

// SampleNumbers: which samples of their pixels the slots of a chunk are. They are the same for most
// chunks of a picture, and are written when they are new.

class SampleNumbers {
public:
    // Of so many slots: samples first .. first + count - 1 of one pixel, then of the next.
    void set(std::uint32_t first, std::uint32_t count, std::size_t slots) {
        if (first != first_ || count != count_) numbers_.clear();
        first_ = first, count_ = count;
        numbers_.reserve(slots);
        std::uint32_t inPixel = static_cast<std::uint32_t>(numbers_.size()) % count;
        while (numbers_.size() < slots) {
            numbers_.push_back(first + inPixel);
            inPixel = inPixel + 1 < count ? inPixel + 1 : 0;
        }
    }
    const std::uint32_t& operator[](std::size_t slot) const { return numbers_[slot]; }

private:
    std::uint32_t first_ = 0, count_ = 0;
    std::vector<std::uint32_t> numbers_; // there may be more
};
