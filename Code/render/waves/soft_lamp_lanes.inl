// The formulas of frameAround(), PointLight::sample() and shadowRay(), as in lit_lanes.inl: a lane
// is a point of the block, and its samples follow each other.
// Included by the file of each instruction set inside its namespace.

namespace {

// How W points see the lamp.
struct LampSeen {
    Three toCentre, x, y, z; // of the disk; z is towards the lamp
    unsigned seen;
};

// PointLight::cannotReach()
inline unsigned behindHorizon(const PointEmission& lamp, const Three& n, const Three& d,
                              Floats distance2) {
    const Floats zero(0.0f), behind = (zero - dot(n, d)) - Floats(lamp.radius);
    return bits((behind > zero) & (behind * behind > Floats(sqr(kHorizonSlack)) * distance2));
}

inline LampSeen lookAtLamp(const PointEmission& lamp, const LitBlock& block, std::size_t first) {
    const Three d =
        Three::all(lamp.position.x, lamp.position.y, lamp.position.z) - Three::load(block.p, first);
    const Floats distance2 = dot(d, d);
    const unsigned unseen = behindHorizon(lamp, Three::load(block.n, first), d, distance2);
    const Three unit = d / sqrt(distance2);
    const Doubles x(unit.x), y(unit.y), z(unit.z), one(1.0), none(-0.0);
    const Doubles sign = withSign(one, z);
    const Doubles a = Doubles(-1.0) / (sign + z), b = x * y * a;
    const auto rounded = [&](const Doubles& i, const Doubles& j, const Doubles& k) {
        return Three{i.toFloats(), j.toFloats(), k.toFloats()};
    };
    return {d, rounded(one + sign * x * x * a, sign * b, (none - sign) * x),
            rounded(b, sign + y * y * a, none - y), unit, ~unseen & bits(distance2 > Floats(0.0f))};
}

// Samples of the lamp, one of each point: places on it, and the ways there.
struct LampRow : DiskRow {
    Three toLight;
    Floats distance2, distance;
};

// W points of a block from `first` on, lit by a lamp that has a size.
class SoftLanes {
public:
    // `share`: of each sample in the light.
    SoftLanes(const PointEmission& lamp, const LitBlock& block, float share, std::size_t first)
        : block_(block), first_(first), lit_(block, {first}), seen_(lookAtLamp(lamp, block, first)),
          radius_(lamp.radius), constant_(lamp.attenuation.constant),
          linear_(lamp.attenuation.linear), quadratic_(lamp.attenuation.quadratic), share_(share),
          intensity_(Three::all(lamp.intensity.r, lamp.intensity.g, lamp.intensity.b)) {}

    // Those of them that may be lit.
    unsigned lanesOf(unsigned points) const { return lit_.lanesOf(points) & seen_.seen; }

    bool isShiny() const { return lit_.isShiny(); }

    void findWay(LampRow& row) const {
        const Floats x = Floats::load(row.x) * radius_, y = Floats::load(row.y) * radius_;
        const Three d = seen_.toCentre + seen_.x * x + seen_.y * y;
        row.distance2 = dot(d, d), row.distance = sqrt(row.distance2);
        row.toLight = d / row.distance;
    }

