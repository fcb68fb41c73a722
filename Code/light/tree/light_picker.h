// LightPicker: chooses one of many lights, likelier those that light a point more: a tree of groups
// of lights (Conty Estevez and Kulla 2018), at each group of which the children are weighed by what
// they may give to the point. The choice is made in lanes: pick_lanes.h.
#pragma once

#include "light/tree/light_nodes.h"

#include <cstddef>
#include <span>
#include <vector>

class LightPicker {
public:
    LightPicker() = default;
    // Light number i is that of bounds[i]; dark ones are never chosen. The tree depends on the
    // bounds alone.
    explicit LightPicker(std::span<const LightBounds> lights);

    LightTreeView view() const {
        return {reinterpret_cast<const LightNode*>(pairs_.data()), trails_.data(), lit_, only_};
    }
    std::size_t bytes() const {
        return pairs_.size() * sizeof(Pair) + trails_.size() * sizeof(std::uint32_t);
    }
    int depth() const { return depth_; }

private:
    struct alignas(64) Pair {
        LightNode nodes[2];
    };
    struct Sum;
    struct Item;
    class Builder;
    std::vector<Pair> pairs_;
    std::vector<std::uint32_t> trails_;
    std::uint32_t lit_ = 0, only_ = 0;
    int depth_ = 0;
};
