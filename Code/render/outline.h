// Outlines of convex bodies in a picture, in pixels from the left and the top edge.
#pragma once

#include "base/vec.h"
#include "camera/camera.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

// A body is the hull of balls, or of points.
struct BodyBall {
    Vec3d centre;
    double radius = 0;
};
// A disk is how the camera sees a ball; depth of field makes it larger.
struct OutlineDisk {
    Vec2d centre;
    double radius = 0, blur = 0;
};

// The picture of a camera at rest.
class PictureMap {
public:
    explicit PictureMap(const Camera& camera) : optics_(camera.optics()), axes_(camera.axesAt(0)) {}

    double depth(Vec3d p) const { return dot(p - axes_.eye, axes_.forward); }
    // Returns the disk of a ball in front of the camera.
    OutlineDisk disk(const BodyBall& ball) const {
        const Vec3d from = ball.centre - axes_.eye;
        const double z = optics_.isPerspective ? dot(from, axes_.forward) : 1;
        const double across = dot(from, axes_.right) / z, up = dot(from, axes_.up) / z;
        const double pixel = std::max(optics_.step.x, optics_.step.y);
        OutlineDisk out{{(across - optics_.topLeft.x) / optics_.step.x,
                         (optics_.topLeft.y - up) / optics_.step.y},
                        ball.radius / z / pixel,
                        0};
        if (optics_.hasLens) {
            const double depth = dot(from, axes_.forward);
            out.blur = optics_.apertureRadius * std::fabs(depth / optics_.focusDistance - 1) / z /
                       std::min(optics_.step.x, optics_.step.y);
        }
        return out;
    }
    bool isPerspective() const { return optics_.isPerspective; }

private:
    Camera::Optics optics_;
    Camera::Axes axes_;
};

// The outline of a body, of the part in front of the camera; empty: it is behind.
std::vector<OutlineDisk> outlineOf(const PictureMap& map, std::span<const BodyBall> body);

// An extent says how far disks reach along a direction of unit length.
struct Extent {
    double low = kInfinity, high = -kInfinity;
    double size() const { return high - low; }
};
Extent extentAlong(std::span<const OutlineDisk> outline, Vec2d n, bool withBlur);

// The direction in which an outline is narrowest, without its blur, of those that its sides and
// sixteen others have.
Vec2d narrowestWay(std::span<const OutlineDisk> outline);
