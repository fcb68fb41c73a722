#include "render/path/path.h"

#include "render/path/path_memory.h"
#include "render/path/path_numbers.h"
#include "render/to_float.h"
#include "render/waves/background.h"
#include "render/waves/points.h"
#include "render/waves/single_bounces.h"

#include <bit>

namespace {

constexpr std::size_t kPoints = PointBlock::kPoints;

// The squares of two densities, over their sum (power heuristic).
float misWeight(float pdf, float other) {
    const float a = pdf * pdf, b = other * other;
    return a < kInfinityF ? a / (a + b) : 1.0f;
}

class PathWave {
public:
    PathWave(const Wave& wave)
        : wave_(wave), context_(wave.context), scene_(context_.scene), memory_(wave.memory),
          path_(memory_.path), lights_(scene_.pathLights()), materials_(scene_.lobedMaterials()),
          limits_(context_.settings.picture) {}

    void run() {
        findSurfaces();
        addMissed();
        if (lights_.hasUnshaped()) addMet();
        path_.shadowRays.clear();
        memory_.next.clear(), path_.nextStates.clear();
        const PointBatch& points = memory_.points;
        for (std::size_t b = 0; b < points.blocks(); ++b) scatterBlock(b);
        addShadowed();
    }

private:
    const PathState& stateOf(std::size_t ray) const { return path_.states[ray]; }

    void findSurfaces() {
        PointBatch& points = memory_.points;
        points.clear(wave_.rays.size());
        waves::listHits(memory_.hits, wave_.rays.size(), points);
        points.at.setMaterials(scene_.materials());
        waves::findSurfaces(wave_);
        for (std::size_t b = 0; b < points.blocks(); ++b) {
            waves::seeBlock<true>(wave_, b, 0);
            waves::takeSamples(wave_.rays, b, points);
        }
        for (std::size_t k = 0; k < points.count; ++k) points.material[k] = &points.at.of(k).base;
        if (wave_.depth == 0 && context_.wantsFirstHits) describeFirstHits(wave_);
    }

    // Light that arrives along ray i, on its sample.
    void add(std::size_t i, Rgb radiance) {
        Rgb light = wave_.rays.weight[i] * radiance;
        clampIndirect(light, wave_.depth);
        wave_.add(wave_.rays.sample[i], light);
    }
    // `bounces` lie between the camera and where the light is reflected or seen.
    void clampIndirect(Rgb& light, int bounces) const {
        const float most = toFloat(limits_.clampIndirect);
        if (!(most > 0) || bounces < 1) return;
        const float sum = light.r + light.g + light.b;
        if (sum > 3 * most) light = light * (3 * most / sum);
    }

    // What part of a light's radiance a ray adds that has met it, if its direction was sampled with
    // a density: the light could have been sampled as well.
    float partOfHit(const PathState& state, std::uint32_t light, Vec3 dir) const {
        if (!(state.pdf > 0) || light == PathLights::kNone) return 1;
        return misWeight(state.pdf, lights_.pdf(state.p, state.n, light, dir));
    }

    void addMissed() {
        const PointBatch& points = memory_.points;
        const std::span<const Rgb> seen = waves::backgroundsOf(wave_);
        const Rgb background = seen.empty() ? scene_.background(Vec3{}) : Rgb{};
        for (std::size_t m = 0; m < points.missedCount; ++m) {
            const std::uint32_t i = points.missed[m];
            const Vec3 dir = normalize(wave_.rays.dir[i]);
            const PathState& state = stateOf(i);
            const Rgb radiance = seen.empty() ? background : seen[m];
            add(i, radiance * partOfHit(state, lights_.sky(), dir));
        }
    }

    // Lamps that are no shapes, and that rays go through.
    void addMet() {
        const PathBatch& rays = wave_.rays;
        for (std::size_t i = 0; i < rays.size(); ++i) {
            const PathState& state = stateOf(i);
            const float end = memory_.hits[i].isHit() ? memory_.hits[i].t : kInfinityF;
            lights_.meet(rays.org[i], rays.dir[i], end, state.pdf > 0 ? 0 : rays.seesLights[i],
                         [&](std::uint32_t light, Rgb radiance) {
                             add(i, radiance * partOfHit(state, light, rays.dir[i]));
                         });
        }
    }

    // What the surface at point k emits.
    void addEmission(std::size_t k) {
        const PointBatch& points = memory_.points;
        const std::uint32_t i = points.ray[k];
        const PathState& state = stateOf(i);
        const ShadedPoint at = points.at[k];
        const Material here = materialAt(at);
        if (isBlack(here.emission) || (at.of->emitsFront && !at.front)) return;
        if (at.of->isLamp && wave_.rays.seesLights[i] == 0) return;
        const Hit& hit = memory_.hits[i];
        std::uint32_t light = lights_.ofObject(at.surface.object, at.front);
        if (light == PathLights::kNone) light = lights_.ofTriangle(hit.shape, hit.prim);
        add(i, here.emission * partOfHit(state, light, normalize(wave_.rays.dir[i])));
    }

