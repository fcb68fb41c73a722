// Path tracing against closed forms, and against Whitted pictures where both see the same light.
// Closed rooms, and samples of lamps against those of lobes: raytracer verify T23.
#include "check.h"
#include "render/shot.h"

#include "integrate/path_memory.h"
#include "isa/isa.h"
#include "material/ggx.h"

namespace test_path {

namespace {

shot::Tweak path(int diffuseDepth = 64) {
    return [=](RenderSettings& settings) {
        settings.picture.integrator = IntegratorKind::Path;
        settings.picture.maxDepth = settings.picture.diffuseDepth = diffuseDepth;
        settings.picture.glossyDepth = settings.picture.transmissionDepth = 64;
        settings.isa = &bestIsa();
    };
}

// A scene that is seen from above, with a floor of albedo 1/2; all lamps are above the camera.
std::string floorUnder(const std::string& lights, int samples = 64) {
    return cat(shot::TopView{.pixels = 8, .side = 2, .height = 0.5, .samples = samples}.text(),
               "material grey {\n diffuse 0.5 0.5 0.5\n}\n"
               "plane floor {\n scale 20 20 1\n material grey\n}\n",
               lights);
}

} // namespace

// White lobes in an even sky send all of its light on: what stands in it cannot be seen. Facets of
// rough glass and metal keep their light to the precision of their tables, 1 % (test_lobes).
TEST(white_lobes_vanish_in_an_even_sky) {
    struct Row {
        const char* lobe;
        double off;
    };
    for (const Row& row : {Row{"diffuse", 1e-5}, Row{"mirror", 1e-5}, Row{"refraction", 1e-5},
                           Row{"dielectric ior 1.5", 1e-5}, Row{"translucent", 1e-5},
                           Row{"conductor color 1 1 1 roughness 0.6", 0.01},
                           Row{"dielectric ior 1.5 roughness 0.5", 0.02}}) {
        const auto picture =
            shot::render(cat("settings {\n resolution 8 8\n samples 256\n max_depth 64\n}\n"
                             "world {\n background 1 1 1\n}\n"
                             "camera c {\n look_at 0 -3 0  0 0 0  0 0 1\n lens 50\n}\n"
                             "material m {\n lobe ",
                             row.lobe, "\n}\nsphere s {\n material m\n}\n"),
                         path());
        const auto [mean, sigma] = shot::estimate(picture.color);
        CHECK_NEAR(mean, 1.0, 4.5 * sigma + row.off);
    }
}

// A white closed room that shines has 1 for each place that a path meets, however deep it may go.
TEST(paths_keep_limits_of_any_depth) {
    for (const int depth : {254, 255, 300, 1024}) {
        const auto picture =
            shot::render("settings {\n resolution 4 4\n samples 4\n}\n"
                         "camera c {\n look_at 0 0 0  1 0 0  0 0 1\n}\n"
                         "material m {\n diffuse 1 1 1\n emission 1 1 1\n}\nsphere s {\n radius 3\n"
                         " material m\n}\n",
                         path(depth));
        const auto [mean, sigma] = shot::estimate(picture.color);
        CHECK_NEAR(mean, depth + 2, 4.5 * sigma + 1e-4 * depth);
    }
}

// The last ray of a path sees lights and no more, as in Cycles: in a mirror, and through what is not
// opaque.
TEST(last_rays_see_lights) {
    const std::string view =
        "settings {\n resolution 4 4\n samples 256\n}\n"
        "camera c {\n look_at 0 0 3  0 0 0  0 1 0\n fov 20\n}\n"
        "material shine {\n diffuse 1 1 1\n emission 3 3 3\n}\n"
        "material grey {\n diffuse 0.5 0.5 0.5\n}\n"
        "material glance {\n lobe mirror weight 0.5 0.5 0.5\n}\n"
        "material pane {\n diffuse 0 0 0\n opacity 0.25\n}\n"
        "sphere around {\n radius 9\n material shine\n}\n";
    const auto none = [](RenderSettings& settings) {
        path(0)(settings);
        settings.picture.maxDepth = settings.picture.glossyDepth = 0;
    };
    const auto mean = [&](const std::string& shapes) {
        return shot::estimate(shot::render(view + shapes, none).color);
    };
    // The closed form: half of the 3 that the ball around all shines with.
    const auto [mirrored, ofMirrored] = mean("plane p {\n scale 2 2 1\n material glance\n}\n");
    CHECK_NEAR(mirrored, 1.5, 4.5 * ofMirrored + 1e-5);
    const auto [lit, ofLit] = mean("plane p {\n scale 2 2 1\n material grey\n}\n");
    CHECK_NEAR(lit, 1.5, 4.5 * ofLit + 1e-5);
    // Between floor and light there is a pane, which three quarters of the light pass.
    const auto [shaded, ofShaded] =
        mean("plane p {\n scale 2 2 1\n translate 0 0 -1\n material grey\n}\n"
             "sphere s {\n radius 2\n translate 0 0 -1\n material pane\n}\n");
    CHECK_NEAR(shaded, 1.5 * 0.75 * 0.75, 4.5 * ofShaded + 1e-5);
}

// Whatever a picture holds, numbers stay in their range: nothing in a white sky is brighter than
// the sky, and nothing shines darkness.
TEST(pictures_keep_numbers_in_range) {
    for (const float texel : {5.0f, -1.0f}) {
        shot::writeTexture("out_of_range.pfm", 2, 2, [=](double, double) {
            return Rgb{texel, texel, texel};
        });
        for (const char* const words :
             {"lobe oren_nayar color 1 1 1 times t", "lobe schlick_mirror color 1 1 1 times t",
              "lobe dielectric reflect_tint 1 1 1 times t roughness 0.5",
              "lobe dielectric transmit_tint 1 1 1 times t", "lobe diffuse weight 1 1 1 times t",
              "lobe coat tint 1 1 1 times t covers\n lobe diffuse",
              "diffuse 1 1 1\n opacity_texture t", "emission 1 1 1\n emission_texture t"})
            for (const bool isPath : {true, false}) {
                const bool shines = std::string(words).find("emission") == 0;
                const auto picture =
                    shot::render(cat("settings {\n resolution 4 4\n samples 64\n max_depth 32\n}\n"
                                     "world {\n background 1 1 1\n environment_lights true\n}\n"
                                     "camera c {\n look_at 0 -3 0  0 0 0  0 0 1\n lens 50\n}\n"
                                     "texture t {\n file \"out_of_range.pfm\"\n}\nmaterial m {\n ",
                                     words, "\n}\nsphere s {\n material m\n}\n"),
                                 isPath ? path() : shot::Tweak{});
                double sum = 0;
                for (int i = 0; i < 16; ++i) {
                    const float r = picture.at(i % 4, i / 4).r;
                    sum += static_cast<double>(r);
                    CHECK_INFO(r >= 0, words << ": " << r);
                }
                if (!shines) CHECK_INFO(sum / 16 < 1.05, words << ": " << sum / 16);
            }
    }
}

// A floor under each kind of lamp has the radiance that Whitted pictures have: paths of no bounce
// see the same light. Means over all pixels; those of both are random.
TEST(paths_and_whitted_pictures_see_the_same_lamps) {
    for (const std::string lamp :
         {" translate 0.3 0.2 1.5\n color 2 2 2\n", " translate 0.3 0.2 1.5\n radius 0.4\n",
          " type spot\n translate 0 0 2\n cone_angle 60\n", " type sun\n angle 30\n",
          " type rectangle\n translate 0.5 0 1\n size 2 1\n",
          " type rectangle\n translate 0.5 0 1\n size 2 1\n visible true\n spread 90\n",
          " type disk\n translate 0.5 0 1\n size 2 1\n",
          " type sphere\n translate 0.5 0 1.5\n radius 0.7\n"}) {
        const std::string text = floorUnder(cat("light l {\n", lamp, "}\n"), 256);
        const auto whitted = shot::render(text);
        const auto traced = shot::render(text, path(0));
        double squares = 0, sum = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const double d = static_cast<double>(traced.at(x, y).r) -
                                 static_cast<double>(whitted.at(x, y).r);
                sum += d, squares += d * d;
            }
        const double sigma = std::sqrt(squares / 64 / 64);
        CHECK_NEAR(sum / 64, 0.0, 4.5 * sigma + 2e-5 * shot::estimate(whitted.color).mean);
    }
}

