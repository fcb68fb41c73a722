// The solids in the order of their tree's leaves: those that were added, or what several threads
// are told of each.
#include "accel/kernels/solids.h"
#include "base/for_each.h"

#include <algorithm>
#include <utility>

std::vector<std::uint32_t> SolidTree::writeNodes(std::span<const Bounds> of, int threads) {
    around = {};
    for (const Bounds& box : of) around.extend(box);
    WideTree tree = buildWideOfBoxes(width, of, threads);
    lines = std::move(tree.lines), sah = tree.sah;
    return std::move(tree.triangleIds);
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
    constexpr std::size_t kTogether = 1024, kAhead = 8;
    struct Rest {
        std::vector<Tube> tubes;
        std::vector<FacetGroup> facets;
        std::vector<Movement> movements;
        std::size_t firstTube = 0, firstFacets = 0, firstMovement = 0;
    };
    const auto ofPart = [](auto& things, std::size_t first) {
        return things.begin() + static_cast<std::ptrdiff_t>(first);
    };
    std::vector<Rest> rests((order.size() + kTogether - 1) / kTogether);
    solids.resize(order.size()), boxes.resize(order.size());
    forEachPart(threads, order.size(), kTogether, [&](std::size_t first, std::size_t last) {
        SolidTree part;
        part.solids.reserve(last - first), part.boxes.reserve(last - first);
        Rest& rest = rests[first / kTogether];
        for (std::size_t i = first; i < last; ++i) {
            const std::uint32_t at = order[i];
            const std::uint32_t next = order[std::min(i + kAhead, last - 1)];
            __builtin_prefetch(&of[next]);
            const Described solid = describe(at, next);
            part.add(of[at], solid.number, solid.hides, solid.form);
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
    for (Rest& rest : rests) {
        rest.firstTube = join(tubes, rest.tubes);
        rest.firstFacets = join(facets, rest.facets);
        rest.firstMovement = join(movements, rest.movements);
    }
    if (!facets.empty()) width == 16 ? putFacetsInOrder<16>() : putFacetsInOrder<8>();
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

template <int W> void SolidTree::putFacetsInOrder() {
    constexpr std::size_t kLines = sizeof(WideNode<W>) / sizeof(WideTree::Line);
    for (std::size_t line = 0; line < lines.size(); line += kLines)
        for (WideRef& child : reinterpret_cast<WideNode<W>*>(&lines[line])->child)
            if (isLeaf(child) && solids[child >> 2].kind == Kind::Facets)
                child |= static_cast<WideRef>(kInOrder);
}

std::size_t SolidTree::bytes() const {
    return lines.size() * sizeof(WideTree::Line) + solids.size() * sizeof(Solid) +
           boxes.size() * sizeof(Bounds) + tubes.size() * sizeof(Tube) +
           facets.size() * sizeof(FacetGroup) + movements.size() * sizeof(Movement) +
           endless.size() * sizeof(Solid);
}
