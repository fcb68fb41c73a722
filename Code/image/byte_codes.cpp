#include "image/byte_codes.h"

ByteCodes::ByteCodes(const DynamicCodes& codes)
    : literals_(canonicalCodes(codes.literalLengths())),
      before_(canonicalCodes(codes.distanceLengths())[0]) {}

JoinedCodes ByteCodes::zeros(std::size_t count) const {
    JoinedCodes codes;
    for (std::size_t i = 0; i < count; ++i) codes.add(literals_[0]);
    return codes;
}

JoinedCodes ByteCodes::zeroAndMatch(std::size_t count) const {
    const std::size_t length = count - 1;
    const CodeRange range = kLengthRanges[kLengthSlot[length]];
    JoinedCodes codes;
    codes.add(literals_[0]);
    codes.add(literals_[lengthSymbol(length)]);
    codes.add(length - range.base, range.extra);
    codes.add(before_);
    return codes;
}

void ByteCodes::putLongestMatches(BitWriter& out, std::size_t count) const {
    for (std::size_t left = count; left > 0; left -= kLongestMatch) {
        out.put(literals_[lengthSymbol(kLongestMatch)]);
        out.put(before_);
        out.flush();
    }
}