// The mean of a floor under lamps, by paths of no bounce.
static double floorByPaths(const std::string& lamp, const shot::Tweak& more = {}) {
    return shot::estimate(shot::render(floorUnder(lamp, 256),
                                       [&](RenderSettings& settings) {
                                           path(0)(settings);
                                           if (more) more(settings);
                                       })
                              .color)
        .mean;
}

// A lamp's light is counted once, whether its body can be met or not, where it casts no shadows and
// where it is asked in its centre alone. Direct light is not clamped as indirect light is.
TEST(paths_count_lamps_once) {
    const std::string lamp = "light l {\n type rectangle\n translate 0.5 0 1\n size 2 1\n";
    const double shades = floorByPaths(lamp + "}\n");
    // Means of 16,384 samples each, of a relative deviation below 1.
    CHECK_NEAR(floorByPaths(lamp + " shadows false\n}\n"), shades, 0.02 * shades);
    CHECK_NEAR(floorByPaths(lamp + " shadows false\n visible true\n}\n"), shades, 0.02 * shades);
    const auto inCentre = [](RenderSettings& settings) { settings.switches.softShadows = false; };
    const double hard = floorByPaths(lamp + " visible true\n}\n", inCentre);
    CHECK_NEAR(hard, shot::estimate(shot::render(floorUnder(lamp + "}\n"), inCentre).color).mean,
               1e-5 * hard);
    const auto clamped = [](RenderSettings& settings) { settings.picture.clampIndirect = 1e-4; };
    CHECK_EQUAL(floorByPaths(lamp + "}\n", clamped), shades);
}

