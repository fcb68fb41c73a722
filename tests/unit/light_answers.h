// The answers to light_questions.h in the lanes of this unit.
#pragma once

#include "light/kinds/sky.h"
#include "light/lights.h"
#include "light/tree/pick_lanes.h"
#include "unit/light_questions.h"

LANES_BEGIN

class AnswerRows {
public:
    AnswerRows(light_questions::Answers& out, std::size_t first) : out_(out), first_(first) {}
    ~AnswerRows() { out_.count = at_; }
    AnswerRows(const AnswerRows&) = delete;
    AnswerRows& operator=(const AnswerRows&) = delete;

    void add(Ints bits) { bits.store(out_.rows[at_++] + first_); }
    void add(Floats a) { add(bitsOf(a)); }
    void add(const Floats3& a) { add(a.x), add(a.y), add(a.z); }
    void add(const SampledLight& s) {
        add(s.toLight), add(s.distance), add(s.irradiance), add(s.pdf);
        add(select(s.single, Ints(1), Ints(0)));
    }
    void add(const LightMeeting& m) { add(m.distance), add(m.radiance); }

private:
    light_questions::Answers& out_;
    std::size_t first_, at_ = 0;
};

inline void answer(const light_questions::Questions& in, light_questions::Answers& out) {
    for (std::size_t first = 0; first < light_questions::kPoints; first += W) {
        AnswerRows rows(out, first);
        const auto vector = [&](const float(*a)[light_questions::kPoints]) {
            return Floats3{Floats::load(a[0] + first), Floats::load(a[1] + first),
                           Floats::load(a[2] + first)};
        };
        const Floats3 p = vector(in.p), n = vector(in.n), dir = vector(in.dir);
        const Floats u = Floats::load(in.u + first), v = Floats::load(in.v + first);
        const auto ask = [&](const auto& light) {
            const SampledLight s = light.sample(p, u, v);
            rows.add(s), rows.add(light.centre(p));
            rows.add(light.pdf(p, dir)), rows.add(light.pdf(p, s.toLight));
            rows.add(light.meet(p, dir)), rows.add(light.meet(p, s.toLight));
        };
        forLight(in.kind, [&]<class L>() {
            ask(L(LightNumbers{in.numbers[0] + first, light_questions::kPoints}));
        });
        const SkyEmitter sky(in.sky);
        rows.add(sky.sample(p, u, v)), rows.add(sky.pdf(p, dir)), rows.add(sky.meet(p, dir));
        const LightChoice choice(in.tree);
        const PickedLight picked = choice.pick(p, n, unitDoubles(Ints::load(in.bits + first)));
        rows.add(picked.light), rows.add(picked.probability), rows.add(picked.u.toFloats());
        rows.add(choice.probability(p, n, Ints::load(in.light + first)));
    }
}

LANES_END
