// The formulas of coneFromSquare(), as those of the disk are in disk_lanes.inl.
// Included by soft_lamp_lanes.inl.

// Where the angle 2 pi u is on the unit circle, reckoned to 2^-41 of either number for u of 24
// bits.
// exact::sinCos() gets this angle rounded to a double, and so does who wants the same near zeros.
// Lanes of right angles are added to `unsure`: of their zeros too little is left.
struct OnCircle {
    Doubles x, y;
};
inline OnCircle nearlyOnCircle(Floats u, unsigned& unsure) {
    // A right angle in two parts: four times the first one is exact.
    constexpr double kRight = 0x1.921fb5444p+0, kRest = 0x1.68c234c4c6629p-39;
    const Floats turns = floor(u * Floats(4.0f) + Floats(0.5f));
    const Doubles quarter(turns);
    const Doubles rest = (Doubles(kTwoPi) * Doubles(u) - quarter * Doubles(kRight)) -
                         quarter * Doubles(kRest);
    unsure |= bits(abs(rest.toFloats()) < Floats(0x1p-22f));
    const Doubles q = rest * Doubles(4 / kPi), w = q * q, zero(0.0);
    const Doubles c = cosineOf(w), s = q * sineOf(w);
    const auto is = [&](float turn) { return turns == Floats(turn); };
    const Mask second = is(1), third = is(2), fourth = is(3);
    return {select(second, zero - s, select(third, zero - c, select(fourth, s, c))),
            select(second, c, select(third, zero - s, select(fourth, zero - c, s)))};
}

// x and y of the direction; its z is zOnCone(). Not for cones that are too narrow for floats.
inline void placeOnCone(DiskRow& row, const Doubles& oneMinusCos, unsigned& unsure) {
    const Doubles h = oneMinusCos * Doubles(Floats::load(row.u));
    const Doubles sine = sqrt(max(h * (Doubles(2.0) - h), Doubles(0.0)));
    const OnCircle at = nearlyOnCircle(Floats::load(row.v), unsure);
    surelyRounded(sine * at.x, unsure).store(row.x);
    surelyRounded(sine * at.y, unsure).store(row.y);
}
inline Floats zOnCone(const DiskRow& row, const Doubles& oneMinusCos) {
    return (Doubles(1.0) - oneMinusCos * Doubles(Floats::load(row.u))).toFloats();
}
inline void placeSurelyOnCone(DiskRow& row, const double* oneMinusCos, unsigned lanes) {
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto i = static_cast<std::size_t>(std::countr_zero(lanes));
        const Vec3 way = coneFromSquare({row.u[i], row.v[i]}, oneMinusCos[i]);
        row.x[i] = way.x, row.y[i] = way.y;
    }
}
constexpr double kNarrowestCone = 0x1p-60;
