// The surface of a sphere at W hits, as AnalyticShape::surfaceUnder() and Sphere::describe() have
// it: the same operations in the same order. Included by the file of each instruction set inside
// its namespace.

namespace {

struct Doubles3 {
    Doubles x, y, z;
};

inline Doubles dot(const Doubles3& a, const Doubles3& b) {
    return (a.x * b.x + a.y * b.y) + a.z * b.z;
}
inline Doubles3 along(const Doubles3& from, const Doubles3& dir, const Doubles& t) {
    return {from.x + dir.x * t, from.y + dir.y * t, from.z + dir.z * t};
}
// Rows i, i + step .. of a map's linear part.
inline Doubles row(const std::array<double, 12>& m, std::size_t i, std::size_t step,
                   const Doubles3& v) {
    return (Doubles(m[i]) * v.x + Doubles(m[i + step]) * v.y) + Doubles(m[i + 2 * step]) * v.z;
}
inline Doubles3 vectorOf(const std::array<double, 12>& m, const Doubles3& v) {
    return {row(m, 0, 1, v), row(m, 4, 1, v), row(m, 8, 1, v)};
}
inline Doubles3 pointOf(const std::array<double, 12>& m, const Doubles3& p) {
    const Doubles3 v = vectorOf(m, p);
    return {v.x + Doubles(m[3]), v.y + Doubles(m[7]), v.z + Doubles(m[11])};
}

struct RaysInLanes {
    Doubles3 org, dir;
    Doubles t;
};

inline Doubles3 inDouble(const Floats& x, const Floats& y, const Floats& z) {
    return {Doubles(x), Doubles(y), Doubles(z)};
}

// Lanes behind the last of `which` repeat it.
inline RaysInLanes raysOf(const RaySpan& rays, std::span<const Hit> hits,
                          std::span<const std::uint32_t> which) {
    std::uint32_t ray[W];
    for (std::size_t i = 0; i < W; ++i) ray[i] = which[i < which.size() ? i : which.size() - 1];
    alignas(64) float t[W], lost[W];
    for (std::size_t i = 0; i < W; ++i) t[i] = hits[ray[i]].t, lost[i] = hits[ray[i]].u;
    const Doubles exact = Doubles(Floats::load(t)) + Doubles(Floats::load(lost));
    if (const std::size_t first = ray[0]; which.size() == W && ray[W - 1] == first + (W - 1)) {
        Floats o[3], d[3];
        loadVectors(&rays.org[first].x, o[0], o[1], o[2]);
        loadVectors(&rays.dir[first].x, d[0], d[1], d[2]);
        return {inDouble(o[0], o[1], o[2]), inDouble(d[0], d[1], d[2]), exact};
    }
    alignas(64) float org[3][W], dir[3][W];
    for (std::size_t i = 0; i < W; ++i) {
        const Vec3 from = rays.org[ray[i]], to = rays.dir[ray[i]];
        org[0][i] = from.x, org[1][i] = from.y, org[2][i] = from.z;
        dir[0][i] = to.x, dir[1][i] = to.y, dir[2][i] = to.z;
    }
    const auto load = [](const float(&v)[3][W]) {
        return inDouble(Floats::load(v[0]), Floats::load(v[1]), Floats::load(v[2]));
    };
    return {load(org), load(dir), exact};
}

} // namespace

void sphereSurfaces(const SphereToShade& sphere, const RaySpan& rays, std::span<const Hit> hits,
                    std::span<const std::uint32_t> which, Strided<Surface> out) {
    constexpr double kThreeUlps = 3 * 0x1p-24;
    for (std::size_t first = 0; first < which.size(); first += W) {
        const std::size_t count = std::min<std::size_t>(W, which.size() - first);
        const RaysInLanes world = raysOf(rays, hits, which.subspan(first, count));

        const Doubles3 seen = along(world.org, world.dir, world.t);
        const Doubles place = max(max(abs(seen.x), abs(seen.y)), abs(seen.z));
        const Doubles fixedError =
            Doubles(sphere.leastError) +
            Doubles(sphere.errorPerPlace) * (place + Doubles(sphere.farthest));

        const Doubles3 met = along(pointOf(sphere.objectFromWorld, world.org),
                                   vectorOf(sphere.objectFromWorld, world.dir), world.t);
        const Doubles distance = sqrt(dot(met, met));
        const Doubles3 n{orWhereZero(distance, met.x / distance, 0),
                         orWhereZero(distance, met.y / distance, 0),
                         orWhereZero(distance, met.z / distance, 1)};
        const Doubles radius(sphere.radius);
        const Doubles3 local{n.x * radius, n.y * radius, n.z * radius};
        const Doubles3 rough = pointOf(sphere.worldFromObject, local);
        const Doubles3 back = pointOf(sphere.objectFromWorld, rough);
        const Doubles3 more = vectorOf(sphere.worldFromObject,
                                       {local.x - back.x, local.y - back.y, local.z - back.z});
        const Doubles3 p{rough.x + more.x, rough.y + more.y, rough.z + more.z};

        const Doubles3 steep{row(sphere.objectFromWorld, 0, 4, n),
                             row(sphere.objectFromWorld, 1, 4, n),
                             row(sphere.objectFromWorld, 2, 4, n)};
        const Doubles size = sqrt(dot(steep, steep));
        const Doubles3 normal{steep.x / size, steep.y / size, steep.z / size};
        const Doubles rounding = (abs(normal.x * p.x) + abs(normal.y * p.y)) + abs(normal.z * p.z);
        const Doubles error = Doubles(kThreeUlps) * rounding + fixedError;

        alignas(64) float at[6][W];
        alignas(64) double errors[W];
        p.x.toFloats().store(at[0]), p.y.toFloats().store(at[1]), p.z.toFloats().store(at[2]);
        normal.x.toFloats().store(at[3]), normal.y.toFloats().store(at[4]);
        normal.z.toFloats().store(at[5]);
        error.store(errors);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 ng{at[3][i], at[4][i], at[5][i]};
            out[first + i] = {.p = {at[0][i], at[1][i], at[2][i]},
                              .ng = ng,
                              .ns = ng,
                              .uv = {},
                              .material = sphere.material,
                              .object = sphere.object,
                              .error = floatAbove(errors[i]),
                              .rayError = 0,
                              .lift = {}};
        }
    }
}
