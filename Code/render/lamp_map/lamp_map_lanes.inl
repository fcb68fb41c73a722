// The points of a block, W at a time, on the map of a lamp. Filters decide as those of the tree do,
// by the same functions: no hit passes by, and what is certain is one.
// Included by the file of each instruction set inside its namespace.

enum class Answer { Closest, Any };

#include "accel/kernels/solids_hulls.inl"

namespace {

// Points that something hides, and those of which only a ray can tell.
struct HiddenByMap {
    unsigned hidden = 0, unsure = 0;
};

// W of the points. They go on step by step, so that many take turns and wait for memory together.
class RaysOnMap {
public:
    RaysOnMap(const LampMap& map, const LitBlock& block, const LitByLamp& by, std::size_t first,
              unsigned lanes)
        : map_(map), hulls_(map.shapes->hulls.data()), block_(block), first_(first),
          shape_(Ints::load(block.shape + first)) {
        const Floats one(1.0f);
        const Floats lamp[3] = {map.lamp.x, map.lamp.y, map.lamp.z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            lines_.org[axis] = lamp[axis];
            lines_.dir[axis] = Floats::load(by.dir[axis] + first);
        }
        const auto& d = lines_.dir;
        length2_ = fma(d[0], d[0], fma(d[1], d[1], d[2] * d[2]));
        lines_.length = sqrt(length2_);
        lines_.perLength = one / lines_.length, lines_.perLength2 = one / length2_;
        lines_.slack = map.slack, lines_.tMin = 0.0f;
        lines_.best = Floats::load(by.tMax + first);

        answer_.unsure = lanes & ~sane();
        live_ = lanes & ~answer_.unsure;
        answer_.unsure |= besideOthers(live_);
        at_ = findCells();
        reach_ = endOfReach();
    }

    void findList() {
        if (live_ != 0) at_ = intsAt(map_.starts.data(), shiftedUp(at_, 2));
    }

    void findFirst() {
        if (live_ == 0) return;
        const Ints shapes = select(maskOf(live_), shape_, Ints(0u));
        own_ = select(maskOf(block_.inside >> first_), Ints(MappedShapes::kNoHull),
                      intsAt(map_.shapes->hullOf.data(), shiftedUp(shapes, 2)));
        fetchHulls();
    }

    // Returns whether there is more to look at.
    bool step() {
        if (live_ == 0) return false;
        if (asked_ != 0) {
            meetAll(asked_);
            live_ &= ~answer_.hidden;
        }
        if (live_ == 0) return false;
        at_ = select(maskOf(live_), at_ + Ints(1u), at_);
        fetchHulls();
        return live_ != 0;
    }

    HiddenByMap answer() const { return {answer_.hidden, answer_.unsure & ~answer_.hidden}; }

private:
    static constexpr int kHullShift = 32 - LampMap::kHullBits;

    void fetchHulls() {
        const Ints entry = intsAt(map_.lists.data(), shiftedUp(at_, 2));
        live_ &= bits(entry < reach_);
        hull_ = shiftedDown(shiftedUp(entry, kHullShift), kHullShift);
        asked_ = live_ & ~bits(hull_ == own_);
    }

    // Points near each other look at the same hulls.
    void meetAll(unsigned lanes) {
        alignas(64) std::uint32_t hull[W];
        select(maskOf(lanes), hull_, Ints(0u)).store(hull); // others may be past the last one
        while (lanes != 0) {
            const std::uint32_t number = hull[std::countr_zero(lanes)];
            const unsigned same = lanes & bits(hull_ == Ints(number));
            if (std::popcount(same) == 1 && std::popcount(lanes) > kMostAlone)
                return meetInLanes(hull, lanes);
            meet(hulls_[number], same);
            lanes &= ~same;
        }
    }

    // Neither empty, nor without end, nor of NaN.
    unsigned sane() const {
        const Floats zero(0.0f), one(1.0f);
        return bits((length2_ > Floats(0x1p-80f)) & (length2_ < Floats(0x1p80f)) &
                    (lines_.best > zero) & (lines_.best <= one));
    }

