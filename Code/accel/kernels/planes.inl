// The steps of canHit(), AnalyticShape::rootsOf() and InfinitePlane::roots() for W rays at a time.
// Included by the file of each instruction set inside its namespace.

namespace {

// W rays from `first` on; lanes behind the last ray repeat it.
struct RaysForPlane {
    Floats org[3], dir[3], tMin;

    RaysForPlane(const RaySpan& rays, std::size_t first) {
        if (first + W <= rays.size()) {
            loadVectors(&rays.org[first].x, org[0], org[1], org[2]);
            loadVectors(&rays.dir[first].x, dir[0], dir[1], dir[2]);
            tMin = Floats::unaligned(&rays.tMin[first]);
            return;
        }
        alignas(64) float o[3][W], d[3][W], near[W];
        for (std::size_t i = 0; i < W; ++i) {
            const std::size_t ray = std::min(first + i, rays.size() - 1);
            for (std::size_t axis = 0; axis < 3; ++axis)
                o[axis][i] = rays.org[ray][axis], d[axis][i] = rays.dir[ray][axis];
            near[i] = rays.tMin[ray];
        }
        for (std::size_t axis = 0; axis < 3; ++axis)
            org[axis] = Floats::load(o[axis]), dir[axis] = Floats::load(d[axis]);
        tMin = Floats::load(near);
    }
    // isTraceable()
    Mask traceable() const {
        const auto largest = [](const Floats(&v)[3]) {
            return max(max(abs(v[0]), abs(v[1])), abs(v[2]));
        };
        const Floats d = largest(dir), o = largest(org);
        const Floats sum = (dir[0] + dir[1] + dir[2]) + (org[0] + org[1] + org[2]);
        return (d > Floats(1e-30f)) & (d < Floats(1e30f)) & (o < Floats(1e30f)) &
               (sum - sum == Floats(0.0f));
    }
};

// Where the lines of the rays meet the plane, not NaN in the lanes of `met`.
struct Crossings {
    Doubles exact;
    Floats t;
    unsigned met;

    Crossings(const StillPlane& plane, const RaysForPlane& rays) : exact(0.0), t(0.0f) {
        const Doubles3 o = Doubles3::of(rays.org[0], rays.org[1], rays.org[2]);
        const Doubles3 d = Doubles3::of(rays.dir[0], rays.dir[1], rays.dir[2]);
        const auto row = [&](std::size_t first, const Doubles3& v) {
            const double* const m = &plane.objectFromWorld[first];
            return Doubles(m[0]) * v.x + Doubles(m[1]) * v.y + Doubles(m[2]) * v.z;
        };
        const auto placed = [&](std::size_t first) {
            return row(first, o) + Doubles(plane.objectFromWorld[first + 3]);
        };
        const Doubles3 org{placed(0), placed(4), placed(8)}, dir{row(0, d), row(4, d), row(8, d)};
        const Doubles zero(0.0), endless(kInfinity);
        const Doubles dd = dot(dir, dir);
        met = less(zero, dd) & less(dd, endless) & less(dot(org, org), endless) &
              less(zero, abs(dir.z)) & bits(rays.traceable());
        exact = (Doubles(-0.0) - org.z) / dir.z;
        t = exact.toFloats();
    }
};

// Of lanes from `first` on, those that there are rays for.
inline unsigned lanesIn(std::size_t first, std::size_t rays) {
    return rays - first >= W ? (1u << W) - 1 : (1u << (rays - first)) - 1;
}

} // namespace

std::size_t closestOfPlane(const StillPlane& plane, const RaySpan& rays, std::span<const Hit> best,
                           PlaneHit* found) {
    std::size_t count = 0;
    alignas(64) float limit[W], t[W], lost[W];
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const RaysForPlane block(rays, first);
        const Crossings at(plane, block);
        unsigned met = at.met & bits(at.t > block.tMin) & lanesIn(first, rays.size());
        if (met == 0) continue;
        for (std::size_t i = 0; i < W; ++i) limit[i] = best[std::min(first + i, rays.size() - 1)].t;
        met &= bits((at.t <= Floats::load(limit)) & (at.t < Floats(kInfinityF)));
        at.t.store(t);
        (at.exact - Doubles(at.t)).toFloats().store(lost);
        for (; met != 0; met &= met - 1) {
            const auto i = static_cast<std::size_t>(std::countr_zero(met));
            found[count++] = {static_cast<std::uint32_t>(first + i), t[i], lost[i]};
        }
    }
    return count;
}

void anyOfPlane(const StillPlane& plane, const RaySpan& rays, std::uint8_t* hidden) {
    alignas(64) float limit[W];
    for (std::size_t first = 0; first < rays.size(); first += W) {
        const RaysForPlane block(rays, first);
        const Crossings at(plane, block);
        unsigned met = at.met & bits(at.t > block.tMin) & lanesIn(first, rays.size());
        if (met == 0) continue;
        for (std::size_t i = 0; i < W; ++i)
            limit[i] = rays.tMax[std::min(first + i, rays.size() - 1)];
        met &= bits(at.t < Floats::load(limit));
        for (; met != 0; met &= met - 1)
            hidden[first + static_cast<std::size_t>(std::countr_zero(met))] = 1;
    }
}
