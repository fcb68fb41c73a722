#include "check.h"

#include "cli/stats_output.h"

#include <limits>

namespace test_stats_output {

namespace {

// A value at the start of `text`, which is cut off; false when it is no JSON (RFC 8259). Numbers
// are checked as far as they can go wrong here: nan, inf and signs.
bool eatValue(std::string_view& text);

bool eat(std::string_view& text, std::string_view word) {
    if (!text.starts_with(word)) return false;
    text.remove_prefix(word.size());
    return true;
}

bool eatString(std::string_view& text) {
    if (!eat(text, "\"")) return false;
    while (!text.empty() && text[0] != '"') {
        if (static_cast<unsigned char>(text[0]) < 0x20) return false;
        if (eat(text, "\\u")) {
            for (int i = 0; i < 4; ++i, text.remove_prefix(1))
                if (text.empty() || !std::isxdigit(static_cast<unsigned char>(text[0])))
                    return false;
            continue;
        }
        if (eat(text, "\\") && (text.empty() || (text[0] != '"' && text[0] != '\\'))) return false;
        text.remove_prefix(1);
    }
    return eat(text, "\"");
}

bool eatNumber(std::string_view& text) {
    const std::size_t end = text.find_first_not_of("0123456789+-.e");
    const std::string_view number = text.substr(0, end);
    text.remove_prefix(number.size());
    return !number.empty() && number[0] != '+' && number[0] != '.';
}

bool eatList(std::string_view& text, bool withKeys, std::string_view close) {
    if (eat(text, close)) return true;
    do {
        if (withKeys && !(eatString(text) && eat(text, ":"))) return false;
        if (!eatValue(text)) return false;
    } while (eat(text, ","));
    return eat(text, close);
}

bool eatValue(std::string_view& text) {
    if (eat(text, "{")) return eatList(text, true, "}");
    if (eat(text, "[")) return eatList(text, false, "]");
    if (text.starts_with("\"")) return eatString(text);
    return eat(text, "null") || eat(text, "true") || eat(text, "false") || eatNumber(text);
}

bool isJson(std::string_view text) { return eatValue(text) && text == "\n"; }

Stats example() {
    Stats stats;
    stats.renderSeconds = 2, stats.totalSeconds = 2.5;
    stats.rays.camera = 1000, stats.rays.shadow = 4000, stats.rays.tracedShadow = 3000;
    stats.cameraHits = 900;
    stats.accel = {"bvh", 11, 6, 352, 40, 32, 1600, 12.5};
    stats.rays.skipped.emptyTileRays = 500, stats.rays.skipped.unlitSamples = 1000;
    stats.rays.points = 40, stats.rays.skipped.unshadedPoints = 10;
    stats.peakBytes = 123456789, stats.mipBytes = 777, stats.unmadeMipBytes = 111;
    stats.threads = 2;
    stats.kernel = "scalar";
    stats.featuresNeeded = {"shadows", "a \"b\"\\\n\x01"};
    stats.featuresSkipped = {"dof: aperture_radius is 0", "aa: one sample per pixel"};
    stats.samplesMin = stats.samplesMean = stats.samplesMax = 16;
    stats.nanSamples = 1;
    return stats;
}

} // namespace

TEST(stats_json_has_the_keys_of_the_contract) {
    const std::string json =
        statsJson(example(), {"a \"b\".txt", "out.png", {640, 360}, {"a.txt", "-q"}});
    CHECK(isJson(json));
    for (const char* part :
         {"{\"scene\":\"a \\\"b\\\".txt\",\"output\":\"out.png\",\"width\":640,\"height\":360,"
          "\"arguments\":[\"a.txt\",\"-q\"],\"version\":\"",
          "\"seconds\":{\"parse\":0,\"build\":0,\"render\":2,\"write\":0,\"total\":2.5}",
          "\"rays\":{\"camera\":1000,\"shadow\":4000,\"shadow_traced\":3000,\"reflect\":0,"
          "\"refract\":0,\"indirect\":0}",
          "\"hits\":{\"camera\":900}", "\"rays_per_second\":1750",
          "\"accel\":{\"kind\":\"bvh\",\"nodes\":11,\"leaves\":6,\"bytes\":352,\"sah\":12.5,"
          "\"triangles\":32,\"bytes_per_triangle\":50}",
          "\"peak_bytes\":123456789", "\"mip_bytes\":777", "\"threads\":2", "\"kernel\":\"scalar\"",
          "\"features\":{\"needed\":[\"shadows\",\"a \\\"b\\\"\\\\\\u000a\\u0001\"],\"skipped\":[",
          // 3500 rays in 2 s
          "\"skipped_work\":{\"empty_tile_rays\":{\"count\":500,\"of\":1000},"
          "\"settled_samples\":{\"count\":0,\"of\":1000,\"seconds\":0},"
          "\"ray_numbers\":{\"count\":0,\"of\":2500},"
          "\"unshaded_points\":{\"count\":10,\"of\":40},\"unlit_samples\":{\"count\":1000,\"of\":5000,"
          "\"seconds\":0.57142857142857",
          "\"open_lamps\":{\"count\":1000,\"of\":4000,\"seconds\":0.57142857142857",
          "\"unread_picture_bytes\":{\"count\":0,\"of\":0},\"unmade_mip_bytes\":{\"count\":111,\"of\":888}}",
          "\"samples\":{\"min\":16,\"mean\":16,\"max\":16}",
          "\"numeric\":{\"nan_samples\":1,\"degenerate_primitives\":0}"})
        CHECK_INFO(json.find(part) != std::string::npos, part << " in " << json);
}

TEST(stats_json_is_valid_for_odd_numbers) {
    Stats stats;
    CHECK(isJson(statsJson(stats, {})));
    stats.accel.sah = std::numeric_limits<double>::quiet_NaN();
    stats.parseSeconds = std::numeric_limits<double>::infinity();
    stats.renderSeconds = 1e-300;
    stats.rays.camera = std::numeric_limits<std::uint64_t>::max() / 16; // each has some random numbers
    CHECK(isJson(statsJson(stats, {})));
    CHECK(statsJson(stats, {}).find("\"sah\":null") != std::string::npos);
    CHECK(!isJson("{\"a\":nan}\n"));
    CHECK(!isJson("{\"a\":1,}\n"));
}

TEST(stats_table_is_aligned_and_complete) {
    const std::string table = statsTable(example());
    for (const char* part :
         {"camera                             1 000", "Mray/s", "50.0 bytes per triangle",
          "skipped  dof: aperture_radius is 0\n           aa: one sample", "bvh"})
        CHECK_INFO(table.find(part) != std::string::npos, part << " in\n" << table);
}

// What was skipped is listed if there was any of it, with the seconds where they are known.
TEST(stats_table_says_what_was_skipped) {
    const std::string table = statsTable(example());
    for (const char* part : {"rays of empty tiles                  500 rays (50.0 %)\n",
                             "unlit samples of lamps             1 000 shadow rays (20.0 %, about 0.571 s)\n",
                             "mip levels not made                  111 bytes (12.5 %)\n"})
        CHECK_INFO(table.find(part) != std::string::npos, part << " in\n" << table);
    CHECK(table.find("cutoff") == std::string::npos);
    CHECK(statsTable({}).find("skipped work\n  none\n") != std::string::npos);
}

// The 1,000 samples of a picture with an error goal are 100 places with 10 each; with 64 each they would have 6,400.
TEST(stats_of_settled_samples) {
    Stats stats = example();
    stats.samplesMin = 4, stats.samplesMean = 10, stats.samplesMax = 64;
    stats.error = ErrorStats{};
    CHECK(statsTable(stats).find("settled samples                    5 400 samples (84.4 %, about 10.800 s)") !=
          std::string::npos);
}

// What only a picture with an error goal has.
TEST(stats_of_an_error_goal) {
    Stats stats = example();
    CHECK(statsJson(stats, {}).find("error") == std::string::npos);
    CHECK(statsTable(stats).find("error") == std::string::npos);
    stats.samplesMin = 4, stats.samplesMean = 17.26, stats.samplesMax = 512;
    stats.error = ErrorStats{.goal = 0.01, .estimate = 0.0123456, .passes = 7, .mostSamples = 512,
                             .cappedPixels = 1234, .unsureBlocks = 2};
    const std::string json = statsJson(stats, {}), table = statsTable(stats);
    CHECK(isJson(json));
    for (const char* part :
         {"\"error_estimate\":0.0123456,\"error_unit\":\"display\",\"error_goal\":0.01,\"passes\":7",
          "\"capped_pixels\":1234,\"unsure_blocks\":2",
          "\"samples\":{\"min\":4,\"mean\":17.26,\"max\":512}"})
        CHECK_INFO(json.find(part) != std::string::npos, part << " in " << json);
    for (const char* part : {" 17.3 (4 to 512)", "0.0123 (display; goal 0.01)", "1 234 (at 512 samples)"})
        CHECK_INFO(table.find(part) != std::string::npos, part << " in\n" << table);
}

} // namespace test_stats_output
