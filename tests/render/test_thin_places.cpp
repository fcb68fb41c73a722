// Places with things that few samples of a pixel may miss.
#include "base/text.h"
#include "check.h"
#include "render/thin_places.h"
#include "shot.h"
#include "verify/meshes.h"

#include <cmath>

namespace test_thin_places {

using meshes::Random;

namespace {

constexpr int kWidth = 96, kHeight = 64;
constexpr double kPixel = 36.0 / 35 / kWidth; // at depth 1

// A camera at the origin that looks along +y.
std::string camera() {
    return "settings {\n resolution 96 64\n}\ncamera c {\n look_at 0 0 0  0 1 0  0 0 1\n lens 35\n"
           " sensor 36 24\n}\n";
}
Vec3d placeAt(Vec2d pixel, double depth) {
    return {(pixel.x - kWidth / 2.0) * kPixel * depth, depth,
            (kHeight / 2.0 - pixel.y) * kPixel * depth};
}
std::string numbers(Vec3d v) { return cat(v.x, " ", v.y, " ", v.z); }

ThinPlaces placesOf(const std::string& text, double reach = 0.75) {
    RenderSettings settings;
    const SceneDesc desc = shot::parse(text);
    settings.picture = desc.settings;
    const Scene scene(desc, {"test.txt", ""}, settings);
    return {scene, kWidth, kHeight, reach};
}
int markedOf(const ThinPlaces& places) {
    int marked = 0;
    for (int row = 0; row < places.rows(); ++row)
        for (int column = 0; column < places.columns(); ++column)
            marked += places.samples(column, row) > 1;
    return marked;
}
std::uint16_t samplesAt(const ThinPlaces& places, Vec2d pixel) {
    return places.samples(static_cast<int>(pixel.x / 4), static_cast<int>(pixel.y / 4));
}
// So many that a disk of an eighth of a pixel has a cell of the net in it, and twelve samples meet what is longer.
double wanted(double width, double length) {
    return std::min(1024.0, 12 / (width * std::min(length, 2.0)));
}

// A box or a tube along a random direction in the picture: half of its sides in pixels.
std::string turned(const std::string& kind, Random& random, Vec3d at, double depth, Vec2d half) {
    const double angle = random.uniform(0, 360), across = half.x * kPixel * depth,
                 along = half.y * kPixel * depth;
    return cat(kind, " body {\n translate ", numbers(at), "\n rotate ", angle, " 0 1 0\n scale ",
               across, " ", across, " ", along, "\n}\n");
}

} // namespace

// A thousand random placements of bodies and lone triangles from an eighth of a pixel on: the place
// where each is seen has the samples that are sure to meet it.
TEST(thin_places_find_an_eighth_of_a_pixel) {
    Random random(91);
    int missed = 0;
    for (int i = 0; i < check::scaled(1000); ++i) {
        const Vec2d pixel{random.uniform(3, kWidth - 3), random.uniform(3, kHeight - 3)};
        const double depth = std::exp2(random.uniform(-2, 8)), width = random.uniform(0.125, 0.9);
        const Vec3d at = placeAt(pixel, depth);
        const double radius = 0.5 * width * kPixel * depth,
                     length = random.uniform(0.5, 20) * width;
        std::string body;
        switch (i % 4) {
        case 0:
            body = cat("sphere s {\n radius ", radius, "\n translate ", numbers(at), "\n}\n");
            break;
        case 1: body = turned("cylinder", random, at, depth, {width / 2, length / 2}); break;
        case 2: body = turned("cube", random, at, depth, {width / 2, length / 2}); break;
        default: { // five of them, so that they are no facets
            body = "mesh m {\n points 15\n";
            const double side = 0.5 * width * kPixel * depth;
            for (int t = 0; t < 5; ++t) {
                const Vec3d p = t == 0 ? at : placeAt({-9.0 - t, 5}, depth);
                for (const Vec3d corner : {Vec3d{-side, 0, -side}, {side, 0, -side}, {0, 0, side}})
                    body += numbers(p + corner) + "\n";
            }
            body += " triangles 5\n";
            for (int t = 0; t < 5; ++t) body += cat(3 * t, " ", 3 * t + 1, " ", 3 * t + 2, "\n");
            body += "}\ninstance i {\n mesh m\n}\n";
        }
        }
        const ThinPlaces places = placesOf(camera() + body);
        // Beside the middle of the picture the depth of a box is seen as well.
        const bool hasDepth = i % 4 == 1 || i % 4 == 2;
        const double seen = hasDepth ? 1.6 : 1;
        if (samplesAt(places, pixel) >= wanted(seen * width, seen * (hasDepth ? length : width))) continue;
        if (++missed <= 3)
            CHECK_INFO(false, i << ": width " << width << " at " << pixel.x << " " << pixel.y
                                << " has " << samplesAt(places, pixel) << " samples\n"
                                << body);
    }
    CHECK_EQUAL(missed, 0);
}

// What is large is left alone, and so is a fine mesh but for where it is thin.
TEST(thin_places_leave_large_things_alone) {
    CHECK_EQUAL(markedOf(placesOf(camera())), 0);
    CHECK_EQUAL(markedOf(placesOf(camera() + "sphere s {\n radius 1\n translate 0 9 0\n}\n")), 0);
    CHECK_EQUAL(markedOf(placesOf(camera() + "cube c {\n translate 0 9 0\n}\n")), 0);
    const std::string behind = "sphere s {\n radius 0.01\n translate 0 -9 0\n}\n";
    CHECK_EQUAL(markedOf(placesOf(camera() + behind)), 0);
    // A grid of 60 x 60 squares, each of a third of a pixel.
    constexpr int kSide = 60;
    const double step = kPixel * 10 / 3;
    std::string mesh = cat("mesh m {\n points ", (kSide + 1) * (kSide + 1), "\n");
    for (int y = 0; y <= kSide; ++y)
        for (int x = 0; x <= kSide; ++x)
            mesh += cat((x - kSide / 2) * step, " 10 ", (y - kSide / 2) * step, "\n");
    mesh += cat(" triangles ", 2 * kSide * kSide, "\n");
    for (int y = 0; y < kSide; ++y)
        for (int x = 0; x < kSide; ++x) {
            const int a = y * (kSide + 1) + x, b = a + kSide + 1;
            mesh += cat(a, " ", a + 1, " ", b, "\n", a + 1, " ", b + 1, " ", b, "\n");
        }
    mesh += "}\ninstance i {\n mesh m\n}\n";
    CHECK_EQUAL(markedOf(placesOf(camera() + mesh)), 0);
}

// A wire across the picture is marked along all of its way, and no more than two blocks beside it.
TEST(thin_places_follow_a_wire) {
    const ThinPlaces places = placesOf(
        camera() + cat("cylinder c {\n translate 0 10 0\n rotate 45 0 1 0\n scale ", kPixel, " ",
                       kPixel, " 100\n}\n"));
    for (int i = 1; i < kHeight - 1; ++i)
        CHECK_EQUAL(samplesAt(places, {(kWidth - kHeight) / 2.0 + i, kHeight - 1.0 - i}), 32);
    CHECK(markedOf(places) <= 16 * 4);
}

} // namespace test_thin_places