    void scatterBlock(std::size_t b) {
        const PointBatch& points = memory_.points;
        const PointBlock& at = points.at.block(b);
        PathBlock& block = path_.block;
        const std::size_t first = b * kPoints, size = points.sizeOf(b);
        block.lit = block.open = block.scattered = block.single = block.diffuse =
            block.transmitted = 0;
        std::uint32_t pixels[kPoints] = {}, samples[kPoints] = {};
        unsigned waiting = 0; // points whose lobes are asked
        for (std::size_t k = first; k < first + size; ++k) {
            const std::size_t i = k - first;
            const LobedMaterial& of = materials_[at.material[i]];
            if ((of.flags & LobedMaterial::kEmits) != 0) addEmission(k);
            if (of.lobes == 0 || stateOf(points.ray[k]).isLast) continue;
            waiting |= 1u << i;
            pixels[i] = wave_.rays.stream[points.ray[k]];
            samples[i] = wave_.chunk.sampleNumber[points.slot[k]];
        }
        if (waiting == 0) return;
        drawNumbers(context_, wave_.depth, pixels, samples, block.numbers);
        for (std::size_t k = first; k < first + size; ++k) {
            const Rgb weight = points.weight[k];
            block.throughput[0][k - first] = weight.r;
            block.throughput[1][k - first] = weight.g;
            block.throughput[2][k - first] = weight.b;
        }
        waiting &= ~goStraight(b, waiting);
        while (waiting != 0) waiting &= ~scatterAlike(b, waiting);
    }

    // Points that rays go through as if they weren't there; returns which.
    unsigned goStraight(std::size_t b, unsigned points) {
        unsigned straight = 0;
        for (; points != 0; points &= points - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(points));
            const std::size_t k = b * kPoints + i;
            const SceneMaterial& of = memory_.points.at.of(k);
            if (!of.seeThrough()) continue;
            const ShadedPoint at = memory_.points.at[k];
            const Material here = materialAt(at);
            if (!(path_.block.numbers.spare[i] < 1 - here.opacity)) continue;
            straight |= 1u << i;
            const std::uint32_t ray = memory_.points.ray[k];
            PathState state = stateOf(ray);
            if (++state.transparent > limits_.transparentDepth) continue;
            const PathBatch& rays = wave_.rays;
            memory_.next.push(
                {leave(at.surface, -at.eye.ng), rays.dir[ray], 0, kInfinityF, rays.time[ray]},
                rays.sample[ray], rays.weight[ray] * here.filter, rays.medium[ray],
                rays.stream[ray], rays.seesLights[ray]);
            path_.nextStates.push_back(state);
            ++wave_.counts.refract;
        }
        return straight;
    }

