// The solids in the order of their tree's leaves: those that were added, or what several threads
// are told of each.
#include "accel/kernels/solids.h"
#include "base/for_each.h"

#include <algorithm>
#include <utility>

// 0: it is no ball.
static double ballScaleOf(const SolidTree::Solid& solid) {
    if (solid.meets != SolidTree::Meets::Sphere || solid.turned) return 0;
    const AffineRows& m = solid.shape->objectFromWorld();
    return m[0] == m[5] && m[0] == m[10] ? m[0] : 0;
}

static SolidTree::Ball ballOf(const SolidTree::Solid& solid, const Bounds& box) {
    const AffineRows& m = solid.shape->objectFromWorld();
    return {box, {m[3], m[7], m[11]}, solid.shape->radius, solid.number};
}

void SolidTree::build(int nodeWidth, int threads) {
    width = nodeWidth;
    const std::vector<std::uint32_t> order = writeNodes(boxes, threads);
    const auto sort = [&](auto& things) {
        const auto before = things;
        for (std::size_t i = 0; i < order.size(); ++i) things[i] = before[order[i]];
    };
    sort(solids), sort(boxes);
}

void SolidTree::build(int nodeWidth, std::span<const Bounds> of, const Describe& describe,
                      int threads) {
    width = nodeWidth;
    take(writeNodes(of, threads), of, describe, threads);
}

// Each part of the solids has its own lists of what has a `part` there, which are joined then.
void SolidTree::take(std::span<const std::uint32_t> order, std::span<const Bounds> of,
                     const Describe& describe, int threads) {
    constexpr std::size_t kTogether = 1024, kAhead = 8, kSome = 32;
    struct Rest {
        std::vector<Tube> tubes;
        std::vector<FacetGroup> facets;
        std::vector<Movement> movements;
        std::size_t firstTube = 0, firstFacets = 0, firstMovement = 0;
        double ballScale = 0;
        std::size_t balls = 0; // of that scale
    };
    const auto ofPart = [](auto& things, std::size_t first) {
        return things.begin() + static_cast<std::ptrdiff_t>(first);
    };
    std::vector<Rest> rests((order.size() + kTogether - 1) / kTogether);
    solids.resize(order.size()), boxes.resize(order.size()), balls.resize(order.size());
    std::vector<std::uint8_t> isBall(order.size(), 0); // of its part's scale
    forEachPart(threads, order.size(), kTogether, [&](std::size_t first, std::size_t last) {
        SolidTree part;
        part.solids.reserve(last - first), part.boxes.reserve(last - first);
        Rest& rest = rests[first / kTogether];
        std::size_t seen = 0; // balls of any scale
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t at = order[i];
            const std::uint32_t next = order[std::min(i + kAhead, last - 1)];
            __builtin_prefetch(&of[next]);
            const Described solid = describe(at, next);
            part.add(of[at], solid.number, solid.hides, solid.form);
            // After some of which few are balls, the others are not looked at.
            if (rest.balls + kSome < (i - first) / 2) continue;
            const double scale = ballScaleOf(part.solids.back());
            if (scale == 0) continue;
            ++seen;
            if (scale != rest.ballScale) {
                if (2 * rest.balls >= seen) continue;
                // Most so far are of another scale than the one that was kept.
                rest.ballScale = scale, rest.balls = 0;
                std::fill(isBall.begin() + static_cast<std::ptrdiff_t>(first),
                          isBall.begin() + static_cast<std::ptrdiff_t>(i), std::uint8_t{0});
            }
            balls[i] = ballOf(part.solids.back(), of[at]);
            isBall[i] = 1, ++rest.balls;
        }
        std::copy(part.solids.begin(), part.solids.end(), ofPart(solids, first));
        std::copy(part.boxes.begin(), part.boxes.end(), ofPart(boxes, first));
        rest.tubes = std::move(part.tubes), rest.facets = std::move(part.facets);
        rest.movements = std::move(part.movements);
    });
    const auto join = [](auto& things, const auto& more) {
        const std::size_t first = things.size();
        things.insert(things.end(), more.begin(), more.end());
        return first;
    };
    const auto most = std::max_element(
        rests.begin(), rests.end(), [](const Rest& a, const Rest& b) { return a.balls < b.balls; });
    ballScale = most == rests.end() ? 0 : most->ballScale;
    std::size_t countOfBalls = 0;
    for (const Rest& rest : rests) countOfBalls += rest.ballScale == ballScale ? rest.balls : 0;
    if (ballScale == 0 || countOfBalls < order.size() / 4 * 3) balls = {};
    for (Rest& rest : rests) {
        rest.firstTube = join(tubes, rest.tubes);
        rest.firstFacets = join(facets, rest.facets);
        rest.firstMovement = join(movements, rest.movements);
    }
    const auto isInOrder = [&](std::size_t place) {
        const bool isOne = isBall[place] != 0 && rests[place / kTogether].ballScale == ballScale;
        return solids[place].kind == Kind::Facets || (!balls.empty() && !isOne);
    };
    if (!facets.empty() || (!balls.empty() && countOfBalls < order.size()))
        width == 16 ? putInOrder<16>(isInOrder) : putInOrder<8>(isInOrder);
    if (tubes.empty() && facets.empty() && movements.empty()) return;
    forEachPart(threads, order.size(), kTogether, [&](std::size_t first, std::size_t last) {
        const Rest& rest = rests[first / kTogether];
        for (std::size_t i = first; i < last; ++i) {
            Solid& solid = solids[i];
            const std::size_t before = solid.moves                  ? rest.firstMovement
                                       : solid.kind == Kind::Tube   ? rest.firstTube
                                       : solid.kind == Kind::Facets ? rest.firstFacets
                                                                    : 0;
            solid.part += static_cast<std::uint32_t>(before);
        }
    });
}

template <int W, class Fn> void SolidTree::putInOrder(const Fn& isInOrder) {
    constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
    for (std::size_t line = 0; line < lines.size(); line += kLines)
        for (WideRef& child : reinterpret_cast<WideNode<W>*>(&lines[line])->child)
            if (isLeaf(child) && isInOrder(child >> 2)) child |= static_cast<WideRef>(kInOrder);
}

std::size_t SolidTree::bytes() const {
    return lines.size() * sizeof(WideTree::Line) + solids.size() * sizeof(Solid) +
           boxes.size() * sizeof(Bounds) + balls.size() * sizeof(Ball) +
           tubes.size() * sizeof(Tube) + facets.size() * sizeof(FacetGroup) +
           movements.size() * sizeof(Movement) + endless.size() * sizeof(Solid);
}
