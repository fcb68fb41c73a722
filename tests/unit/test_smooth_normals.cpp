// Smooth normals: bodies whose normals are known, and points with very many triangles.
#include "read/mesh/mesh_steps.h"

#include "check.h"

#include <chrono>
#include <random>

namespace test_smooth_normals {

namespace {

// Outward; each side as two triangles whose diagonals go any way.
MeshDesc cube() {
    MeshDesc mesh;
    for (int i = 0; i < 8; ++i)
        mesh.points.push_back({i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0});
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                      {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
    return mesh;
}
Vec3d flatNormal(const MeshDesc& mesh, std::size_t triangle) {
    const auto& t = mesh.triangles[triangle];
    return normalize(
        cross(mesh.points[t[1]] - mesh.points[t[0]], mesh.points[t[2]] - mesh.points[t[0]]));
}
Vec3 normalAt(const MeshDesc& mesh, std::size_t triangle, std::size_t corner) {
    return mesh.normals.at(mesh.normalTriangles.at(triangle)[corner]);
}
void checkNormal(const MeshDesc& mesh, std::size_t triangle, std::size_t corner, Vec3d expected) {
    const Vec3d n = toDouble(normalAt(mesh, triangle, corner));
    CHECK_INFO(length(n - expected) < 2e-7, "triangle " << triangle << " corner " << corner << ": "
                                                        << n.x << ' ' << n.y << ' ' << n.z);
}
// A cone of n triangles around its tip, the last of the points.
MeshDesc cone(std::uint32_t n, double height) {
    MeshDesc mesh;
    for (std::uint32_t i = 0; i < n; ++i) {
        const double angle = 2 * M_PI * i / n;
        mesh.points.push_back({std::cos(angle), std::sin(angle), 0});
        mesh.triangles.push_back({i, (i + 1) % n, n});
    }
    mesh.points.push_back({0, 0, height});
    return mesh;
}

} // namespace

TEST(smooth_normals_of_a_cube) {
    // All the way round: weights by angle make the corner's direction, however sides are divided.
    for (const double angle : {180.0, 91.0}) {
        MeshDesc mesh = cube();
        smoothByAngle(mesh, angle);
        for (std::size_t i = 0; i < 12; ++i)
            for (std::size_t k = 0; k < 3; ++k)
                checkNormal(mesh, i, k, normalize(mesh.points[mesh.triangles[i][k]]));
        CHECK_EQUAL(mesh.normals.size(), std::size_t{8});
    }
    // Its edges bend 90 degrees, which is not less than 90. Three normals per point.
    MeshDesc mesh = cube();
    smoothByAngle(mesh, 90);
    for (std::size_t i = 0; i < 12; ++i)
        for (std::size_t k = 0; k < 3; ++k) checkNormal(mesh, i, k, flatNormal(mesh, i));
    CHECK_EQUAL(mesh.normals.size(), std::size_t{24});
    smoothByAngle(mesh, 0);
    CHECK(mesh.normals.empty() && mesh.normalTriangles.empty());
}

TEST(smooth_normals_of_a_bent_strip) {
    // Two squares that bend 30 degrees at x = 0: the middle one is the mean, weights are equal.
    const double c = std::sqrt(0.75), s = 0.5;
    MeshDesc mesh;
    mesh.points = {{-1, 0, 0}, {-1, 1, 0}, {0, 0, 0}, {0, 1, 0}, {c, 0, -s}, {c, 1, -s}};
    mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {2, 4, 5}, {2, 5, 3}};
    const Vec3d left{0, 0, 1}, right{s, 0, c}, middle = normalize(left + right);
    MeshDesc smooth = mesh;
    smoothByAngle(smooth, 31);
    checkNormal(smooth, 0, 0, left);
    checkNormal(smooth, 0, 1, middle);
    checkNormal(smooth, 0, 2, middle);
    checkNormal(smooth, 2, 0, middle);
    checkNormal(smooth, 2, 1, right);
    smoothByAngle(smooth, 29);
    checkNormal(smooth, 0, 1, left);
    checkNormal(smooth, 2, 0, right);
    // Groups say the same without angles; group 0 is flat, and has one normal per triangle.
    smooth = mesh;
    smoothByGroup(smooth, std::vector<std::uint32_t>{7, 7, 7, 7});
    checkNormal(smooth, 0, 1, middle);
    smoothByGroup(smooth, std::vector<std::uint32_t>{1, 1, 4000000000u, 4000000000u});
    checkNormal(smooth, 0, 1, left);
    checkNormal(smooth, 3, 2, right);
    smoothByGroup(smooth, std::vector<std::uint32_t>{0, 0, 5, 5});
    checkNormal(smooth, 1, 1, left);
    checkNormal(smooth, 2, 0, right);
    CHECK_EQUAL(smooth.normals.size(), std::size_t{2 + 4});
    // Placement and size change nothing.
    for (const double size : {1e-200, 1e-30, 1e50}) {
        MeshDesc scaled = mesh;
        for (Vec3d& p : scaled.points) p *= size;
        smoothByAngle(scaled, 180);
        checkNormal(scaled, 0, 1, middle);
    }
}

// What has no direction: triangles without area, and sides that face each other.
TEST(smooth_normals_without_direction) {
    MeshDesc mesh;
    mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {9, 9, 9}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 1}, {0, 1, 3}};
    for (const double angle : {30.0, 180.0}) {
        smoothByAngle(mesh, angle);
        for (const Vec3& n : mesh.normals) CHECK_NEAR(length(n), 1, 1e-6);
        checkNormal(mesh, 0, 1, {0, 0, 1});
        checkNormal(mesh, 1, 1, {0, 0, angle < 180 ? -1.0 : 1.0});
    }
    smoothByGroup(mesh, std::vector<std::uint32_t>{1, 1, 1});
    for (const Vec3& n : mesh.normals) CHECK_NEAR(length(n), 1, 1e-6);
}