// The body of a lamp hides other lamps from shadow rays as it does from rays of lobes, whichever
// side of it they meet; otherwise weights of the two would decide what is seen.
TEST(paths_find_nothing_behind_bodies_of_lamps) {
    const std::string behind = "light b {\n type disk\n translate 0 0 9\n color 1e4 1e4 1e4\n}\n";
    const std::string dim = "light a {\n visible true\n color 1 1 1\n";
    for (const std::string type : {"rectangle", "disk"}) {
        const std::string above = cat(" type ", type, "\n size 30 30\n translate 0 0 1\n");
        CHECK_EQUAL(floorByPaths(cat(dim, above, " rotate 180 1 0 0\n}\n", behind)), 0.0);
        const std::string down = cat(dim, above, "}\n");
        const double alone = floorByPaths(down);
        CHECK_NEAR(floorByPaths(down + behind), alone, 0.02 * alone);
    }
    const std::string ball = dim + " type sphere\n translate 0 0 4\n radius 3\n}\n";
    const double alone = floorByPaths(ball);
    CHECK_NEAR(floorByPaths(ball + behind), alone, 0.02 * alone);
}

// At the last bounce of a Whitted picture samples of lamps have all of the light that rays of rough
// lobes would find otherwise.
TEST(rough_metal_keeps_its_highlight_at_the_last_bounce) {
    const auto highlight = [](int depth) {
        return shot::estimate(
            shot::render(cat("settings {\n resolution 8 8\n samples 1024\n max_depth ", depth,
                             "\n cutoff 0\n}\n"
                             "camera c {\n look_at 0 -1 1  0 0 0  0 0 1\n lens 50\n}\n"
                             "material m {\n lobe conductor color 1 1 1 roughness 0.5\n}\n"
                             "plane p {\n scale 9 9 1\n material m\n}\n"
                             "light l {\n type sphere\n translate 0 1 1\n radius 0.4\n}\n"))
                .color);
    };
    const auto alone = highlight(0), together = highlight(1);
    CHECK(alone.mean > 0.1);
    CHECK_NEAR(alone.mean, together.mean, 0.01 * together.mean);
}

// What paths leave out of a scene is said.
TEST(paths_say_that_they_have_no_ambient_light) {
    const SceneDesc desc = shot::parse("world {\n ambient 1 1 1\n}\ncamera c {\n}\n");
    RenderSettings settings;
    settings.picture = desc.settings;
    for (const auto integrator : {IntegratorKind::Whitted, IntegratorKind::Path}) {
        settings.picture.integrator = integrator;
        const Scene scene(desc, SourceFile{"scene.txt", ""}, settings);
        CHECK_EQUAL(scene.warnings().size(), integrator == IntegratorKind::Path ? 1u : 0u);
    }
}

// Eight lobes that are written, and those that short keywords mean besides.
TEST(short_keywords_add_to_eight_lobes) {
    std::string material = "material m {\n";
    for (int i = 0; i < 8; ++i) material += " lobe diffuse weight 0.05 0.05 0.05\n";
    const std::string rest = "plane floor {\n scale 20 20 1\n material m\n}\n"
                             "light l {\n type sun\n color 3.14159265 3.14159265 3.14159265\n}\n";
    const auto radiance = [&](const std::string& more) {
        return shot::render(cat(shot::TopView{.pixels = 1}.text(), material, more, "}\n", rest))
            .at(0, 0);
    };
    CHECK_RGB(radiance(""), (Vec3d{0.4, 0.4, 0.4}), 1e-6);
    CHECK_RGB(radiance(" diffuse 0.1 0.2 0.3\n mirror 0.1 0.1 0.1\n transmission 0.1 0.1 0.1\n"
                       " specular 0.01 0.01 0.01\n"),
              (Vec3d{0.5 + 0.01 * kPi, 0.6 + 0.01 * kPi, 0.7 + 0.01 * kPi}), 1e-5);
}

