// Promise P3 at its root: a scene times 2^k has the same normalised numbers, a moved one nearly so.
#include "scene/frame.h"

#include "check.h"
#include "verify/meshes.h"

namespace test_frame {

using meshes::Random;

namespace {

Rows scaledRows(const Rows& rows, double factor, Vec3d offset) {
    Rows out = rows; // world' = world * factor + offset
    for (double& x : out) x *= factor;
    for (std::size_t i = 0; i < 3; ++i) out[4 * i + 3] += offset[i];
    return out;
}

// A bit of everything, two keys for some.
SceneDesc someScene(Random& random) {
    SceneDesc desc;
    desc.meshes.push_back(meshes::icosphere(2));
    for (int kind = 0; kind < 8; ++kind) {
        ObjectDesc object;
        object.kind = static_cast<ObjectDesc::Kind>(kind);
        object.radius = random.uniform(0.3, 2);
        object.topRadius = random.uniform(0, 2);
        if (object.kind == ObjectDesc::Kind::Mesh) object.mesh = 0;
        object.worldFromObject = {random.affine(3, 5).rows()};
        if (kind % 2) object.worldFromObject.push_back(random.affine(3, 5).rows());
        desc.objects.push_back(object);
    }
    return desc;
}

SceneDesc moved(SceneDesc desc, double factor, Vec3d offset) {
    for (ObjectDesc& object : desc.objects)
        for (Rows& key : object.worldFromObject) key = scaledRows(key, factor, offset);
    return desc;
}

ObjectDesc objectOf(ObjectDesc::Kind kind, const Rows& rows = kIdentityRows) {
    ObjectDesc object;
    object.kind = kind;
    object.worldFromObject = {rows};
    return object;
}

CameraDesc cameraAt(Vec3d place) {
    CameraDesc camera;
    camera.worldFromCamera = {Transform::translate(place).rows()};
    return camera;
}
// Seen from so far away that no object is nearer than others.
SceneFrame fromAfar(const SceneDesc& desc) { return frameOf(desc, cameraAt({1e30, 0, 0})); }

} // namespace

TEST(frame_powers_of_two_change_no_bit) {
    Random random(101);
    for (int n = 0; n < 20; ++n) {
        const SceneDesc desc = someScene(random);
        const Vec3d eye = random.inBox(20);
        const SceneFrame frame = frameOf(desc, cameraAt(eye));
        for (const int k : {-60, -20, -7, 1, 3, 20, 60}) {
            const double factor = std::ldexp(1.0, k);
            const SceneDesc scaled = moved(desc, factor, {});
            const SceneFrame other = frameOf(scaled, cameraAt(eye * factor));
            CHECK(other.centre == frame.centre * factor && other.scale * factor == frame.scale);
            for (std::size_t i = 0; i < desc.objects.size(); ++i)
                for (std::size_t key = 0; key < desc.objects[i].worldFromObject.size(); ++key)
                    CHECK(other.placed(scaled.objects[i].worldFromObject[key]) ==
                          frame.placed(desc.objects[i].worldFromObject[key]));
            MergedMesh a, b;
            const Rows& rows = desc.objects.back().worldFromObject[0];
            a.add(desc.meshes[0], frame.placed(rows), {0}, 0);
            b.add(desc.meshes[0], other.placed(scaledRows(rows, factor, {})), {0}, 0);
            CHECK(a.geometry.points == b.geometry.points &&
                  a.geometry.normals == b.geometry.normals);
            MeshDesc big = desc.meshes[0];
            for (Vec3d& p : big.points) p = p * factor;
            CHECK(toGeometry(big, frameOf(big)).points ==
                  toGeometry(desc.meshes[0], frameOf(desc.meshes[0])).points);
        }
    }
}

TEST(frame_extent_is_one_to_two) {
    Random random(102);
    for (int n = 0; n < 200; ++n) {
        const double size = random.logUniform(1e-9, 1e9);
        const SceneDesc desc =
            moved(someScene(random), size, random.inBox(1) * (size * random.logUniform(1, 1e6)));
        const SceneFrame frame = fromAfar(desc);
        BoundsD box; // of the points of the mesh and of the keys' origins, which are inside
        for (const ObjectDesc& object : desc.objects) {
            if (object.kind == ObjectDesc::Kind::InfinitePlane) continue;
            for (const Rows& key : object.worldFromObject) {
                box.extend(frame.point({key[3], key[7], key[11]}));
                if (object.kind != ObjectDesc::Kind::Mesh) continue;
                for (const Vec3d p : desc.meshes[0].points)
                    box.extend(frame.point(Transform::fromRows(key).point(p)));
            }
        }
        CHECK(maxAbs(box.lo) <= 1 && maxAbs(box.hi) <= 1); // half of the extent
        const Vec3d p = random.inBox(1);
        CHECK(length(frame.point(frame.worldPoint(p)) - p) < 1e-9);
    }
    // Exactly: two unit spheres at x = 0 and 6 fill 8 by 2 by 2.
    SceneDesc two;
    two.objects.push_back(objectOf(ObjectDesc::Kind::Sphere));
    two.objects.push_back(
        objectOf(ObjectDesc::Kind::Sphere, Transform::translate({6, 0, 0}).rows()));
    CHECK_NEAR(fromAfar(two).centre.x, 3, 1e-14);
    CHECK_EQUAL(fromAfar(two).scale, 0.125);
}

// A scene 10^6 extents away: its doubles carry 1e6 * 2^-53 of it, 1e-10, a thousandth of a float's
// last place; so the floats differ by a rounding at most.
TEST(frame_far_places) {
    Random random(103);
    double worst = 0;
    for (int n = 0; n < 50; ++n) {
        const MeshDesc mesh = meshes::icosphere(2);
        const Transform map = random.affine(2, 0);
        const SceneFrame frame = meshes::frameFor(mesh, map);
        const double extent = 1 / frame.scale;
        const Transform farMap = Transform::translate(random.direction() * (1e6 * extent)) * map;
        const SceneFrame farFrame = meshes::frameFor(mesh, farMap);
        CHECK_EQUAL(farFrame.scale, frame.scale);
        const meshes::Ready near = meshes::baked(mesh, map, frame),
                            far = meshes::baked(mesh, farMap, farFrame);
        for (std::size_t i = 0; i < near.geometry->points.size(); ++i)
            worst = max(worst, static_cast<double>(
                                   maxAbs(near.geometry->points[i] - far.geometry->points[i])));
    }
    std::printf("worst change of a coordinate by moving 1e6 extents: %g, seed 103\n", worst);
    CHECK_INFO(worst <= 0x1p-24 + 2e-9, worst);
}

// Unit spheres at x = 0, 6 and `far`, seen from y = -5: the third one counts as long as it is no
// farther than 8 times 4, the distance of the nearest.
TEST(frame_leaves_out_what_is_far) {
    const auto spheres = [](double far, double eye) {
        SceneDesc desc;
        for (const double x : {0.0, 6.0, far})
            desc.objects.push_back(
                objectOf(ObjectDesc::Kind::Sphere, Transform::translate({x, 0, 0}).rows()));
        return frameOf(desc, cameraAt({0, eye, 0}));
    };
    CHECK_NEAR(spheres(31, -5).centre.x, 15.5, 1e-13);
    CHECK_EQUAL(spheres(31, -5).scale, 1.0 / 32);
    for (const double far : {34.0, 1e3, 1e6, 1e9, 1e20, -1e12}) {
        CHECK_NEAR(spheres(far, -5).centre.x, 3, 1e-14);
        CHECK_EQUAL(spheres(far, -5).scale, 0.125);
    }
    // 2^16 times as far as the nearest object, or as large as all that are near.
    CHECK_EQUAL(spheres(5e5, -5).distantFrom, kInfinityF);
    CHECK_EQUAL(spheres(6e5, -5).distantFrom, 0x1p16f);
    // A large thing that is near: the origin is the camera, 0.6 above a floor of 400.
    SceneDesc floor;
    floor.objects.push_back(
        objectOf(ObjectDesc::Kind::Cube, Rows{200, 0, 0, 0, 0, 200, 0, 0, 0, 0, 1, -1}));
    const SceneFrame near = frameOf(floor, cameraAt({7, 8, 0.6}));
    CHECK(near.centre == (Vec3d{7, 8, 0.6}) && near.scale == 0.125);
    // Nearness is nothing to parallel rays.
    CameraDesc parallel = cameraAt({7, 8, 0.5});
    parallel.kind = CameraDesc::Kind::Orthographic, parallel.orthoScale = 50;
    CHECK(frameOf(floor, parallel).centre == (Vec3d{0, 0, -1}));
    // Around the eye: 1/64 of its size away.
    CHECK_EQUAL(spheres(1e9, 0.5).scale, 2.0);
}

TEST(frame_of_little) {
    // Nothing, or only what has no end: the world as it is.
    CHECK(fromAfar(SceneDesc{}).scale == 1 && fromAfar(SceneDesc{}).centre == Vec3d{});
    SceneDesc plane;
    plane.objects.push_back(objectOf(ObjectDesc::Kind::InfinitePlane));
    CHECK(fromAfar(plane).scale == 1);
    // Cameras and lights count where nothing else does.
    CameraDesc camera;
    camera.worldFromCamera = {Transform::translate({10, 0, 0}).rows()};
    plane.cameras.push_back(camera);
    LightDesc light;
    light.worldFromLight = Transform::translate({10, 40, 0}).rows();
    plane.lights.push_back(light);
    CHECK(fromAfar(plane).centre == (Vec3d{10, 20, 0}) && fromAfar(plane).scale == 1.0 / 32);
    plane.objects.push_back(objectOf(ObjectDesc::Kind::Sphere));
    CHECK(maxAbs(fromAfar(plane).centre) < 1e-14 && fromAfar(plane).scale == 0.5);
    // A single point has no size, and an infinite one no frame.
    MeshDesc mesh;
    mesh.points = {{3, 4, 5}};
    CHECK(frameOf(mesh).centre == (Vec3d{3, 4, 5}) && frameOf(mesh).scale == 1);
    mesh.points.push_back({kInfinity, 0, 0});
    CHECK(frameOf(mesh).scale == 1 && frameOf(mesh).centre == Vec3d{});
    // A cone is as wide as its wider end.
    SceneDesc cone;
    cone.objects.push_back(objectOf(ObjectDesc::Kind::Cone));
    cone.objects[0].topRadius = 4;
    CHECK_EQUAL(fromAfar(cone).scale, 0.125);
}

} // namespace test_frame
