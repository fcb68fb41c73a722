// Camera: where the ray of a place in the picture starts and goes, as Blender's cameras define it
// (the formulas are Cycles', and checked against it). Knows nothing about scenes.
#pragma once

#include "base/motion.h"
#include "base/ray.h"
#include "base/vec.h"
#include "sample/warp.h"

#include <optional>
#include <span>

// Lengths in normalised world units but for the millimetres of lens and sensor.
struct CameraParams {
    enum class Kind { Perspective, Orthographic };
    // Which side of the picture the sensor width (Vertical: height) belongs to. Auto: the longer
    // one, always with the sensor's width.
    enum class SensorFit { Auto, Horizontal, Vertical };
    Kind kind = Kind::Perspective;
    MovingTransform worldFromCamera; // looks along -z, +y up; its scale is dropped
    int width = 1, height = 1;       // of the whole picture, pixels
    Vec2d pixelAspect{1, 1};
    double lensMm = 50;
    double sensorWidthMm = 36, sensorHeightMm = 24;
    SensorFit sensorFit = SensorFit::Auto;
    double shiftX = 0, shiftY = 0;  // in units of the fitted side, up and right
    double orthoScale = 6;          // length of the fitted side
    double clipStart = 0;           // depth along the view axis where rays start
    double apertureRadius = 0;      // of the lens; 0 is a pinhole
    double focusDistance = 10;      // depth of the sharp plane along the view axis
    int apertureBlades = 0;         // below 3: a disk
    double apertureRotationRad = 0; // of the first corner, from +x of the camera
    double apertureRatio = 1;       // anamorphic: lens x is divided by it
};

class Camera {
public:
    explicit Camera(CameraParams params);

    // pixel: from the left and the TOP edge of the picture; (0.5, 0.5) is the centre of the first
    // pixel of the file. lens: a point of the unit square, of no effect without hasLens(); time in
    // [0,1] of the shutter. dir has unit length; tMin is where the ray passes clipStart.
    Ray ray(Vec2d pixel, Vec2 lens, float time) const;

    // dir and tMin of ray() for many places x, y; of cameras with a shared origin.
    void pinholeRays(std::span<const double> x, std::span<const double> y, std::span<Vec3> dir,
                     std::span<float> tMin) const;

    // All that ray() is made of, of a perspective camera at rest with a lens: for who makes many
    // rays at once.
    struct Lens {
        Vec3d right, up, forward, eye;
        Vec2d topLeft, step; // at depth 1, of the picture and of its pixels
        double focusDistance, apertureRadius, apertureRatio, clipStart;
        int blades;            // 0: a round one
        const double* corners; // Polygon::corners()
    };
    std::optional<Lens> lens() const;
    // The same for a camera whose rays start in one point: its lens has no size.
    std::optional<Lens> pinhole() const;

    // What ray() rounds: for cameras without a lens at rest, the line of a place in the picture.
    struct Line {
        Vec3d org, dir; // dir of any length
    };
    Line line(Vec2d pixel) const { return lineFrom(atRest_, pixel); }

    // The camera's place and the unit vector that it looks along.
    struct View {
        Vec3d eye, axis;
    };
    View view(float time) const;

    bool hasLens() const { return params_.apertureRadius > 0; }
    bool isMoving() const { return !params_.worldFromCamera.isStatic(); }
    // All rays start at the same point, to the last bit.
    bool hasSharedOrigin() const {
        return params_.kind == CameraParams::Kind::Perspective && !hasLens() && !isMoving();
    }

private:
    struct Axes {
        Vec3d right, up, forward, eye;
    };
    Lens lensAtRest() const;
    static Axes axesOf(const Transform& worldFromCamera);
    Axes axesAt(float time) const {
        return isMoving() ? axesOf(params_.worldFromCamera.at(static_cast<double>(time))) : atRest_;
    }

    Line lineFrom(const Axes& axes, Vec2d pixel) const {
        const Vec3d across = axes.right * (topLeft_.x + pixel.x * step_.x) +
                             axes.up * (topLeft_.y - pixel.y * step_.y);
        if (params_.kind == CameraParams::Kind::Perspective)
            return {axes.eye, across + axes.forward};
        return {axes.eye + across, axes.forward};
    }
    Ray rayFrom(const Axes& axes, Vec2d pixel, Vec2 lens, float time) const;
    float clipDepth(Vec3d dir, const Axes& axes) const {
        return static_cast<float>(params_.clipStart / dot(dir, axes.forward));
    }

    CameraParams params_;
    Polygon aperture_;
    Axes atRest_;
    // A place of the picture is topLeft_ + (px step_.x, -py step_.y) along the camera's axes: at
    // depth 1 (perspective) or anywhere (orthographic).
    Vec2d topLeft_, step_;
};
