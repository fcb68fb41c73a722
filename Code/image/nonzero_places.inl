// Finds the bytes that aren't zero. byte_lanes.h says what; the file that includes this says how 64
// of them are looked at: isZero64(), and nonzeroPlaces64(), which may write kTooManyPlaces too many.

bool nonzeroPlaces(std::span<const std::uint8_t> bytes, std::size_t most,
                   RawVector<std::uint32_t>& places) {
    places.resize(most + 64 + kTooManyPlaces);
    std::size_t count = 0, at = 0;
    for (; at + 64 <= bytes.size() && count <= most; at += 64)
        if (!isZero64(&bytes[at])) count += nonzeroPlaces64(&bytes[at], at, &places[count]);
    for (; at < bytes.size() && count <= most; ++at)
        if (bytes[at] != 0) places[count++] = static_cast<std::uint32_t>(at);
    places.resize(count);
    return count <= most;
}