// A surface that shines lights as the lamp of its form does, sampled or met by chance; so it does
// on a floor whose bent normals lift the origins of shadow rays.
TEST(shining_surfaces_light_as_lamps_do) {
    struct Pair {
        const char *lamp, *surface;
    };
    for (const Pair& pair :
         {Pair{"light l {\n type sphere\n translate 0.5 0 1.5\n radius 0.3\n color 5 5 5\n}\n",
               "sphere s {\n translate 0.5 0 1.5\n radius 0.3\n material lamp\n}\n"},
          Pair{"light l {\n type rectangle\n translate 0.5 0 1\n size 1 1\n color 5 5 5\n}\n",
               "plane s {\n translate 0.5 0 1\n rotate 180 1 0 0\n scale 0.5 0.5 1\n"
               " material lamp\n}\n"},
          Pair{"light l {\n type disk\n translate 0.5 0 1\n size 1 1\n color 5 5 5\n}\n",
               "disk s {\n translate 0.5 0 1\n rotate 180 1 0 0\n radius 0.5\n"
               " material lamp\n}\n"},
          // A map that mirrors leaves the side that shines where it is.
          Pair{"light l {\n type rectangle\n translate 0.5 0 1\n size 1 1\n color 5 5 5\n}\n",
               "plane s {\n translate 0.5 0 1\n rotate 180 1 0 0\n scale -0.5 0.5 1\n"
               " material lamp\n}\n"},
          Pair{"light l {\n type disk\n translate 0.5 0 1\n size 1 1\n color 5 5 5\n}\n",
               "disk s {\n translate 0.5 0 1\n scale 1 -1 -1\n rotate 180 0 0 1\n radius 0.5\n"
               " material lamp\n}\n"},
          Pair{"light l {\n type rectangle\n translate 0.5 0 1\n size 1 1\n color 5 5 5\n}\n",
               "mesh square {\npoints 4\n-0.5 -0.5 0\n0.5 -0.5 0\n0.5 0.5 0\n-0.5 0.5 0\n"
               "triangles 2\n0 2 1\n0 3 2\n}\n"
               "instance s {\n translate 0.5 0 1\n mesh square\n material lamp\n}\n"}}) {
        const std::string material =
            "material lamp {\n diffuse 0 0 0\n emission 5 5 5\n emission_sides front\n}\n";
        // From below the camera sees no lamp: all are above it.
        const std::string view = "settings {\n resolution 8 8\n samples 256\n}\n"
                                 "camera c {\n look_at -1 -2 0.5  0 0 0  0 0 1\n lens 60\n}\n"
                                 "material grey {\n diffuse 0.5 0.5 0.5\n}\n";
        for (const std::string floor :
             {"plane floor {\n scale 20 20 1\n material grey\n}\n",
              "mesh dome {\npoints 4\n-20 -20 0\n20 -20 0\n20 20 0\n-20 20 0\n"
              "triangles 2\n0 1 2\n0 2 3\n"
              "normals 4\n-5e-4 -5e-4 1\n5e-4 -5e-4 1\n5e-4 5e-4 1\n-5e-4 5e-4 1\n}\n"
              "instance floor {\n mesh dome\n material grey\n}\n"}) {
            const auto lamp = shot::render(cat(view, floor, pair.lamp), path(0));
            const auto surface = shot::render(cat(view, floor, material, pair.surface), path(0));
            double squares = 0, sum = 0, all = 0;
            for (int y = 0; y < 8; ++y)
                for (int x = 0; x < 8; ++x) {
                    const double a = static_cast<double>(lamp.at(x, y).r),
                                 b = static_cast<double>(surface.at(x, y).r);
                    sum += b - a, squares += (b - a) * (b - a), all += a;
                }
            CHECK(all > 1);
            CHECK_NEAR(sum / 64, 0.0, 4.5 * std::sqrt(squares) / 64 + 1e-4 * all / 64);
        }
    }
}

