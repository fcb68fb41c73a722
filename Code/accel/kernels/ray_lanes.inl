// RaySetup of accel/ray_setup.h for the boxes of the scene, for W rays at once: the same formulas,
// lane by lane, and the same bits. Included by the file of each instruction set inside its
// namespace.

struct RayLanes {
    Floats r[3], nearOffset[3], farOffset[3], zCut;

    // `limit`: t behind which nothing is wanted. What is not isTraceable(), or has no range, is not
    // in `lanes` afterwards.
    RayLanes(const Floats (&o)[3], const Floats (&d)[3], Floats tMin, Floats limit, float extent,
             unsigned& lanes) {
        const Floats one(1.0f), zero(0.0f);
        const Floats ax = abs(d[0]), ay = abs(d[1]), az = abs(d[2]);
        const Mask alongZ = (az >= ax) & (az >= ay), alongY = ay >= ax;
        const auto pick = [&](Floats x, Floats y, Floats z) {
            return select(alongZ, z, select(alongY, y, x));
        };
        const Floats depth = pick(d[0], d[1], d[2]), dz = abs(depth);
        const Floats sign = select(depth < zero, Floats(-1.0f), one);
        const Floats Sx = pick(d[1], d[2], d[0]) / dz, Sy = pick(d[2], d[0], d[1]) / dz;
        const Floats smallest(RaySetup::kSmallestSlope);
        const Floats rx = one / withSign(max(abs(Sx), smallest), Sx);
        const Floats ry = one / withSign(max(abs(Sy), smallest), Sy);
        const Floats oMax = max(max(abs(o[0]), abs(o[1])), abs(o[2]));
        const Floats e = max(Floats(extent), oMax) * Floats(0x1p-19f);
        const Floats px = e * abs(rx), py = e * abs(ry);
        const auto slab = [&](int axis, Floats inverse, Floats pad) {
            const Floats at = (zero - o[axis]) * inverse, twice = pad + pad;
            r[axis] = inverse;
            nearOffset[axis] = at - twice;
            farOffset[axis] = at + twice;
        };
        slab(0, pick(sign, ry, rx), pick(e, py, px));
        slab(1, pick(rx, sign, ry), pick(px, e, py));
        slab(2, pick(ry, rx, sign), pick(py, px, e));
        const Floats key = one / (limit * dz); // depthCut()
        zCut = select(key > zero, (one / key) * Floats(1.0000005f),
                      Floats(std::numeric_limits<float>::max()));
        const Floats sum = ((d[0] + d[1]) + d[2]) + ((o[0] + o[1]) + o[2]);
        const Floats longest = max(max(ax, ay), az);
        lanes &= bits((longest > Floats(1e-30f)) & (longest < Floats(1e30f)) &
                      (oMax < Floats(1e30f)) & (sum - sum == zero) & (tMin < limit));
    }

    unsigned entering(const Bounds& box) const {
        Floats entry(0.0f), exit = zCut;
        for (int axis = 0; axis < 3; ++axis) {
            const auto a = static_cast<std::size_t>(axis);
            const Mask back = r[axis] < Floats(0.0f);
            const Floats lo(box.lo[a]), hi(box.hi[a]);
            entry = max(select(back, hi, lo) * r[axis] + nearOffset[axis], entry);
            exit = min(select(back, lo, hi) * r[axis] + farOffset[axis], exit);
        }
        return bits(entry <= exit);
    }
};
