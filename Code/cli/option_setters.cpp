#include "cli/option_setters.h"

#include "desc/properties.h"
#include "image/image.h"

#include <algorithm>
#include <filesystem>
#include <limits>

namespace {

// What the same number may be in a scene file.
Range rangeOf(std::string_view keyword) {
    return propertyNamed(BlockType::Settings, keyword).range;
}

} // namespace

int wholeLike(std::string_view keyword, const FlagValue& value) {
    const Range range = rangeOf(keyword);
    return value.whole(static_cast<int>(range.lo), static_cast<int>(range.hi));
}

double numberLike(std::string_view keyword, const FlagValue& value) {
    const Range range = rangeOf(keyword);
    return value.number(range.lo, range.hi);
}

void setAction(Options& o, Options::Action action, const FlagValue& value) {
    using Action = Options::Action;
    if (o.action == Action::Help) return;
    if (action != Action::Help && o.action != Action::Render && o.action != action)
        failUsage(cat(value.flag, " cannot be combined with another option of the group '",
                      kActionGroup, "'"));
    o.action = action;
}

void setScale(Options& o, const FlagValue& value) {
    const double percent = value.number(0.01, 10000);
    if (percent < 1)
        value.wrong(cat("a percentage, at least 1 (is ", shortest(100 * percent), " meant?)"));
    o.scalePercent = percent;
}

void setResolution(Options& o, const FlagValue& value) {
    const std::string expected =
        cat("WIDTHxHEIGHT, each from 1 to ", Image::kMaxSide, " (such as 1920x1080)");
    const std::vector<int> sides = value.wholes(2, "x", expected);
    for (const int side : sides)
        if (side < 1 || side > Image::kMaxSide) value.wrong(expected);
    o.resolution = {sides[0], sides[1]};
}

void setCrop(Options& o, const FlagValue& value) {
    constexpr std::string_view kExpected =
        "x0,y0,x1,y1 in pixels from the top left with 0 <= x0 < x1 and 0 <= y0 < y1";
    const std::vector<int> edges = value.wholes(4, ",", kExpected);
    if (edges[0] < 0 || edges[1] < 0 || edges[2] <= edges[0] || edges[3] <= edges[1])
        value.wrong(kExpected);
    o.crop = {edges[0], edges[1], edges[2], edges[3]};
}

void setBackground(Options& o, const FlagValue& value) {
    constexpr std::string_view kExpected = "r,g,b, each at least 0 (such as 0.1,0.2,0.4)";
    const std::vector<double> rgb = value.numbers(3, kExpected);
    for (const double channel : rgb)
        if (!kColor.contains(channel)) value.wrong(kExpected);
    o.background = {rgb[0], rgb[1], rgb[2]};
}

void setError(Options& o, const FlagValue& value) {
    constexpr std::string_view kWorst = "worst:";
    std::string_view text = value.text;
    o.errorOfWorstBlock = text.starts_with(kWorst);
    if (o.errorOfWorstBlock) text.remove_prefix(kWorst.size());
    const std::size_t colon = text.find(':');
    o.errorUnit = colon == std::string_view::npos
                      ? ErrorUnit::Display
                      : enumValue<ErrorUnit>({value.flag, text.substr(colon + 1)});
    const auto error = parseDouble(text.substr(0, colon));
    if (!error || !(*error >= 1e-6) || !(*error <= 1e6))
        value.wrong(cat("a number from 1e-06 to 1e+06, as 0.01, 0.01:", alternatives<ErrorUnit>(),
                        " or worst:0.01"));
    o.error = error;
}

void setFilter(Options& o, const FlagValue& value) {
    using Filter = SettingsDesc::Filter;
    const std::size_t comma = value.text.find(',');
    o.filter = enumValue<Filter>({value.flag, value.text.substr(0, comma)});
    o.filterWidth.reset();
    if (comma == std::string_view::npos) return;
    const Range range = rangeOf("filter");
    const auto width = parseDouble(value.text.substr(comma + 1));
    if (!width || !range.contains(*width))
        value.wrong(cat("NAME or NAME,WIDTH with a width above ", shortest(range.lo), " and up to ",
                        shortest(range.hi), " pixels"));
    o.filterWidth = width;
}

void setAovs(Options& o, const FlagValue& value) {
    o.aovs.clear();
    for (const FlagValue& word : value.words()) {
        const Aov aov = enumValue<Aov>(word);
        if (std::find(o.aovs.begin(), o.aovs.end(), aov) == o.aovs.end()) o.aovs.push_back(aov);
    }
}

void setTextures(Options& o, const FlagValue& value) {
    o.switches.textures = value.on;
    if (value.text.empty()) return;
    if (!std::filesystem::is_directory(value.text)) value.wrong("a folder");
    o.textureFolder = value.text;
}

void setSeed(Options& o, const FlagValue& value) {
    const auto seed = parseInteger(value.text);
    if (!seed || !kAnyUnsigned.contains(static_cast<double>(*seed)))
        value.wrong(cat("a whole number from 0 to ", std::numeric_limits<std::uint32_t>::max()));
    o.seed = static_cast<std::uint32_t>(*seed);
}

void setConvert(Options& o, const FlagValue& value) {
    o.convertTo = value.text;
    if (o.convertTo != "-" && !o.convertTo.ends_with(".txt"))
        value.wrong("the name of a .txt file, or -");
    setAction(o, Options::Action::Convert, value);
}
