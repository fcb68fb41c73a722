// Small scenes that together use everything that can be said without a picture file, made from
// random numbers: shapes, places and colours are other ones each time. And what the rows about
// whole pictures do with them.
#pragma once

#include "render/render.h"
#include "verify/meshes.h"

#include <cstdint>
#include <functional>
#include <span>

namespace scenes {

struct Maker {
    const char* name;
    SceneDesc (*make)(meshes::Random&); // 32 x 24 pixels, a few samples each; valid
};
std::span<const Maker> makers();

// The same scene with all lengths times `factor`, and intensities so that the light stays the same.
SceneDesc scaled(SceneDesc desc, double factor);
// The same scene elsewhere. What no transform places has its points in the world: they are moved.
SceneDesc moved(SceneDesc desc, Vec3d by);

// Rendered on one thread but for what `tweak` changes. Pictures are looked for in textureFolder.
using Tweak = std::function<void(RenderSettings&)>;
Picture render(const SceneDesc& desc, const Tweak& tweak = {});

// Of every bit of the colours and of all AOVs: -0 and 0 are told apart.
std::uint64_t hashOf(const Picture& picture);
double largest(const Image& image); // over all pixels and channels

} // namespace scenes
