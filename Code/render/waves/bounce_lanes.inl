// The formulas of material/fresnel.h, and those of bounces() for what is sharp, in their order.
// Where those return early, lanes go on with numbers that nobody takes. Included by the file of
// each instruction set inside its namespace, after vectors3.inl.

namespace {

inline Floats3 operator-(const Floats3& a, const Floats3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Floats3 operator*(const Floats3& a, const Floats3& b) {
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}
inline Floats3 operator*(const Floats3& a, Floats s) { return {a.x * s, a.y * s, a.z * s}; }
inline Floats3 normalize(const Floats3& a) {
    const Floats length = sqrt(dot(a, a));
    return {a.x / length, a.y / length, a.z / length};
}
inline Mask isBlack(const Floats3& a) {
    const Floats zero(0.0f);
    return (a.x == zero) & (a.y == zero) & (a.z == zero);
}

using Rows = float (&)[3][BounceBlock::kPoints];
inline Floats3 load(Rows rows, std::size_t first) {
    return {Floats::load(rows[0] + first), Floats::load(rows[1] + first),
            Floats::load(rows[2] + first)};
}
inline void store(const Floats3& v, Rows rows, std::size_t first) {
    v.x.store(rows[0] + first), v.y.store(rows[1] + first), v.z.store(rows[2] + first);
}

inline Floats cos2Refracted(Floats cosIn, Floats eta) {
    const Floats one(1.0f), through = eta * cosIn;
    return (one - eta) * (one + eta) + through * through;
}

inline Floats fresnelDielectric(Floats cosIn, Floats eta) {
    const Floats zero(0.0f), one(1.0f), c = min(max(cosIn, zero), one);
    const Floats cos2Out = cos2Refracted(c, eta), cosOut = sqrt(cos2Out);
    const Floats parallel = (c - eta * cosOut) / (c + eta * cosOut);
    const Floats perpendicular = (eta * c - cosOut) / (eta * c + cosOut);
    const Floats part = Floats(0.5f) * (parallel * parallel + perpendicular * perpendicular);
    return select(cos2Out > zero, part, one);
}

inline void bounce(BounceBlock& block, std::size_t first) {
    const unsigned lanes = block.used >> first & ((1u << W) - 1);
    if (lanes == 0) return;
    const Floats zero(0.0f), one(1.0f), eta = Floats::load(block.eta + first);
    const Floats3 n = load(block.n, first), ng = load(block.ng, first),
                  toEye = load(block.toEye, first), mirror = load(block.mirror, first),
                  transmission = load(block.transmission, first);
    const Mask isGlass = maskOf(block.glass >> first & lanes);
    const Floats cosIn = dot(n, toEye), f = fresnelDielectric(cosIn, eta);

    const Floats cos2Out = cos2Refracted(cosIn, eta), cosOut = sqrt(cos2Out);
    const Floats3 through = normalize(n * (eta * cosIn - cosOut) - toEye * eta);
    const unsigned transmits = bits(isGlass) & ~bits(isBlack(transmission));
    const unsigned passes = transmits & bits(cos2Out > zero),
                   refracts = passes & bits(dot(through, ng) < zero);
    store(through, block.refractedDir, first);
    const Floats3 weight = load(block.weight, first);
    const auto isWorthTracing = [&](const Floats3& all) {
        const Floats most = max(max(all.x, all.y), all.z);
        return bits((most > zero) & (most >= Floats(block.cutoff)));
    };
    const Floats3 on = weight * (transmission * (one - f));
    store(on, block.refracted, first);

    const Floats3 all = select(isBlack(mirror), transmission, mirror); // under total reflection
    Floats3 reflected = select(isGlass, mirror * f, mirror);
    reflected = select(maskOf(transmits & ~passes), all, reflected);
    const Floats3 back = normalize(n * (Floats(2.0f) * cosIn) - toEye);
    const unsigned reflects = lanes & ~bits(isBlack(reflected));
    const Floats3 returned = weight * reflected;
    store(back, block.reflectedDir, first), store(returned, block.reflected, first);

    block.reflects |= (reflects & isWorthTracing(returned)) << first;
    block.refracts |= (refracts & isWorthTracing(on)) << first;
    block.bent |= ((passes & ~refracts) | (reflects & ~bits(dot(back, ng) > zero))) << first;
}

} // namespace

void bouncesInLanes(BounceBlock& block) {
    block.reflects = block.refracts = block.bent = 0;
    for (std::size_t first = 0; first < BounceBlock::kPoints; first += W) bounce(block, first);
}
