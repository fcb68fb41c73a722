// What the rows about whole pictures do with a scene: give it another size or place, render it,
// compare.
#pragma once

#include "render/render.h"

#include <cstdint>

namespace scenes {

// The same scene with all lengths times `factor`, and intensities so that the light stays the same.
SceneDesc scaled(SceneDesc desc, double factor);
// The same scene elsewhere. What no transform places has its points in the world: they are moved.
SceneDesc moved(SceneDesc desc, Vec3d by);

// Rendered on one thread with the scalar kernel, but for what `tweak` changes.
using Tweak = FunctionRef<void(RenderSettings&)>;
Picture render(const SceneDesc& desc, Tweak tweak = {});

// Of every bit of the colours and of all AOVs: -0 and 0 are told apart.
std::uint64_t hashOf(const Picture& picture);
double largest(const Image& image); // over all pixels and channels

} // namespace scenes
