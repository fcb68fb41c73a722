#include "shape/checkered.h"

#include <cmath>
#include <utility>

Checkered::Checkered(std::unique_ptr<const Shape> shape, std::uint32_t otherMaterial)
    : shape_(std::move(shape)), otherMaterial_(otherMaterial) {
    const StillShape* const inLanes = shape_->stillToShade();
    if (inLanes == nullptr || inLanes->kind != StillShape::Kind::Plane) return;
    inLanes_ = *inLanes;
    inLanes_->oddMaterial = otherMaterial;
}

Surface Checkered::surface(const Ray& ray, const Hit& hit) const {
    Surface surface = shape_->surface(ray, hit);
    const float squares = std::floor(surface.uv.x) + std::floor(surface.uv.y);
    // Halves of even numbers are whole; so are those of all floats from 2^24 on.
    if (std::floor(squares / 2) != squares / 2) surface.material = otherMaterial_;
    return surface;
}