    struct Sample {
        Three light;
        unsigned lit; // by it, if only by black
    };
    template <bool kMayShine> Sample sample(const LampRow& row, unsigned asked) const {
        const Three toLight = row.toLight;
        const Floats cosAtDisk = dot(toLight, seen_.z);
        const Floats faded = quadratic_ * row.distance2 + linear_ * row.distance + constant_;
        const Three irradiance = intensity_ * (cosAtDisk / faded);
        const unsigned lit = asked & ~black(irradiance) & lit_.rises(toLight);
        const Three reflected =
            lit_.template reflected<kMayShine>(Three::load(block_.n, first_), toLight, lit);
        return {Three::load(block_.weight, first_) * reflected * irradiance * share_, lit};
    }

private:
    const LitBlock& block_;
    std::size_t first_;
    LitLanes<PointsInRow> lit_;
    LampSeen seen_;
    Floats radius_, constant_, linear_, quadratic_, share_;
    Three intensity_;
};

inline void store(const Three& v, float* x, float* y, float* z) {
    v.x.store(x), v.y.store(y), v.z.store(z);
}

// Row by row, and nothing is called: the processor works at several, and places some while it
// divides for others.
inline void findRows(const SoftLanes& lanes, const SamplesOnLamp& samples, std::size_t first,
                     LampRow* rows) {
    const PairsInLanes pairs{samples.index + first, samples.x + first, samples.y + first,
                             samples.first + first};
    drawPairs(pairs, rows, static_cast<std::uint32_t>(samples.count));
    unsigned unsure = 0;
    placeOnDisk(rows[0], unsure);
    for (std::size_t s = 1; s < samples.count; ++s)
        placeOnDisk(rows[s], unsure), lanes.findWay(rows[s - 1]);
    lanes.findWay(rows[samples.count - 1]);
    if (unsure == 0) return;
    for (LampRow* row = rows; row != rows + samples.count; ++row)
        placeSurely(*row, unsure), lanes.findWay(*row);
}

template <bool kMayShine>
void sumSamples(const SoftLanes& lanes, const SamplesOnLamp& samples, const LinesToLamp& lines,
                unsigned mayBeHidden, std::size_t first, LitBySamples& out) {
    constexpr std::size_t kPoints = LitBlock::kPoints;
    LampRow rows[LitBySamples::kMost];
    findRows(lanes, samples, first, rows);
    const unsigned asked = lanes.lanesOf(samples.points);
    mayBeHidden = mayBeHidden >> first & ((1u << W) - 1);
    unsigned waiting = out.waiting >> first & ((1u << W) - 1);
    const Three before = Three::load(out.sum, first);
    Three sum = before;
    for (std::size_t s = 0; s < samples.count; ++s) {
        const LampRow& row = rows[s];
        SoftLanes::Sample by = lanes.sample<kMayShine>(row, asked);
        if ((by.lit & mayBeHidden) != 0) {
            by.lit &= ~black(by.light);
            const auto [hidden, unsure] =
                lines.ask(row.toLight, row.distance, by.lit & mayBeHidden);
            by.lit &= ~hidden, waiting |= unsure;
            const std::size_t to = s * kPoints + first;
            store(by.light, out.light[0] + to, out.light[1] + to, out.light[2] + to);
            store(row.toLight, out.dir[0] + to, out.dir[1] + to, out.dir[2] + to);
            (Doubles(row.distance) * Doubles(1 - 0x1p-20)).toFloats().store(out.tMax + to);
            out.lit[s] |= static_cast<std::uint16_t>((by.lit & mayBeHidden) << first);
            out.unsure[s] |= static_cast<std::uint16_t>(unsure << first);
        }
        sum = select(maskOf(by.lit), sum + by.light, sum);
    }
    out.waiting |= waiting << first;
    store(select(maskOf(waiting), before, sum), out.sum[0] + first, out.sum[1] + first,
          out.sum[2] + first);
}

} // namespace

void lightBySamples(const PointEmission& lamp, const LitBlock& block, const SamplesOnLamp& places,
                    const Occluders& occluders, const HiddenPoints& hidden, LitBySamples& out) {
    out.lit.fill(0), out.unsure.fill(0);
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const SoftLanes lanes(lamp, block, places.share, first);
        if (lanes.lanesOf(places.points) == 0) continue;
        const LinesToLamp lines(block, occluders, hidden, first);
        if (lanes.isShiny())
            sumSamples<true>(lanes, places, lines, hidden.maybe, first, out);
        else
            sumSamples<false>(lanes, places, lines, hidden.maybe, first, out);
    }
}

// cannotReach() and whole() of PointLight, and wholeLight() of a point.
void wholeLight(const PointEmission& lamp, const LitBlock& block, unsigned points,
                unsigned unhidden, WholeLight& out) {
    const Attenuation& fade = lamp.attenuation;
    if (!fade.isInverseSquare() && !fade.isConstant()) unhidden = 0;
    unhidden &= ~(block.shiny[0] | block.shiny[1] | block.shiny[2]);
    const Three none = Three::all(0, 0, 0);
    out.known = 0;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const auto put = [&](const Three& light) {
            store(light, out.light[0] + first, out.light[1] + first, out.light[2] + first);
        };
        put(none);
        const LitLanes<PointsInRow> lit(block, {first});
        if (lit.lanesOf(points) == 0) continue;
        const Three n = Three::load(block.n, first);
        const Three d = Three::all(lamp.position.x, lamp.position.y, lamp.position.z) -
                        Three::load(block.p, first);
        const Floats distance2 = dot(d, d), distance = sqrt(distance2);
        const unsigned unseen = behindHorizon(lamp, n, d, distance2);
        out.known |= (lit.lanesOf(points) & unseen) << first;
        const Floats height = Floats(lamp.radius) + Floats(kHorizonSlack) * distance;
        const auto isAbove = [&](const Three& up) { return bits(dot(up, d) >= height); };
        unsigned above = isAbove(Three::load(block.ng, first));
        if (const unsigned lifted = lit.lanesOf(block.lifted); lifted != 0)
            above |= lifted & isAbove(Three::load(block.ns, first));
        unsigned lanes =
            lit.lanesOf(points & unhidden) & above & isAbove(n) & bits(distance2 > Floats(0.0f));
        if (lanes == 0) continue;
        const Floats radius2(sqr(lamp.radius));
        const Floats faded = fade.isConstant()
                                 ? Floats(fade.constant) / logRatio(radius2 / distance2)
                                 : Floats(fade.quadratic) * (distance2 + radius2);
        const Three irradiance = Three::all(lamp.intensity.r, lamp.intensity.g, lamp.intensity.b) *
                                 (Floats(1.0f) / faded);
        const Three reflected = lit.template reflected<false>(n, d / distance, lanes);
        const Three light = Three::load(block.weight, first) * reflected * irradiance;
        lanes &= ~black(light);
        put(select(maskOf(lanes), light, none));
        out.known |= lanes << first;
    }
}