// Random bodies against the definition written down as it reads.
TEST(smooth_normals_agree_with_definition) {
    for (std::uint32_t seed = 0; seed < check::scaled(30u); ++seed) {
        std::mt19937 random(seed);
        const auto number = [&] { return static_cast<double>(random()) / 4294967296.0; };
        MeshDesc mesh;
        for (int i = 0; i < 12; ++i) mesh.points.push_back({number(), number(), number()});
        for (std::uint32_t i = 0; i < 40; ++i) {
            const auto a = static_cast<std::uint32_t>(random() % 12), b = (a + 1 + i % 4) % 12,
                       c = (b + 1 + static_cast<std::uint32_t>(random() % 5)) % 12;
            if (c != a) mesh.triangles.push_back({a, b, c});
        }
        const double limit = 20 + 150 * number();
        smoothByAngle(mesh, limit);
        for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
            for (std::size_t k = 0; k < 3; ++k) {
                Vec3d sum;
                for (std::size_t j = 0; j < mesh.triangles.size(); ++j)
                    for (std::size_t m = 0; m < 3; ++m) {
                        const auto& t = mesh.triangles[j];
                        if (t[m] != mesh.triangles[i][k]) continue;
                        const double bend =
                            std::acos(std::fmin(1, dot(flatNormal(mesh, i), flatNormal(mesh, j))));
                        if (j != i && bend * 180 / M_PI >= limit) continue;
                        const Vec3d p = mesh.points[t[m]],
                                    a = normalize(mesh.points[t[(m + 1) % 3]] - p),
                                    b = normalize(mesh.points[t[(m + 2) % 3]] - p);
                        sum += flatNormal(mesh, j) * std::acos(dot(a, b));
                    }
                const Vec3d n = toDouble(normalAt(mesh, i, k));
                CHECK_INFO(length(n - normalize(sum)) < 1e-6,
                           "seed " << seed << ", triangle " << i);
            }
    }
}

TEST(smooth_normals_around_many_triangles) {
    // Below and above the number from which directions are compared in steps.
    for (const std::uint32_t n : {500u, 5000u, 100000u}) {
        // Sides 45 degrees off the axis: across the tip normals bend 90 degrees.
        MeshDesc mesh = cone(n, 1);
        const auto start = std::chrono::steady_clock::now();
        smoothByAngle(mesh, 120);
        const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - start;
        checkNormal(mesh, 0, 2, {0, 0, 1});
        checkNormal(mesh, n / 2, 2, {0, 0, 1});
        // Pairs of 100000 would take minutes. 0.1 s measured.
        CHECK_INFO(seconds.count() < 20, n << " took " << seconds.count());
        // Within 30 degrees, the mean of those around: along the side, in the plane of symmetry,
        // but for the steps.
        smoothByAngle(mesh, 30);
        const Vec3d mean = toDouble(normalAt(mesh, n / 8, 2));
        CHECK_INFO(length(mean - flatNormal(mesh, n / 8)) < (n > 512 ? 0.2 : 0.05),
                   n << ": " << mean.x << ' ' << mean.y << ' ' << mean.z);
    }
}

// Points are smoothed in parts by several threads; numbers and bits of the normals are the same.
TEST(smooth_normals_do_not_depend_on_threads) {
    constexpr std::uint32_t kSide = 150; // 22500 points: three parts
    std::mt19937 random(11);
    const auto upTo = [&](double most) {
        return std::uniform_real_distribution<double>(0, most)(random);
    };
    MeshDesc mesh;
    for (std::uint32_t i = 0; i < kSide * kSide; ++i)
        mesh.points.push_back({double(i / kSide), double(i % kSide), upTo(2)});
    std::vector<std::uint32_t> groups;
    for (std::uint32_t i = 0; i + kSide + 1 < kSide * kSide; ++i) {
        if (i % kSide == kSide - 1) continue;
        mesh.triangles.push_back({i, i + 1, i + kSide + 1});
        mesh.triangles.push_back({i, i + kSide + 1, i + kSide});
        const auto group = static_cast<std::uint32_t>(upTo(3));
        groups.insert(groups.end(), {group, group});
    }
    const auto smoothed = [&](double angle, int threads) {
        MeshDesc out = mesh;
        if (angle > 0)
            smoothByAngle(out, angle, threads);
        else
            smoothByGroup(out, groups, threads);
        return out;
    };
    for (const double angle : {0.0, 40.0, 180.0}) {
        const MeshDesc one = smoothed(angle, 1);
        CHECK_INFO(one.normals.size() >= kSide * kSide, one.normals.size());
        // One normal for each point, numbered as these are.
        CHECK_INFO((one.normalTriangles == one.triangles) == (angle == 180), angle << " degrees");
        for (const int threads : {2, 5})
            CHECK_INFO(smoothed(angle, threads) == one, angle << " degrees, " << threads);
    }
}

} // namespace test_smooth_normals
