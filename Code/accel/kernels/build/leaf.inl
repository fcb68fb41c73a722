// Leaves. Included inside a kernel's namespace.

// False when the triangles have more than W different points.
template <int W>
inline bool makeLeaf(const BuildInput& in, const PrimBox* prims, const BuildRange& r, Grown& grown) {
    alignas(64) WideLeaf<W> leaf{};
    NumberSet<W> known;
    known.fill(0xffffffffu);
    std::uint32_t count = 0;
    for (std::uint32_t i = 0; i < r.count; ++i) {
        const Corners& corners = in.triangles[idOf(prims[i])];
        // All three are looked for before one is added; one that comes twice costs a place.
        std::uint32_t found[3], at[3];
        for (std::size_t k = 0; k < 3; ++k) found[k] = known.find(corners[k]);
        for (std::size_t k = 0; k < 3; ++k) {
            at[k] = static_cast<std::uint32_t>(
                std::countr_zero(found[k] | std::uint64_t{1} << count)); // known ones are in front
            count += found[k] == 0;
        }
        if (count > W) return false;
        for (std::size_t k = 0; k < 3; ++k) {
            known.put(corners[k], at[k]);
            leaf.corner[k][i] = static_cast<std::uint8_t>(at[k]);
        }
    }
    alignas(64) std::array<std::uint32_t, W> points;
    known.store(points.data());
    for (std::uint32_t i = 0; i < W; ++i) {
        const Vec3 p = in.points[points[i < count ? i : 0]];
        for (std::size_t axis = 0; axis < 3; ++axis) leaf.point[axis][i] = p[axis];
    }
    leaf.first = r.first;
    leaf.count = static_cast<std::uint8_t>(r.count);
    __m128 longest = _mm_setzero_ps();
    for (std::uint32_t i = 0; i < r.count; ++i) {
        in.ids[r.first + i] = idOf(prims[i]);
        const Box b = Box::load(prims[i]);
        longest = _mm_max_ps(negated(_mm_add_ps(b.lo(), b.negHi())), longest);
    }
    alignas(16) std::array<float, 4> side;
    _mm_store_ps(side.data(), longest);
    const float reach = std::max(std::max(side[0], side[1]), side[2]);
    // Rounded up, and the infinite stays infinite.
    leaf.reach = static_cast<std::uint16_t>(
        std::min(std::bit_cast<std::uint32_t>(reach) + 0xffffu, 0x7f800000u) >> 16);

    constexpr std::size_t kLines = sizeof(leaf) / sizeof(WideTree::Line);
    grown.lines.resize(grown.lines.size() + kLines);
    std::memcpy(grown.lines.data() + grown.lines.size() - kLines, &leaf, sizeof leaf);
    grown.nodes[r.node].leaf = grown.leaves++;
    return true;
}
