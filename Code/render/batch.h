// Rays travel in batches, as a structure of arrays: a tile's camera rays, then wave after wave what
// they spawn. Ray i of a batch is element i of every array.
#pragma once

#include "base/ray_span.h"
#include "render/medium_tree.h"

#include <cstddef>
#include <cstdint>
#include <vector>

// Geometry of the rays, where their light is added, and what it is multiplied with.
struct RayBatch {
    std::vector<Vec3> org, dir;
    std::vector<float> tMin, tMax, time;
    std::vector<std::uint32_t> sample; // slot of the camera sample that the ray belongs to
    std::vector<Rgb> weight;

    std::size_t size() const { return org.size(); }
    bool empty() const { return org.empty(); }
    Ray ray(std::size_t i) const { return {org[i], dir[i], tMin[i], tMax[i], time[i]}; }
    RaySpan span() const { return {org, dir, tMin, tMax, time}; }
    void push(const Ray& ray, std::uint32_t slot, Rgb rayWeight) {
        org.push_back(ray.org);
        dir.push_back(ray.dir);
        tMin.push_back(ray.tMin);
        tMax.push_back(ray.tMax);
        time.push_back(ray.time);
        sample.push_back(slot);
        weight.push_back(rayWeight);
    }
    void clear() {
        org.clear(), dir.clear(), tMin.clear(), tMax.clear(), time.clear();
        sample.clear(), weight.clear();
    }
};

// Rays that look for surfaces; shadow rays need no more than a RayBatch.
struct PathBatch : RayBatch {
    std::vector<MediumTree::Inside> medium;
    std::vector<std::uint32_t> stream;    // which random numbers: one number per branch of the tree
    std::vector<std::uint8_t> seesLights; // false: the highlight has counted the lamps already

    void push(const Ray& ray, std::uint32_t slot, Rgb rayWeight, MediumTree::Inside inside,
              std::uint32_t branch, bool seesLamps) {
        RayBatch::push(ray, slot, rayWeight);
        medium.push_back(inside);
        stream.push_back(branch);
        seesLights.push_back(seesLamps);
    }
    void clear() {
        RayBatch::clear();
        medium.clear(), stream.clear(), seesLights.clear();
    }
};