    unsigned othersThan(std::uint32_t shape, bool hidesOutside, bool hidesInside) const {
        const unsigned inside = block_.inside >> first_;
        return ~bits(shape_ == Ints(shape)) | (inside & (hidesInside ? ~0u : 0)) |
               (~inside & (hidesOutside ? ~0u : 0));
    }

    // Lanes that other shapes may hide.
    unsigned besideOthers(unsigned lanes) const {
        unsigned met = 0;
        const Floats slack(lines_.slack);
        for (const Occluder& other : map_.others) {
            const unsigned asked =
                lanes & ~met & othersThan(other.shape, other.hidesOutside, other.hidesInside);
            if (asked == 0) continue;
            Mask apart = maskOf(0);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                const Floats end = fma(lines_.dir[axis], lines_.best, lines_.org[axis]);
                apart = apart | (min(end, lines_.org[axis]) > Floats(other.box.hi[axis]) + slack) |
                        (max(end, lines_.org[axis]) < Floats(other.box.lo[axis]) - slack);
            }
            if (other.plane) {
                const Vec3 n = other.plane->n;
                const float lamp = dot(n, map_.lamp) + other.plane->offset;
                // The point may be far outside of the scene.
                const Floats room = fma(lines_.length, Floats(0x1p-18f), slack + slack);
                const Floats rise = fma(along(n), lines_.best, Floats(lamp)), zero(0.0f);
                if (lamp > 2 * map_.slack) apart = apart | (rise > room);
                if (lamp < -2 * map_.slack) apart = apart | (rise < zero - room);
            }
            met |= asked & ~bits(apart);
        }
        return met;
    }

    Floats along(Vec3 axis) const {
        return fma(Floats(axis.x), lines_.dir[0],
                   fma(Floats(axis.y), lines_.dir[1], Floats(axis.z) * lines_.dir[2]));
    }

    // The cells of the lanes that are in the picture; the others are taken away: nothing is there.
    Ints findCells() {
        const Floats depth = along(map_.ahead), zero(0.0f);
        live_ &= ~bits(depth <= Floats(LampMap::kLeastCosine) * lines_.length);
        const Floats perDepth = Floats(1.0f) / depth, end(static_cast<float>(map_.cells()));
        const Floats x = fma(along(map_.right) * perDepth, Floats(map_.scale[0]),
                             Floats(map_.offset[0])),
                     y = fma(along(map_.up) * perDepth, Floats(map_.scale[1]),
                             Floats(map_.offset[1]));
        const unsigned isIn = bits((x >= zero) & (x < end) & (y >= zero) & (y < end));
        const unsigned isOut = bits(x < zero) | bits(x >= end) | bits(y < zero) | bits(y >= end);
        answer_.unsure |= live_ & ~isIn & ~isOut; // NaN
        live_ &= isIn;
        const Mask on = maskOf(live_);
        return truncated(select(on, x, zero)) +
               shiftedUp(truncated(select(on, y, zero)), map_.logCells);
    }

    // Beyond the last step all numbers are, behind NaN none.
    Ints endOfReach() const {
        const Floats reach = fma(lines_.best, lines_.length, lines_.slack);
        const Floats step = (reach - Floats(map_.firstStep)) * Floats(map_.perStep);
        constexpr auto kMost = static_cast<float>((1u << (32 - LampMap::kHullBits)) - 2);
        const Floats next = max(step + Floats(1.0f), Floats(0.0f));
        return select(next < Floats(kMost),
                      shiftedUp(truncated(min(next, Floats(kMost))), LampMap::kHullBits),
                      Ints(~0u));
    }

    void meet(const MappedShapes::Hull& hull, unsigned lanes) {
        const BallLanes ball = ballOf({hull.centre.x, hull.centre.y, hull.centre.z}, hull.radius);
        if (hull.halfLength == 0) return meetBalls(ball, lanes);
        meetTubes(ball, {{hull.axis.x, hull.axis.y, hull.axis.z}, hull.halfLength}, lanes);
    }

    static BallLanes ballOf(const Floats (&centre)[3], Floats radius) {
        return {{centre[0], centre[1], centre[2]},
                abs(radius),
                max(radius * Floats(MappedShapes::kInner), Floats(0.0f))};
    }

