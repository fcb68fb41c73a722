// PNG files from what a fuzzer makes of them: the mutations are to reach what is behind the
// checksums.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace fuzz {

// The same file with right checksums (CRC-32) in all chunks, as far as they can be followed.
std::vector<std::uint8_t> withRightChecksums(std::span<const std::uint8_t> png);

// In `png` the chunks IDAT hold rows as they are, not packed; here they hold what packs them.
std::vector<std::uint8_t> withPackedRows(std::span<const std::uint8_t> png);

} // namespace fuzz
