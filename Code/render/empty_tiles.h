// EmptyTiles: finds tiles whose camera rays can meet nothing, from the boxes of the shapes. Such a
// tile shows the background, without a ray.
#pragma once

#include "render/camera_rays.h"

class EmptyTiles {
public:
    EmptyTiles(const IntegratorContext& context, const CameraRays& rays);
    // False says nothing.
    bool isEmpty(const Tile& tile) const;

private:
    const CameraRays& rays_;
    const Camera& camera_;
    bool canTell_;
    std::vector<BoundsD> boxes_;
    double slack_; // a box that is farther off the sides of a tile's view is not in it
};
