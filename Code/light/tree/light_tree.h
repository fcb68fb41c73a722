// LightBounds: where a light, or a group of them, is and where it shines, for the choice among
// many.
#pragma once

#include "base/bounds.h"
#include "light/light_row.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

struct LightBounds {
    Bounds box;           // of all places on it; empty for what is distant
    Vec3 axis{0, 0, 1};   // unit: normals are around it; the way to what is distant
    double cosSpread = 1; // of the largest angle between a normal and the axis
    double cosReach = 0;  // of the largest angle to a normal at which light leaves
    double intensity = 0; // mean of the colours, along a normal [W/sr]; of what is distant the
                          // irradiance of a surface that faces it
    bool isTwoSided = false, isDistant = false;
    double reach2 = 1; // of what is distant: times the irradiance it counts as an intensity, where
                       // power alone decides

    // Whether it lights nothing: it is black, or has no area.
    bool isDark() const { return !(static_cast<float>(intensity) > 0); }
};
// Lamps that do not fade with the square of the distance count as distant, with the light that they
// give at distance 1.
LightBounds boundsOf(const LightRow& row);

// Returns the bounds of a sky; irradiance is that of a surface which sees half of it.
LightBounds boundsOfSky(double irradiance);

// LightNode: a light, or a group of them, in the tree by which one of many is chosen. 32 bytes; the
// two children of a group follow each other, in one line of the cache.

struct LightNode {
    float centre[3];              // of a ball around all places; of what is distant x is
                                  // LightBounds::reach2
    float intensity;              // sum; 0 for none
    std::uint32_t radiusAndX;     // upper half: the ball's radius, a float without its lower half;
                                  // lower half: x of the axis
    std::uint32_t yAndZ;          // of the axis
    std::uint32_t spreadAndReach; // cosines: 16 bits, then 14 bits, then the flags
    std::uint32_t child;          // kLightLeaf + light, or the pair of its children

    static constexpr std::uint32_t kTwoSided = 1, kDistant = 2;      // flags
    static constexpr float kCosineSteps = 32767, kReachSteps = 8191; // -1 to 1 is twice as many
};
static_assert(sizeof(LightNode) == 32);
inline constexpr std::uint32_t kLightLeaf = 0x80000000u;

// Makes a node that bounds at least as much.
LightNode packedNode(const LightBounds& bounds, std::uint32_t child);

// What the lanes see of a LightPicker.
struct LightTreeView {
    const LightNode* pairs = nullptr;      // two nodes each; empty for one light
    const std::uint32_t* trails = nullptr; // of each light: bit i is set where the way from the
                                           // root goes to the second child of a pair in step i
    std::uint32_t lit = 0;  // how many lights are not dark
    std::uint32_t only = 0; // the light, if it is one
};

// What a group of lights costs the choice among them: intensity times the directions that it lights
// (Conty Estevez and Kulla 2018).

// The measure of directions of normals within an angle of cosine cosSpread of an axis that shine up
// to an angle of cosine cosReach: 2 pi (1 - cos o) + pi/2 (2 w sin o - cos(o - 2 w) - 2 o sin o +
// cos o), w = min(o + e, pi). For cosReach 0, most lights, from a table: off by 1e-3 of it.
double directionsOf(double cosSpread, double cosReach);

// LightPicker: chooses one of many lights, likelier those that light a point more: a tree of groups
// of lights (Conty Estevez and Kulla 2018), at each group of which the children are weighed by what
// they may give to the point. The choice is made in lanes: pick_lanes.h.

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
