#include "image/zero_runs.h"

#include "image/byte_lanes.h"
#include "image/run_codes.h"

bool putZeroRuns(BitWriter& out, std::span<const std::uint8_t> bytes, bool last) {
    constexpr std::size_t kMostBytes = std::size_t{1} << 24;
    if (bytes.size() > kMostBytes) return false;
    thread_local RawVector<std::uint32_t> places; // the system need not clear it every time
    if (!byteLanes().nonzeroPlaces(bytes, bytes.size() / kBytesPerNonzero, places)) return false;

    RunCounts counts;
    counts.add(bytes, 0, places, bytes.size());
    counts.choose();
    const RunCodes codes(counts);
    if (!codes.fit()) return false;
    codes.put(out, bytes, places, last);
    return true;
}
