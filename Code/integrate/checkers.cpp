#include "integrate/checkers.h"

#include "integrate/wave.h"
#include "sample/hash.h"
#include "texture/box_checker.h"

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

// The part of what ray i stands for that lies on odd squares.
float oddPartOf(const Wave& wave, const StillShape& plane, std::uint32_t i, Vec3 normal) {
    const Hit& hit = wave.memory.hits[i];
    const Ray ray = wave.rays.ray(i);
    const double t = static_cast<double>(hit.t) + static_cast<double>(hit.u);
    const RayD local{pointUnder(plane.objectFromWorld(), toDouble(ray.org)),
                     vectorUnder(plane.objectFromWorld(), toDouble(ray.dir))};
    const Vec3d p = local.at(t);
    const Transform& place = plane.worldFromObject;
    const SurfaceDerivatives d{toFloat(place.vector({1, 0, 0})), toFloat(place.vector({0, 1, 0}))};
    const float width = wave.memory.path.states[i].cone.widthAt(hit.t);
    return static_cast<float>(oddPart({p.x, p.y}, footprintOn(width, ray.dir, normal, d)));
}

// A number in [0,1) that nothing else takes.
float numberFor(const Wave& wave, std::uint32_t i) {
    constexpr std::uint32_t kSquares = 0x5c4ec5e5;
    const std::uint64_t bits = hash(wave.rays.stream[i],
                                    wave.chunk.sampleNumber[wave.rays.sample[i]],
                                    kSquares + static_cast<std::uint32_t>(wave.depth));
    return unitFloat(high32(bits));
}

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
    PointBatch& points = wave.memory.points;
    std::vector<MaterialMix>& mixes = wave.memory.path.mixes;
    mixes.assign(points.count, {});
    for (std::size_t k = 0; k < points.count; ++k) {
        const std::uint32_t i = points.ray[k];
        const Checker* const checker =
            checkerAt(wave.context.checkers, wave.memory.hits[i].shape);
        if (checker == nullptr) continue;
        PointBlock& block = points.at.block(k / PointBlock::kPoints);
        const std::size_t place = k % PointBlock::kPoints;
        const StillShape& plane = *checker->plane;
        const float odd = oddPartOf(wave, plane, i, SurfaceBlock::get(block.ng, place));
        if (!checker->mixes) {
            block.material[place] =
                numberFor(wave, i) < odd ? plane.oddMaterial : plane.material;
            continue;
        }
        const bool isOdd = odd > 0.5f;
        block.material[place] = isOdd ? plane.oddMaterial : plane.material;
        mixes[k] = {isOdd ? plane.material : plane.oddMaterial, isOdd ? 1 - odd : odd};
    }
}
