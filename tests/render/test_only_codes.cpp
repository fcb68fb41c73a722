// RenderSettings::onlyCodes: the codes are those of the picture, and where it can't be made of
// codes it is the picture.
#include "check.h"
#include "shot.h"

namespace test_only_codes {

namespace {

// A bright ball in front of nothing and of a floor: tiles that are empty, and values above 1.
std::string scene(const std::string& settings) {
    return "settings {\n resolution 70 45\n" + settings +
           "}\nworld {\n background 0.2 0.4 3\n}\n"
           "camera c {\n look_at 0 -6 1  0 0 0  0 0 1\n}\n"
           "light l {\n translate 2 -3 4\n color 30 20 10\n}\n"
           "sphere s {\n radius 0.7\n}\nplane p {\n translate 0 0 -1\n}\n";
}

void checkCodes(const std::string& settings, int threads, const shot::Tweak& more = {}) {
    const auto rendered = [&](bool onlyCodes) {
        return shot::render(scene(settings), [&](RenderSettings& s) {
            s.onlyCodes = onlyCodes;
            s.threads = threads;
            if (more) more(s);
        });
    };
    const shot::Shot image = rendered(false), codes = rendered(true);
    CHECK(image.codes.isEmpty() && codes.color.pixels().empty());
    const bool isLinear = settings.find("linear") != std::string::npos;
    const Encoding encoding{isLinear ? Encoding::Transfer::Linear : Encoding::Transfer::Srgb, 8};
    CHECK_INFO(encodeImage(codes.codes, "ppm") == encodeImage(image.color, "ppm", encoding),
               settings << threads << " threads");
    const bool isDraft = settings.find("samples 1\n") != std::string::npos;
    CHECK_INFO(codes.codes.encoding() == Encoding({encoding.transfer, 8, isDraft}), settings);
    CHECK_EQUAL(codes.aovs.size(), image.aovs.size());
    for (std::size_t i = 0; i < codes.aovs.size(); ++i)
        CHECK_EQUAL(shot::differingPixels(codes.aovs[i].image, image.aovs[i].image), 0);
}

} // namespace

TEST(onlyCodesAreThoseOfThePicture) {
    const auto withAovs = [](RenderSettings& s) { s.aovs = {Aov::Depth, Aov::Samples}; };
    for (const std::string samples : {" samples 1\n", " samples 4\n"})
        for (const std::string more : {"", " transfer linear\n", " crop 9 7 69 44\n"})
            for (const int threads : {1, 3}) {
                checkCodes(samples + more, threads);
                checkCodes(samples + more, threads, withAovs);
            }
}

TEST(onlyCodesWhereThePictureCanBeMadeOfThem) {
    for (const bool isGoal : {false, true}) {
        const auto shot = shot::render(scene(isGoal ? "" : " sampler corners\n samples 1\n"),
                                       [&](RenderSettings& s) {
                                           s.onlyCodes = true;
                                           if (isGoal) s.refinement = Refinement{.error = 0.1, .mostSamples = 8};
                                       });
        CHECK(shot.codes.isEmpty());
        CHECK_EQUAL(shot.color.width(), 70);
    }
}

} // namespace test_only_codes
