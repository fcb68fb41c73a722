// Golden pictures: the scenes of scenes.cpp as they were when somebody looked at them.
// tests/golden/golden.tsv lists name, largest RMSE and its reason; a picture that is off is written
// to build/golden-<name>.pfm. A wanted change: look at those, then remake the goldens with
//     REGOLD=1 build/release/unit-tests goldenPictures
// and say in the commit why they changed. Run from the top folder.
#include "check.h"
#include "scenes.h"
#include "shot.h"

#include "image/compare.h"

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace test_golden {

TEST(goldenPictures) {
    const std::string folder = "tests/golden/";
    if (std::getenv("REGOLD")) {
        std::ofstream list(folder + "golden.tsv");
        list << "name\tscene\tmax_rmse\treason\n";
        for (const auto& [name, text] : scenes::all()) {
            shot::render(text).color.write(folder + name + ".png", {Encoding::Transfer::Srgb, 16});
            list << name
                 << "\ttests/render/scenes.cpp\t1e-06\tsame bits expected: half a step of 16 bits "
                    "is 8e-6 of sRGB, compared after the same encoding\n";
        }
    }
    std::ifstream list(folder + "golden.tsv");
    CHECK_INFO(list.good(), "no " << folder << "golden.tsv: run from the top folder");
    std::string line;
    std::getline(list, line);
    std::size_t compared = 0;
    while (std::getline(list, line)) {
        std::istringstream columns(line);
        std::string name, scene, limit;
        std::getline(columns, name, '\t');
        std::getline(columns, scene, '\t');
        std::getline(columns, limit, '\t');
        for (const auto& [known, text] : scenes::all()) {
            if (known != name) continue;
            ++compared;
            const Image image = shot::render(text).color;
            const Image golden(folder + name + ".png");
            const std::vector<std::uint8_t> bytes =
                encodeImage(image, "png", {Encoding::Transfer::Srgb, 16});
            const double error = rmse(Image(decodeImage(bytes, name)), golden);
            if (error <= std::stod(limit)) continue;
            std::filesystem::create_directories("build");
            image.write("build/golden-" + name + ".pfm");
            CHECK_INFO(false, name << ": RMSE " << error << ", limit " << limit
                                   << ", see build/golden-" << name << ".pfm");
        }
    }
    CHECK_EQUAL(compared, scenes::all().size());
}

} // namespace test_golden
