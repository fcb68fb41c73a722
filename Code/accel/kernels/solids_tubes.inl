// Cylinders: where all rays of a packet meet one, with the bits of shape/cylinder.cpp, and which
// side of it they see.
// Included by solids.inl.

class PacketTubes : public PacketFacets {
protected:
    using PacketFacets::PacketFacets, PacketFacets::meet, PacketFacets::seesSide;

    struct TubeRoots {
        Doubles ox, oy, dx, dy, dz; // the rays in object space
        Floats t[2], lost[2];       // ascending; lost: by rounding, as in Hit::u
        unsigned met[2];            // lanes
        unsigned end[2];            // lanes that meet an end there, not the wall
        unsigned ahead;             // lanes along the axis
        unsigned undecided;         // lanes without a direction across or along the axis
    };

    // AnalyticShape::rootsOf() and Cylinder::roots(), operation by operation.
    TubeRoots meet(const StillTube& tube) const {
        const auto& m = tube.objectFromWorld;
        const Doubles X(columns_.org[0]), Y(columns_.org[1]), Z(columns_.org[2]),
            U(columns_.dir[0]), V(columns_.dir[1]), T(columns_.dir[2]);
        const auto direction = [&](std::size_t i) {
            return (Doubles(m[i]) * U + Doubles(m[i + 1]) * V) + Doubles(m[i + 2]) * T;
        };
        const auto point = [&](std::size_t i) {
            return ((Doubles(m[i]) * X + Doubles(m[i + 1]) * Y) + Doubles(m[i + 2]) * Z) +
                   Doubles(m[i + 3]);
        };
        const Doubles ox = point(0), oy = point(4), oz = point(8);
        const Doubles dx = direction(0), dy = direction(4), dz = direction(8);
        const Doubles zero(0.0), one(1.0), most(std::numeric_limits<double>::max());
        const Doubles dd = dx * dx + dy * dy, od = ox * dx + oy * dy;
        const Doubles along = od / dd;
        const Doubles px = ox - dx * along, py = oy - dy * along;
        const Doubles ll = px * px + py * py, rr(tube.radius * tube.radius);
        const Doubles middle = zero - along, half = sqrt((rr - ll) / dd);
        Doubles enter = middle - half, exit = middle + half;

        unsigned lanes = atMost(ll, rr) & atMost(dd + dz * dz, most) &
                         atMost((ox * ox + oy * oy) + oz * oz, most);
        if (!(tube.radius > 0)) lanes = 0;
        TubeRoots out{ox, oy, dx, dy, dz, {}, {}, {lanes, lanes}, {0, 0}, 0, atMost(dd, zero)};
        if (tube.caps) {
            out.ahead = ~atMost(dz, zero);
            out.undecided |= ~out.ahead & atMost(zero, dz);
            const Doubles low = (Doubles(-1.0) - oz) / dz, high = (one - oz) / dz;
            const Doubles in = min(low, high), beyond = max(low, high);
            out.end[0] = atMost(enter, in), out.end[1] = atMost(beyond, exit);
            enter = max(enter, in), exit = min(exit, beyond);
            out.met[0] &= atMost(enter, exit), out.met[1] = out.met[0];
        } else {
            const auto isWithin = [&](const Doubles& t) {
                const Doubles z = oz + dz * t;
                return atMost(z, one) & atMost(Doubles(-1.0), z);
            };
            out.met[0] &= isWithin(enter), out.met[1] &= isWithin(exit);
        }
        out.t[0] = enter.toFloats(), out.t[1] = exit.toFloats();
        out.lost[0] = (enter - Doubles(out.t[0])).toFloats();
        out.lost[1] = (exit - Doubles(out.t[1])).toFloats();
        return out;
    }

    // Lanes that see the wanted side for certain, of what they meet at (t, lost), which is their
    // first root or the other one: AnalyticShape::seesFront() with twice its threshold. Maps take
    // normals one way and directions the other, so that their product is the same in both spaces.
    unsigned seesSide(const SolidTree::Tube& tube, const TubeRoots& roots, unsigned ends,
                      unsigned first, Floats t, Floats lost) const {
        const Doubles zero(0.0), at = Doubles(t) + Doubles(lost);
        const Doubles x = roots.ox + roots.dx * at, y = roots.oy + roots.dy * at;
        const Doubles X(columns_.dir[0]), Y(columns_.dir[1]), Z(columns_.dir[2]);
        const Doubles least = Doubles(0x1p-19) * ((X * X + Y * Y) + Z * Z);
        const Doubles facing = x * roots.dx + y * roots.dy;
        const unsigned wall =
            ~atMost(facing * facing, least * (Doubles(tube.wallStretch) * (x * x + y * y)));
        const unsigned end = ~atMost(roots.dz * roots.dz, least * Doubles(tube.endStretch));
        const bool isFront = tube.exact.side == ::Facets::Side::Front;
        return (ends & end & (isFront ? first : ~first)) |
               (~ends & wall & ~(isFront ? atMost(zero, facing) : atMost(facing, zero)));
    }
};
