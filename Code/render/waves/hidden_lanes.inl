// The questions of Occluders::mayHide(), asked for every point of a block by itself. Included by
// the file of each instruction set inside its namespace.

namespace {

// The part of [0,1] where linear functions a + t b are not negative, after some of them.
struct TimesInLanes {
    Floats lo{0.0f}, hi{1.0f};
    void keepPositive(Floats a, Floats b) {
        const Floats zero(0.0f), crossing = (zero - a) / b;
        lo = select(b > zero, max(crossing, lo), lo);
        hi = select(b < zero, min(crossing, hi), hi);
        lo = select((b == zero) & (a < zero), Floats(2.0f), lo);
    }
};

class PointsToLamp {
public:
    PointsToLamp(const LitBlock& block, std::size_t first, const PointEmission& lamp)
        : lamp_(Bounds{lamp.position, lamp.position}.padded(lamp.radius)), lampRadius_(lamp.radius),
          p_(Three::load(block.p, first)) {
        const Vec3 centre = lamp.position;
        const Three way = Three::all(centre.x, centre.y, centre.z) - p_;
        distance_ = sqrt(dot(way, way));
        unit_ = way / distance_;
        const Three lift = Three::load(block.lift, first);
        lift_ = abs(lift.x) + abs(lift.y) + abs(lift.z);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const Floats p = Floats::load(block.p[axis] + first);
            const Floats lifted = p + Floats::load(block.lift[axis] + first);
            lo_[axis] = min(p, lifted), hi_[axis] = max(p, lifted);
        }
    }

    float extent() const {
        Floats most(::max(maxAbs(lamp_.lo), maxAbs(lamp_.hi)));
        for (std::size_t axis = 0; axis < 3; ++axis)
            most = max(max(abs(lo_[axis]), abs(hi_[axis])), most);
        return largest(most);
    }

    unsigned meet(const Bounds& box, float slack) const {
        TimesInLanes times;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            times.keepPositive(hi_[axis] - Floats(box.lo[axis] - slack),
                               Floats(lamp_.hi[axis]) - hi_[axis]);
            times.keepPositive(Floats(box.hi[axis] + slack) - lo_[axis],
                               lo_[axis] - Floats(lamp_.lo[axis]));
        }
        return ~bits(times.lo > times.hi * Floats(1 + 0x1p-18f));
    }

    // The hull of the point and of a ball around the lamp is a cone of the angle whose sine is
    // lampRadius / distance. A ball is `height` over its axis and `along` it. How far from the
    // cone's sides is the centre, outwards, and the same across the axis?
    struct BallSeen {
        Floats along, height, distance2, cosine, sine, out;
    };
    BallSeen look(const Occluder& ball) const {
        const Three d = Three::all(ball.centre.x, ball.centre.y, ball.centre.z) - p_;
        const Floats along = dot(d, unit_), one(1.0f);
        const Three across = d - unit_ * along;
        const Floats height = sqrt(dot(across, across)), sine = Floats(lampRadius_) / distance_;
        const Floats cosine = sqrt(one - sine * sine); // NaN in the lamp: then nothing is known
        return {along, height, dot(d, d), cosine, sine, height * cosine - along * sine};
    }

    // Is the ball off the cone?
    unsigned passBy(const Occluder& ball, const BallSeen& seen, float slack) const {
        const Floats room = Floats(ball.radius + slack) + lift_;
        const Mask isBehind = seen.along * seen.cosine + seen.height * seen.sine < Floats(0.0f);
        return bits(seen.out > room) | bits(isBehind & (seen.distance2 > room * room));
    }

    // Does all of the cone go through the ball in front of the lamp? The line that is farthest from
    // the centre is on the other side of the axis.
    unsigned areBehind(const Occluder& ball, const BallSeen& seen, float slack) const {
        const Floats around = Floats(slack) + lift_, core(ball.core), outside = core + around;
        const Floats farthest = seen.height * seen.cosine + seen.along * seen.sine;
        const Mask isAhead = seen.along * seen.cosine > seen.height * seen.sine;
        const Mask isNearer = seen.along + seen.height + around < distance_ - Floats(lampRadius_);
        return bits((farthest + around < core) & isAhead & isNearer &
                    (seen.distance2 > outside * outside));
    }

    unsigned areBeside(const Occluder::Sides& plane, float slack) const {
        float lampLo = plane.offset, lampHi = plane.offset;
        Floats lo(plane.offset), hi(plane.offset);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const float n = plane.n[axis];
            const bool up = n > 0;
            lampLo += n * (up ? lamp_.lo : lamp_.hi)[axis];
            lampHi += n * (up ? lamp_.hi : lamp_.lo)[axis];
            lo = lo + Floats(n) * (up ? lo_ : hi_)[axis];
            hi = hi + Floats(n) * (up ? hi_ : lo_)[axis];
        }
        if (lampLo > slack) return bits(lo > Floats(slack));
        if (lampHi < -slack) return bits(hi < Floats(-slack));
        return 0;
    }

private:
    Bounds lamp_;
    float lampRadius_;
    Three p_, unit_;
    Floats distance_, lift_;
    Floats lo_[3], hi_[3];
};

} // namespace

HiddenPoints hiddenPoints(const Occluders& occluders, const LitBlock& block,
                          const PointEmission& lamp) {
    HiddenPoints hidden;
    for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
        const unsigned all = block.used >> first & ((1u << W) - 1);
        const PointsToLamp points(block, first, lamp);
        const float slack = occluders.slack(points.extent());
        const Ints shapes = Ints::load(block.shape + first);
        unsigned met = 0, behind = 0;
        for (const Occluder& caster : occluders.all()) {
            const unsigned inside = block.inside >> first;
            const unsigned others = ~bits(shapes == Ints(caster.shape)) |
                                    (inside & (caster.hidesInside ? ~0u : 0)) |
                                    (~inside & (caster.hidesOutside ? ~0u : 0));
            unsigned asked = all & ~behind & others;
            if (caster.core == 0) asked &= ~met;
            if (asked != 0 && caster.plane) asked &= ~points.areBeside(*caster.plane, slack);
            if (asked != 0 && caster.radius < kInfinityF) {
                const auto seen = points.look(caster);
                asked &= ~points.passBy(caster, seen, slack);
                behind |= asked & points.areBehind(caster, seen, slack);
            }
            asked &= ~met;
            if (asked != 0) met |= asked & points.meet(caster.box, slack);
            if (behind == all) break;
        }
        hidden.maybe |= (met | behind) << first, hidden.surely |= behind << first;
    }
    return hidden;
}
