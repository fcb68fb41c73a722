// Does what Huffman tables and bits of JPEG need, but not for each symbol.
#include "image/jpeg_bits.h"

#include "base/text.h"

#include <algorithm>

bool JpegHuffman::define(Bytes counts, Bytes symbols) {
    *this = {};
    std::copy(symbols.begin(), symbols.end(), symbols_.begin());
    unsigned code = 0, index = 0; // the next code, filled up to 16 bits, and its symbol
    for (unsigned length = 1; length <= kLongest; ++length) {
        first_[length] = index;
        const unsigned step = 1u << (kLongest - length); // from a code to the next
        if (code + counts[length - 1] * step > 1u << kLongest) return false;
        for (unsigned i = 0; i < counts[length - 1]; ++i, ++index, code += step) {
            if (length > kQuick) continue;
            const Found found{symbols_[index], static_cast<std::uint8_t>(length)};
            std::fill_n(quick_.begin() + (code >> (kLongest - kQuick)), 1u << (kQuick - length),
                        found);
        }
        end_[length] = code;
    }
    isDefined_ = true;
    return true;
}

void JpegBits::fill() {
    while (count_ <= 56 && !isAtEnd_) {
        isAtEnd_ = at_ == file_.size();
        if (isAtEnd_) return;
        const std::uint8_t byte = file_[at_];
        if (byte == 0xFF) {
            std::size_t next = at_ + 1;
            while (next < file_.size() && file_[next] == 0xFF) ++next;
            isAtEnd_ = next == file_.size() || file_[next] != 0;
            if (isAtEnd_) return;
            at_ = next;
        }
        ++at_;
        waiting_ |= std::uint64_t{byte} << (56 - count_);
        count_ += 8;
    }
}

void JpegBits::restart(unsigned number) {
    constexpr unsigned kRestart = 0xD0;
    const std::size_t marker = nextJpegMarker(file_, at_);
    if (marker == file_.size()) endsEarly();
    if (file_[marker] != kRestart + number)
        failPicture(name_, cat("the restart marker ", number, " is missing before byte ", marker,
                               "; the file is damaged"));
    at_ = marker + 1;
    waiting_ = 0;
    count_ = 0;
    isAtEnd_ = false;
}

void JpegBits::brokenCode() const {
    if (isAtEnd_ && count_ < JpegHuffman::kLongest) endsEarly();
    failPicture(name_, cat("there is no Huffman code for the bits before byte ", at_,
                           "; the file is damaged"));
}
void JpegBits::endsEarly() const {
    failPicture(name_, cat("the data of a scan end too early, at byte ", at_, " of ", file_.size(),
                           "; the file is cut off or damaged"));
}

std::size_t nextJpegMarker(Bytes file, std::size_t at) {
    while (true) {
        while (at < file.size() && file[at] != 0xFF) ++at;
        while (at < file.size() && file[at] == 0xFF) ++at;
        if (at == file.size() || file[at] != 0) return at;
    }
}
