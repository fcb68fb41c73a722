// The rays of a bundle as they lie in their batch, W to a packet: read from there and answered
// there. Which of them are traced together is decided in bundle_rays.h.
#pragma once

#include "accel/kernels/chord.h"
#include "accel/kernels/kernels.h"
#include "accel/kernels/queue_answers.h"
#include "base/math.h"
#include "base/ray.h"
#include "base/vec.h"
#include "simd/lanes.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

LANES_BEGIN

class BundlePackets {
public:
    static constexpr std::size_t kMostRays = 256;
    static constexpr int kPackets = static_cast<int>(kMostRays) / W;

    BundlePackets(const RaySpan& rays, Vec3 org)
        : origin(org), rays_(rays), finiteOrigin_(maxAbs(org) < 1e30f) {}

    // `list`: numbers of rays, in ascending order, at most kMostRays.
    void load(std::span<const std::uint32_t> list) {
        list_ = list;
        loaded_ = (static_cast<int>(list.size()) + W - 1) / W;
        inARow_ = list.back() - list.front() + 1 == list.size();
        for (int p = 0; p < loaded_; ++p) traceable_[p] = loadDirections(p);
    }

    // Misses for the rays that isTraceable() refuses.
    template <class Results> void refuse(const Results& results) const {
        for (int p = 0; p < loaded_; ++p) {
            const std::size_t rays = std::min<std::size_t>(W, list_.size() - at(p, 0));
            const unsigned refused = ~traceable_[p] & ((1u << rays) - 1);
            if (refused != 0) answerMisses(p, refused, results);
        }
    }

    Vec3 origin;

protected:
    // Asks for what lies `distance` behind these W elements: the next bundle's, probably. Behind
    // the end of a batch, the next batch often follows. What is read waits in the second cache:
    // the first one is busy with this bundle.
    template <class T> static void prefetchAhead(T* first, std::size_t distance = kMostRays) {
        constexpr int kToWrite = std::is_const_v<T> ? 0 : 1, kCache = kToWrite != 0 ? 3 : 2;
        const auto ahead = reinterpret_cast<std::uintptr_t>(first) + distance * sizeof(T);
        for (std::size_t byte = 0; byte < W * sizeof(T); byte += 64)
            // NOLINTNEXTLINE(performance-no-int-to-ptr): may be behind the end
            __builtin_prefetch(reinterpret_cast<const void*>(ahead + byte), kToWrite, kCache);
    }

    // Its number in the batch.
    std::uint32_t number(int p, int lane) const { return list_[at(p, lane)]; }
    bool isRay(int p, int lane) const { return at(p, lane) < list_.size(); }
    Vec3 directionOf(int p, int lane) const {
        return {dir_[0][p][lane], dir_[1][p][lane], dir_[2][p][lane]};
    }
    // Is every lane of the packet a ray, and do they follow each other in the batch?
    bool isFull(int p) const { return inARow_ && at(p + 1, 0) <= list_.size(); }

    // Answers of these lanes of a packet.
    void answer(int p, unsigned lanes, Floats t, Ints triangle, TriangleHit* hits) const {
        if (lanes == (1u << W) - 1 && isFull(p)) {
            TriangleHit* const first = &hits[number(p, 0)];
            prefetchAhead(first);
            storePairs(t, triangle, &first->t);
            return;
        }
        alignas(64) float ts[W];
        alignas(64) std::uint32_t triangles[W];
        t.store(ts), triangle.store(triangles);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            hits[number(p, i)] = {ts[i], triangles[i]};
        }
    }
    // With u and v: lanes that are no hit have the ray's end for t, and zeros.
    void answer(int p, unsigned lanes, Floats t, Weights weights, Ints triangle, Ints shape,
                Hit* hits) const {
        if (lanes == (1u << W) - 1 && isFull(p)) {
            Hit* const first = &hits[number(p, 0)];
            prefetchAhead(first);
            storeRows(t, weights.u, weights.v, triangle, shape, &first->t);
            return;
        }
        alignas(64) Hit rows[W];
        storeRows(t, weights.u, weights.v, triangle, shape, &rows[0].t);
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            hits[number(p, i)] = rows[i];
        }
    }
    void answer(int p, unsigned lanes, unsigned found, std::uint8_t* hidden) const {
        if (lanes == (1u << W) - 1 && isFull(p)) return storeFlags(found, hidden + number(p, 0));
        for (; lanes != 0; lanes &= lanes - 1) {
            const int i = std::countr_zero(lanes);
            hidden[number(p, i)] = found >> i & 1;
        }
    }
    void answerMisses(int p, unsigned lanes, const HitLists& hits) const {
        if (hits.whole == nullptr)
            answer(p, lanes, Floats(kInfinityF), Ints(TriangleHit::kNone), hits.brief);
        else
            for (; lanes != 0; lanes &= lanes - 1) {
                const std::uint32_t ray = number(p, std::countr_zero(lanes));
                hits.miss(ray, rays_.tMax[ray]);
            }
    }
    void answerMisses(int p, unsigned lanes, std::uint8_t* hidden) const {
        answer(p, lanes, 0, hidden);
    }

    const RaySpan& rays_;
    int loaded_ = 0;               // packets
    unsigned traceable_[kPackets]; // lanes that hold a ray that isTraceable()
    alignas(64) float dir_[3][kPackets][W];

private:
    static std::size_t at(int p, int lane) {
        return static_cast<std::size_t>(p) * W + static_cast<std::size_t>(lane);
    }

    // Returns the traceable lanes.
    unsigned loadDirections(int p) {
        const std::size_t first = at(p, 0);
        Floats dx, dy, dz_;
        if (isFull(p)) {
            const std::uint32_t ray = list_[first];
            prefetchAhead(&rays_.dir[ray]);
            prefetchAhead(&rays_.org[ray], rays_.size()); // compared before anything is traced
            loadVectors(&rays_.dir[ray].x, dx, dy, dz_);
            dx.store(dir_[0][p]), dy.store(dir_[1][p]), dz_.store(dir_[2][p]);
        } else {
            for (std::size_t i = 0; i < W; ++i) {
                const Vec3 d = first + i < list_.size() ? rays_.dir[list_[first + i]] : Vec3{};
                dir_[0][p][i] = d.x, dir_[1][p][i] = d.y, dir_[2][p][i] = d.z;
            }
            dx = Floats::load(dir_[0][p]), dy = Floats::load(dir_[1][p]);
            dz_ = Floats::load(dir_[2][p]);
        }
        if (!finiteOrigin_) return 0;
        const Floats sum = ((dx + dy) + dz_) + Floats((origin.x + origin.y) + origin.z);
        const Floats size = max(max(abs(dx), abs(dy)), abs(dz_));
        return bits((size > Floats(1e-30f)) & (size < Floats(1e30f)) & (sum - sum == Floats(0.0f)));
    }

    std::span<const std::uint32_t> list_;
    bool inARow_ = false, finiteOrigin_;
};

LANES_END
