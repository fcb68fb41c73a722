// The text header that PPM and PFM share: words between white space, # comments up to the line end.
// Private to image/.
#pragma once

#include "image/formats.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

class NetpbmHeader {
public:
    // The first two bytes are the magic number, as the caller has checked.
    NetpbmHeader(Bytes file, const std::string& name) : file_(file), name_(name) {}

    std::string_view magic() const { return text(0, 2); }
    // The next whole number (0 .. 10^9) or finite real number that is not zero. Fails with
    // "name:line:col" when there is none; `what` says which one is expected.
    long long number(std::string_view what);
    double real(std::string_view what);
    // The next whole number of a plain raster, at most `most`.
    std::uint32_t sample(std::uint32_t most);
    // The `size` bytes that follow the one white space after the header. Fails when there are less.
    Bytes data(std::size_t size);
    // Skips white space and comments; false at the end of the file.
    bool hasMore();
    // Bytes from the current place on.
    std::size_t left() const { return file_.size() - at_; }
    // Fails at the start of the word that was read last.
    [[noreturn]] void failHere(const std::string& what) const;

private:
    std::string_view text(std::size_t from, std::size_t count) const {
        return {reinterpret_cast<const char*>(file_.data()) + from, count};
    }
    std::string_view word(std::string_view what);
    void skipComment();

    Bytes file_;
    const std::string& name_;
    std::size_t at_ = 2; // after the letter and digit of the kind
    std::size_t wordStart_ = 0;
};
