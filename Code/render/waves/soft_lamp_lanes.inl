// The formulas of Sampler::get2D(), diskFromSquare(), frameAround(), PointLight::sample() and
// shadowRay(), as in lit_lanes.inl: a lane is a place on the lamp as a point of the block sees it.
// Included by the file of each instruction set inside its namespace.

namespace {

// As many whole numbers as the compiler's registers have room for, which sobol.inl takes.
using Bits __attribute__((vector_size(4 * kSobolLanes))) = std::uint32_t;
using SignedBits __attribute__((vector_size(4 * kSobolLanes))) = std::int32_t;
using UnitFloats __attribute__((vector_size(4 * kSobolLanes))) = float;

#include "sample/sobol.inl"

inline Bits loadBits(const std::uint32_t* from) {
    Bits all;
    std::memcpy(&all, from, sizeof(all));
    return all;
}
// unitFloat(): 24 bits fit into a signed number, which lanes can convert.
inline void storeUnit(const Bits& all, float* to) {
    const Bits upper = all >> 8;
    SignedBits number;
    std::memcpy(&number, &upper, sizeof(number));
    const UnitFloats unit = __builtin_convertvector(number, UnitFloats) * 0x1p-24f;
    std::memcpy(to, &unit, sizeof(unit));
}

// Seeds and sample number of W pairs, and the pairs.
struct PairsInLanes {
    alignas(64) std::uint32_t index[W], x[W], y[W], sample[W];

    void make(Floats& outX, Floats& outY) const {
        alignas(64) float u[W], v[W];
        for (std::size_t i = 0; i < W; i += kSobolLanes) {
            const auto pair = sobolPair(loadBits(sample + i), loadBits(index + i), loadBits(x + i),
                                        loadBits(y + i));
            storeUnit(pair.x, u + i), storeUnit(pair.y, v + i);
        }
        outX = Floats::load(u), outY = Floats::load(v);
    }
};

struct DiskLanes {
    Floats x, y;
};

// sinKernel() and cosKernel() of base/math.cpp for an angle of no lower part, each the upper part
// of its result.
inline Doubles sineOf(const Doubles& x) {
    constexpr double c3 = -1.0 / 6, c5 = 1.0 / 120, c7 = -1.0 / 5040, c9 = 1.0 / 362880;
    constexpr double c11 = -1.0 / 39916800, c13 = 1.0 / 6227020800, c15 = -1.0 / 1307674368000;
    constexpr double c17 = 1.0 / 355687428096000;
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2;
    const Doubles low = (Doubles(c5) + z * Doubles(c7)) + z2 * (Doubles(c9) + z * Doubles(c11));
    const Doubles high = (Doubles(c13) + z * Doubles(c15)) + z2 * Doubles(c17);
    return x + (x * z) * (Doubles(c3) + z * (low + z4 * high));
}
inline Doubles cosineOf(const Doubles& x) {
    constexpr double c4 = 1.0 / 24, c6 = -1.0 / 720, c8 = 1.0 / 40320, c10 = -1.0 / 3628800;
    constexpr double c12 = 1.0 / 479001600, c14 = -1.0 / 87178291200, c16 = 1.0 / 20922789888000;
    const Doubles z = x * x, z2 = z * z, z4 = z2 * z2, one(1.0);
    const Doubles low = (Doubles(c4) + z * Doubles(c6)) + z2 * (Doubles(c8) + z * Doubles(c10));
    const Doubles high = (Doubles(c12) + z * Doubles(c14)) + z2 * Doubles(c16);
    const Doubles half = Doubles(0.5) * z, main = one - half;
    return main + (((one - main) - half) + z2 * (low + z4 * high));
}

inline DiskLanes onDisk(Floats u, Floats v) {
    const Doubles two(2.0), one(1.0);
    const Doubles x = two * Doubles(u) - one, y = two * Doubles(v) - one;
    const Mask isSide = abs(y) < abs(x);
    const Doubles radius = select(isSide, x, y);
    const Doubles angle = Doubles(kPi / 4) * (select(isSide, y, x) / radius);
    const Doubles s = sineOf(angle), c = cosineOf(angle);
    DiskLanes disk{(radius * select(isSide, c, s)).toFloats(),
                   (radius * select(isSide, s, c)).toFloats()};
    // The centre, and angles that exact::sinCos() has other ways for.
    const Doubles size = abs(angle);
    unsigned others = ((1u << W) - 1) & ~(atMost(Doubles(0x1p-27), size) & less(size, kPi / 4));
    if (others == 0) return disk;
    alignas(64) float us[W], vs[W], xs[W], ys[W];
    u.store(us), v.store(vs), disk.x.store(xs), disk.y.store(ys);
    for (; others != 0; others &= others - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(others));
        const Vec2 place = diskFromSquare({us[i], vs[i]});
        xs[i] = place.x, ys[i] = place.y;
    }
    return {Floats::load(xs), Floats::load(ys)};
}

// How the points of a block see the lamp.
struct LampSeen {
    alignas(64) float toCentre[3][LitBlock::kPoints], x[3][LitBlock::kPoints],
        y[3][LitBlock::kPoints], z[3][LitBlock::kPoints]; // of the disk; z is towards the lamp
    unsigned seen = 0;
};

inline void store(const Three& v, float (&to)[3][LitBlock::kPoints], std::size_t first) {
    v.x.store(to[0] + first), v.y.store(to[1] + first), v.z.store(to[2] + first);
}

