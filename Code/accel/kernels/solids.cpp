// What kernels are told of solids, the table of the kernels, and the batches that go to them by
// origin.
#include "accel/kernels/solids.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

void SolidTree::reserve(std::size_t count) {
    solids.reserve(count), boxes.reserve(count), tubes.reserve(count);
}

static SolidTree::Tube measured(const StillTube& tube) {
    const AffineRows& m = tube.shape->objectFromWorld();
    const Vec3d x{m[0], m[1], m[2]}, y{m[4], m[5], m[6]}, z{m[8], m[9], m[10]};
    // Gershgorin's circles about the Gram matrix.
    const double xx = dot(x, x), yy = dot(y, y), zz = dot(z, z);
    const double xy = std::fabs(dot(x, y)), yz = std::fabs(dot(y, z)), zx = std::fabs(dot(z, x));
    const double across = max(xx, yy) + xy;
    const double any = max(max(xx + zx, yy + yz) + xy, zz + yz + zx);
    return {tube, tube.cone ? any : across, zz};
}

void SolidTree::add(const Bounds& box, std::uint32_t number, bool hides, const SolidForm& form) {
    solids.push_back(made(number, hides, form));
    boxes.push_back(box);
}

void SolidTree::addEndless(std::uint32_t number, bool hides, const SolidForm& form) {
    endless.push_back(made(number, hides, form));
}

SolidTree::Solid SolidTree::made(std::uint32_t number, bool hides, const SolidForm& form) {
    Solid solid{.number = number, .hides = hides};
    solid.isTube = form.hull.axis != Vec3d{};
    solid.centre = toFloat(form.hull.centre), solid.axis = toFloat(form.hull.axis);
    solid.radius = floatAbove(form.hull.radius * (1 + 0x1p-20));
    solid.halfLength = floatAbove(form.hull.halfLength * (1 + 0x1p-20));
    // Not where the exact formula might over- or underflow.
    const double size = form.sphere ? form.sphere->radius : form.hull.innerRadius;
    if (size > 0x1p-100 && size < 0x1p100)
        solid.innerRadius = static_cast<float>(form.hull.innerRadius * (1 - 0x1p-20));
    if (form.sphere) {
        solid.kind = Kind::Sphere;
        solid.shape = form.sphere;
        solid.side = form.sphereSide;
    }
    if (form.faces) {
        using enum StillFaces::Of;
        solid.kind = form.faces->of == Cube      ? Kind::Cube
                     : form.faces->of == Disk    ? Kind::Disk
                     : form.faces->of == Corners ? Kind::Corners
                                                 : Kind::Endless;
        solid.shape = form.faces->shape;
        solid.side = form.faces->side;
    }
    if (form.tube) {
        solid.kind = Kind::Tube;
        solid.shape = form.tube->shape;
        if (!form.motion) {
            solid.part = static_cast<std::uint32_t>(tubes.size());
            tubes.push_back(measured(*form.tube));
        }
    }
    bool turns = false;
    if (form.motion && solid.kind != Kind::Other) {
        solid.moves = true;
        solid.part = static_cast<std::uint32_t>(movements.size());
        turns = form.motion->turning != nullptr;
        movements.push_back({*form.motion, form.tube ? measured(*form.tube) : Tube{}});
    }
    if (solid.shape != nullptr) {
        const AffineRows& m = solid.shape->objectFromWorld();
        solid.turned =
            turns || m[1] != 0 || m[2] != 0 || m[4] != 0 || m[6] != 0 || m[8] != 0 || m[9] != 0;
    }
    const bool isPlain = !solid.moves && form.sphereSide == ::Facets::Side::Both;
    if (form.sphere && isPlain) solid.meets = Meets::Sphere;
    if (form.tube && !solid.moves && form.tube->side != ::Facets::Side::Back)
        solid.meets = form.tube->cone ? (form.tube->caps ? Meets::CappedCone : Meets::Cone)
                                      : (form.tube->caps ? Meets::CappedTube : Meets::Tube);
    solid.isOpenFront =
        solid.meets == Meets::Tube && form.tube->side == Facets::Side::Front ? 1 : 0;
    if (form.facets) {
        solid.kind = Kind::Facets;
        solid.part = static_cast<std::uint32_t>(facets.size());
        FacetGroup group{.facet = {},
                         .count = static_cast<std::uint32_t>(form.facets->triangles.size()),
                         .extent = form.facets->extent,
                         .side = form.facets->side};
        for (std::size_t i = 0; i < group.count; ++i) {
            const auto& p = form.facets->triangles[i];
            const Vec3d p0 = toDouble(p[0]);
            group.facet[i] = {p, cross(toDouble(p[1]) - p0, toDouble(p[2]) - p0)};
        }
        facets.push_back(group);
    }
    return solid;
}

