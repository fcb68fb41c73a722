// Spheres: where all rays of a packet meet one, or each its own, with the bits of shape/sphere.cpp.
// Included by solids.inl.

class PacketSpheres : public PacketTubes {
protected:
    using PacketTubes::meet, PacketTubes::PacketTubes;

    struct SphereRoots {
        Doubles enter, exit;
        Floats t[2];  // the same in float
        unsigned met; // lanes
    };
    // What is met first.
    struct SphereHits {
        Floats t, lost; // lost: by rounding, as in Hit::u
        unsigned met;
    };

    // Sphere::roots() and insideRound(). A zero of the map adds a zero, which changes no number.
    template <class Map>
    [[gnu::always_inline]] SphereRoots meet(const Map& m, bool turned, const Doubles& radius,
                                            unsigned lanes) const {
        const Doubles X(columns_.org[0]), Y(columns_.org[1]), Z(columns_.org[2]),
            U(columns_.dir[0]), V(columns_.dir[1]), T(columns_.dir[2]);
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
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along, pz = oz - dz * along;
        const Doubles ll = (px * px + py * py) + pz * pz;
        const Doubles rr = radius * radius, zero(0.0);
        lanes &= atMost(ll, rr) & less(zero, radius);
        if (lanes == 0) return {zero, zero, {}, 0};

        const Doubles most(std::numeric_limits<double>::max());
        const Doubles oo = (ox * ox + oy * oy) + oz * oz;
        lanes &= atMost(dd, most) & atMost(oo, most);
        const Doubles middle = zero - along, half = sqrt((rr - ll) / dd);
        const Doubles enter = middle - half, exit = middle + half;
        return {enter, exit, {enter.toFloats(), exit.toFloats()}, lanes};
    }

    unsigned hides(const SphereRoots& roots) const {
        const auto within = [&](Floats t) { return (t > columns_.tMin) & (t < best_); };
        return roots.met & bits(within(roots.t[0]) | within(roots.t[1]));
    }

    SphereHits firstOf(const SphereRoots& roots) const {
        const Mask first = roots.t[0] > columns_.tMin;
        const Floats t = select(first, roots.t[0], roots.t[1]);
        const Doubles lost0 = roots.enter - Doubles(roots.t[0]),
                      lost1 = roots.exit - Doubles(roots.t[1]);
        return {t, select(first, lost0.toFloats(), lost1.toFloats()),
                roots.met & bits((t > columns_.tMin) & (t <= best_) & (t < Floats(kInfinityF)))};
    }
};
