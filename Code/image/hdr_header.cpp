// Reads the text at the beginning of a Radiance HDR picture: variables, an empty line, and the
// resolution with the order of the pixels.
#include "base/error.h"
#include "base/text.h"
#include "image/formats.h"

#include <algorithm>
#include <string_view>
#include <vector>

namespace {

class HdrHeaderReader {
public:
    HdrHeaderReader(Bytes file, const std::string& name)
        : text_(reinterpret_cast<const char*>(file.data()), file.size()), name_(name) {}

    HdrHeader read() {
        takeLine("the first line");
        if (!line_.starts_with("#?RADIANCE") && !line_.starts_with("#?RGBE"))
            broken("the file does not begin with #?RADIANCE or #?RGBE; one of them must be its "
                   "first line");
        while (takeLine("an empty line"), !line_.empty()) takeVariable();
        takeLine("the resolution");
        takeResolution();
        header_.dataStart = at_;
        return header_;
    }

private:
    [[noreturn]] void broken(const std::string& what) const {
        fail(ErrorKind::Input, cat(name_, ":", lineNumber_, ":1: error: ", what));
    }

    // The next line without its end, which is a line feed that a return may precede.
    void takeLine(std::string_view expected) {
        ++lineNumber_;
        const std::size_t end = text_.find('\n', at_);
        if (end == std::string_view::npos)
            broken(cat("the file ends in its header; ", expected, " must follow"));
        line_ = text_.substr(at_, end - at_);
        if (line_.ends_with('\r')) line_.remove_suffix(1);
        at_ = end + 1;
    }

    // The words between blanks. More than `most` are not told apart: the last one is the rest.
    static std::vector<std::string_view> wordsOf(std::string_view text, std::size_t most) {
        constexpr std::string_view kBlanks = " \t";
        std::vector<std::string_view> words;
        for (;;) {
            text.remove_prefix(std::min(text.find_first_not_of(kBlanks), text.size()));
            if (text.empty()) return words;
            const std::size_t end = words.size() == most
                                        ? text.size()
                                        : std::min(text.find_first_of(kBlanks), text.size());
            words.push_back(text.substr(0, end));
            text.remove_prefix(end);
        }
    }

    static std::string quoted(std::string_view text) { return quotedPart(text, 40); }

    void takeVariable() {
        const std::size_t equals = line_.find('=');
        if (equals == std::string_view::npos) return;
        const std::string_view key = line_.substr(0, equals), value = line_.substr(equals + 1);
        if (key == "FORMAT")
            takeFormat(value);
        else if (key == "EXPOSURE")
            takeFactors(key, value, 1);
        else if (key == "COLORCORR")
            takeFactors(key, value, header_.exposure.size());
    }

    void takeFormat(std::string_view value) const {
        const auto words = wordsOf(value, 1);
        if (words.size() == 1 && words[0] == "32-bit_rle_rgbe") return;
        if (words.size() == 1 && words[0] == "32-bit_rle_xyze")
            broken("the pixels are CIE colours (32-bit_rle_xyze); what can be read: "
                   "32-bit_rle_rgbe");
        broken(cat("the format is ", quoted(value), "; it must be 32-bit_rle_rgbe"));
    }

    // Multiplies the exposure by one number for all channels, or by one for each.
    void takeFactors(std::string_view key, std::string_view value, std::size_t count) {
        constexpr double kLeast = 1e-30, kMost = 1e30;
        const auto words = wordsOf(value, count);
        if (words.size() != count)
            broken(cat(key, " is ", quoted(value), "; it must be ", count,
                       count == 1 ? " number" : " numbers"));
        for (std::size_t c = 0; c < header_.exposure.size(); ++c) {
            const auto factor = parseDouble(words[count == 1 ? 0 : c]);
            if (!factor || !(*factor >= kLeast && *factor <= kMost))
                broken(cat(key, " is ", quoted(value), "; it must be more than 0"));
            double& product = header_.exposure[c];
            product *= *factor;
            if (!(product >= kLeast && product <= kMost))
                broken(cat("all ", key, " lines together multiply by ", product,
                           "; it must be 1e-30 to 1e30"));
        }
    }

    // "-Y 480 +X 640": the axis from scanline to scanline, and the one along them. Y points up.
    void takeResolution() {
        const auto words = wordsOf(line_, 4);
        const auto isAxis = [](std::string_view word) {
            return word == "+X" || word == "-X" || word == "+Y" || word == "-Y";
        };
        const auto right = [&] {
            if (words.size() != 4 || !isAxis(words[0]) || !isAxis(words[2])) return false;
            return words[0][1] != words[2][1] && parseInteger(words[1]) && parseInteger(words[3]);
        };
        if (!right())
            broken(cat("the resolution is ", quoted(line_),
                       "; it must be like '-Y 480 +X 640', with + or - before X and Y"));
        const bool hasRows = words[0][1] == 'Y';
        const std::size_t ofX = hasRows ? 2 : 0, ofY = hasRows ? 0 : 2;
        const long long width = *parseInteger(words[ofX + 1]),
                        height = *parseInteger(words[ofY + 1]);
        checkSize(width, height, name_);
        header_.width = static_cast<int>(width);
        header_.height = static_cast<int>(height);
        header_.lines = static_cast<std::size_t>(hasRows ? height : width);
        header_.length = static_cast<std::size_t>(hasRows ? width : height);

        const bool fromLeft = words[ofX][0] == '+', fromTop = words[ofY][0] == '-';
        const std::ptrdiff_t row = header_.width;
        const std::ptrdiff_t xStep = fromLeft ? 1 : -1, yStep = fromTop ? row : -row;
        header_.start = (fromLeft ? 0 : row - 1) + (fromTop ? 0 : row * (header_.height - 1));
        header_.lineStep = hasRows ? yStep : xStep;
        header_.pixelStep = hasRows ? xStep : yStep;
    }

    std::string_view text_;
    const std::string& name_;
    std::size_t at_ = 0;
    std::string_view line_;
    long long lineNumber_ = 0;
    HdrHeader header_;
};

} // namespace

HdrHeader readHdrHeader(Bytes file, const std::string& name) {
    return HdrHeaderReader(file, name).read();
}
