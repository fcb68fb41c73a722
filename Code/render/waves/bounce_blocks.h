// Points on mirrors and glass that wait until a block of them is full, whose rays lanes then make.
#pragma once

#include "render/waves/single_bounces.h"

#include <algorithm>
#include <bit>
#include <cstddef>

namespace waves {

// They keep their order.
class BouncesInLanes {
public:
    explicit BouncesInLanes(const Wave& wave) : wave_(wave) { block_.cutoff = wave.context.cutoff; }

    void add(std::size_t k) {
        const PointBatch& points = wave_.memory.points;
        const ShadedPoint& at = points.at[k];
        const Material& material = *points.material[k];
        const std::size_t i = count_++;
        const auto put = [i](float(*to)[BounceBlock::kPoints], Vec3 v) {
            to[0][i] = v.x, to[1][i] = v.y, to[2][i] = v.z;
        };
        const auto putLight = [&](float(*to)[BounceBlock::kPoints], Rgb c) {
            put(to, {c.r, c.g, c.b});
        };
        put(block_.n, at.eye.n), put(block_.ng, at.eye.ng), put(block_.toEye, at.toEye);
        putLight(block_.mirror, material.mirror);
        putLight(block_.transmission, material.transmission);
        putLight(block_.weight, points.weight[k]);
        points_[i] = k;
        Boundary boundary;
        if (isPlainMirror(material)) {
            boundary.before = boundary.after = wave_.rays.medium[points.ray[k]];
        } else {
            boundary = boundaryAt(wave_, k);
            block_.glass |= 1u << i;
        }
        before_[i] = boundary.before, after_[i] = boundary.after, block_.eta[i] = boundary.eta;
        if (count_ == BounceBlock::kPoints) send();
    }

    // All that wait.
    void send() {
        if (count_ == 0) return;
        block_.used = (1u << count_) - 1;
        wave_.context.bouncesInLanes(block_);
        std::size_t begin = 0;
        for (unsigned rest = block_.bent; rest != 0; rest &= rest - 1) {
            const auto bent = static_cast<std::size_t>(std::countr_zero(rest));
            write(begin, bent);
            bounceAlone(wave_, points_[bent]);
            begin = bent + 1;
        }
        write(begin, count_);
        count_ = 0, block_.glass = 0;
    }

private:
    // What push() does, of the points begin .. end - 1.
    void write(std::size_t begin, std::size_t end) const {
        const unsigned range = (1u << end) - (1u << begin);
        const unsigned reflects = block_.reflects & range, refracts = block_.refracts & range;
        const auto reflected = static_cast<std::size_t>(std::popcount(reflects));
        const auto refracted = static_cast<std::size_t>(std::popcount(refracts));
        wave_.counts.reflect += reflected, wave_.counts.refract += refracted;
        const PointBatch& points = wave_.memory.points;
        const PathBatch& from = wave_.rays;
        PathBatch& next = wave_.memory.next;
        std::size_t to = next.extend(reflected + refracted);
        // Nothing is rough.
        std::fill_n(next.seesLights.begin() + static_cast<std::ptrdiff_t>(to),
                    reflected + refracted, std::uint8_t{true});
        Vec3 *const org = next.org.data(), *const dirs = next.dir.data();
        float *const tMin = next.tMin.data(), *const tMax = next.tMax.data(),
                     *const time = next.time.data();
        std::uint32_t *const sample = next.sample.data(), *const stream = next.stream.data();
        Rgb* const weights = next.weight.data();
        MediumTree::Inside* const inside = next.medium.data();
        using Rows = float[3][BounceBlock::kPoints];
        const auto put = [&](std::size_t i, std::size_t ray, const Rows& dir, const Rows& weight,
                             Vec3 start, MediumTree::Inside medium, std::uint32_t branch) {
            org[to] = start, dirs[to] = {dir[0][i], dir[1][i], dir[2][i]};
            tMin[to] = 0, tMax[to] = kInfinityF, time[to] = from.time[ray];
            weights[to] = {weight[0][i], weight[1][i], weight[2][i]};
            sample[to] = from.sample[ray], inside[to] = medium;
            stream[to] = low32(hash(from.stream[ray], branch));
            ++to;
        };
        for (unsigned rest = reflects | refracts; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const std::size_t ray = points.ray[points_[i]];
            const ShadedPoint& at = points.at[points_[i]];
            if ((reflects >> i & 1) != 0)
                put(i, ray, block_.reflectedDir, block_.reflected, leave(at.surface, at.eye.ng),
                    before_[i], kReflected);
            if ((refracts >> i & 1) != 0)
                put(i, ray, block_.refractedDir, block_.refracted, leave(at.surface, -at.eye.ng),
                    after_[i], kRefracted);
        }
    }

    const Wave& wave_;
    BounceBlock block_;
    std::size_t count_ = 0, points_[BounceBlock::kPoints];
    MediumTree::Inside before_[BounceBlock::kPoints], after_[BounceBlock::kPoints];
};

} // namespace waves
