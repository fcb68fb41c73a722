// PathLights: all that shines in a scene, which light is chosen for a point, and what a ray that
// meets one has to know.
#pragma once

#include "base/math.h"
#include "base/vec.h"
#include "light/light_row.h"
#include "light/sky/sky_table.h"
#include "light/tree/light_tree.h"

#include <cstdint>
#include <span>
#include <vector>

class PathLights {
public:
    static constexpr std::uint32_t kNone = 0xffffffffu;
    // How rays see lamps: as one that a mirror or glass sent, or as a camera ray (and one that went
    // straight on).
    static constexpr std::uint8_t kSeesAsReflection = 1, kSeesAsCamera = 2;

    struct Entry {
        LightRow row;
        bool isOpen = false;    // casts no shadows
        bool isSoft = false;    // its samples differ
        bool isSurface = false; // shadow rays meet it where they end
        bool inCentre = false;  // asked as if it sat in its centre
        bool isPlace = false;   // shadow rays of Whitted pictures start at `place`
        Vec3 place{};
        // Rays that lobes spread add nothing of it, as its samples have all of its light.
        bool isOfSamplesAlone() const { return isOpen || inCentre; }
    };
    // Where shadow rays to it end, as a part of its distance.
    static float endOf(const Entry& entry) { return entry.isSurface ? 1 - 0x1p-15f : 1 - 0x1p-20f; }
    // Returns the number of the light.
    std::uint32_t add(const Entry& entry);
    // A lamp that is no shape. `seenBy`: which rays see it besides those that lobes spread, by
    // these bits.
    void addUnshaped(std::uint32_t light, std::uint8_t seenBy);
    // A side of the surface of an object that is no mesh is a light, or a triangle of a shape is.
    void addObject(std::uint32_t object, bool front, std::uint32_t light);
    void addTriangle(std::uint32_t shape, std::uint32_t triangle, std::uint32_t light);
    // The sky is one of them; `table` says how it is sampled, `brightness` what its
    // numbers are multiplied by.
    void addSky(SkyTable table, SkyRadiance radiance, double brightness, bool isOpen);
    // Call once when all are there and paths choose one of them for a point.
    void makeTree();

    std::size_t size() const { return entries_.size(); }
    bool isEmpty() const { return entries_.empty(); }
    const Entry& entry(std::uint32_t light) const { return entries_[light]; }
    LightTreeView tree() const { return picker_.view(); }

    // Density per steradian with which a sample comes along `dir`, a unit vector, from this light:
    // of its choice and of the direction; infinite where samples have all of its light. `n`: black
    // where both sides of the surface are lit.
    float pdf(Vec3 p, Vec3 n, std::uint32_t light, Vec3 dir) const;
    // The same of the direction alone.
    float pdfOfLight(Vec3 p, std::uint32_t light, Vec3 dir) const;

    std::uint32_t sky() const { return sky_; } // kNone: it is not sampled
    // Its kind, besides those of the list of lights.
    static constexpr std::uint32_t kSkyKind = 0xff;
    SkyView skyView() const { return skyTable_.view(skyRadiance_); }
    // kNone: it is not sampled.
    std::uint32_t ofObject(std::uint32_t object, bool front) const {
        const std::size_t side = 2 * std::size_t{object} + front;
        return side < ofObject_.size() ? ofObject_[side] : kNone;
    }
    std::uint32_t ofTriangle(std::uint32_t shape, std::uint32_t triangle) const {
        if (shape >= ofTriangle_.size() || triangle >= ofTriangle_[shape].size()) return kNone;
        return ofTriangle_[shape][triangle];
    }

    // Calls fn(light, radiance) for every unshaped lamp that the ray meets before `end`. `seenBy`:
    // how the ray sees lamps, 0 for those that a lobe spread.
    template <class Fn>
    void meet(Vec3 org, Vec3 dir, float end, std::uint8_t seenBy, Fn&& fn) const {
        for (const Unshaped& lamp : unshaped_) {
            if (seenBy != 0 && (lamp.seenBy & seenBy) == 0) continue;
            const Meeting at = meetOne(lamp.light, org, dir);
            if (!isBlack(at.radiance) && (at.distance < end || end == kInfinityF))
                fn(lamp.light, at.radiance);
        }
    }
    // What a ray sees of a lamp that it has met; `otherwise` where rounding says that it hasn't.
    Rgb radianceOf(std::uint32_t light, Vec3 org, Vec3 dir, Rgb otherwise) const {
        const Meeting at = meetOne(light, org, dir);
        return at.distance < kInfinityF ? at.radiance : otherwise;
    }
    bool hasUnshaped() const { return !unshaped_.empty(); }
    // Returns which rays see any of them, by those bits.
    std::uint8_t unshapedSeenBy() const { return unshapedSeenBy_; }

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
    LightPicker picker_;
    std::vector<Unshaped> unshaped_;
    std::uint8_t unshapedSeenBy_ = 0;
    std::vector<std::uint32_t> ofObject_;                // by object and side
    std::vector<std::vector<std::uint32_t>> ofTriangle_; // by shape; empty where none shines
    std::uint32_t sky_ = kNone;
    SkyTable skyTable_;
    SkyRadiance skyRadiance_;
    double skyBrightness_ = 1;
};
