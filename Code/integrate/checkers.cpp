#include "integrate/checkers.h"

#include "integrate/wave.h"
#include "sample/hash.h"
#include "texture/picture_lanes.h"

#include <algorithm>

namespace {

bool mayMix(const LobedMaterials& lobes, const StillShape& plane) {
    const LobedMaterial &even = lobes[plane.material], &odd = lobes[plane.oddMaterial];
    constexpr std::uint32_t kApart = kHasSides | LobedMaterial::kEmits |
                                     LobedMaterial::kSeeThrough | LobedMaterial::kAnisotropic;
    return even.signature == odd.signature && even.flags == odd.flags &&
           (even.flags & kApart) == 0 && even.factors == 0 && odd.factors == 0;
}

const Checker* checkerAt(const std::vector<Checker>& checkers, std::uint32_t shape) {
    const auto found = std::lower_bound(
        checkers.begin(), checkers.end(), shape,
        [](const Checker& checker, std::uint32_t number) { return checker.shape < number; });
    return found != checkers.end() && found->shape == shape ? &*found : nullptr;
}

// A number in [0,1) that nothing else takes.
float numberFor(const Wave& wave, std::uint32_t i) {
    constexpr std::uint32_t kSquares = 0x5c4ec5e5;
    const std::uint64_t bits = hash(wave.rays.stream[i],
                                    wave.chunk.sampleNumber[wave.rays.sample[i]],
                                    kSquares + static_cast<std::uint32_t>(wave.depth));
    return unitFloat(high32(bits));
}

// MixedPoints: decides about the points of one checker after the other, sixteen at a time.
class MixedPoints {
public:
    MixedPoints(const Wave& wave, std::vector<MaterialMix>& mixes) : wave_(wave), mixes_(mixes) {}

    void add(const Checker& checker, std::size_t k) {
        if (count_ == CheckerBlock::kPoints || checker_ != &checker) {
            mix();
            begin(checker);
        }
        const std::uint32_t i = wave_.memory.points.ray[k];
        const Hit& hit = wave_.memory.hits[i];
        const PointBlock& block = blockOf(k);
        cones_.put(count_, wave_.memory.path.states[i].cone.widthAt(hit.t), wave_.rays.dir[i],
                   SurfaceBlock::get(block.ng, k % PointBlock::kPoints));
        SurfaceBlock::set(cones_.org, count_, wave_.rays.org[i]);
        cones_.t[0][count_] = hit.t, cones_.t[1][count_] = hit.u;
        number_[count_++] = k;
    }
    // Decides about those that are left.
    void mix() {
        if (count_ == 0) return;
        const StillShape& plane = *checker_->plane;
        wave_.context.pictures.oddParts(plane.objectFromWorld(), cones_, count_);
        for (std::size_t j = 0; j < count_; ++j) {
            const std::size_t k = number_[j];
            std::uint32_t& material = blockOf(k).material[k % PointBlock::kPoints];
            const float odd = cones_.odd[j];
            if (!checker_->mixes) {
                const bool isOdd = numberFor(wave_, wave_.memory.points.ray[k]) < odd;
                material = isOdd ? plane.oddMaterial : plane.material;
                continue;
            }
            const bool isOdd = odd > 0.5f;
            material = isOdd ? plane.oddMaterial : plane.material;
            mixes_[k] = {isOdd ? plane.material : plane.oddMaterial, isOdd ? 1 - odd : odd};
        }
        count_ = 0;
    }

private:
    void begin(const Checker& checker) {
        if (checker_ == &checker) return;
        checker_ = &checker;
        const Transform& place = checker.plane->worldFromObject;
        for (std::size_t i = 0; i < CheckerBlock::kPoints; ++i)
            cones_.put(i, {toFloat(place.vector({1, 0, 0})), toFloat(place.vector({0, 1, 0}))});
    }
    PointBlock& blockOf(std::size_t k) const {
        return wave_.memory.points.at.block(k / PointBlock::kPoints);
    }

    const Wave& wave_;
    std::vector<MaterialMix>& mixes_;
    const Checker* checker_ = nullptr;
    CheckerBlock cones_;
    std::size_t count_ = 0, number_[CheckerBlock::kPoints];
};

} // namespace

std::vector<Checker> checkersOf(const Scene& scene) {
    std::vector<Checker> out;
    const LobedMaterials& lobes = scene.lobedMaterials();
    if (lobes.size() == 0) return out;
    for (const std::uint32_t number : scene.shapes().unbounded) {
        const StillShape* const plane = scene.shapes().shapes[number]->stillToShade();
        if (plane != nullptr && plane->kind == StillShape::Kind::Plane &&
            plane->material != plane->oddMaterial)
            out.push_back({number, plane, mayMix(lobes, *plane)});
    }
    std::sort(out.begin(), out.end(),
              [](const Checker& a, const Checker& b) { return a.shape < b.shape; });
    return out;
}

void waves::mixCheckers(const Wave& wave) {
    const PointBatch& points = wave.memory.points;
    std::vector<MaterialMix>& mixes = wave.memory.path.mixes;
    mixes.assign(points.count, {});
    MixedPoints mixed(wave, mixes);
    std::uint32_t lastShape = Hit::kNoShape;
    const Checker* checker = nullptr; // of the last shape
    for (std::size_t k = 0; k < points.count; ++k) {
        const std::uint32_t shape = wave.memory.hits[points.ray[k]].shape;
        if (shape != lastShape) checker = checkerAt(wave.context.checkers, shape);
        lastShape = shape;
        if (checker != nullptr) mixed.add(*checker, k);
    }
    mixed.mix();
}
