#include "desc/names.h"

#include <algorithm>
#include <cstdint>

namespace {

// Length of the valid UTF-8 sequence at the start of the text, 0 when there is none.
std::size_t sequenceLength(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
    };
    const std::uint8_t lead = byte(0);
    if (lead < 0x80) return lead < 0x20 || lead == 0x7f ? 0 : 1;
    if (lead < 0xc2 || lead > 0xf4) return 0;
    const std::size_t length = lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
    // The second byte excludes overlong forms, surrogates and what is above U+10FFFF.
    const std::uint8_t lo = lead == 0xe0 ? 0xa0 : lead == 0xf0 ? 0x90 : 0x80;
    const std::uint8_t hi = lead == 0xed ? 0x9f : lead == 0xf4 ? 0x8f : 0xbf;
    if (byte(1) < lo || byte(1) > hi) return 0;
    for (std::size_t i = 2; i < length; ++i)
        if (byte(i) < 0x80 || byte(i) > 0xbf) return 0;
    return length;
}

} // namespace

std::size_t findBadText(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
        if (text[i] >= 0x20 && text[i] < 0x7f) { // most text is ASCII
            ++i;
            continue;
        }
        const std::size_t length = sequenceLength(text.substr(i, 4));
        if (length == 0) return i;
        i += length;
    }
    return std::string_view::npos;
}

std::string_view firstCharacter(std::string_view text) {
    return text.substr(0, std::max<std::size_t>(1, sequenceLength(text.substr(0, 4))));
}

std::string shown(std::string_view text) {
    constexpr std::size_t kShown = 60;
    constexpr std::string_view kHex = "0123456789abcdef";
    std::string out;
    std::size_t i = 0;
    while (i < text.size() && out.size() < kShown) {
        const std::size_t length = sequenceLength(text.substr(i, 4));
        if (length > 0)
            out += text.substr(i, length);
        else {
            const auto byte = static_cast<std::uint8_t>(text[i]);
            out += {'\\', 'x', kHex[byte >> 4], kHex[byte & 15]};
        }
        i += length > 0 ? length : 1;
    }
    return i < text.size() ? out + "..." : out;
}
