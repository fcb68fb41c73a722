// The surfaces of W hits, as AnalyticShape::surfaceUnder() and the describe() of the shapes have
// them: the same operations in the same order. Included by the file of each instruction set inside
// its namespace.

namespace {

// Places of a shape's numbers.
enum Number : std::size_t {
    WorldFromObject = 0,  // Transform::rows()
    ObjectFromWorld = 12, // the same
    Radius = 24,
    LeastError,
    ErrorPerPlace,
    kNumbers
};

// put(place, number) for all of a shape.
template <class PutFn> void forEachNumber(const StillShape& shape, PutFn&& put) {
    const AffineRows& there = shape.worldFromObject.rows();
    const AffineRows& back = shape.objectFromWorld();
    for (std::size_t k = 0; k < 12; ++k) put(WorldFromObject + k, there[k]);
    for (std::size_t k = 0; k < 12; ++k) put(ObjectFromWorld + k, back[k]);
    put(Radius, shape.radius);
    put(LeastError, shape.leastError);
    put(ErrorPerPlace, shape.errorPerPlace);
}

// The numbers of a shape that all lanes are on, or of one for each lane.
struct NumbersOfOne {
    explicit NumbersOfOne(const StillShape& shape) {
        forEachNumber(shape, [&](std::size_t place, double number) { of[place] = number; });
    }
    Doubles operator()(std::size_t number) const { return Doubles(of[number]); }
    double of[kNumbers];
};
struct NumbersOfMany {
    // Lanes behind the last shape repeat it.
    explicit NumbersOfMany(std::span<const StillShape* const> shapes) {
        for (std::size_t i = 0; i < W; ++i)
            forEachNumber(*shapes[i < shapes.size() ? i : shapes.size() - 1],
                          [&](std::size_t place, double number) { of[place][i] = number; });
    }
    Doubles operator()(std::size_t number) const { return Doubles::load(of[number]); }
    alignas(64) double of[kNumbers][W];
};

// Rows i, i + step .. of a map's linear part.
template <class Numbers>
Doubles row(const Numbers& m, std::size_t i, std::size_t step, const Doubles3& v) {
    return (m(i) * v.x + m(i + step) * v.y) + m(i + 2 * step) * v.z;
}
template <class Numbers> Doubles3 vectorOf(const Numbers& m, Number map, const Doubles3& v) {
    return {row(m, map, 1, v), row(m, map + 4, 1, v), row(m, map + 8, 1, v)};
}
template <class Numbers> Doubles3 pointOf(const Numbers& m, Number map, const Doubles3& p) {
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
    alignas(64) float p[3][W], n[3][W], uv[2][W]; // uv: of planes
    alignas(64) double error[W];
};

// Of the squares that a plane is divided into.
inline bool isOdd(float u, float v) {
    const float squares = std::floor(u) + std::floor(v);
    return std::floor(squares / 2) != squares / 2;
}

// Rounded, by axis.
inline void store(const Doubles3& v, float (&to)[3][W]) {
    v.x.toFloats().store(to[0]), v.y.toFloats().store(to[1]), v.z.toFloats().store(to[2]);
}

// Points of the surface in object space.
struct Local {
    Doubles3 p, normal;
};

template <class Numbers> Local onSphere(const Numbers& shape, const Doubles3& met) {
    const Doubles distance = sqrt(dot(met, met)), zero(0.0);
    const Doubles3 n = select(zero < distance, met / distance, Doubles3{zero, zero, Doubles(1.0)});
    return {n * shape(Radius), n};
}

// `clearance`: how far, in the world, the origin of a ray may be from the point.
template <class Numbers>
Local onCylinder(const Numbers& shape, const Doubles3& met, const Doubles& clearance) {
    const Doubles around = sqrt(met.x * met.x + met.y * met.y), zero(0.0), one(1.0), half(0.5);
    const Mask isOff = zero < around;
    const Doubles c = select(isOff, met.x / around, one), s = select(isOff, met.y / around, zero);
    // How much z changes over a unit of the world.
    const Doubles3 steep{shape(ObjectFromWorld + 8), shape(ObjectFromWorld + 9),
                         shape(ObjectFromWorld + 10)};
    const Doubles inset = clearance * sqrt(dot(steep, steep));
    const Doubles limit = one - select(inset < half, inset, half);
    const Doubles z = max(met.z, zero - limit);
    const Doubles radius = shape(Radius);
    return {{c * radius, s * radius, select(z < limit, z, limit)}, {c, s, zero}};
}

template <StillShape::Round kRound, class Numbers>
void describe(const Numbers& shape, const RaysInLanes& world, SurfacesInLanes& out) {
    constexpr double kThreeUlps = 3 * 0x1p-24;
    const Doubles3 seen = along(world.org, world.dir, world.t);
    const auto largest = [](const Doubles3& v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); };
    const Doubles3 centre{shape(WorldFromObject + 3), shape(WorldFromObject + 7),
                          shape(WorldFromObject + 11)};
    Doubles leastError = shape(LeastError);
    if constexpr (kRound == StillShape::Round::Plane)
        leastError = leastError * max(largest(seen), Doubles(1.0));
    const Doubles fixedError =
        leastError + shape(ErrorPerPlace) * (largest(seen) + largest(centre));

