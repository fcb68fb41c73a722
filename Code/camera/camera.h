// Camera: where the ray of a place in the picture starts and goes, as Blender's cameras define it
// (the formulas are Cycles', and checked against it). Knows nothing about scenes.
#pragma once

#include "base/motion.h"
#include "base/ray.h"
#include "base/ray_cone.h"
#include "base/vec.h"
#include "sample/warp.h"

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

    // Returns how wide the ray of a pixel is, as its direction and time say; a lens counts as a pinhole.
    RayCone cone(Vec3 dir, float time) const;

    // Unit vectors and the camera's place.
    struct Axes {
        Vec3d right, up, forward, eye;
    };
    Axes axesAt(float time) const {
        return isMoving() ? axesOf(params_.worldFromCamera.at(static_cast<double>(time))) : atRest_;
    }
    // All else that ray() is made of: for lanes, which make many at once.
    struct Optics {
        bool isPerspective, hasLens;
        // A place of the picture is topLeft + (px step.x, -py step.y) along the camera's axes: at
        // depth 1 (perspective) or anywhere (orthographic).
        Vec2d topLeft, step;
        double focusDistance, apertureRadius, apertureRatio, clipStart;
        int blades;            // 0: a round one
        const double* corners; // Polygon::corners()
    };
    Optics optics() const; // is valid as long as this camera

    // What ray() rounds: for cameras without a lens at rest, the line of a place in the picture.
    struct Line {
        Vec3d org, dir; // dir of any length
    };
    Line line(Vec2d pixel) const;

    bool hasLens() const { return optics_.hasLens; }
    bool isMoving() const { return !params_.worldFromCamera.isStatic(); }
    // All rays start at the same point, to the last bit.
    bool hasSharedOrigin() const { return optics_.isPerspective && !hasLens() && !isMoving(); }

private:
    static Axes axesOf(const Transform& worldFromCamera);

    CameraParams params_;
    Polygon aperture_;
    Axes atRest_;
    Optics optics_;
};
