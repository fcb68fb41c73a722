// Spheres: where all rays of a packet meet one, or each its own, with the bits of shape/sphere.cpp.
// Included by solids.inl.

class PacketSpheres : public PacketTubes {
protected:
    using PacketTubes::firstOf, PacketTubes::hides, PacketTubes::meet, PacketTubes::PacketTubes;

    struct SphereRoots {
        Doubles enter, exit;
        Floats t[2];  // the same in float
        unsigned met; // lanes
    };

    // Sphere::roots() and insideRound(). A zero of the map adds a zero, which changes no number.
    template <class Map>
    [[gnu::always_inline]] static SphereRoots
    meet(const RayColumns& rays, const Map& m, bool turned, const Doubles& radius, unsigned lanes) {
        const Doubles X(rays.org[0]), Y(rays.org[1]), Z(rays.org[2]), U(rays.dir[0]),
            V(rays.dir[1]), T(rays.dir[2]);
        const auto point = [&](std::size_t i, const Doubles& x) {
            if (!turned) return m(i / 4 * 5) * x + m(i + 3);
            return ((m(i) * X + m(i + 1) * Y) + m(i + 2) * Z) + m(i + 3);
        };
        const auto direction = [&](std::size_t i, const Doubles& x) {
            if (!turned) return m(i / 4 * 5) * x;
            return (m(i) * U + m(i + 1) * V) + m(i + 2) * T;
        };
        const Doubles ox = point(0, X), oy = point(4, Y), oz = point(8, Z);
        const Doubles dx = direction(0, U), dy = direction(4, V), dz = direction(8, T);
        const Doubles dd = (dx * dx + dy * dy) + dz * dz, od = (ox * dx + oy * dy) + oz * dz;
        const Doubles oo = (ox * ox + oy * oy) + oz * oz, rr = radius * radius, zero(0.0);
        // Rays that leave it, as mirrored ones do: outside by more than the 2^-48 that oo, ll and
        // along are off by, they have both roots behind them.
        lanes &= ~(less(zero, od) & less(rr * Doubles(1 + 0x1p-30), oo) &
                   bits(rays.tMin >= Floats(0.0f)));
        if (lanes == 0) return {zero, zero, {}, 0};
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along, pz = oz - dz * along;
        const Doubles ll = (px * px + py * py) + pz * pz;
        lanes &= atMost(ll, rr) & less(zero, radius);
        if (lanes == 0) return {zero, zero, {}, 0};

        const Doubles most(std::numeric_limits<double>::max());
        lanes &= atMost(dd, most) & atMost(oo, most);
        const Doubles middle = zero - along, half = sqrt((rr - ll) / dd);
        const Doubles enter = middle - half, exit = middle + half;
        return {enter, exit, {enter.toFloats(), exit.toFloats()}, lanes};
    }

    static unsigned hides(const SphereRoots& roots, const RayRanges& ranges) {
        return roots.met & (ranges.hides(roots.t[0]) | ranges.hides(roots.t[1]));
    }

    static FoundLanes firstOf(const SphereRoots& roots, const RayRanges& ranges) {
        const Mask first = roots.t[0] > ranges.tMin;
        const Floats t = select(first, roots.t[0], roots.t[1]);
        const Doubles lost0 = roots.enter - Doubles(roots.t[0]),
                      lost1 = roots.exit - Doubles(roots.t[1]);
        return {.t = t,
                .lost = select(first, lost0.toFloats(), lost1.toFloats()),
                .met = roots.met & ranges.hits(t)};
    }

    // Of one that is seen from one side, rays meet where they enter it, or where they leave it:
    // AnalyticShape::seesFront() at both, with twice its threshold.
    template <class Map>
    static FoundLanes firstOf(const SphereRoots& roots, const RayRanges& ranges,
                              ::Facets::Side side, const RayColumns& columns, const Map& map) {
        const ObjectRays rays = objectRays(columns, map, true);
        const Doubles x(columns.dir[0]), y(columns.dir[1]), z(columns.dir[2]), zero(0.0);
        const Doubles least = Doubles(0x1p-19) * ((x * x + y * y) + z * z) * normalStretch(map);
        Floats lost[2] = {Floats(0.0f), Floats(0.0f)};
        unsigned sure = ~0u;
        for (const int end : {0, 1}) {
            const Doubles t(roots.t[end]);
            lost[end] = ((end == 0 ? roots.enter : roots.exit) - t).toFloats();
            const Doubles at = t + Doubles(lost[end]);
            const Doubles px = rays.ox + rays.dx * at, py = rays.oy + rays.dy * at,
                          pz = rays.oz + rays.dz * at;
            const Doubles facing = (px * rays.dx + py * rays.dy) + pz * rays.dz;
            sure &= less(least * ((px * px + py * py) + pz * pz), facing * facing) &
                    (end == 0 ? less(facing, zero) : less(zero, facing));
        }
        const int seen = side == ::Facets::Side::Front ? 0 : 1;
        return {.t = roots.t[seen],
                .lost = lost[seen],
                .met = roots.met & ranges.hits(roots.t[seen]),
                .undecided = roots.met & ~sure};
    }
};
