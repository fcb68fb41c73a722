#include "render/lamp_map/mapped_shapes.h"

#include <algorithm>

namespace {

// Fewer are looked at without a map.
constexpr std::size_t kFewestHulls = Occluders::kMost + 1;

bool hasRoundHull(const SolidTree::Solid& solid) {
    return solid.kind != SolidTree::Kind::Facets && solid.radius < kInfinityF &&
           (!solid.isTube || solid.halfLength < kInfinityF);
}

// Much of the hull of a large thing is air, and lamps may be in it.
bool isFloor(const SolidTree::Solid& solid, float extent) {
    return solid.innerRadius == 0 && solid.radius > extent / 8;
}

// One does not hide itself from what is outside.
bool isConvex(const SolidTree::Solid& solid, const ShapeSet& shapes) {
    return solid.kind != SolidTree::Kind::Other ||
           !shapes.shapes[solid.number]->hidesFromItself(false);
}

MappedShapes::Hull hullOf(const SolidTree::Solid& solid) {
    const bool isFilled = solid.innerRadius > solid.radius * MappedShapes::kInner &&
                          (!solid.isTube || solid.halfLength > 0);
    return {solid.centre, isFilled ? solid.radius : -solid.radius,
            solid.isTube ? solid.axis : Vec3{}, solid.isTube ? solid.halfLength : 0};
}

} // namespace

std::optional<MappedShapes> MappedShapes::of(const ShapeSet& shapes) {
    const auto& solids = shapes.solids().solids;
    if (solids.size() < kFewestHulls || solids.size() >> kNumberBits != 0 ||
        !shapes.placed().isEmpty())
        return {};
    MappedShapes out;
    out.extent = shapes.extent;
    const auto addOther = [&](std::uint32_t number) {
        if (shapes.shadows[number] != ShapeSet::Shadow::Opaque) return true;
        out.others.push_back(occluderOf(shapes, number));
        return out.others.size() <= kMostOthers;
    };
    if (!std::all_of(shapes.unbounded.begin(), shapes.unbounded.end(), addOther) ||
        !std::all_of(shapes.batched.begin(), shapes.batched.end(), addOther))
        return {};
    std::vector<const SolidTree::Solid*> mapped;
    mapped.reserve(solids.size());
    for (const SolidTree::Solid& solid : solids) {
        if (!solid.hides) continue;
        if (solid.moves) return {};
        if (!hasRoundHull(solid) || isFloor(solid, shapes.extent)) {
            if (!addOther(solid.number)) return {};
            continue;
        }
        mapped.push_back(&solid);
    }
    const auto tubes =
        std::stable_partition(mapped.begin(), mapped.end(), [](const SolidTree::Solid* solid) {
            return ::hullOf(*solid).halfLength == 0;
        });
    out.firstTube = static_cast<std::uint32_t>(tubes - mapped.begin());
    out.hulls.reserve(mapped.size());
    out.hullOf.assign(shapes.shapes.size(), kNoHull);
    std::size_t filled = 0;
    for (const SolidTree::Solid* const solid : mapped) {
        if (isConvex(*solid, shapes))
            out.hullOf[solid->number] = static_cast<std::uint32_t>(out.hulls.size());
        out.hulls.push_back(::hullOf(*solid));
        out.box.extend(shapes.boxes[solid->number]);
        filled += out.hulls.back().radius > 0;
    }
    // Of the rest too many rays would have to be asked.
    if (out.hulls.size() < kFewestHulls || filled < out.hulls.size() / 4 * 3) return {};
    return out;
}
