#include "shape/analytic_shape.h"

namespace {

constexpr double kFloatUlp = 0x1p-24; // half an ulp, relative: error of one rounding to float

// The scene has its extent in [1,2) and its centre at 0 (scene/scene.h): how far a ray can run
// along a surface without end before nothing is left to be seen.
constexpr double kSceneReach = 4;

double sumOfProducts(Vec3d a, Vec3d b) {
    return std::fabs(a.x * b.x) + std::fabs(a.y * b.y) + std::fabs(a.z * b.z);
}

// Row i of the linear part.
Vec3d row(const AffineRows& r, std::size_t i) { return {r[4 * i], r[4 * i + 1], r[4 * i + 2]}; }

// Largest row sum of |M| |M^-1|: how much a relative error of the object's coordinates grows when
// it is seen as a distance in the world. At most 3 for a rotation, else about the condition number.
double amplification(const AffineRows& map, const AffineRows& inverse) {
    Vec3d sums; // of the rows of |M^-1|
    for (std::size_t i = 0; i < 3; ++i) sums[i] = sumOfProducts(row(inverse, i), {1, 1, 1});
    double largest = 0;
    for (std::size_t i = 0; i < 3; ++i) largest = max(largest, sumOfProducts(row(map, i), sums));
    return largest;
}

// A bound of the square of how much the map stretches, by Gershgorin's circles about its Gram
// matrix.
double largestStretch2(const Transform& map) {
    const Vec3d x = map.column(0), y = map.column(1), z = map.column(2);
    const double xy = std::fabs(dot(x, y)), yz = std::fabs(dot(y, z)), zx = std::fabs(dot(z, x));
    return max(dot(x, x) + xy + zx, max(dot(y, y) + xy + yz, dot(z, z) + yz + zx));
}

} // namespace

AnalyticShape::Local AnalyticShape::cap(Vec3d p, bool top, double radius, double inset) {
    const double side = top ? 1 : -1;
    const double around = std::sqrt(p.x * p.x + p.y * p.y);
    const double limit = radius - min(inset, radius / 2);
    const double factor = around > limit ? limit / around : 1;
    const double x = p.x * factor, y = p.y * factor;
    return {{x, y, side},
            {0, 0, side},
            {0.5 + 0.5 * side * x / radius, 0.5 + 0.5 * y / radius},
            {2 * side * radius, 0, 0},
            {0, 2 * radius, 0}};
}

AnalyticShape::AnalyticShape(const MovingTransform& worldFromObject, std::uint32_t material,
                             std::uint32_t object, double radius)
    : still_{.worldFromObject = worldFromObject.keys().front(),
             .radius = radius,
             .material = material,
             .oddMaterial = material,
             .object = object,
             .corners = nullptr} {
    if (!worldFromObject.isStatic())
        motion_ = std::make_unique<const MovingTransform>(worldFromObject);
}

Bounds AnalyticShape::bounds() const {
    const BoundsD box =
        isStill() ? boxUnder(worldFromObject()) : motion_->bounds(boxUnder(Transform()));
    if (!box.isFinite()) {
        const float inf = kInfinityF;
        return {{-inf, -inf, -inf}, {inf, inf, inf}};
    }
    return outward(box.padded(0x1p-22 * max(maxAbs(box.lo), maxAbs(box.hi))));
}

// The origin goes on lines. The turn changes no length, and between two keys the stretch is no
// longer than at one of them.
SolidForm AnalyticShape::movingForm(double farthest) const {
    BoundsD way;
    double most = 0;
    for (const Transform& key : motion_->keys()) {
        way.extend(key.translation());
        most = max(most, largestStretch2(key));
    }
    const double reach = farthest * std::sqrt(most);
    SolidForm form{ballAround(way)};
    form.hull.radius += reach;
    auto drift = motion_->drift();
    const bool turns = !drift;
    form.motion = {std::move(drift), turns ? motion_.get() : nullptr, reach};
    return form;
}

SolidForm AnalyticShape::tubeForm(double radius) const {
    if (!isStill()) return movingForm(std::sqrt(1 + radius * radius));
    const Vec3d x = worldFromObject().column(0), y = worldFromObject().column(1);
    const Vec3d axis = worldFromObject().column(2);
    const double size = length(axis);
    if (!(size > 0x1p-100)) return Shape::solidForm();
    // The largest stretch of the disks, which is also a bound across the axis.
    const double xx = dot(x, x), yy = dot(y, y), xy = dot(x, y);
    const double stretch = std::sqrt(0.5 * (xx + yy) + std::sqrt(sqr(0.5 * (xx - yy)) + xy * xy));
    // The disks may lean.
    const Vec3d unit = axis / size;
    const double lean = length(Vec3d{dot(x, unit), dot(y, unit), 0});
    return {{.centre = worldFromObject().translation(),
             .axis = unit,
             .radius = radius * stretch,
             .halfLength = size + radius * lean},
            {}};
}

