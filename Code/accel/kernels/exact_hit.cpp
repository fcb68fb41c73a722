#include "accel/kernels/exact_hit.h"

#include "accel/triangle.h"

#include <bit>
#include <new>

namespace {

float keyOf(const WideMesh& mesh, const RaySetup& setup, std::uint32_t triangle) {
    const auto& c = mesh.triangles[triangle];
    return canonicalKey(setup, mesh.points[c[0]], mesh.points[c[1]], mesh.points[c[2]]);
}

constexpr auto makeChosenLanes() {
    std::array<std::array<std::uint8_t, 8>, 256> table{};
    for (unsigned mask = 0; mask < 256; ++mask) {
        std::size_t n = 0;
        for (unsigned lane = 0; lane < 8; ++lane)
            if (mask >> lane & 1) table[mask][n++] = static_cast<std::uint8_t>(lane);
    }
    return table;
}

struct AlignedDelete {
    void operator()(std::byte* p) const { ::operator delete[](p, std::align_val_t{64}); }
};

} // namespace

constexpr std::array<std::array<std::uint8_t, 8>, 256> kChosenLanes = makeChosenLanes();

float exactKey(const WideMesh& mesh, Vec3 org, Vec3 dir, std::uint32_t triangle) {
    return keyOf(mesh, RaySetup(org, dir, mesh.extent), triangle);
}

bool improve(const WideMesh& mesh, Vec3 org, Vec3 dir, std::uint32_t first, unsigned lanes,
             RayBest& best) {
    const RaySetup setup(org, dir, mesh.extent);
    bool better = false;
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
        const std::uint32_t triangle = mesh.tree.triangleIds[first + lane];
        const float key = keyOf(mesh, setup, triangle);
        if (!(key > 0 && key < best.below)) continue;
        if (key > best.key || (key == best.key && triangle < best.triangle)) {
            best.key = key;
            best.triangle = triangle;
            better = true;
        }
    }
    return better;
}

bool hits(const WideMesh& mesh, Vec3 org, Vec3 dir, std::uint32_t first, unsigned lanes,
          const RayBest& best) {
    const RaySetup setup(org, dir, mesh.extent);
    for (; lanes != 0; lanes &= lanes - 1) {
        const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
        const float key = keyOf(mesh, setup, mesh.tree.triangleIds[first + lane]);
        if (key > best.key && key < best.below) return true;
    }
    return false;
}

std::byte* scratchMemory(std::size_t bytes) {
    thread_local std::unique_ptr<std::byte[], AlignedDelete> memory;
    thread_local std::size_t size = 0;
    if (size < bytes) {
        memory.reset(static_cast<std::byte*>(::operator new[](bytes, std::align_val_t{64})));
        size = bytes;
    }
    return memory.get();
}