inline void lookAtLamp(const PointEmission& lamp, const LitBlock& block, std::size_t first,
                       LampSeen& out) {
    const Three d =
        Three::all(lamp.position.x, lamp.position.y, lamp.position.z) - Three::load(block.p, first);
    const Floats zero(0.0f), distance2 = dot(d, d);
    const Floats behind = (zero - dot(Three::load(block.n, first), d)) - Floats(lamp.radius);
    const Mask unseen =
        (behind > zero) & (behind * behind > Floats(sqr(kHorizonSlack)) * distance2);
    out.seen |= (~bits(unseen) & bits(distance2 > zero) & ((1u << W) - 1)) << first;
    const Three unit = d / sqrt(distance2);
    const Doubles x(unit.x), y(unit.y), z(unit.z), one(1.0), none(-0.0);
    const Doubles sign = withSign(one, z);
    const Doubles a = Doubles(-1.0) / (sign + z), b = x * y * a;
    const auto put = [&](const Doubles& i, const Doubles& j, const Doubles& k,
                         float(&to)[3][LitBlock::kPoints]) {
        store({i.toFloats(), j.toFloats(), k.toFloats()}, to, first);
    };
    put(one + sign * x * x * a, sign * b, (none - sign) * x, out.x);
    put(b, sign + y * y * a, none - y, out.y);
    store(unit, out.z, first), store(d, out.toCentre, first);
}

template <class Points> class SoftLanes {
public:
    SoftLanes(const PointEmission& lamp, const LitBlock& block, const LampSeen& lampSeen,
              const Points& points)
        : lamp_(lamp), block_(block), seen_(lampSeen), lit_(block, points) {}

    // Returns the lanes that are lit.
    unsigned light(const DiskLanes& disk, float share, std::size_t to, LitBySamples& out) const {
        unsigned lanes = lit_.lanesOf(block_.used & seen_.seen);
        const Floats radius(lamp_.radius), one(1.0f);
        const Three d = lit_.three(seen_.toCentre) + lit_.three(seen_.x) * (disk.x * radius) +
                        lit_.three(seen_.y) * (disk.y * radius);
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const Three toLight = d / distance;
        const Floats cosAtDisk = dot(toLight, lit_.three(seen_.z));
        const Attenuation& fade = lamp_.attenuation;
        const Floats faded = Floats(fade.quadratic) * distance2 + Floats(fade.linear) * distance +
                             Floats(fade.constant);
        const Three irradiance =
            Three::all(lamp_.intensity.r, lamp_.intensity.g, lamp_.intensity.b) *
            (cosAtDisk / faded);
        lanes &= ~black(irradiance) & lit_.rises(toLight);
        if (lanes == 0) return 0;
        const Three reflected = lit_.reflected(lit_.three(block_.n), toLight, lanes);
        const Three light = lit_.three(block_.weight) * reflected * irradiance * Floats(share);
        const auto put = [to](const Three& v, float(*rows)[LitBySamples::kRoom]) {
            v.x.store(rows[0] + to), v.y.store(rows[1] + to), v.z.store(rows[2] + to);
        };
        put(light, out.light), put(toLight, out.dir);
        (Doubles(distance) * Doubles(1 - 0x1p-20)).toFloats().store(out.tMax + to);
        return lanes & ~black(light);
    }

private:
    const PointEmission& lamp_;
    const LitBlock& block_;
    const LampSeen& seen_;
    LitLanes<Points> lit_;
};

} // namespace

void lightBySamples(const PointEmission& lamp, const LitBlock& block, const SamplesOnLamp& places,
                    LitBySamples& out) {
    LampSeen seen;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W)
        lookAtLamp(lamp, block, first, seen);
    const std::size_t points = std::bit_width(block.used), count = places.count;
    std::fill(out.lit.begin(), out.lit.end(), std::uint16_t{0});
    PairsInLanes pairs;
    const auto shine = [&](const auto& who, std::size_t first) {
        Floats u(0.0f), v(0.0f);
        pairs.make(u, v);
        const unsigned lit =
            SoftLanes(lamp, block, seen, who).light(onDisk(u, v), places.share, first, out);
        out.lit[first / 16] |= static_cast<std::uint16_t>(lit << first % 16);
    };
    if (count % W == 0) {
        for (std::size_t k = 0; k < points; ++k) {
            if ((seen.seen >> k & 1) == 0) continue;
            for (std::size_t i = 0; i < W; ++i)
                pairs.index[i] = places.index[k], pairs.x[i] = places.x[k],
                pairs.y[i] = places.y[k];
            for (std::size_t s = 0; s < count; s += W) {
                for (std::uint32_t i = 0; i < W; ++i)
                    pairs.sample[i] = places.first[k] + static_cast<std::uint32_t>(s) + i;
                shine(PointForAll{k}, k * count + s);
            }
        }
        return;
    }
    std::size_t k = 0;
    std::uint32_t s = 0;
    for (std::size_t first = 0; first < points * count; first += W) {
        PointsByLane who;
        for (std::size_t i = 0; i < W; ++i) {
            const std::size_t point = std::min(k, points - 1);
            who.points[i] = point;
            pairs.index[i] = places.index[point], pairs.x[i] = places.x[point],
            pairs.y[i] = places.y[point], pairs.sample[i] = places.first[point] + s;
            if (++s == count) s = 0, ++k;
        }
        shine(who, first);
    }
}
