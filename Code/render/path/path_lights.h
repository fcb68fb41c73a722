// PathLights: all that shines in a scene, and which light is chosen for a point.
#pragma once

#include "base/math.h"
#include "light/light_row.h"

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

class PathLights {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;

    struct Entry {
        LightRow row;
        bool isOpen = false; // casts no shadows
    };
    // `power`: what it is chosen by. Returns the number of the light.
    std::uint32_t add(const Entry& entry, float power);
    // What rays see of a lamp that is no shape; 0 for those that go by way of lobes only.
    void addUnshaped(std::uint32_t light, std::uint8_t seenBy);
    // The surface of a shape, and of one of its triangles, is a light.
    void addSurface(std::uint32_t shape, std::uint32_t prim, std::uint32_t light);
    // Call once when all are there.
    void finish();

    bool isEmpty() const { return entries_.empty(); }
    const Entry& entry(std::uint32_t light) const { return entries_[light]; }

    // The light for a number in [0,1), and how probable it is.
    struct Pick {
        std::uint32_t light;
        float probability;
    };
    Pick pick(float u) const;
    // Density per steradian with which the light sends a sample along `dir` to the point: of the
    // choice and of the direction. `n`: black where both sides of the surface are lit.
    float pdf(Vec3 p, Vec3 n, std::uint32_t light, Vec3 dir) const;

    std::uint32_t sky() const { return sky_; }
    std::uint32_t ofSurface(std::uint32_t shape, std::uint32_t prim) const;

    // Calls fn(light, radiance) for every unshaped lamp that the ray meets before `end`. `seenBy`:
    // how the ray sees lamps, 0 for those that a lobe spread.
    template <class Fn>
    void meet(Vec3 org, Vec3 dir, float end, std::uint8_t seenBy, Fn&& fn) const {
        for (const Unshaped& lamp : unshaped_) {
            if (seenBy != 0 && (lamp.seenBy & seenBy) == 0) continue;
            const Meeting at = meetOne(lamp.light, org, dir);
            if (at.distance < end ||
                (at.distance == end && end == kInfinityF && !isBlack(at.radiance)))
                fn(lamp.light, at.radiance);
        }
    }
    bool hasUnshaped() const { return !unshaped_.empty(); }

private:
    struct Meeting {
        float distance;
        Rgb radiance;
    };
    struct Unshaped {
        std::uint32_t light;
        std::uint8_t seenBy;
    };
    Meeting meetOne(std::uint32_t light, Vec3 org, Vec3 dir) const;

    std::vector<Entry> entries_;
    std::vector<float> powers_, ends_; // ends_: of the shares of [0,1)
    std::vector<Unshaped> unshaped_;
    std::unordered_map<std::uint64_t, std::uint32_t> surfaces_;
    std::uint32_t sky_ = kNone;
};