    // Scatters the light of those points that have the same kinds of lobes as the first of them.
    unsigned scatterAlike(std::size_t b, unsigned waiting) {
        const PointBatch& points = memory_.points;
        const PointBlock& at = points.at.block(b);
        const auto leader = static_cast<std::size_t>(std::countr_zero(waiting));
        const std::uint32_t number = at.material[leader];
        const LobedMaterial& of = materials_[number];
        LobeBlock& lobes = path_.lobes;
        lobes.begin(materials_, of);
        unsigned alike = 0;
        for (unsigned rest = waiting; rest != 0; rest &= rest - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(rest));
            const LobedMaterial& other = materials_[at.material[i]];
            if (other.signature != of.signature) continue;
            alike |= 1u << i;
            if (at.material[i] != number) lobes.put(materials_, other, i);
            if (other.factors != 0)
                lobes.paint(materials_, other, i, points.at.uv(b * kPoints + i));
        }
        PathBlock& block = path_.block;
        block.points = alike;
        waves::Boundary boundaries[kPoints];
        if ((of.flags & kHasSides) != 0)
            for (unsigned rest = alike; rest != 0; rest &= rest - 1) {
                const auto i = static_cast<std::size_t>(std::countr_zero(rest));
                boundaries[i] = waves::boundaryAt(wave_, b * kPoints + i);
                block.eta[i] = boundaries[i].eta;
            }
        context_.settings.isa->path->scatter(lights_, at, lobes, block);
        takeLight(b, alike);
        takeRays(b, alike, of, boundaries);
        return alike;
    }

    // Shadow rays to the chosen lamps.
    void takeLight(std::size_t b, unsigned alike) {
        const PathBlock& block = path_.block;
        for (unsigned lit = block.lit & alike; lit != 0; lit &= lit - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(lit));
            const std::size_t k = b * kPoints + i;
            const std::uint32_t ray = memory_.points.ray[k], slot = memory_.points.slot[k];
            const Vec3 v = SurfaceBlock::get(block.fromLamp, i);
            Rgb light{v.x, v.y, v.z};
            clampIndirect(light, bouncesOf(stateOf(ray)) + 1);
            ++wave_.counts.shadow;
            if ((block.open >> i & 1) != 0) {
                wave_.add(slot, light);
                continue;
            }
            path_.shadowRays.push({SurfaceBlock::get(block.lampOrg, i),
                                   SurfaceBlock::get(block.toLamp, i), 0, block.lampEnd[i],
                                   wave_.rays.time[ray]},
                                  slot, light);
        }
    }
    static int bouncesOf(const PathState& state) {
        return state.diffuse + state.glossy + state.transmission;
    }

    // Rays that go on.
    void takeRays(std::size_t b, unsigned alike, const LobedMaterial& of,
                  const waves::Boundary* boundaries) {
        const PathBlock& block = path_.block;
        const PathBatch& rays = wave_.rays;
        for (unsigned on = block.scattered & alike; on != 0; on &= on - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(on));
            const std::size_t k = b * kPoints + i;
            const std::uint32_t ray = memory_.points.ray[k];
            PathState state = stateOf(ray);
            const bool isDiffuse = (block.diffuse >> i & 1) != 0,
                       isTransmitted = (block.transmitted >> i & 1) != 0,
                       isSingle = (block.single >> i & 1) != 0;
            if (!limits_.caustics && state.diffuse > 0 && !isDiffuse) continue;
            if (isDiffuse)
                state.isLast = ++state.diffuse > limits_.diffuseDepth;
            else if (isTransmitted)
                state.isLast = ++state.transmission > limits_.transmissionDepth;
            else
                state.isLast = ++state.glossy > limits_.glossyDepth;
            const int bounces = bouncesOf(state);
            state.isLast |= bounces > limits_.maxDepth;
            // The last ray is traced for the light that was weighted against it.
            if (state.isLast && isSingle) continue;
            const Vec3 w = SurfaceBlock::get(block.weight, i);
            Rgb weight = rays.weight[ray] * Rgb{w.x, w.y, w.z};
            if (bounces > kBouncesWithoutRoulette) {
                const float go = clamp(maxChannel(weight), kLeastToGo, 1.0f);
                if (!(block.numbers.roulette[i] < go)) continue;
                weight = weight * (1 / go);
            }
            state.pdf = block.pdf[i];
            state.p = SurfaceBlock::get(memory_.points.at.block(b).p, i);
            state.n = (of.flags & kTransmits) != 0
                          ? Vec3{}
                          : SurfaceBlock::get(memory_.points.at.block(b).n, i);
            const bool crosses = isTransmitted && (of.flags & kHasSides) != 0;
            memory_.next.push({SurfaceBlock::get(block.org, i), SurfaceBlock::get(block.dir, i), 0,
                               kInfinityF, rays.time[ray]},
                              rays.sample[ray], weight,
                              crosses ? boundaries[i].after : rays.medium[ray], rays.stream[ray],
                              PathBatch::kSeesAsReflection);
            path_.nextStates.push_back(state);
            ++(isTransmitted ? wave_.counts.refract
               : isDiffuse   ? wave_.counts.indirect
                             : wave_.counts.reflect);
        }
    }
    static constexpr int kBouncesWithoutRoulette = 3;
    static constexpr float kLeastToGo = 0.05f;

    void addShadowed() {
        const RayBatch& rays = path_.shadowRays;
        if (rays.empty()) return;
        wave_.counts.tracedShadow += rays.size();
        if (scene_.hasSeeThrough()) {
            transmitted(scene_, rays, memory_.transmittance);
            for (std::size_t i = 0; i < rays.size(); ++i)
                if (const Rgb part = memory_.transmittance[i]; !isBlack(part))
                    wave_.add(rays.sample[i], rays.weight[i] * part);
            return;
        }
        scene_.shapes().occluded(rays.span(), memory_.hidden);
        for (std::size_t i = 0; i < rays.size(); ++i)
            if (memory_.hidden[i] == 0) wave_.add(rays.sample[i], rays.weight[i]);
    }

    const Wave& wave_;
    const IntegratorContext& context_;
    const Scene& scene_;
    WaveMemory& memory_;
    PathMemory& path_;
    const PathLights& lights_;
    const LobedMaterials& materials_;
    const SettingsDesc& limits_;
};

} // namespace

void integratePath(const IntegratorContext& context, SampleChunk& chunk, WaveMemory& memory,
                   RayCounts& counts, std::uint64_t& cameraHits) {
    counts.camera += chunk.cameraRays.size();
    memory.media = context.media;
    memory.path.states.assign(chunk.cameraRays.size(), PathState{});
    const PathBatch* rays = &chunk.cameraRays;
    for (int depth = 0; !rays->empty(); ++depth) {
        const Wave wave{context, *rays, depth, chunk, memory, counts};
        closest(context.scene, *rays, memory.hits);
        PathWave(wave).run();
        if (depth == 0) cameraHits += memory.points.count;
        std::swap(memory.rays, memory.next);
        std::swap(memory.path.states, memory.path.nextStates);
        rays = &memory.rays;
    }
}
