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

// What maps show of a solid.
struct Mapped {
    std::uint32_t number; // of the shape
    bool isConvex;
    MappedShapes::Hull hull;
    float core;

    bool isTube() const { return hull.halfLength > 0; }
    bool isFilled() const { return core > hull.radius * MappedShapes::kInner; }
    // As large as rays see it, from anywhere, but for a factor that all have.
    double area() const {
        return static_cast<double>(hull.radius) *
               static_cast<double>(isTube() ? hull.halfLength : hull.radius);
    }
    // The share of that where they may pass by.
    double air() const {
        if (!(hull.radius > 0)) return 1;
        const double share = static_cast<double>(core) / static_cast<double>(hull.radius);
        return 1 - (isTube() ? share : share * share);
    }
};

float coreOf(const SolidTree::Solid& solid, const ShapeSet& shapes) {
    if (solid.innerRadius > 0 || solid.kind != SolidTree::Kind::Tube) return solid.innerRadius;
    const double core = shapes.shapes[solid.number]->solidForm().hull.coreRadius;
    // As for the inner radius of a solid.
    return core > 0x1p-100 && core < 0x1p100 ? static_cast<float>(core * (1 - 0x1p-20)) : 0;
}

Mapped mapped(const SolidTree::Solid& solid, const ShapeSet& shapes) {
    Mapped out{solid.number,
               isConvex(solid, shapes),
               {solid.centre, solid.radius, {}, 0},
               solid.innerRadius};
    if (!solid.isTube) return out;
    if (!(solid.halfLength > 0)) {
        out.core = 0; // as a ball
    } else {
        out.hull.axis = solid.axis, out.hull.halfLength = solid.halfLength;
        out.core = coreOf(solid, shapes);
    }
    return out;
}

// Rays that come near to a solid and may pass by have to be asked in spite of the map: with more
// air than this it takes as long as it saves.
constexpr double kMostAir = 0.5;
bool paysOff(const std::vector<Mapped>& all) {
    double area = 0, air = 0;
    for (const Mapped& m : all) area += m.area(), air += m.area() * m.air();
    return air < kMostAir * area;
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
        !std::all_of(shapes.distant.begin(), shapes.distant.end(), addOther) ||
        !std::all_of(shapes.batched.begin(), shapes.batched.end(), addOther))
        return {};
    std::vector<Mapped> all;
    all.reserve(solids.size());
    for (const SolidTree::Solid& solid : solids) {
        if (!solid.hides) continue;
        if (solid.moves) return {};
        if (!hasRoundHull(solid) || isFloor(solid, shapes.extent)) {
            if (!addOther(solid.number)) return {};
            continue;
        }
        all.push_back(mapped(solid, shapes));
        out.box.extend(shapes.boxes[solid.number]);
    }
    if (all.size() < kFewestHulls || !paysOff(all)) return {};
    const auto others = std::stable_partition(
        all.begin(), all.end(), [](const Mapped& m) { return m.isFilled() && !m.isTube(); });
    out.firstOther = static_cast<std::uint32_t>(others - all.begin());
    out.hulls.reserve(all.size());
    out.hullOf.assign(shapes.shapes.size(), kNoHull);
    for (const Mapped& m : all) {
        if (m.isConvex) out.hullOf[m.number] = static_cast<std::uint32_t>(out.hulls.size());
        out.hulls.push_back(m.hull);
    }
    if (!std::all_of(others, all.end(), [](const Mapped& m) { return m.isFilled(); })) {
        out.cores.reserve(all.size() - out.firstOther);
        for (auto other = others; other != all.end(); ++other) out.cores.push_back(other->core);
    }
    return out;
}