double AnalyticShape::roundStretch(Vec3d axis) const {
    const Vec3d x = worldFromObject().column(0), y = worldFromObject().column(1);
    // But for 2^-30, which the hull covers as it does rounding.
    const double xx = dot(x, x), yy = dot(y, y), most = 0x1p-30 * xx;
    const double lean = max(std::fabs(dot(x, axis)), std::fabs(dot(y, axis)));
    const bool isRound = std::fabs(xx - yy) <= most && std::fabs(dot(x, y)) <= most;
    return isRound && lean * lean <= most * 0x1p-30 ? std::sqrt(xx) : 0;
}

SolidForm AnalyticShape::facesForm(StillFaces::Of of, double farthest) const {
    SolidForm form = isStill() ? Shape::solidForm() : movingForm(farthest);
    form.faces = {.shape = &still_, .of = of};
    return form;
}

void AnalyticShape::measure(StillShape::Kind kind, unsigned parts, unsigned caps) {
    if (!isStill()) return;
    still_ = stillUnder(still_.worldFromObject);
    const bool wantsEnd = kind != StillShape::Kind::Plane;
    if (still_.hasEnd != wantsEnd || still_.worldFromObject.isSingular()) return;
    still_.kind = kind;
    still_.parts = static_cast<std::uint8_t>(parts | caps),
    still_.caps = static_cast<std::uint8_t>(caps);
}

StillShape AnalyticShape::stillUnder(const Transform& worldFromObject) const {
    const BoundsD box = boxUnder(worldFromObject);
    StillShape shape = still_;
    shape.worldFromObject = worldFromObject;
    shape.hasEnd = box.isFinite();
    // The reach of a ray along the surface.
    shape.leastError = kFloatUlp * (shape.hasEnd ? length(box.size()) : kSceneReach);
    shape.errorPerPlace =
        0x1p-48 * amplification(worldFromObject.rows(), worldFromObject.inverseRows());
    return shape;
}

static RayD mapped(const AffineRows& map, const RayD& ray) {
    return {pointUnder(map, ray.org), vectorUnder(map, ray.dir)};
}

AnalyticShape::Roots AnalyticShape::rootsOf(const Ray& ray) const {
    const RayD world = toDouble(ray);
    const RayD local = isStill() ? mapped(still_.objectFromWorld(), world)
                                 : mapped(worldFromObjectAt(ray.time).inverseRows(), world);
    // Zero, NaN or infinite rays meet nothing.
    const double dd = dot(local.dir, local.dir);
    if (!(dd > 0 && dd < kInfinity && dot(local.org, local.org) < kInfinity)) return {};
    return roots(local);
}

namespace {

// u keeps what t lost when it was rounded: surface() gets the root to 48 bits, which small shapes
// far away need, and can tell two roots with the same t apart.
Hit hitAt(const Root& root, float t) {
    Hit hit;
    hit.t = t;
    hit.u = static_cast<float>(root.t - static_cast<double>(t));
    hit.prim = root.part;
    return hit;
}

} // namespace

bool AnalyticShape::intersect(const Ray& ray, Hit& hit) const {
    for (const Root& root : rootsOf(ray)) {
        const float t = static_cast<float>(root.t);
        if (!(t > ray.tMin)) continue;
        if (!(t <= hit.t && t < kInfinityF)) return false;
        const std::uint32_t shape = hit.shape;
        hit = hitAt(root, t);
        hit.shape = shape;
        return true;
    }
    return false;
}

bool AnalyticShape::occludes(const Ray& ray) const {
    for (const Root& root : rootsOf(ray)) {
        const float t = static_cast<float>(root.t);
        if (t > ray.tMin && t < ray.tMax) return true;
    }
    return false;
}

void AnalyticShape::collect(const Ray& ray, std::vector<Hit>& hits) const {
    for (const Root& root : rootsOf(ray)) {
        const float t = static_cast<float>(root.t);
        if (t > ray.tMin && t < ray.tMax) hits.push_back(hitAt(root, t));
    }
}

