#include "bench/file.h"

#include <bit>
#include <string_view>

namespace {

class WordWriter {
public:
    void text(std::string_view text, std::size_t size) {
        for (std::size_t i = 0; i < size; ++i)
            bytes_.push_back(i < text.size() ? static_cast<std::uint8_t>(text[i]) : 0);
    }
    void whole(std::size_t value) { word(static_cast<std::uint32_t>(value)); }
    void number(float value) { word(std::bit_cast<std::uint32_t>(value)); }
    void vector(Vec3 v) { number(v.x), number(v.y), number(v.z); }
    std::vector<std::uint8_t> take() { return std::move(bytes_); }

private:
    void word(std::uint32_t value) {
        for (int shift = 0; shift < 32; shift += 8)
            bytes_.push_back(static_cast<std::uint8_t>(value >> shift));
    }
    std::vector<std::uint8_t> bytes_;
};

} // namespace

std::vector<std::uint8_t> encodeBenchFile(const MeshGeometry& geometry, const SceneFrame& frame,
                                          std::span<const BenchRays> sets) {
    WordWriter out;
    const auto world = [&](Vec3 p) { return toFloat(frame.worldPoint(toDouble(p))); };
    const auto back = static_cast<float>(1 / frame.scale); // a power of two: t stays as it is
    out.text("RTRAYS01", 8);
    out.whole(geometry.points.size()), out.whole(geometry.triangles.size());
    out.whole(sets.size());
    for (const Vec3 point : geometry.points) out.vector(world(point));
    for (const auto& corners : geometry.triangles)
        for (const std::uint32_t corner : corners) out.whole(corner);
    for (const BenchRays& set : sets) {
        out.text(set.name, 16);
        out.whole(set.size()), out.whole(set.anyHit);
        for (std::size_t i = 0; i < set.size(); ++i) {
            out.vector(world(set.org[i])), out.number(set.tMin[i]);
            out.vector(set.dir[i] * back), out.number(set.tMax[i]);
        }
    }
    return out.take();
}