    const Doubles3 met = along(pointOf(shape, ObjectFromWorld, world.org),
                               vectorOf(shape, ObjectFromWorld, world.dir), world.t);
    const auto local = [&] {
        if constexpr (kRound == StillShape::Round::Sphere) {
            return onSphere(shape, met);
        } else if constexpr (kRound == StillShape::Round::Cylinder) {
            const Doubles far = Doubles(kThreeUlps) * sqrt(dot(seen, seen)) + fixedError;
            return onCylinder(shape, met, Doubles(2.0) * far);
        } else {
            const Doubles zero(0.0);
            met.x.toFloats().store(out.uv[0]), met.y.toFloats().store(out.uv[1]);
            return Local{{met.x, met.y, zero}, {zero, zero, Doubles(1.0)}};
        }
    }();
    const Doubles3 rough = pointOf(shape, WorldFromObject, local.p);
    const Doubles3 back = pointOf(shape, ObjectFromWorld, rough);
    const Doubles3 p = rough + vectorOf(shape, WorldFromObject, local.p - back);

    const Doubles3& n = local.normal;
    const Doubles3 steep{row(shape, ObjectFromWorld, 4, n), row(shape, ObjectFromWorld + 1, 4, n),
                         row(shape, ObjectFromWorld + 2, 4, n)};
    const Doubles3 normal = steep / sqrt(dot(steep, steep));
    const Doubles rounding = (abs(normal.x * p.x) + abs(normal.y * p.y)) + abs(normal.z * p.z);
    store(p, out.p), store(normal, out.n);
    (Doubles(kThreeUlps) * rounding + fixedError).store(out.error);
}

template <StillShape::Round kRound>
void surfacesOf(const RoundsMet& met, const SurfacePlaces& out) {
    SurfacesInLanes found;
    for (std::size_t first = 0; first < met.which.size(); first += W) {
        const std::size_t count = std::min<std::size_t>(W, met.which.size() - first);
        const RaysInLanes rays = raysOf(met.rays, met.hits, met.which.subspan(first, count));
        const auto shapes = met.shapes.subspan(first, count);
        const auto isFirst = [&](const StillShape* other) { return other == shapes[0]; };
        if (std::all_of(shapes.begin() + 1, shapes.end(), isFirst))
            describe<kRound>(NumbersOfOne(*shapes[0]), rays, found);
        else
            describe<kRound>(NumbersOfMany(shapes), rays, found);
        for (std::size_t i = 0; i < count; ++i) {
            std::uint32_t material = shapes[i]->material;
            if constexpr (kRound == StillShape::Round::Plane)
                if (shapes[i]->oddMaterial != material && isOdd(found.uv[0][i], found.uv[1][i]))
                    material = shapes[i]->oddMaterial;
            const SurfacePlaces::Place to = out[met.to[first + i]];
            to.block.putFlat(to.lane, {found.p[0][i], found.p[1][i], found.p[2][i]},
                             {found.n[0][i], found.n[1][i], found.n[2][i]},
                             floatAbove(found.error[i]), material, shapes[i]->object);
        }
    }
}

} // namespace

void roundSurfaces(const RoundsMet& met, SurfacePlaces out) {
    if (met.shapes.empty()) return;
    using enum StillShape::Round;
    if (met.shapes[0]->round == Sphere) return surfacesOf<Sphere>(met, out);
    if (met.shapes[0]->round == Plane) return surfacesOf<Plane>(met, out);
    surfacesOf<Cylinder>(met, out);
}