// Each number of a lobe may be multiplied by pictures, and by what pictures leave of 1.
TEST(pictures_multiply_numbers_of_lobes) {
    const auto even = [](double r, double g, double b) {
        return [=](double, double) {
            return Rgb{static_cast<float>(r), static_cast<float>(g), static_cast<float>(b)};
        };
    };
    shot::writeTexture("path_a.pfm", 2, 2, even(0.5, 0.25, 1));
    shot::writeTexture("path_b.pfm", 2, 2, even(0.4, 0.8, 0.2));
    const std::string textures =
        "texture a {\n file \"path_a.pfm\"\n}\ntexture b {\n file \"path_b.pfm\"\n}\n";
    const auto colorOf = [&](const std::string& lobe) {
        return shot::render(cat(shot::TopView{.pixels = 1}.text(), textures, "material m {\n lobe ",
                                lobe, "\n}\nplane floor {\n scale 20 20 1\n material m\n}\n",
                                "light l {\n type sun\n color 3.14159265 3.14159265 "
                                "3.14159265\n}\n"))
            .at(0, 0);
    };
    CHECK_RGB(colorOf("diffuse weight 0.5 0.5 0.5"), (Vec3d{0.5, 0.5, 0.5}), 1e-6);
    CHECK_RGB(colorOf("diffuse weight 0.5 0.5 0.5 times a"), (Vec3d{0.25, 0.125, 0.5}), 1e-6);
    CHECK_RGB(colorOf("diffuse weight 1 1 1 times a without b 0.5"),
              (Vec3d{0.5 * 0.8, 0.25 * 0.6, 0.9}), 1e-6);
    // The grey value of a, of which Oren-Nayar's roughness takes a part.
    const double grey = 0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722;
    const Rgb textured = colorOf("oren_nayar weight 0.5 0.5 0.5 roughness 0.8 times a");
    const Rgb plain = colorOf(cat("oren_nayar weight 0.5 0.5 0.5 roughness ", 0.8 * grey));
    CHECK_NEAR(textured.r, plain.r, 1e-6);
    CHECK(std::fabs(plain.r - 0.5f) > 1e-3f);
}

// A picture of paths has the same bits for every instruction set, number of threads, size of tiles
// and of chunks.
TEST(paths_have_the_same_bits_everywhere) {
    const std::string text =
        cat("settings {\n resolution 24 24\n samples 4\n max_depth 12\n}\n"
            "world {\n background 0.3 0.4 0.6\n}\n"
            "camera c {\n look_at 0 -4 1.5  0 0 0.5  0 0 1\n lens 40\n}\n"
            "material wall {\n diffuse 0.7 0.6 0.5\n}\n"
            "material glass {\n lobe dielectric ior 1.5 roughness 0.2\n}\n"
            "material metal {\n lobe conductor color 0.9 0.8 0.6 roughness 0.3 anisotropy 0.5\n}\n"
            "material car {\n lobe coat roughness 0.1 covers\n lobe oren_nayar roughness 0.5"
            " weight 0.6 0.1 0.1\n}\n"
            "material fur {\n lobe sheen roughness 0.4 covers\n lobe translucent weight 0.4 0.4 0.4"
            "\n lobe diffuse weight 0.4 0.3 0.3\n opacity 0.8\n}\n"
            "material hot {\n emission 4 3 2\n}\n"
            "plane floor {\n scale 6 6 1\n material wall\n}\n"
            "sphere a {\n translate -1.2 0 0.5\n radius 0.5\n material glass\n}\n"
            "sphere b {\n translate 0 0 0.5\n radius 0.5\n material metal\n}\n"
            "sphere d {\n translate 1.2 0 0.5\n radius 0.5\n material car\n}\n"
            "cube e {\n translate 0.6 -1 0.3\n scale 0.3 0.3 0.3\n material fur\n}\n"
            "cylinder f {\n translate -0.8 -1 0.2\n scale 0.2 0.2 0.2\n material hot\n}\n"
            "light l {\n type rectangle\n translate 0 1 3\n size 1 1\n color 6 6 6\n}\n"
            "light s {\n type sun\n rotate 40 1 0 0\n angle 3\n}\n");
    for (const auto integrator : {IntegratorKind::Path, IntegratorKind::Whitted}) {
        const auto as = [&](const Isa& isa, int threads, int tileSide, int chunkSamples) {
            return shot::render(text, [&](RenderSettings& settings) {
                settings.picture.integrator = integrator;
                settings.isa = &isa, settings.threads = threads;
                settings.tileSide = tileSide, settings.chunkSamples = chunkSamples;
            });
        };
        const auto scalar = as(oneLane(), 1, 16, 4096);
        CHECK(shot::estimate(scalar.color).mean > 0.05);
        for (const Isa& isa : allIsas())
            if (isa.supported())
                CHECK_EQUAL(shot::differingPixels(scalar.color, as(isa, 1, 16, 4096).color), 0);
        CHECK_EQUAL(shot::differingPixels(scalar.color, as(bestIsa(), 3, 5, 64).color), 0);
        CHECK_EQUAL(shot::differingPixels(scalar.color, as(oneLane(), 2, 7, 100).color), 0);
    }
}