namespace {

// Sorts the rays of a batch that are still asked for by their origins: the shadow rays of a wave
// come lamp by lamp for every hit, and packets want those of one lamp.
class Origins {
public:
    // unwanted: a byte for each ray, 1 where it is not asked for; empty: all are.
    void sort(const RaySpan& rays, std::span<const std::uint8_t> unwanted) {
        ends_.clear();
        const bool wantsAll =
            unwanted.empty() || std::memchr(unwanted.data(), 1, unwanted.size()) == nullptr;
        const auto keepOrder = [&] {
            order_ = wantsAll ? firstNumbers(rays.size()) : numbersOf(rays.size(), unwanted);
            ends_.assign(1, order_.size());
        };
        if (areFromOnePoint(rays)) return keepOrder();
        list_.clear(), origins_.clear(), groups_.clear();
        std::size_t guess = 0; // lamps take turns
        for (std::uint32_t i = 0; i < rays.size(); ++i) {
            if (!wantsAll && unwanted[i] != 0) continue;
            list_.push_back(i);
            const Vec3 origin = rays.org[i];
            if (guess >= origins_.size() || !(origins_[guess] == origin)) {
                guess = 0;
                while (guess < origins_.size() && !(origins_[guess] == origin)) ++guess;
                // Origins of their own, as after a bounce.
                if (guess == kMostOrigins) return keepOrder();
                if (guess == origins_.size()) origins_.push_back(origin), ends_.push_back(0);
            }
            ++ends_[guess];
            groups_.push_back(static_cast<std::uint8_t>(guess));
            if (++guess == origins_.size()) guess = 0;
        }
        order_ = list_;
        if (ends_.size() < 2) return;
        std::size_t sum = 0;
        for (std::size_t& end : ends_) end = std::exchange(sum, sum + end);
        sorted_.resize(order_.size());
        for (std::size_t k = 0; k < order_.size(); ++k) sorted_[ends_[groups_[k]]++] = order_[k];
        order_ = sorted_;
    }

    template <class CallFn> void forEachGroup(CallFn&& call) const {
        std::size_t begin = 0;
        for (const std::size_t end : ends_) {
            call(order_.subspan(begin, end - begin));
            begin = end;
        }
    }

private:
    // Looks at some: packets of rays from several points are slower and no less right.
    static bool areFromOnePoint(const RaySpan& rays) {
        constexpr std::size_t kAll = 16, kStep = 13;
        for (std::size_t i = 1; i < rays.size(); i += i < kAll ? 1 : kStep)
            if (!(rays.org[i] == rays.org[0])) return false;
        return rays.size() > 0;
    }

    std::span<const std::uint32_t> firstNumbers(std::size_t count) {
        while (all_.size() < count) all_.push_back(static_cast<std::uint32_t>(all_.size()));
        return std::span(all_).first(count);
    }
    std::span<const std::uint32_t> numbersOf(std::size_t rays,
                                             std::span<const std::uint8_t> unwanted) {
        list_.resize(rays);
        std::size_t count = 0;
        for (std::uint32_t i = 0; i < rays; ++i) {
            list_[count] = i;
            count += unwanted[i] == 0;
        }
        return std::span(list_).first(count);
    }

    static constexpr std::size_t kMostOrigins = 16;
    std::span<const std::uint32_t> order_;           // a part of one of these:
    std::vector<std::uint32_t> all_, list_, sorted_; // all_: 0, 1, 2 ...
    std::vector<std::uint8_t> groups_;               // of the rays in list_
    std::vector<std::size_t> ends_;                  // of the groups in order_
    std::vector<Vec3> origins_;
};

} // namespace

void closestSolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
                   const RaySpan& rays, std::span<Hit> hits) {
    thread_local Origins origins;
    origins.sort(rays, {});
    origins.forEachGroup([&](std::span<const std::uint32_t> order) {
        kernel.closest(tree, calls, rays, order, hits.data());
    });
}

void anySolids(const SolidKernel& kernel, const SolidTree& tree, const SolidCalls& calls,
               const RaySpan& rays, std::span<std::uint8_t> hidden) {
    thread_local Origins origins;
    origins.sort(rays, hidden);
    origins.forEachGroup([&](std::span<const std::uint32_t> order) {
        kernel.any(tree, calls, rays, order, hidden.data());
    });
}
