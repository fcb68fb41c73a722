// The surfaces of W hits, as AnalyticShape::surfaceOf() and the describe() of the shapes have
// them: the same operations in the same order. Included by the file of each instruction set inside
// its namespace.

namespace {

using Kind = StillShape::Kind;

#include "accel/kernels/still_numbers.inl"

struct RaysInLanes {
    Doubles3 org, dir;
    Doubles t;
};

inline Doubles3 along(const Doubles3& from, const Doubles3& dir, const Doubles& t) {
    return {from.x + dir.x * t, from.y + dir.y * t, from.z + dir.z * t};
}

// The rays of W lanes; those behind the last of `which` repeat it.
class RaysOfLanes {
public:
    explicit RaysOfLanes(std::span<const std::uint32_t> which) {
        const std::size_t count = which.size();
        if (count == W) {
            std::memcpy(ray_, which.data(), sizeof ray_);
            return;
        }
        std::copy_n(which.data(), count, ray_);
        std::fill(ray_ + count, ray_ + W, which.back());
    }
    std::uint32_t operator[](std::size_t lane) const { return ray_[lane]; }

private:
    std::uint32_t ray_[W];
};

// The rays of W hits. They are read one register ahead: what was stored number by number can't be
// loaded all at once before it has reached the cache.
class RayColumns {
public:
    // Rays that ascend, of which so many differ.
    void read(const RaySpan& rays, std::span<const Hit> hits, const RaysOfLanes& ray,
              std::size_t count) {
        static_assert(offsetof(Hit, u) == offsetof(Hit, t) + sizeof(float));
        Floats t, lost;
        loadPairs([&](std::size_t i) { return &hits[ray[i]].t; }, t, lost);
        t.store(t_), lost.store(lost_);
        const std::size_t first = ray[0];
        if (count == W && ray[W - 1] == first + (W - 1)) {
            readRow(&rays.org[first].x, org_), readRow(&rays.dir[first].x, dir_);
            return;
        }
        for (std::size_t i = 0; i < W; ++i) {
            const Vec3 &from = rays.org[ray[i]], &to = rays.dir[ray[i]]; // g++ 12 copies by memory
            org_[0][i] = from.x, org_[1][i] = from.y, org_[2][i] = from.z;
            dir_[0][i] = to.x, dir_[1][i] = to.y, dir_[2][i] = to.z;
        }
    }
    RaysInLanes lanes() const {
        const auto load = [](const float(&v)[3][W]) {
            return Doubles3::of(Floats::load(v[0]), Floats::load(v[1]), Floats::load(v[2]));
        };
        return {load(org_), load(dir_), Doubles(Floats::load(t_)) + Doubles(Floats::load(lost_))};
    }

private:
    static void readRow(const float* from, float (&to)[3][W]) {
        Floats x, y, z;
        loadVectors(from, x, y, z);
        x.store(to[0]), y.store(to[1]), z.store(to[2]);
    }
    alignas(64) float org_[3][W], dir_[3][W], t_[W], lost_[W];
};

// For each W of so many things, read(first, count, into) one ahead of use(first, count, of).
template <class Columns, class ReadFn, class UseFn>
void readAhead(std::size_t size, const ReadFn& read, const UseFn& use) {
    std::array<Columns, 2> columns;
    const auto countFrom = [&](std::size_t at) { return std::min<std::size_t>(W, size - at); };
    if (size > 0) read(std::size_t{0}, countFrom(0), columns[0]);
    for (std::size_t first = 0; first < size; first += W) {
        const std::size_t next = first + W;
        if (next < size) read(next, countFrom(next), columns[next / W % 2]);
        use(first, countFrom(first), columns[first / W % 2]);
    }
}

struct SurfacesInLanes {
    alignas(64) float p[3][W], n[3][W], error[W];
    alignas(64) std::uint32_t material[W], object[W];
    alignas(64) float uv[2][W];
    unsigned odd = 0; // lanes on an odd square of a plane
    bool hasUv = false;

