// What the steps of the tree builder hand to each other: plain data. wide_build.cpp says in which
// order the steps come and on which threads.
#pragma once

#include "accel/kernels/wide_tree.h"
#include "accel/prim_box.h"
#include "base/bounds.h"
#include "base/raw_vector.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace kernels::build {

using Corners = std::array<std::uint32_t, 3>;

inline constexpr std::size_t kBins = 16;
// Binned by their centres, for all three axes at once.
struct WideBins {
    std::array<std::array<PrimBox, kBins>, 3> box;
    alignas(16) std::array<std::array<std::uint32_t, 4>, kBins> count; // by bin, then axis
};

// Where the bins of some triangles lie, in doubled centres. What is outside falls into the outmost
// ones, so an estimate of the bounds will do.
struct alignas(16) WideBinGrid {
    std::array<float, 4> lo, hi, scale; // scale: bins per length; 0: an axis without extent
    std::array<float, 4> last;          // number of the last bin
    std::uint32_t bins() const { return static_cast<std::uint32_t>(last[0]) + 1; }
};

// Triangles of bins < cut on the axis go left.
struct WideBinSplit {
    int axis = -1; // none
    float cut = 0;
    std::uint32_t leftCount = 0;
    PrimBox left, right;
};

// Neighbours in one of the two lists, that become a subtree.
struct BuildRange {
    std::uint32_t node, first, count;
    std::uint16_t depth;
    bool inSpare; // which list
    PrimBox box;
    WideBinGrid grid;
    WideBinSplit split;
};

struct alignas(32) BinaryNode {
    std::array<float, 3> lo;
    std::uint32_t left; // children left, left + 1; 0: a leaf, as the root is nobody's child
    std::array<float, 3> negHi;
    std::uint32_t leaf; // its number, or subtree's
    bool isLeaf() const { return left == 0; }
};
static_assert(sizeof(BinaryNode) == 32);
inline BinaryNode leafNode(const PrimBox& box) {
    return {{box.lo[0], box.lo[1], box.lo[2]}, 0, {box.negHi[0], box.negHi[1], box.negHi[2]}, 0};
}

// All triangles twice: divided from one list into the other.
struct PrimLists {
    RawVector<PrimBox> prims, spare;
    PrimBox* of(const BuildRange& r, bool other = false) {
        return ((r.inSpare != other) ? spare : prims).data() + r.first;
    }
};

// Triangles, or things of which no more than their boxes is known.
struct BuildInput {
    std::span<const Vec3> points;
    std::span<const Corners> triangles;
    std::span<const Bounds> boxes;
    PrimLists* lists;
    std::uint32_t* ids; // of the finished tree: those of a range lie where the range lies
};

// What one thread has made, of one subtree after the other.
struct Grown {
    RawVector<BinaryNode> nodes;     // children behind their parents
    RawVector<WideTree::Line> lines; // of the leaves
    std::uint32_t leaves = 0;
};

} // namespace kernels::build
