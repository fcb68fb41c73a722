// External truth: Eric Haines' SPD "tetra" at its standard size, whose ray counts are published
// (Readme.txt: 263,169 eye rays, 213,381 of them meet nothing, 46,111 shadow rays).
#include "check.h"
#include "render/render.h"
#include "render/scene.h"

#include <cmath>

namespace {

// Recurses into the four corners of a cube whose signs multiply to +; at the end a tetrahedron on
// those corners, outward.
void addTetra(MeshDesc& mesh, Vec3d centre, double half, int levels) {
    const std::array<Vec3d, 4> corners = {Vec3d{1, 1, 1}, Vec3d{1, -1, -1}, Vec3d{-1, 1, -1},
                                          Vec3d{-1, -1, 1}};
    if (levels > 0) {
        for (const Vec3d c : corners) addTetra(mesh, centre + c * (half / 2), half / 2, levels - 1);
        return;
    }
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    for (const Vec3d c : corners) mesh.points.push_back(centre + c * half);
    for (const auto& t : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}) {
        auto [a, b, c] = t;
        const Vec3d n = cross(mesh.points[first + b] - mesh.points[first + a],
                              mesh.points[first + c] - mesh.points[first + a]);
        if (dot(n, mesh.points[first + a] - centre) < 0) std::swap(b, c);
        mesh.triangles.push_back({first + a, first + b, first + c});
    }
}

} // namespace

TEST(tetraOfSpdHasItsPublishedRays) {
    SceneDesc desc;
    desc.meshes.emplace_back();
    addTetra(desc.meshes[0], {0, 0, 0}, 1, 5);
    CHECK_EQUAL(desc.meshes[0].triangles.size(), 4096u);
    ObjectDesc object;
    object.kind = ObjectDesc::Kind::Mesh;
    object.mesh = 0;
    desc.objects.push_back(object);
    LightDesc light;
    light.worldFromLight = Transform::translate({2, -18, -5}).rows();
    light.color = {300, 300, 300};
    desc.lights.push_back(light);
    // The corners of 512 x 512 pixels, where `angle` spans the centres of first and last pixel: 511
    // steps. Pixel centres of a picture of 513 x 513 whose edges are 513 of these steps apart.
    CameraDesc camera;
    camera.worldFromCamera = {Transform::lookAt({1.02285, -3.17715, -2.17451},
                                                {-0.004103, -0.004103, 0.216539},
                                                {-0.816497, -0.816497, 0.816497})
                                  .rows()};
    camera.lensMm = 1;
    camera.sensorWidthMm = 2 * std::tan(radians(22.5)) * 513 / 511;
    desc.cameras.push_back(camera);
    desc.settings.width = desc.settings.height = 513;
    desc.settings.samplesPerPixel = 1;
    desc.settings.jitter = false;

    RenderSettings settings;
    settings.picture = desc.settings;
    const Scene scene(desc, {"tetra", ""}, settings);
    Stats stats;
    render(scene, settings, {}, stats);
    std::printf("tetra: %llu eye, %llu background, %llu shadow rays\n",
                static_cast<unsigned long long>(stats.rays.camera),
                static_cast<unsigned long long>(stats.rays.camera - stats.cameraHits),
                static_cast<unsigned long long>(stats.rays.shadow));
    CHECK_EQUAL(stats.rays.camera, 263169u);
    // 20 of 263,169: rays along edges, which other programs round otherwise (STYLE 5).
    CHECK_NEAR(static_cast<double>(stats.rays.camera - stats.cameraHits), 213381, 20);
    CHECK_NEAR(static_cast<double>(stats.rays.shadow), 46111, 20);
}
