// Textures, bump and normal maps, and the environment, pixel by pixel.
#include "check.h"
#include "shot.h"

#include <filesystem>

namespace test_textures {

namespace {

namespace fs = std::filesystem;

Rgb pattern(int x, int y) { // 4x4, y from the bottom
    return {static_cast<float>(x * 4 + y) / 16, static_cast<float>((x * 7 + y * 3) % 5) / 4,
            static_cast<float>(y) / 3};
}
// What the format's README says a texture is at (s, t), written anew: colours count as they cover,
// and what `clip` cuts off covers nothing.
Vec3d lookup(double s, double t, const std::string& extension, bool nearest) {
    const auto covers = [&](int x, int y) {
        return extension != "clip" || (x >= 0 && x <= 3 && y >= 0 && y <= 3);
    };
    const auto texel = [&](int x, int y) -> Vec3d {
        const auto wrap = [&](int i) {
            return extension == "repeat" ? ((i % 4) + 4) % 4 : std::min(std::max(i, 0), 3);
        };
        const Rgb c = pattern(wrap(x), wrap(y));
        return covers(x, y) ? Vec3d{double{c.r}, double{c.g}, double{c.b}} : Vec3d{};
    };
    if (nearest)
        return texel(static_cast<int>(std::floor(s * 4)), static_cast<int>(std::floor(t * 4)));
    const double x = s * 4 - 0.5, y = t * 4 - 0.5;
    const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
    Vec3d sum;
    double weights = 0;
    for (const int di : {0, 1})
        for (const int dj : {0, 1}) {
            const double weight = (di == 1 ? x - i : i + 1 - x) * (dj == 1 ? y - j : j + 1 - y);
            sum += texel(i + di, j + dj) * weight;
            weights += covers(i + di, j + dj) ? weight : 0;
        }
    return weights > 0 ? sum / weights : Vec3d{};
}

// A plane [-1,1]^2 under a sun along `light`, whose material has the lines `material`.
Image lit(const std::string& material, const std::string& light, const std::string& textures,
          int pixels = 8) {
    const shot::TopView view{.pixels = pixels};
    return shot::render(view.text() + textures + "material m {\n diffuse 0.5 0.5 0.5\n" + material +
                        "}\nplane p {\n material m\n}\nlight l {\n type sun\n look_at " + light +
                        "  0 0 0  0 1 0\n}\n")
        .color;
}
double lambert(Vec3d n, Vec3d l) {
    return 0.5 / kPi * std::max(dot(normalize(n), normalize(l)), 0.0);
}

} // namespace

// Every extension and interpolation, three periods of the picture, turned and moved: 1e-5, as uv
// are floats that are multiplied by 3 and by the texture's slope of 4 per unit.
TEST(texturePixels) {
    shot::writeTexture("pattern.pfm", 4, 4, [](double u, double v) {
        return pattern(static_cast<int>(u * 4), static_cast<int>(v * 4));
    });
    const shot::TopView view{.pixels = 37};
    for (const std::string extension : {"repeat", "extend", "clip"})
        for (const bool nearest : {true, false}) {
            const Image image =
                shot::render(view.text() + "texture t {\n file pattern.pfm\n extension " +
                             extension + "\n interpolation " + (nearest ? "nearest" : "bilinear") +
                             "\n scale 3 3\n rotation 20\n offset -0.6 -1.3\n}\n"
                             "material m {\n diffuse 0 0 0\n emission 1 1 1\n emission_texture "
                             "t\n}\nplane p {\n material m\n}\n")
                    .color;
            int wrong = 0;
            for (int y = 0; y < 37; ++y)
                for (int x = 0; x < 37; ++x) {
                    const Vec2d p = view.place(x, y);
                    const double u = 3 * (p.x + 1) / 2, v = 3 * (p.y + 1) / 2;
                    const double c = std::cos(radians(20)), s = std::sin(radians(20));
                    const Vec3d wanted =
                        lookup(c * u - s * v - 0.6, s * u + c * v - 1.3, extension, nearest);
                    const Rgb is = image.pixel(x, y);
                    wrong +=
                        maxAbs(Vec3d{is.r - wanted.x, is.g - wanted.y, is.b - wanted.z}) > 1e-5;
                }
            CHECK_INFO(wrong == 0, wrong << " pixels with " << extension << nearest);
        }
}

// 8-bit files: whole codes, decoded from sRGB after filtering, or taken as they are. Row 0 is the
// top.
TEST(textureFilesOfEightBits) {
    Image image(2, 2);
    image.setPixel(0, 0, {1, 0, 0}), image.setPixel(1, 0, {0, 1, 0}),
        image.setPixel(0, 1, {0, 0, 1});
    image.setPixel(1, 1, {0.5f, 0.5f, 0.5f});
    for (const std::string file : {"four.ppm", "four.png"}) {
        image.write(shot::textureFolder() + "/" + file,
                    {Encoding::Transfer::Linear, 8}); // 0.5 -> 128
        for (const bool srgb : {true, false}) {
            const shot::TopView view{.pixels = 2};
            const Image out = shot::render(view.text() + "texture t {\n file " + file +
                                           "\n space " + (srgb ? "srgb" : "linear") +
                                           "\n interpolation nearest\n}\nmaterial m {\n diffuse 0 "
                                           "0 0\n emission 1 1 1\n emission_texture t\n}\n"
                                           "plane p {\n material m\n}\n")
                                  .color;
            CHECK((out.pixel(0, 0) == Rgb{1, 0, 0} && out.pixel(1, 0) == Rgb{0, 1, 0} &&
                   out.pixel(0, 1) == Rgb{0, 0, 1}));
            const double code = 128.0 / 255;
            CHECK_NEAR(out.pixel(1, 1).r, srgb ? std::pow((code + 0.055) / 1.055, 2.4) : code,
                       1e-6);
        }
    }
}

// A file of any other format is what a PFM of the same values is: as texture and as environment.
TEST(texturesOfEveryFormat) {
    for (const std::string file :
         {"jpeg/420_progressive.jpg", "jpeg/grey_baseline.jpg", "tga/t02_24_a0_m00_f000_o1_s.tga",
          "tga/t01_08_a0_m24_f000_o0_pillow.tga", "hdr/oiio_rle.hdr", "hdr/old_code.hdr",
          "exr/piz_half_tiles.exr", "exr/zip_float_lines.exr", "exr/layers_order.exr"}) {
        const std::string path = cat("tests/scenes/", file);
        Image(path, Encoding::Transfer::Linear).write(shot::textureFolder() + "/same.pfm");
        const auto rendered = [](const std::string& name, const std::string& use) {
            return shot::render(cat("settings {\n resolution 40 40\n samples 1\n}\ncamera c {\n "
                                    "look_at 0 0 3  0 0 0  0 1 0\n}\ntexture t {\n file \"",
                                    name, "\"\n space linear\n}\n", use))
                .color;
        };
        for (const std::string use :
             {"material m {\n emission 1 1 1\n emission_texture t\n}\nplane p {\n material m\n}\n",
              "world {\n background 1 1 1\n environment t\n}\n"
              "material m {\n mirror 1 1 1\n}\nsphere s {\n material m\n}\n"}) {
            const Image is = rendered(fs::absolute(path).string(), use);
            const Image wanted = rendered("same.pfm", use);
            // Codes of 8 bits are filtered before they are decoded: 1e-6.
            float most = 0, brightest = 0;
            for (std::size_t i = 0; i < is.pixels().size(); ++i) {
                const Rgb a = is.pixels()[i], b = wanted.pixels()[i];
                most = max(most, maxChannel({std::fabs(a.r - b.r), std::fabs(a.g - b.g),
                                             std::fabs(a.b - b.b)}));
                brightest = max(brightest, maxChannel(b));
            }
            CHECK_INFO(most <= 1e-6f * brightest, file << ": " << most << " of " << brightest);
            CHECK_INFO(!(is.pixel(20, 20) == is.pixel(13, 25)), file << ": one colour");
        }
    }
}

// Textures multiply diffuse and specular alike.
TEST(texturesMultiplyMaterials) {
    shot::writeTexture("grey.pfm", 1, 1, [](double, double) { return Rgb{0.25f, 0.5f, 0.75f}; });
    const std::string texture = "texture t {\n file grey.pfm\n}\n";
    const std::string light = "0.3 0.2 2";
    const Rgb plain = lit(" specular 1 1 1\n exponent 3\n", light, "").pixel(4, 4);
    const Rgb both = lit(" specular 1 1 1\n exponent 3\n diffuse_texture t\n specular_texture t\n",
                         light, texture)
                         .pixel(4, 4);
    CHECK_RGB(both, (Vec3d{plain.r * 0.25, plain.g * 0.5, plain.b * 0.75}), 3e-7);
}

TEST(flatNormalAndBumpMapsChangeNothing) {
    shot::writeTexture("flat.pfm", 3, 3, [](double, double) { return Rgb{0.5f, 0.5f, 1}; });
    const std::string texture = "texture t {\n file flat.pfm\n}\n", light = "1 2 3";
    const Image plain = lit("", light, "");
    for (const std::string map :
         {" normal_map t\n", " bump_map t\n", " bump_map t\n normal_map t\n"})
        CHECK_EQUAL(shot::differingPixels(lit(map, light, texture), plain), 0);
}

// A height that rises by `slope` along u or v tilts the normal to (-dh/dx, -dh/dy, 1): the plane is
// 2 wide, so dh/dx is half of dh/du. Relative 2e-6: the slope is a difference of two floats.
TEST(constantSlopesTiltTheNormal) {
    for (const Vec2d slope : {Vec2d{1, 0}, Vec2d{0, 1}, Vec2d{0.75, -0.5}}) {
        shot::writeTexture("ramp.pfm", 64, 64, [&](double u, double v) {
            const float h = static_cast<float>(2 + slope.x * u + slope.y * v);
            return Rgb{h, h, h};
        });
        for (const double height : {0.5, -1.5}) {
            const Image image =
                lit(cat(" bump_map t\n bump_strength ", height, "\n bump_distance 0.5\n"), "1 2 3",
                    "texture t {\n file ramp.pfm\n}\n");
            const Vec3d n{-slope.x / 2 * height * 0.5, -slope.y / 2 * height * 0.5, 1};
            // 64 texels: the heights of 2 to 3 have errors of 2e-7, their difference 1e-5 of 1/64.
            for (int i = 0; i < 64; ++i)
                CHECK_NEAR(image.pixel(i % 8, i / 8).r, lambert(n, {1, 2, 3}),
                           2e-5 * lambert(n, {1, 2, 3}));
        }
    }
}

// On a plane that is mirrored in x the height rises the other way, and the front stays the front.
TEST(bumpsOnMirroredPlanes) {
    shot::writeTexture("rise.pfm", 64, 1, [&](double u, double) {
        const float h = static_cast<float>(2 + u);
        return Rgb{h, h, h};
    });
    const shot::TopView view{.pixels = 1};
    for (const double side : {1.0, -1.0}) {
        const float radiance =
            shot::render(view.text() +
                         "texture t {\n file rise.pfm\n}\nmaterial m {\n diffuse 0.5 0.5 0.5\n "
                         "bump_map t\n}\n" +
                         cat("plane p {\n scale ", side, " 1 1\n material m\n}\n") +
                         "light l {\n type sun\n look_at 1 2 3  0 0 0  0 1 0\n}\n")
                .at(0, 0)
                .r;
        CHECK_NEAR(radiance, lambert({-0.5 * side, 0, 1}, {1, 2, 3}), 1e-5);
    }
}

// A normal that points into the surface is none: the surface's own holds.
TEST(normalMapsThatPointInwardChangeNothing) {
    shot::writeTexture("inward.pfm", 1, 1, [](double, double) { return Rgb{0.9f, 0.5f, 0.1f}; });
    const std::string texture = "texture t {\n file inward.pfm\n space linear\n}\n",
                      light = "1 2 3";
    CHECK_EQUAL(shot::differingPixels(lit(" normal_map t\n", light, texture), lit("", light, "")),
                0);
}

TEST(normalMapTiltsTheNormal) {
    const Vec3d n = normalize(Vec3d{0.3, -0.4, 1});
    const auto code = [](double x) { return static_cast<float>(0.5 + 0.5 * x); };
    shot::writeTexture("tilt.pfm", 1, 1, [&](double, double) {
        return Rgb{code(n.x), code(n.y), code(n.z)};
    });
    const std::string texture = "texture t {\n file tilt.pfm\n space linear\n}\n";
    CHECK_NEAR(lit(" normal_map t\n", "1 2 3", texture).pixel(3, 3).r, lambert(n, {1, 2, 3}), 1e-6);
    const Vec3d half = Vec3d{0, 0, 1} * 0.5 + n * 0.5;
    CHECK_NEAR(lit(" normal_map t\n normal_strength 0.5\n", "1 2 3", texture).pixel(3, 3).r,
               lambert(half, {1, 2, 3}), 1e-6);
    // Turned by 90 degrees the map turns along; mirrored in x, u runs the other way.
    const auto placed = [&](const std::string& how) {
        const shot::TopView view{.pixels = 1};
        return shot::render(
                   view.text() + texture +
                   "material m {\n diffuse 0.5 0.5 0.5\n normal_map t\n}\n"
                   "plane p {\n" +
                   how + " material m\n}\nlight l {\n type sun\n look_at 1 2 3  0 0 0  0 1 0\n}\n")
            .at(0, 0)
            .r;
    };
    CHECK_NEAR(placed(" rotate 90 0 0 1\n"), lambert({-n.y, n.x, n.z}, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" scale -1 1 1\n"), lambert({-n.x, n.y, n.z}, {1, 2, 3}), 1e-6);
    // Stretched unevenly, the normal is that of the carved plane under the inverse transpose.
    CHECK_NEAR(placed(" scale 1 -3 1\n"), lambert({n.x, -n.y / 3, n.z}, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" scale 2 0.5 1\n"), lambert({n.x / 2, n.y * 2, n.z}, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" scale 1 1 3\n"), lambert({n.x, n.y, n.z / 3}, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" scale 3 3 3\n"), lambert(n, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" rotate 90 0 0 1\n scale 2 0.5 1\n"),
               lambert({-n.y * 2, n.x / 2, n.z}, {1, 2, 3}), 1e-6);
    CHECK_NEAR(placed(" scale 2 0.5 1\n key\n translate 0 0 0.1\n scale 2 0.5 1\n"),
               lambert({n.x / 2, n.y * 2, n.z}, {1, 2, 3}), 1e-6);
}

// The same map on a mesh with texture coordinates of its own.
TEST(mapsOnMeshesFollowTheirCoordinates) {
    const Vec3d n = normalize(Vec3d{0.3, -0.4, 1});
    const auto code = [](double x) { return static_cast<float>(0.5 + 0.5 * x); };
    shot::writeTexture("tilt.pfm", 1, 1, [&](double, double) {
        return Rgb{code(n.x), code(n.y), code(n.z)};
    });
    const shot::TopView view{.pixels = 4};
    const auto mesh = [&](const std::string& uvs, bool twice) {
        return shot::render(
                   view.text() +
                   "texture t {\n file tilt.pfm\n}\nmaterial m {\n diffuse 0.5 0.5 0.5\n "
                   "normal_map t\n}\n"
                   "mesh q {\n points 4\n -1 -1 0 1 -1 0 1 1 0 -1 1 0\n triangles 2\n 0 1 2 0 2 "
                   "3\n uvs 4\n " +
                   uvs +
                   "\n uv_triangles 2\n 0 1 2 0 2 3\n}\ninstance i {\n mesh q\n material m\n}\n" +
                   (twice ? "instance j {\n translate 0 0 -4\n mesh q\n}\n" : "") +
                   "light l {\n type sun\n look_at 1 2 3  0 0 0  0 1 0\n}\n")
            .at(1, 2)
            .r;
    };
    for (const bool twice : {false, true}) {
        CHECK_NEAR(mesh("0 0 1 0 1 1 0 1", twice), lambert(n, {1, 2, 3}), 1e-6);
        CHECK_NEAR(mesh("0 1 0 0 1 0 1 1", twice), lambert({-n.y, n.x, n.z}, {1, 2, 3}),
                   1e-6); // u along +y, v along -x
        CHECK_NEAR(mesh("1 0 0 0 0 1 1 1", twice), lambert({-n.x, n.y, n.z}, {1, 2, 3}),
                   1e-6); // u along -x
    }
}

// A sky whose colour is its direction, (d + 1) / 2: the six axes and whole pictures, turned or not.
// 2e-4: bilinear between 512 texels around is off by (2 pi / 512)^2 / 8 of the slope, float by
// 1e-7.
TEST(environmentIsWhereItShouldBe) {
    shot::writeTexture("sky.pfm", 512, 256, [](double u, double v) {
        const double around = kTwoPi * (0.5 - u), up = kPi * (v - 0.5);
        const Vec3d d{std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                      std::sin(up)};
        return Rgb{static_cast<float>(0.5 + d.x / 2), static_cast<float>(0.5 + d.y / 2),
                   static_cast<float>(0.5 + d.z / 2)};
    });
    for (const double turn : {0.0, 90.0, -30.0}) {
        const std::string world =
            cat("texture sky {\n file sky.pfm\n}\nworld {\n background 1 0.5 2\n environment sky\n"
                " environment_rotation ",
                turn, "\n}\n");
        const double c = std::cos(radians(turn)), s = std::sin(radians(turn));
        for (const Vec3d d : {Vec3d{1, 0, 0}, Vec3d{-1, 0, 0}, Vec3d{0, 1, 0}, Vec3d{0, -1, 0},
                              Vec3d{0, 0, 1}, Vec3d{0, 0, -1}, Vec3d{3, -2, 1}}) {
            const Rgb pixel =
                shot::render(cat("settings {\n resolution 1 1\n samples 1\n jitter false\n}\n",
                                 world, "camera c {\n look_at 0 0 0  ", d.x, " ", d.y, " ", d.z,
                                 d.x == 0 && d.y == 0 ? "  0 1 0" : "  0 0 1", "\n}\n"))
                    .at(0, 0);
            // The sky turned from +x to +y: in direction d is what was in d turned back.
            const Vec3d unit = normalize(d),
                        back{c * unit.x + s * unit.y, c * unit.y - s * unit.x, unit.z};
            // At the poles the last row holds, half a texel short of them: pi/512 of the slope.
            const double bound = d.x == 0 && d.y == 0 ? 3.1e-3 : 2e-4;
            CHECK_NEAR(pixel.r, 0.5 + back.x / 2, bound);
            CHECK_NEAR(pixel.g, (0.5 + back.y / 2) / 2, bound);
            CHECK_NEAR(pixel.b, (0.5 + back.z / 2) * 2, 2 * bound);
        }
    }
    // A mirror ball shows it too: at the middle of the top view it reflects straight up.
    const shot::TopView view{.pixels = 1, .side = 0.01};
    const Rgb up =
        shot::render(
            view.text() +
            "texture sky {\n file sky.pfm\n}\nworld {\n background 1 1 1\n environment sky\n}\n"
            "material m {\n diffuse 0 0 0\n mirror 1 1 1\n}\nsphere s {\n material m\n}\n")
            .at(0, 0);
    CHECK_NEAR(up.b, 1, 2e-4);
}

} // namespace test_textures