    // Each lane its own.
    void meetInLanes(const std::uint32_t (&hull)[W], unsigned lanes) {
        static_assert(offsetof(MappedShapes::Hull, axis) == 4 * sizeof(float) &&
                      offsetof(MappedShapes::Hull, halfLength) == 7 * sizeof(float));
        const float* row[W];
        for (int i = 0; i < W; ++i) row[i] = &hulls_[hull[i]].centre.x;
        Floats a[4], b[4];
        loadRows(row, a);
        for (const float*& from : row) from += 4;
        loadRows(row, b);
        const BallLanes ball = ballOf({a[0], a[1], a[2]}, a[3]);
        const unsigned balls = lanes & bits(b[3] == Floats(0.0f));
        if (balls != 0) meetBalls(ball, balls);
        if (balls != lanes) meetTubes(ball, {{b[0], b[1], b[2]}, b[3]}, lanes & ~balls);
    }

    void meetBalls(const BallLanes& ball, unsigned lanes) {
        const Nearness near = nearBall<Answer::Any>(lines_, ball);
        const auto& d = lines_.dir;
        const Floats foot = fma(ball.centre[0] - lines_.org[0], d[0],
                                fma(ball.centre[1] - lines_.org[1], d[1],
                                    (ball.centre[2] - lines_.org[2]) * d[2])) *
                            lines_.perLength2;
        const Floats entry = fnma(ball.radius + lines_.slack, lines_.perLength, foot);
        lanes &= near.may;
        answer_.hidden |= lanes & near.certain;
        answer_.unsure |= lanes & bits(notGreater(entry, lines_.best));
    }

    void meetTubes(const BallLanes& ball, const TubeLanes& tube, unsigned lanes) {
        const Nearness near = nearTube<Answer::Any>(lines_, ball, tube, lanes);
        answer_.hidden |= lanes & near.may & near.certain;
        answer_.unsure |= lanes & near.may;
    }

    static constexpr int kMostAlone = 2; // hulls that are met faster one by one

    const LampMap& map_;
    const MappedShapes::Hull* hulls_;
    const LitBlock& block_;
    std::size_t first_;
    Ints shape_;
    Lines lines_;
    Floats length2_;
    unsigned live_ = 0, asked_ = 0; // lanes that go on, and those that look at a hull
    Ints at_{0u}; // first the cell, then the place in the lists
    Ints reach_{0u}, own_{0u}, hull_{0u};
    HiddenByMap answer_;
};

} // namespace

void askLampMap(const LampMap& map, std::span<const LitBlock> blocks, std::span<LitByLamp> by) {
    constexpr std::size_t kTogether = 8 * LitBlock::kPoints / W;
    struct Asked {
        std::size_t block, first;
        alignas(64) std::byte rays[sizeof(RaysOnMap)];
        RaysOnMap& onMap() { return *std::launder(reinterpret_cast<RaysOnMap*>(rays)); }
    };
    std::array<Asked, kTogether> asked;
    std::size_t count = 0;
    const auto finish = [&] {
        const auto some = std::span(asked).first(count);
        for (Asked& a : some) a.onMap().findList();
        for (Asked& a : some) a.onMap().findFirst();
        for (bool more = true; more;) {
            more = false;
            for (Asked& a : some) more |= a.onMap().step();
        }
        for (Asked& a : some) {
            const HiddenByMap answer = a.onMap().answer();
            by[a.block].lit &= ~(answer.hidden << a.first);
            by[a.block].unsure |= answer.unsure << a.first;
        }
        count = 0;
    };
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        const unsigned points = std::exchange(by[b].unsure, 0);
        for (std::size_t first = 0; first < LitBlock::kPoints; first += W) {
            const unsigned lanes = points >> first & ((1u << W) - 1);
            if (lanes == 0) continue;
            Asked& a = asked[count];
            a.block = b, a.first = first;
            new (a.rays) RaysOnMap(map, blocks[b], by[b], first, lanes);
            if (++count == kTogether) finish();
        }
    }
    finish();
}
