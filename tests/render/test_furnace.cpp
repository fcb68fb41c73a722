// White surroundings: nothing may be brighter than white, and what only redirects light is white.
#include "check.h"
#include "shot.h"
#include "solids.h"

namespace test_furnace {

namespace {

Image furnace(const std::string& material, const std::string& body) {
    return shot::render("settings {\n resolution 48 48\n samples 4\n max_depth 400\n}\nworld {\n "
                        "background 1 1 1\n ambient 1 1 1\n}\n"
                        "camera c {\n look_at 2 -4 3  0 0 0  0 0 1\n lens 60\n}\nmaterial m {\n" +
                        material + "}\n" + body + " rotate 20 1 2 3\n material m\n}\n")
        .color;
}
const std::vector<std::string> kBodies = {"sphere b {\n", "cube b {\n", "cylinder b {\n",
                                          "cone b {\n top_radius 0.5\n",
                                          "instance b {\n mesh ball\n"};

} // namespace

TEST(whiteFurnace) {
    const std::string ball = solids::text(solids::ball(5));
    struct Case {
        std::string material;
        double smallest; // the darkest pixel may be
        double mean;
        bool isRough = false; // samples of single pixels scatter about their mean
    };
    // A weight below 1/2048 is not traced, and glass branches at every face: some 100 cut branches
    // take 5 % off single pixels of glass, 20 % with ior 2.4 in faceted bodies, less off the mean.
    const std::vector<Case> cases = {
        {" diffuse 1 1 1\n", 1, 1},
        {" diffuse 0 0 0\n mirror 1 1 1\n", 1, 1},
        {" diffuse 0.5 0.5 0.5\n mirror 0.5 0.5 0.5\n", 0.99, 0.999},
        {" diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n", 0.95, 0.995},
        {" diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n ior 2.4\n", 0.8,
         0.99},
        {" diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n ior 1\n",
         0.999999, 0.999999},
        {" diffuse 0 0 0\n opacity 0\n", 1, 1},
        {" diffuse 1 1 1\n opacity 0.5\n", 0.999999, 0.999999},
        {" diffuse 0 0 0\n mirror 1 1 1\n roughness 0.2\n", 0, 0.98, true},
        {" diffuse 0 0 0\n mirror 1 1 1\n transmission 1 1 1\n fresnel dielectric\n roughness "
         "0.3\n",
         0, 0.9, true},
        {" diffuse 0 0 0\n mirror 0.04 0.04 0.04\n transmission 0.96 0.96 0.96\n fresnel schlick\n",
         0.8, 0.97}};
    for (const Case& c : cases)
        for (const std::string& body : kBodies) {
            const Image image =
                furnace(c.material, (body.starts_with("instance") ? ball : "") + body);
            const double largest =
                c.isRough ? shot::estimate(image).mean : static_cast<double>(shot::largest(image));
            CHECK_INFO(largest <= 1 + (c.isRough ? 5e-3 : 1e-5), largest << c.material << body);
            CHECK_INFO(shot::smallest(image) >= c.smallest - 1e-6, shot::smallest(image)
                                                                       << c.material << body);
            CHECK_INFO(shot::estimate(image).mean >= c.mean - 1e-6,
                       shot::estimate(image).mean << c.material << body);
        }
}

} // namespace test_furnace