// The error, along the normal n, of a ray origin made from p, with u = 2^-24:
//  - p is rounded to float, and so is the origin p + n error:      2 u sum |n_i p_i|, taken 3 times
//  - n is rounded: a ray that leaves along the rounded tangent plane sinks below the true one by
//    u sqrt(3)/2 of its way, which ends within the shape's box:     u reach
//    (the rest of this term, 0.13 u reach, covers the rounding of the formulas in double)
//  - the map to object space and back in double, whose error is 2^-53 times a dozen operations
//    times the amplification of the map:                          2^-48 amplification (|p| + |T|)
Surface AnalyticShape::surfaceOf(const StillShape& shape, const Ray& ray, const Hit& hit,
                                 SurfaceNeeds needs) const {
    const Transform& worldFromObject = shape.worldFromObject;
    const AffineRows& objectFromWorld = shape.objectFromWorld();
    const double t = static_cast<double>(hit.t) + static_cast<double>(hit.u);
    const Vec3d seen = toDouble(ray).at(t);

    const double leastError = shape.leastError * (shape.hasEnd ? 1 : max(1.0, maxAbs(seen)));
    const double fixedError =
        leastError + shape.errorPerPlace * (maxAbs(seen) + maxAbs(worldFromObject.translation()));
    // Twice the largest error that any normal can give.
    const double distance = 2 * (3 * kFloatUlp * length(seen) + fixedError);

    const Local local = describe(mapped(objectFromWorld, toDouble(ray)).at(t), hit.prim,
                                 {distance, objectFromWorld, needs.uv});
    // One step of refinement: p is where the inverse, which rays are mapped with, sees local.p.
    Vec3d p = worldFromObject.point(local.p);
    p += worldFromObject.vector(local.p - pointUnder(objectFromWorld, p));
    const Vec3d normal = normalize(worldFromObject.normal(local.normal));

    Surface surface;
    surface.p = toFloat(p);
    surface.ng = surface.ns = toFloat(normal);
    surface.uv = {static_cast<float>(local.uv.x), static_cast<float>(local.uv.y)};
    surface.material = shape.material;
    surface.object = shape.object;
    surface.error = floatAbove(3 * kFloatUlp * sumOfProducts(normal, p) + fixedError);
    return surface;
}

Surface AnalyticShape::surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const {
    if (isStill()) return surfaceOf(still_, ray, hit, needs);
    return surfaceOf(stillUnder(worldFromObjectAt(ray.time)), ray, hit, needs);
}

// The sign is asked of the surface's rounded normal. Its error, and that of a point which has not
// been kept clear of edges, is far below the angle of 2^-10 up to which it is computed.
bool AnalyticShape::seesFront(const Ray& ray, const Hit& hit) const {
    if (!isStill()) return Shape::seesFront(ray, hit);
    const RayD local = mapped(still_.objectFromWorld(), toDouble(ray));
    const double t = static_cast<double>(hit.t) + static_cast<double>(hit.u);
    const Vec3d n = normalAt(local.at(t), hit.prim);
    const Vec3d normal = worldFromObject().normal(n), dir = toDouble(ray.dir);
    const double facing = dot(normal, dir);
    if (facing * facing > 0x1p-20 * dot(normal, normal) * dot(dir, dir)) return facing < 0;
    return Shape::seesFront(ray, hit);
}

SurfaceDerivatives AnalyticShape::derivatives(const Ray& ray, const Hit& hit) const {
    const Transform worldFromObject = worldFromObjectAt(ray.time);
    const double t = static_cast<double>(hit.t) + static_cast<double>(hit.u);
    const AffineRows& objectFromWorld = worldFromObject.inverseRows();
    const Vec3d p = mapped(objectFromWorld, toDouble(ray)).at(t);
    const Local local = describe(p, hit.prim, {0, objectFromWorld, true});
    return {toFloat(worldFromObject.vector(local.dpdu)),
            toFloat(worldFromObject.vector(local.dpdv)), isStill() && local.isEven};
}

Vec3d AnalyticShape::Clearance::inset() const {
    return {distance * length(row(objectFromWorld, 0)), distance * length(row(objectFromWorld, 1)),
            distance * length(row(objectFromWorld, 2))};
}

double AnalyticShape::Clearance::steepness(Vec3d n) const {
    return length(row(objectFromWorld, 0) * n.x + row(objectFromWorld, 1) * n.y +
                  row(objectFromWorld, 2) * n.z);
}

BoundsD diskBox(const Transform& worldFromObject, Vec3d centre, double radius) {
    const Vec3d middle = worldFromObject.point(centre);
    Vec3d half;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d m = row(worldFromObject.rows(), i);
        half[i] = radius * std::sqrt(m.x * m.x + m.y * m.y);
    }
    return {middle - half, middle + half};
}