// Cycles' Filter Glossy: alpha is sqrt(1 - p / R) / 2 behind a bounce of density p, along both
// axes.
TEST(filter_glossy_widens_facets_by_the_least_density) {
    PathState state;
    CHECK_EQUAL(state.leastAlpha(1), 0.0f); // camera rays
    state.leastPdf = 0.36f;
    CHECK_NEAR(state.leastAlpha(1), 0.4, 1e-6);
    CHECK_NEAR(state.leastAlpha(0.48f), 0.25, 1e-6);
    CHECK_EQUAL(state.leastAlpha(0.36f), 0.0f);
    using namespace kernels::one;
    const Ggx narrow(0.4f, 0.8f, 0.25f), wide = narrow.atLeast(0.2f);
    CHECK(narrow.x.v > 0.2f && narrow.y.v < 0.2f);
    CHECK_EQUAL(wide.x.v, narrow.x.v);
    CHECK_EQUAL(wide.y.v, 0.2f);
    CHECK(Ggx(0.0f).smooth.v && Ggx(0.0f).atLeast(0.0f).smooth.v);
    CHECK(!Ggx(0.0f).atLeast(0.2f).smooth.v);
}

namespace {

struct Seen {
    double mean, variance; // of pixels
    Image picture;
};
Seen filtered(const std::string& text, double radius, int bounces) {
    Seen seen{0, 0, shot::render(text, [&](RenderSettings& settings) {
                        path(bounces)(settings);
                        settings.picture.filterGlossy = radius;
                    }).color};
    const auto [mean, sigma] = shot::estimate(seen.picture);
    seen.mean = mean, seen.variance = sigma * sigma;
    return seen;
}

} // namespace

// A sun lights rough metal, and this a ceiling: rays from there meet the highlight now and then.
TEST(filter_glossy_keeps_the_light_and_takes_its_noise) {
    for (const char* const lobe : {"conductor color 1 1 1 roughness 0.3",
                                   "conductor color 1 1 1 roughness 0.35 anisotropy 0.8"}) {
        const std::string room =
            cat("settings {\n resolution 8 8\n samples 4096\n}\n"
                "camera c {\n look_at 0 0 0.5  0 0 1  0 1 0\n lens 50\n}\n"
                "material metal {\n lobe ",
                lobe,
                "\n}\nmaterial grey {\n diffuse 0.5 0.5 0.5\n}\n"
                "infinite_plane floor {\n material metal\n}\n"
                "infinite_plane ceiling {\n translate 0 0 1\n material grey\n}\n"
                "light l {\n type sun\n shadows false\n rotate 30 1 0 0\n}\n");
        const Seen sharp = filtered(room, 0, 1), blurred = filtered(room, 1, 1);
        CHECK(sharp.mean > 0.01);
        CHECK_NEAR(blurred.mean, sharp.mean, 0.02 * sharp.mean);
        CHECK_INFO(sharp.variance > 5 * blurred.variance,
                   sharp.variance << " and " << blurred.variance);
    }
}

// What the camera sees itself stays, and what it sees in a smooth mirror.
TEST(filter_glossy_leaves_first_hits) {
    const std::string metal = floorUnder("light l {\n translate 0.3 0.2 1.5\n}\n") +
                              "material m {\n lobe conductor color 1 1 1 roughness 0.2\n}\n"
                              "sphere s {\n scale 0.2 0.2 0.2\n material m\n}\n";
    CHECK(filtered(metal, 1, 0).picture == filtered(metal, 0, 0).picture);
    CHECK(!(filtered(metal, 1, 4).picture == filtered(metal, 0, 4).picture));
    const std::string inMirror =
        metal + "material mirror {\n lobe mirror\n}\n"
                "plane above {\n translate 0 0 0.3\n scale 9 9 1\n material mirror\n}\n";
    CHECK(filtered(inMirror, 1, 1).picture == filtered(inMirror, 0, 1).picture);
}

} // namespace test_path