    // Lane i into place to[i], flat. The blocks know of nothing else.
    void put(std::span<const std::uint32_t> to, const SurfacePlaces& out) const {
        const std::size_t lane = to[0] % SurfaceBlock::kPoints;
        if (to.size() == W && to[W - 1] == to[0] + (W - 1) && lane + W <= SurfaceBlock::kPoints &&
            areInARow(to))
            return putRow(out[to[0]].block, lane);
        for (std::size_t i = 0; i < to.size(); ++i) {
            const auto [block, at] = out[to[i]];
            SurfaceBlock::set(block.p, at, {p[0][i], p[1][i], p[2][i]});
            SurfaceBlock::set(block.ng, at, {n[0][i], n[1][i], n[2][i]});
            block.error[at] = error[i];
            if (hasUv) block.uv[0][at] = uv[0][i], block.uv[1][at] = uv[1][i];
            block.material[at] = material[i], block.object[at] = object[i];
        }
    }

private:
    static bool areInARow(std::span<const std::uint32_t> to) {
        unsigned wrong = 0;
        for (std::uint32_t i = 0; i < W; ++i) wrong |= to[i] ^ (to[0] + i);
        return wrong == 0;
    }
    void putRow(SurfaceBlock& block, std::size_t lane) const {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::copy_n(p[axis], W, block.p[axis] + lane);
            std::copy_n(n[axis], W, block.ng[axis] + lane);
        }
        std::copy_n(error, W, block.error + lane);
        if (hasUv)
            for (std::size_t axis = 0; axis < 2; ++axis)
                std::copy_n(uv[axis], W, block.uv[axis] + lane);
        std::copy_n(material, W, block.material + lane);
        std::copy_n(object, W, block.object + lane);
    }
};

// floatAbove() of what is not negative.
inline Floats roundedUp(const Doubles& x) {
    const Floats nearest = x.toFloats();
    return select(Doubles(nearest) < x, nextFloat(nearest), nearest);
}

// Lanes on the odd ones of the squares that a plane is divided into.
inline unsigned oddSquares(Floats u, Floats v) {
    const Floats half = (floor(u) + floor(v)) * Floats(0.5f);
    return bits(floor(half) == half) ^ ((1u << W) - 1);
}

// Rounded, by axis.
inline void store(const Doubles3& v, float (&to)[3][W]) {
    v.x.toFloats().store(to[0]), v.y.toFloats().store(to[1]), v.z.toFloats().store(to[2]);
}

#include "accel/kernels/still_points.inl"
#include "accel/kernels/still_uv.inl"

// The outward normals of the faces of cubes that are met.
inline Doubles3 facesMet(std::span<const Hit> hits, const RaysOfLanes& ray) {
    alignas(64) double n[3][W] = {};
    for (std::size_t i = 0; i < W; ++i) {
        const std::uint32_t face = hits[ray[i]].prim;
        n[face / 2][i] = face % 2 == 0 ? -1 : 1;
    }
    return {Doubles::load(n[0]), Doubles::load(n[1]), Doubles::load(n[2])};
}

// Of the caps of cylinders and cones that are met: radius, how much the side slopes, and +-1 for
// the end.
inline Doubles3 capsMet(const StillsMet& met, std::size_t first, std::size_t count) {
    alignas(64) double radius[W], slope[W], side[W];
    for (std::size_t i = 0; i < W; ++i) {
        const std::size_t k = first + std::min(i, count - 1);
        const StillShape& shape = *met.shapes[k];
        const bool isTop = met.hits[met.which[k]].prim == StillTube::Top;
        const bool isCone = shape.kind == Kind::Cone;
        radius[i] = !isCone ? shape.radius : isTop ? shape.cone->topRadius : shape.cone->radius;
        slope[i] = isCone ? std::fabs(shape.cone->slope) : 0;
        side[i] = isTop ? 1 : -1;
    }
    return {Doubles::load(radius), Doubles::load(slope), Doubles::load(side)};
}

