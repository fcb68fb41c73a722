// MediumTree: the transparent materials that rays are inside of, the one entered last on top, to
// any depth. Rays that split share what they are inside of: a ray carries the number of a node, and
// the way from there to the root is its stack.
#pragma once

#include <cstdint>
#include <vector>

class MediumTree {
public:
    using Inside = std::uint32_t; // what a ray carries
    static constexpr Inside kNothing = 0;
    static constexpr std::uint32_t kOutside = 0xffffffffu; // the material on top of nothing

    std::uint32_t top(Inside inside) const { return nodes_[inside].material; }
    Inside enter(Inside inside, std::uint32_t material) {
        // Mostly the last ray that was here entered the same: then nothing is added.
        const Inside again = nodes_[inside].lastEntered;
        if (again != kNothing && nodes_[again].material == material) return again;
        const auto entered = static_cast<Inside>(nodes_.size());
        nodes_[inside].lastEntered = entered;
        nodes_.push_back({material, inside, kNothing});
        return entered;
    }
    // Removes the innermost entry of the material. Where there is none, as of an inner shell that
    // is inside out and has a material of its own, what was entered last is left.
    Inside leave(Inside inside, std::uint32_t material) {
        Inside at = inside;
        kept_.clear(); // what overlaps with it and goes on
        for (; at != kNothing && top(at) != material; at = nodes_[at].outer)
            kept_.push_back(top(at));
        if (at == kNothing) return nodes_[inside].outer;
        at = nodes_[at].outer;
        for (; !kept_.empty(); kept_.pop_back()) at = enter(at, kept_.back());
        return at;
    }
    std::size_t size() const { return nodes_.size(); }

private:
    struct Node {
        std::uint32_t material;
        Inside outer, lastEntered;
    };
    std::vector<Node> nodes_{{kOutside, kNothing, kNothing}};
    std::vector<std::uint32_t> kept_; // scratch of leave()
};
