// The surfaces of W hits on spheres, as AnalyticShape::surfaceUnder() and Sphere::describe() have
// them: the same operations in the same order. Included by the file of each instruction set inside
// its namespace.

namespace {

// The numbers of a sphere that all lanes are on, or of one for each lane.
struct NumbersOfOne {
    explicit NumbersOfOne(const SphereToShade& sphere) : of(sphere.numbers) {}
    Doubles operator()(std::size_t number) const { return Doubles(of[number]); }
    const std::array<double, SphereToShade::kNumbers>& of;
};
struct NumbersOfMany {
    // Lanes behind the last sphere repeat it.
    explicit NumbersOfMany(std::span<const SphereToShade* const> spheres) {
        for (std::size_t i = 0; i < W; ++i) {
            const auto& from = spheres[i < spheres.size() ? i : spheres.size() - 1]->numbers;
            for (std::size_t k = 0; k < from.size(); ++k) of[k][i] = from[k];
        }
    }
    Doubles operator()(std::size_t number) const { return Doubles::load(of[number]); }
    alignas(64) double of[SphereToShade::kNumbers][W];
};

// Rows i, i + step .. of a map's linear part.
template <class Numbers>
Doubles row(const Numbers& m, std::size_t i, std::size_t step, const Doubles3& v) {
    return (m(i) * v.x + m(i + step) * v.y) + m(i + 2 * step) * v.z;
}
template <class Numbers>
Doubles3 vectorOf(const Numbers& m, SphereToShade::Number map, const Doubles3& v) {
    return {row(m, map, 1, v), row(m, map + 4, 1, v), row(m, map + 8, 1, v)};
}
template <class Numbers>
Doubles3 pointOf(const Numbers& m, SphereToShade::Number map, const Doubles3& p) {
    const Doubles3 v = vectorOf(m, map, p);
    return {v.x + m(map + 3), v.y + m(map + 7), v.z + m(map + 11)};
}

struct RaysInLanes {
    Doubles3 org, dir;
    Doubles t;
};

inline Doubles3 along(const Doubles3& from, const Doubles3& dir, const Doubles& t) {
    return {from.x + dir.x * t, from.y + dir.y * t, from.z + dir.z * t};
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
        return {Doubles3::of(o[0], o[1], o[2]), Doubles3::of(d[0], d[1], d[2]), exact};
    }
    alignas(64) float org[3][W], dir[3][W];
    for (std::size_t i = 0; i < W; ++i) {
        const Vec3 from = rays.org[ray[i]], to = rays.dir[ray[i]];
        org[0][i] = from.x, org[1][i] = from.y, org[2][i] = from.z;
        dir[0][i] = to.x, dir[1][i] = to.y, dir[2][i] = to.z;
    }
    const auto load = [](const float(&v)[3][W]) {
        return Doubles3::of(Floats::load(v[0]), Floats::load(v[1]), Floats::load(v[2]));
    };
    return {load(org), load(dir), exact};
}

struct SurfacesInLanes {
    alignas(64) float p[3][W], n[3][W];
    alignas(64) double error[W];
};

// Rounded, by axis.
inline void store(const Doubles3& v, float (&to)[3][W]) {
    v.x.toFloats().store(to[0]), v.y.toFloats().store(to[1]), v.z.toFloats().store(to[2]);
}

template <class Numbers>
void describe(const Numbers& sphere, const RaysInLanes& world, SurfacesInLanes& out) {
    constexpr double kThreeUlps = 3 * 0x1p-24;
    using enum SphereToShade::Number;
    const Doubles3 seen = along(world.org, world.dir, world.t);
    const Doubles place = max(max(abs(seen.x), abs(seen.y)), abs(seen.z));
    const Doubles fixedError =
        sphere(LeastError) + sphere(ErrorPerPlace) * (place + sphere(Farthest));

    const Doubles3 met = along(pointOf(sphere, ObjectFromWorld, world.org),
                               vectorOf(sphere, ObjectFromWorld, world.dir), world.t);
    const Doubles distance = sqrt(dot(met, met));
    const Doubles zero(0.0);
    const Doubles3 n = select(zero < distance, met / distance, Doubles3{zero, zero, Doubles(1.0)});
    const Doubles3 local = n * sphere(Radius);
    const Doubles3 rough = pointOf(sphere, WorldFromObject, local);
    const Doubles3 back = pointOf(sphere, ObjectFromWorld, rough);
    const Doubles3 p = rough + vectorOf(sphere, WorldFromObject, local - back);

    const Doubles3 steep{row(sphere, ObjectFromWorld, 4, n), row(sphere, ObjectFromWorld + 1, 4, n),
                         row(sphere, ObjectFromWorld + 2, 4, n)};
    const Doubles3 normal = steep / sqrt(dot(steep, steep));
    const Doubles rounding = (abs(normal.x * p.x) + abs(normal.y * p.y)) + abs(normal.z * p.z);
    store(p, out.p), store(normal, out.n);
    (Doubles(kThreeUlps) * rounding + fixedError).store(out.error);
}

} // namespace

void sphereSurfaces(const SpheresMet& met, Strided<Surface> out) {
    SurfacesInLanes found;
    for (std::size_t first = 0; first < met.which.size(); first += W) {
        const std::size_t count = std::min<std::size_t>(W, met.which.size() - first);
        const RaysInLanes rays = raysOf(met.rays, met.hits, met.which.subspan(first, count));
        const auto spheres = met.spheres.subspan(first, count);
        const auto isFirst = [&](const SphereToShade* other) { return other == spheres[0]; };
        if (std::all_of(spheres.begin() + 1, spheres.end(), isFirst))
            describe(NumbersOfOne(*spheres[0]), rays, found);
        else
            describe(NumbersOfMany(spheres), rays, found);
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 ng{found.n[0][i], found.n[1][i], found.n[2][i]};
            out[met.to[first + i]] = {.p = {found.p[0][i], found.p[1][i], found.p[2][i]},
                                      .ng = ng,
                                      .ns = ng,
                                      .uv = {},
                                      .material = spheres[i]->material,
                                      .object = spheres[i]->object,
                                      .error = floatAbove(found.error[i]),
                                      .rayError = 0,
                                      .lift = {}};
        }
    }
}
