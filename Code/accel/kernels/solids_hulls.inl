// Filters in float, with bounds of their errors: which rays of a packet may meet a solid, and which
// do for certain.
// Included by solids.inl.

class PacketHulls : public PacketRays {
protected:
    using PacketRays::PacketRays;

    // Lines that come near enough to the solid's round hull: a ball, or a tube without ends. With u
    // the unit of rounding and s the largest coordinate, the way to the centre is off by 4 u s, the
    // foot of the perpendicular by some 16 u s more, and `slack` is 64 u s.
    // certain: rays that enter a ball within a sphere, and so the sphere, inside of their range.
    template <Answer A>
    unsigned nearCentre(const SolidTree::Solid& solid, unsigned& certain) const {
        const Floats x = Floats(solid.centre.x) - columns_.org[0],
                     y = Floats(solid.centre.y) - columns_.org[1],
                     z = Floats(solid.centre.z) - columns_.org[2];
        const Floats foot =
            fma(x, columns_.dir[0], fma(y, columns_.dir[1], z * columns_.dir[2])) * perLength2_;
        const Floats px = fnma(foot, columns_.dir[0], x), py = fnma(foot, columns_.dir[1], y),
                     pz = fnma(foot, columns_.dir[2], z);
        const Floats distance2 = fma(px, px, fma(py, py, pz * pz));
        const Floats reach = Floats(solid.radius) + slack_;
        if constexpr (A == Answer::Any) {
            const Floats inner = max(Floats(solid.innerRadius) - slack_, Floats(0.0f));
            certain =
                bits((distance2 < inner * inner) & (foot - reach * perLength_ > columns_.tMin) &
                     (foot + slack_ * perLength_ < best_));
        }
        return bits(notGreater(distance2, reach * reach));
    }
    // n = d x axis: the distance of the lines is |w n| / |n|, and w n is off by 41 u s |d|. The ray
    // is in the endless tube from `middle` - `half` to `middle` + `half`. n is off by 7 u |d|, with
    // FMA or without, so n n, for rays at 1/16 to the axis at least, by 227 u of it, and both by
    // 16.5 slack |d| / n n together. Rays along the axis are asked whatever its ends are.
    // certain: rays that meet the side of a round tube at 30 degrees to its axis at least and not
    // flat, which keeps these errors below 20 times the slack, by 64 within their range and the
    // tube's length.
    template <Answer A>
    unsigned nearAxis(const SolidTree::Solid& solid, unsigned lanes, unsigned& certain) const {
        const Floats x = Floats(solid.centre.x) - columns_.org[0],
                     y = Floats(solid.centre.y) - columns_.org[1],
                     z = Floats(solid.centre.z) - columns_.org[2];
        const Floats ax(solid.axis.x), ay(solid.axis.y), az(solid.axis.z);
        const Floats nx = fms(columns_.dir[1], az, columns_.dir[2] * ay),
                     ny = fms(columns_.dir[2], ax, columns_.dir[0] * az),
                     nz = fms(columns_.dir[0], ay, columns_.dir[1] * ax);
        const Floats across = fma(x, nx, fma(y, ny, z * nz));
        const Floats n2 = fma(nx, nx, fma(ny, ny, nz * nz));
        const Floats n = sqrt(n2), slack = slack_ * length_;
        const Floats reach = fma(Floats(solid.radius), n, slack);
        lanes &= bits(notGreater(abs(across), reach));
        if (lanes == 0) return 0;

        const Floats zero(0.0f), perN2 = Floats(1.0f) / n2;
        const Floats da = fma(columns_.dir[0], ax, fma(columns_.dir[1], ay, columns_.dir[2] * az));
        const Floats xa = fma(x, ax, fma(y, ay, z * az));
        const Floats xd = fma(x, columns_.dir[0], fma(y, columns_.dir[1], z * columns_.dir[2]));
        const Floats middle = fnma(xa, da, xd) * perN2, height = fms(middle, da, xa);
        const auto halfIn = [&](Floats r) { return sqrt(max(fnma(across, across, r * r), zero)); };
        const Floats half = fma(Floats(24.0f), slack, halfIn(reach)) * perN2;
        const Floats up = abs(da);
        lanes &= bits(n < Floats(0.0625f) * length_) |
                 (bits(notGreater(fnma(half, up, abs(height)), Floats(solid.halfLength) + slack_)) &
                  bits(notGreater(columns_.tMin, middle + half)) &
                  bits(notGreater(middle - half, best_)));
        if constexpr (A == Answer::Any) {
            if (lanes == 0 || !(solid.innerRadius > 0)) return lanes;
            const Floats inner = Floats(solid.innerRadius) * n, margin = Floats(64.0f) * slack_;
            const Floats inside = halfIn(inner) * perN2, early = margin * perLength_;
            const Floats tallest = Floats(solid.halfLength * (1 - 0x1p-18f)) - margin;
            const auto meets = [&](Floats t) {
                return (t - early > columns_.tMin) & (t + early < best_) &
                       (abs(fms(t, da, xa)) < tallest);
            };
            certain =
                bits((meets(middle - inside) | meets(middle + inside)) &
                     (abs(across) + slack < Floats(0.9f) * inner) & (n > Floats(0.5f) * length_));
        }
        return lanes;
    }
};
