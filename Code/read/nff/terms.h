// From the terms of NFF to ours: each function is one rule of the standard (NFF 3.1, SPD readme,
// Haines), and knows nothing about the text of a file.
#pragma once

#include "base/vec.h"
#include "desc/name_table.h"
#include "desc/scene_desc.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>

struct NffFill {
    Rgbd color{1, 1, 1};
    double diffuse = 0, specular = 0; // Kd, Ks
    double shine = 0;                 // power of the cosine to the mirrored direction
    double transmittance = 0;         // T
    double ior = 1;                   // many files write 0 for opaque surfaces
    bool operator==(const NffFill&) const = default;
};

// Which fills are equal.
class NffSurfaceTable {
public:
    // Remembers the number, unless an equal fill was there already; then says the number of that.
    std::optional<std::uint32_t> insert(const NffFill& fill, std::uint32_t number) {
        const auto [r, g, b] = fill.color;
        Numbers& numbers = fills_.emplace_back(Numbers{r, g, b, fill.diffuse, fill.specular,
                                                       fill.shine, fill.transmittance, fill.ior});
        for (double& value : numbers) value += 0.0; // -0 becomes 0: bytes tell fills apart
        const auto first =
            table_.insert({reinterpret_cast<const char*>(numbers.data()), sizeof numbers}, number);
        if (first) fills_.pop_back();
        return first;
    }

private:
    using Numbers = std::array<double, 8>;
    std::deque<Numbers> fills_; // which stay where they are
    NameTable table_;
};

struct NffView {
    Vec3d from, at, up;
    double angleDeg = 45;
    int width = 512, height = 512;
};

// Without colours, every one of n lights and the ambient term have this intensity: sqrt(n)/(2n).
// No lights give 0.
double nffIntensity(std::size_t lightCount);

MaterialDesc nffMaterial(const NffFill& fill);
LightDesc nffLight(Vec3d position, Rgbd intensity);
// angleToEdges: see ReadOptions::nffAngleToEdges. The view has a direction, and `up` another one.
CameraDesc nffCamera(const NffView& view, bool angleToEdges);
bool isAlong(Vec3d a, Vec3d b); // one of them is zero or they are parallel, but for 1e-10 radians

// Nothing when it has no height or no radius. Radii are >= 0.
std::optional<ObjectDesc> nffCone(Vec3d base, double baseRadius, Vec3d apex, double apexRadius);
// Both sides, or the inside of what is opaque and has a negative radius. The standard allows to
// leave out the backs of what is opaque, as nothing of its scenes shows them; but for the teapot,
// whose lid has a gap, and what others wrote, so that programs that draw NFF draw them.
ObjectDesc::Sides nffSides(const NffFill& fill, bool insideOnly);
// Do the corners span more than a line?
bool hasArea(std::span<const Vec3d> corners);
