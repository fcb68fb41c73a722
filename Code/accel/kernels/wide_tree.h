// WideTree: the triangles of a mesh as vector kernels want them. A node tests W boxes at once, a
// leaf W triangles over at most W vertices that they share: a vertex is moved into the ray's frame
// once, and both triangles of an edge see the same bits of it.
// Knows nothing about rays and instruction sets; read by the kernels, made by wide_build.cpp.
#pragma once

#include "accel/ray_setup.h"
#include "base/raw_vector.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

// Where a child is: 64-byte lines from the start of the arena, times 4, plus what it is.
using WideRef = std::uint32_t;
enum class WideKind : std::uint32_t { Node = 0, Leaf = 1, None = 2 };
constexpr WideRef wideRef(std::size_t line, WideKind kind) {
    return static_cast<WideRef>(line << 2) | static_cast<WideRef>(kind);
}
constexpr WideKind kindOf(WideRef ref) { return static_cast<WideKind>(ref & 3); }
constexpr std::size_t byteOffset(WideRef ref) { return static_cast<std::size_t>(ref & ~3u) * 16; }

// Children in the order in which rays that any hit ends had better visit them, the first one last
// (build/visit_order.h). A slot without a child has a box that no ray enters, and refers to an
// empty leaf.
template <int W> struct alignas(64) WideNode {
    float plane[3][2][W]; // axis, lower or upper
    WideRef child[W];

    Bounds box(std::size_t i) const {
        return {{plane[0][0][i], plane[1][0][i], plane[2][0][i]},
                {plane[0][1][i], plane[1][1][i], plane[2][1][i]}};
    }
};
static_assert(sizeof(WideNode<16>) == 448 && sizeof(WideNode<8>) == 256);

template <int W> struct alignas(64) WideLeaf {
    float point[3][W];         // axis; unused places repeat the first point
    std::uint8_t corner[3][W]; // of triangle i: corner[0..2][i], numbers of points
    std::uint32_t first;       // triangle i is number triangleIds[first + i] of the mesh
    std::uint8_t cover;        // how much of its box they fill; see build/visit_order.h
    std::uint8_t count;        // triangles
};
static_assert(sizeof(WideLeaf<16>) == 256 && sizeof(WideLeaf<8>) == 128);

struct WideTree {
    int width = 0; // 0: there is none
    WideRef root = wideRef(0, WideKind::None);
    std::uint32_t stackSize = 0; // more than a traversal ever has on its stack
    float leavesPerRay = 0;      // that a ray through the root enters, if nothing hides any
    std::vector<std::uint32_t> triangleIds; // or, of boxes, those of the leaves in their order
    bool isOfBoxes = false;                 // a reference to a leaf is the leaf's number
    std::uint64_t nodes = 0, leaves = 0;
    double sah = 0; // a ray through the root meets so many nodes and triangles, by areas

    bool isEmpty() const { return width == 0; }
    struct alignas(64) Line {
        std::byte bytes[64];
    };
    RawVector<Line> lines; // the nodes and leaves

    const std::byte* base() const { return reinterpret_cast<const std::byte*>(lines.data()); }
    std::size_t bytes() const { return lines.size() * sizeof(Line) + triangleIds.size() * 4; }
    template <class T> const T& at(WideRef ref) const {
        return *reinterpret_cast<const T*>(base() + byteOffset(ref));
    }
};

// Nodes above each other, at most, of a wide tree and of the binary one that it is made of.
inline constexpr std::size_t kMaxTreeDepth = 96;

// Binned SAH (Wald 2007), top down. `width` is 8 or 16. The tree is the same on every machine and
// for any number of threads, 0 being as many as the machine has.
WideTree buildWide(int width, std::span<const Vec3> points,
                   std::span<const std::array<std::uint32_t, 3>> triangles, int threads = 1);

// Builds a tree over boxes of anything, each of which is a leaf of its own. The root is in line 0;
// slots without a child are of kind None.
WideTree buildWideOfBoxes(int width, std::span<const Bounds> boxes, int threads = 1);
