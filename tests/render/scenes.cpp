#include "scenes.h"

#include "shot.h"
#include "solids.h"

namespace scenes {

namespace {

std::string settings(int samples, const std::string& more = "") {
    return cat("settings {\n resolution 64 48\n samples ", samples, "\n", more, "}\n");
}
const std::string kCamera = "camera c {\n look_at 2 -6 3  0 0 0.7  0 0 1\n";
const std::string kFloor =
    "plane floor {\n scale 6 6 1\n material grey\n}\nmaterial grey {\n diffuse 0.6 0.6 0.55\n}\n";
const std::string kLamp = "light lamp {\n translate -2 -3 5\n color 60 60 55\n}\n";
const std::string kSky = "world {\n background 0.2 0.3 0.5\n ambient 0.05 0.05 0.05\n}\n";
const std::string kRed =
    "material red {\n diffuse 0.7 0.1 0.1\n specular 0.5 0.5 0.5\n exponent 40\n}\n";
const std::string kGlass = "material glass {\n diffuse 0 0 0\n mirror 1 1 1\n transmission 1 0.95 "
                           "0.9\n fresnel dielectric\n ior 1.5\n}\n";

std::string textures() {
    shot::writeTexture("colours.pfm", 8, 8, [](double u, double v) {
        return Rgb{static_cast<float>(u), static_cast<float>(v),
                   static_cast<float>(0.5 + 0.5 * std::floor(8 * u) / 8)};
    });
    shot::writeTexture("waves.pfm", 32, 32, [](double u, double v) {
        const double x = std::fabs(u * 4 - std::floor(u * 4) - 0.5),
                     y = std::fabs(v * 4 - std::floor(v * 4) - 0.5);
        const float h = static_cast<float>(0.5 * (x + y));
        return Rgb{h, h, h};
    });
    shot::writeTexture("tilts.pfm", 8, 8, [](double u, double v) {
        return Rgb{static_cast<float>(0.4 + 0.2 * u), static_cast<float>(0.6 - 0.2 * v), 1};
    });
    shot::writeTexture("sky64.pfm", 64, 32, [](double u, double v) {
        return Rgb{static_cast<float>(0.3 + 0.7 * v), static_cast<float>(0.4 + 0.3 * v),
                   static_cast<float>(0.2 + 0.8 * u * (1 - u) * 4)};
    });
    return "texture colours {\n file colours.pfm\n scale 3 2\n rotation 10\n}\n"
           "texture waves {\n file waves.pfm\n}\ntexture tilts {\n file tilts.pfm\n extension "
           "extend\n}\n"
           "texture sky {\n file sky64.pfm\n}\ntexture holes {\n file colours.pfm\n interpolation "
           "nearest\n}\n";
}

} // namespace

const std::vector<Named>& all() {
    static const std::vector<Named> list = [] {
        const std::string ball = solids::text(solids::ball(3)), box = solids::text(solids::box(1));
        std::vector<Named> out;
        out.push_back(
            {"shapes",
             settings(4) + kCamera + "}\n" + kSky + kFloor + kLamp + kRed + ball +
                 "sphere a {\n translate -2 0 0.6\n radius 0.6\n material red\n}\ncube b {\n "
                 "translate -0.5 1 0.5\n rotate 20 0 0 1\n scale 0.4 0.5 0.5\n}\n"
                 "cylinder d {\n translate 1 0.2 0.6\n scale 0.5 0.4 0.6\n material red\n}\ncone e "
                 "{\n translate 2.2 0.5 0.7\n scale 0.6 0.6 0.7\n top_radius 0.3\n}\n"
                 "disk f {\n translate 0 -1.2 0.4\n rotate 60 1 0 0\n radius 0.5\n material "
                 "red\n}\ninstance g {\n translate 0.7 -1.5 0.4\n scale 0.4 0.4 0.4\n mesh ball\n "
                 "material red\n}\n"
                 "infinite_plane sea {\n translate 0 0 -0.5\n}\n"});
        out.push_back(
            {"instances", settings(4) + kCamera + "}\n" + kSky + kFloor + kLamp + kRed + ball + [] {
                 std::string many;
                 for (int i = 0; i < 12; ++i)
                     many += cat("instance i", i, " {\n translate ", i % 4 - 1.5, " ", i / 4 - 1,
                                 " 0.4\n rotate ", 25 * i, " 1 2 3\n scale ",
                                 i % 3 == 0 ? -0.3 : 0.4, " 0.4 ", 0.2 + 0.02 * i, "\n mesh ball\n",
                                 i % 2 ? " material red\n" : "", "}\n");
                 return many;
             }()});
        out.push_back(
            {"glass", settings(4, " max_depth 10\n") + kCamera + "}\n" + kSky + kFloor + kLamp +
                          kRed + kGlass + box +
                          "material water {\n diffuse 0 0 0\n mirror 1 1 1\n transmission 0.9 0.95 "
                          "1\n fresnel dielectric\n ior 1.33\n}\n"
                          "sphere a {\n translate -1 0 1\n material glass\n}\nsphere inside {\n "
                          "translate -1 0 1\n radius 0.5\n material water\n}\n"
                          "instance b {\n translate 1.3 0.5 0.8\n rotate 30 0 0 1\n scale 0.7 0.7 "
                          "0.7\n mesh box\n material glass\n}\n"
                          "sphere d {\n translate 0.4 -1.5 0.4\n radius 0.4\n material red\n}\n"
                          "material chrome {\n diffuse 0 0 0\n mirror 0.8 0.8 0.8\n fresnel "
                          "schlick\n}\nplane wall {\n translate 0 3 1\n rotate 90 1 0 0\n scale 3 "
                          "1 1\n material chrome\n}\n"});
        out.push_back(
            {"soft",
             settings(8, " light_samples 2\n") + kCamera + "}\n" + kSky + kFloor + kRed +
                 "sphere a {\n translate -1 0 0.8\n radius 0.8\n material red\n}\ncube b {\n "
                 "translate 1.2 0 0.5\n scale 0.5 0.5 0.5\n}\n"
                 "light r {\n type rectangle\n look_at -3 -2 4  0 0 0  0 0 1\n size 1.5 1\n color "
                 "20 20 18\n visible true\n}\n"
                 "light d {\n type disk\n translate 1.5 2 3\n size 1 0.5\n color 12 14 16\n spread "
                 "120\n}\n"
                 "light s {\n type sphere\n translate 3 -1 2\n radius 0.3\n color 30 20 10\n "
                 "visible true\n}\n"
                 "light u {\n type sun\n rotate 50 1 0.3 0\n angle 8\n color 0.5 0.5 0.5\n}\n"
                 "light p {\n type spot\n look_at 0 -4 4  0 0 0  0 0 1\n cone_angle 40\n radius "
                 "0.2\n color 40 40 40\n}\n"});
        out.push_back(
            {"textures",
             settings(4) + kCamera + "}\n" + kLamp + textures() +
                 "world {\n background 1 1 1\n ambient 0.1 0.1 0.1\n environment sky\n "
                 "environment_rotation 40\n}\n"
                 "material coloured {\n diffuse 1 1 1\n diffuse_texture colours\n specular 0.4 0.4 "
                 "0.4\n specular_texture waves\n}\n"
                 "material wavy {\n diffuse 0.7 0.7 0.7\n bump_map waves\n bump_distance "
                 "0.3\n}\nmaterial tilted {\n diffuse 0.7 0.7 0.2\n normal_map tilts\n "
                 "normal_strength 0.8\n}\n"
                 "material chrome {\n diffuse 0.1 0.1 0.1\n mirror 0.8 0.8 0.8\n bump_map waves\n "
                 "bump_distance 0.05\n}\n"
                 "plane floor {\n scale 4 4 1\n material coloured\n}\nsphere a {\n translate -1.5 "
                 "0 0.8\n radius 0.8\n material wavy\n}\n"
                 "cylinder b {\n translate 0.3 0.5 0.7\n scale 0.5 0.5 0.7\n material "
                 "tilted\n}\nsphere d {\n translate 1.7 0 0.8\n radius 0.8\n material chrome\n}\n"
                 "cube e {\n translate 0.3 -1.5 0.4\n scale 0.4 0.4 0.4\n material coloured\n}\n"});
        out.push_back(
            {"transparent",
             settings(4) + kCamera + "}\n" + kSky + kFloor + kLamp + kRed + textures() + ball +
                 "material foil {\n diffuse 0.2 0.2 0.2\n opacity 0.3\n filter 0.9 0.4 "
                 "0.2\n}\nmaterial grid {\n diffuse 0.5 0.5 0.5\n opacity_texture holes\n filter "
                 "0.3 0.5 0.9\n}\n"
                 "plane a {\n translate -1 -1 1\n rotate 80 1 0 0\n scale 0.8 0.8 1\n material "
                 "foil\n}\nsphere b {\n translate 1.2 0 0.8\n radius 0.8\n material grid\n}\n"
                 "instance d {\n translate 0 1 0.8\n scale 0.7 0.7 0.7\n mesh ball\n material "
                 "foil\n}\nsphere e {\n translate -0.5 2.5 0.6\n radius 0.6\n material red\n}\n"
                 "instance f {\n translate 2 -1.5 0.4\n scale 0.3 0.3 0.3\n mesh ball\n material "
                 "foil\n}\n"});
        out.push_back(
            {"motion", settings(16) +
                           "camera c {\n look_at 2 -6 3  0 0 0.7  0 0 1\n key\n look_at 2.05 -6 3  "
                           "0 0 0.7  0 0 1\n}\n" +
                           kSky + kFloor + kLamp + kRed + ball +
                           "sphere a {\n translate -1.5 0 0.5\n scale 0.5 0.5 0.5\n key\n "
                           "translate -0.8 0 0.9\n scale 0.5 0.5 0.5\n material red\n}\n"
                           "cube b {\n translate 1 0.5 0.5\n scale 0.5 0.5 0.5\n key\n translate 1 "
                           "0.5 0.5\n rotate 60 0 0 1\n scale 0.5 0.5 0.5\n}\n"
                           "instance d {\n translate 0.5 -1.5 0.4\n scale 0.4 0.4 0.4\n mesh "
                           "ball\n material red\n key\n translate 0.9 -1.5 0.4\n scale 0.4 0.4 "
                           "0.2\n key\n translate 0.9 -1.2 0.4\n scale 0.4 0.4 0.5\n}\n"});
        out.push_back(
            {"dof", settings(16) + kCamera +
                        " aperture_radius 0.15\n focus_distance 6.5\n aperture_blades 6\n "
                        "aperture_rotation 12\n}\n" +
                        kSky + kFloor + kLamp + kRed +
                        "sphere a {\n translate -1 0 0.6\n radius 0.6\n material red\n}\nsphere b "
                        "{\n translate 1.5 -3 0.5\n radius 0.5\n material red\n}\nsphere d {\n "
                        "translate -0.5 5 1\n material red\n}\n"});
        out.push_back(
            {"glossy",
             settings(16) + kCamera + "}\n" + kSky + kFloor + kLamp + kRed +
                 "material brushed {\n diffuse 0.05 0.05 0.05\n mirror 0.8 0.7 0.5\n roughness "
                 "0.3\n specular 0.5 0.4 0.3\n specular_model ashikhmin\n exponent 60\n}\n"
                 "material frosted {\n diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel "
                 "dielectric\n roughness 0.25\n}\n"
                 "sphere a {\n translate -1 0 0.8\n radius 0.8\n material brushed\n}\nsphere b {\n "
                 "translate 1 -0.5 0.7\n radius 0.7\n material frosted\n}\n"
                 "cube d {\n translate 0.3 1.8 0.7\n scale 0.4 0.4 0.7\n material red\n}\n"});
        out.push_back({"highlights",
                       settings(4, " filter gaussian 1.5\n sampler stratified\n") + kCamera +
                           "}\n" + kFloor + kLamp + kRed +
                           "material as {\n diffuse 0.1 0.2 0.5\n specular 0.5 0.5 0.5\n "
                           "specular_model ashikhmin\n exponent 200\n}\n"
                           "sphere a {\n translate -1 0 0.8\n radius 0.8\n material red\n}\nsphere "
                           "b {\n translate 1 0 0.8\n radius 0.8\n material as\n}\n"
                           "light s {\n type spot\n look_at 3 -3 4  0 0 0  0 0 1\n cone_angle 35\n "
                           "blend 0.5\n color 50 50 60\n}\n"});
        out.push_back(
            {"mirrors",
             settings(4, " max_depth 6\n filter tent 2\n sampler random\n") + kCamera + "}\n" +
                 kSky + kFloor + kLamp + kRed +
                 "material mirror {\n diffuse 0.02 0.02 0.02\n mirror 0.9 0.9 0.95\n}\nsphere a "
                 "{\n translate -0.9 0 0.8\n radius 0.8\n material mirror\n}\n"
                 "sphere b {\n translate 0.9 0.3 0.8\n radius 0.8\n material mirror\n}\ncube d {\n "
                 "translate 0.2 -1.7 0.3\n scale 0.3 0.3 0.3\n material red\n}\n"});
        out.push_back(
            {"ortho",
             settings(4, " filter box 1\n sampler grid\n") +
                 "camera c {\n type orthographic\n ortho_scale 7\n shift 0.05 0.02\n look_at 4 -6 "
                 "5  0 0 0.5  0 0 1\n}\n" +
                 kSky + kFloor + kLamp + kRed + box +
                 "instance a {\n translate -1 0 0.7\n rotate 30 0 0 1\n scale 0.7 0.7 0.7\n mesh "
                 "box\n material red\n}\nsphere b {\n translate 1.2 -0.5 0.6\n radius 0.6\n}\n"});
        return out;
    }();
    return list;
}

} // namespace scenes
