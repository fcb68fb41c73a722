// T18: quads that lie in one plane and overlap. Which one is seen must not depend on the camera, on
// rounding or on the tree: it is the first one of the scene that covers the place.
#include "base/text.h"
#include "scene/scene.h"
#include "verify/binary128.h"
#include "verify/groups.h"

namespace battery {

namespace {

using meshes::Random;

constexpr int kQuads = 16, kFrames = 100, kSide = 12; // pixels
// Nearer to an edge than this, in units of the stack, the plane's rounding decides.
constexpr double kMargin = 1e-5;

// All numbers are multiples of 2^-6 below 2^4, so that double and float hold every corner exactly.
struct Stack {
    Vec3d u, v; // span the plane
    struct Quad {
        Vec2d centre;
        double half = 0;
    };
    std::vector<Quad> quads;

    Vec3d at(Vec2d p) const { return u * p.x + v * p.y; }
};

Stack someStack(Random& random) {
    constexpr Vec3d kPlanes[][2] = {{{1, 0, 0}, {0, 1, 0}},  {{0, 1, 0}, {0, 0, 1}},
                                    {{1, 1, 0}, {0, 0, 1}},  {{1, 2, 0}, {-2, 1, 1}},
                                    {{1, 1, 1}, {1, -1, 0}}, {{2, -1, 2}, {1, 2, 3}}};
    const auto& plane = kPlanes[random.below(std::size(kPlanes))];
    Stack stack{plane[0], plane[1], {}};
    const auto grid = [&](std::size_t steps) { return random.below(steps + 1) * 0x1p-6; };
    for (int i = 0; i < kQuads; ++i) {
        const double x = grid(128) - 1, y = grid(128) - 1;
        stack.quads.push_back({{x, y}, 0.25 + grid(64)});
    }
    return stack;
}

enum class Made { Planes, Meshes, Cubes, Instances };
constexpr const char* kMadeNames[] = {"planes", "meshes", "cubes", "instances"};

std::array<Vec3d, 4> cornersOf(const Stack& stack, const Stack::Quad& quad) {
    const double h = quad.half;
    std::array<Vec3d, 4> corners;
    const Vec2d signs[] = {{-h, -h}, {h, -h}, {h, h}, {-h, h}};
    for (std::size_t i = 0; i < 4; ++i)
        corners[i] = stack.at({quad.centre.x + signs[i].x, quad.centre.y + signs[i].y});
    return corners;
}

MeshDesc meshOf(const std::array<Vec3d, 4>& corners) {
    MeshDesc mesh;
    mesh.points.assign(corners.begin(), corners.end());
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    return mesh;
}

// Takes the square [-1,1]^2 at a height, such as the face of a cube at 1, to the quad.
Rows rowsOf(const Stack& stack, const Stack::Quad& quad, double height) {
    const Vec3d x = stack.u * quad.half, y = stack.v * quad.half;
    const Vec3d z = cross(stack.u, stack.v) * 0.25, o = stack.at(quad.centre) - z * height;
    return {x.x, y.x, z.x, o.x, x.y, y.y, z.y, o.y, x.z, y.z, z.z, o.z};
}

SceneDesc sceneOf(const Stack& stack, Made made) {
    SceneDesc desc;
    desc.settings.width = desc.settings.height = kSide;
    if (made == Made::Instances)
        desc.meshes = {meshOf({Vec3d{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})};
    for (const Stack::Quad& quad : stack.quads) {
        ObjectDesc& object = desc.objects.emplace_back();
        switch (made) {
        case Made::Planes:
            object.kind = ObjectDesc::Kind::Plane;
            object.corners = cornersOf(stack, quad);
            break;
        case Made::Meshes:
            object.kind = ObjectDesc::Kind::Mesh;
            object.mesh = static_cast<Handle>(desc.meshes.size());
            desc.meshes.push_back(meshOf(cornersOf(stack, quad)));
            break;
        case Made::Cubes:
            object.kind = ObjectDesc::Kind::Cube;
            object.worldFromObject = {rowsOf(stack, quad, 1)};
            break;
        case Made::Instances:
            object.kind = ObjectDesc::Kind::Mesh;
            object.mesh = 0;
            object.worldFromObject = {rowsOf(stack, quad, 0)};
            break;
        }
    }
    return desc;
}

// Along an arc that comes down from above the plane to 2 degrees over it while it goes round.
CameraDesc cameraAt(const Stack& stack, int frame, double start) {
    const double turn = start + frame * (kTwoPi / kFrames);
    const double height = radians(88 - 86.0 * frame / (kFrames - 1));
    const Vec3d n = normalize(cross(stack.u, stack.v)), x = normalize(stack.u), y = cross(n, x);
    const Vec3d around = x * exact::cos(turn) + y * exact::sin(turn);
    CameraDesc camera;
    const double distance = 8 * length(stack.v);
    camera.worldFromCamera = {
        Transform::lookAt((around * exact::cos(height) + n * exact::sin(height)) * distance, {}, n)
            .rows()};
    return camera;
}

constexpr int kNothing = -1, kTooClose = -2;

// The number of the quad that the ray should see: of the plane in 113 bits, by the list.
int expected(const Stack& stack, const SceneFrame& frame, const Ray& ray) {
    const Vec3w u = toWide(stack.u), v = toWide(stack.v), n = cross(u, v);
    const Vec3w org = toWide(ray.org) - toWide(frame.point({}));
    const Vec3w dir = toWide(ray.dir);
    const Wide t = -dot(n, org) / dot(n, dir);
    if (!(t > 0)) return kNothing;
    const Vec3w p = (org + dir * t) / static_cast<Wide>(frame.scale);
    const double x = static_cast<double>(dot(cross(p, v), n) / dot(n, n));
    const double y = static_cast<double>(dot(cross(u, p), n) / dot(n, n));
    int seen = kNothing;
    for (int i = 0; i < kQuads; ++i) {
        const Stack::Quad& quad = stack.quads[static_cast<std::size_t>(i)];
        const double inside =
            quad.half - max(std::fabs(x - quad.centre.x), std::fabs(y - quad.centre.y));
        if (std::fabs(inside) < kMargin) return kTooClose;
        if (inside > 0 && seen == kNothing) seen = i;
    }
    return seen;
}

int seenObject(const Scene& scene, const Ray& ray, const Hit& hit) {
    if (!hit.isHit()) return kNothing;
    return static_cast<int>(scene.shapes().shapes[hit.shape]->surface(ray, hit).object);
}

// Is what the other scene shows the same? Their shapes and triangles may have other numbers.
bool isSame(const Scene& scene, const Scene& other, const Ray& ray, const Hit& hit) {
    const Hit otherHit = other.shapes().closest(ray);
    return hit.t == otherHit.t && hit.u == otherHit.u && hit.v == otherHit.v &&
           seenObject(scene, ray, hit) == seenObject(other, ray, otherHit);
}

Tally stacks(const Effort& effort, std::uint64_t seed, std::span<const Made> kinds) {
    return inBatches(effort, seed, 12, [&](Random& random, Tally& tally) {
        const Stack stack = someStack(random);
        const Made made = kinds[random.below(kinds.size())];
        SceneDesc desc = sceneOf(stack, made);
        const double start = random.uniform(0, kTwoPi);
        RenderSettings withTree, withoutTree;
        withTree.picture = withoutTree.picture = desc.settings;
        withoutTree.accel = AccelKind::None;
        withTree.copiedTriangles = 0; // instances stay instances
        for (int frame = 0; frame < kFrames; ++frame) {
            desc.cameras = {cameraAt(stack, frame, start)};
            const Scene scene(desc, {}, withTree), plain(desc, {}, withoutTree);
            for (int pixel = 0; pixel < kSide * kSide; ++pixel) {
                const int x = pixel % kSide, y = pixel / kSide;
                const Ray ray = scene.camera().ray({x + 0.5, y + 0.5}, {}, 0);
                const int quad = expected(stack, scene.frame(), ray);
                if (quad == kTooClose) continue;
                ++tally.cases;
                const Hit hit = scene.shapes().closest(ray);
                // The sides of cubes may cover what is outside of their faces.
                const bool isOther = made == Made::Cubes && quad == kNothing;
                if ((seenObject(scene, ray, hit) != quad && !isOther) ||
                    !isSame(scene, plain, ray, hit))
                    tally.fail([&] {
                        return cat(kMadeNames[static_cast<int>(made)], ", frame ", frame,
                                   ", pixel ", x, " ", y, ": ", seenObject(scene, ray, hit),
                                   " instead of ", quad);
                    });
            }
        }
    });
}

Tally stacksOfOwn(const Effort& effort) {
    constexpr Made kKinds[] = {Made::Planes, Made::Meshes, Made::Cubes};
    return stacks(effort, 18, kKinds);
}
// Against copies of them: those without a tree are merged.
Tally stacksOfInstances(const Effort& effort) {
    constexpr Made kKinds[] = {Made::Instances};
    return stacks(effort, 181, kKinds);
}

constexpr Row kCoplanarRows[] = {
    {"T18a", "pixels of 16 quads in one plane that show the wrong one", "", 0, true, stacksOfOwn},
    {"T18b", "the same of instances of one quad", "", 0, true, stacksOfInstances},
};

} // namespace

std::span<const Row> coplanarRows() { return kCoplanarRows; }

} // namespace battery