// face: of cubes; of caps what capsMet() says.
template <Kind kKind, class Numbers>
void describe(const Numbers& shape, const RaysInLanes& world, const Doubles3& face,
              SurfacesInLanes& out) {
    constexpr double kThreeUlps = 3 * 0x1p-24;
    const Doubles3 seen = along(world.org, world.dir, world.t);
    const auto largest = [](const Doubles3& v) { return max(max(abs(v.x), abs(v.y)), abs(v.z)); };
    const Doubles3 centre{shape(WorldFromObject + 3), shape(WorldFromObject + 7),
                          shape(WorldFromObject + 11)};
    Doubles leastError = shape(LeastError);
    if constexpr (kKind == Kind::Plane) leastError = leastError * max(largest(seen), Doubles(1.0));
    const Doubles fixedError =
        leastError + shape(ErrorPerPlace) * (largest(seen) + largest(centre));

    const Doubles3 met = along(pointOf(shape, ObjectFromWorld, world.org),
                               vectorOf(shape, ObjectFromWorld, world.dir), world.t);
    const auto local = [&] {
        const auto clearance = [&] {
            return Doubles(2.0) * (Doubles(kThreeUlps) * sqrt(dot(seen, seen)) + fixedError);
        };
        if constexpr (kKind == Kind::Sphere) return onSphere(shape, met);
        if constexpr (kKind == Kind::Cylinder) return onCylinder(shape, met, clearance());
        if constexpr (kKind == Kind::Cone) return onCone(shape, met, clearance());
        if constexpr (kKind == Kind::Cube) return onCube(shape, met, face, clearance());
        if constexpr (kKind == Kind::Corners) return onCorners(shape, met);
        if constexpr (kKind == Kind::Cap) return onCap(shape, met, face, clearance());
        if constexpr (kKind == Kind::Plane)
            out.odd = oddSquares(met.x.toFloats(), met.y.toFloats());
        if constexpr (kKind == Kind::Plane || kKind == Kind::Disk) return onDisk(met);
    }();
    if constexpr (!kOnlyScales<Numbers>)
        if (out.hasUv) {
            const auto [u, v] = uvOf<kKind>(shape, local, face);
            u.toFloats().store(out.uv[0]), v.toFloats().store(out.uv[1]);
        }
    const Doubles3 rough = pointOf(shape, WorldFromObject, local.p);
    const Doubles3 back = pointOf(shape, ObjectFromWorld, rough);
    const Doubles3 p = rough + vectorOf(shape, WorldFromObject, local.p - back);

    const Doubles3 normal = [&] {
        if constexpr (requires { shape.normal; })
            return shape.normal;
        else
            return normalOf(shape, local.normal);
    }();
    const Doubles rounding = (abs(normal.x * p.x) + abs(normal.y * p.y)) + abs(normal.z * p.z);
    store(p, out.p), store(normal, out.n);
    roundedUp(Doubles(kThreeUlps) * rounding + fixedError).store(out.error);
}

// Of one shape.
inline void setMaterials(const StillShape& shape, SurfacesInLanes& found) {
    select(maskOf(found.odd), Ints(shape.oddMaterial), Ints(shape.material)).store(found.material);
    Ints(shape.object).store(found.object);
}
inline void findMaterials(std::span<const StillShape* const> shapes, SurfacesInLanes& found) {
    for (std::size_t i = 0; i < shapes.size(); ++i) {
        const StillShape& shape = *shapes[i];
        found.material[i] = (found.odd >> i & 1) != 0 ? shape.oddMaterial : shape.material;
        found.object[i] = shape.object;
    }
}

template <Kind kKind> void surfacesOf(const StillsMet& met, const SurfacePlaces& out) {
    SurfacesInLanes found;
    found.hasUv = met.wantsUv;
    const StillShape* last = nullptr;
    std::optional<NumbersOf<kKind>> ofLast;
    const auto read = [&](std::size_t first, std::size_t count, RayColumns& rays) {
        rays.read(met.rays, met.hits, RaysOfLanes(met.which.subspan(first, count)), count);
    };
    readAhead<RayColumns>(
        met.which.size(), read,
        [&](std::size_t first, std::size_t count, const RayColumns& columns) {
            const RaysInLanes rays = columns.lanes();
            const Doubles3 face = [&] {
                if constexpr (kKind == Kind::Cube)
                    return facesMet(met.hits, RaysOfLanes(met.which.subspan(first, count)));
                if constexpr (kKind == Kind::Cap) return capsMet(met, first, count);
                return rays.dir;
            }();
            const auto shapes = met.shapes.subspan(first, count);
            const auto isFirst = [&](const StillShape* other) { return other == shapes[0]; };
            if (std::all_of(shapes.begin() + 1, shapes.end(), isFirst)) {
                if (shapes[0] != last) last = shapes[0], ofLast.emplace(*last);
                describe<kKind>(*ofLast, rays, face, found);
                setMaterials(*last, found);
            } else {
                describe<kKind>(NumbersOfMany<kKind>(shapes), rays, face, found);
                findMaterials(shapes, found);
            }
            found.put(met.to.subspan(first, count), out);
        });
}

} // namespace

void stillSurfaces(const StillsMet& met, SurfacePlaces out) {
    if (met.shapes.empty()) return;
    switch (met.kind) {
    case Kind::Sphere: return surfacesOf<Kind::Sphere>(met, out);
    case Kind::Cylinder: return surfacesOf<Kind::Cylinder>(met, out);
    case Kind::Cone: return surfacesOf<Kind::Cone>(met, out);
    case Kind::Cube: return surfacesOf<Kind::Cube>(met, out);
    case Kind::Disk: return surfacesOf<Kind::Disk>(met, out);
    case Kind::Corners: return surfacesOf<Kind::Corners>(met, out);
    case Kind::Plane: return surfacesOf<Kind::Plane>(met, out);
    case Kind::Cap: return surfacesOf<Kind::Cap>(met, out);
    case Kind::None: break;
    }
}
