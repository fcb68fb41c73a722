// Finds the bytes that aren't zero. byte_lanes.h says what; the file that includes this says how 64
// of them are looked at: isZero64() and nonzeroOf64().

bool nonzeroPlaces(std::span<const std::uint8_t> bytes, std::size_t most,
                   RawVector<std::uint32_t>& places) {
    constexpr std::size_t kGroup = 4;
    places.resize(most + 64 + kGroup);
    std::size_t count = 0, at = 0;
    for (; at + 64 <= bytes.size() && count <= most; at += 64) {
        if (isZero64(&bytes[at])) continue;
        auto [mask, inThese] = nonzeroOf64(&bytes[at]);
        const std::size_t end = count + inThese;
        // In groups, whose number the processor guesses more often than that of the places; what
        // is too much is overwritten.
        for (; count < end; count += kGroup)
            for (std::size_t k = 0; k < kGroup; ++k, mask &= mask - 1)
                places[count + k] = static_cast<std::uint32_t>(
                    at + static_cast<std::size_t>(std::countr_zero(mask)));
        count = end;
    }
    for (; at < bytes.size() && count <= most; ++at)
        if (bytes[at] != 0) places[count++] = static_cast<std::uint32_t>(at);
    places.resize(count);
    return count <= most;
}
