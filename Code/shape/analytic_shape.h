// AnalyticShape: what all shapes with a formula have in common. A derived class says where a line
// meets it in object space and what is there; the ray's way there and back is here, once.
#pragma once

#include "accel/still_shape.h"
#include "base/motion.h"
#include "shape/interval.h"
#include "shape/shape.h"

#include <array>
#include <cstddef>
#include <memory>

class AnalyticShape : public Shape {
public:
    // Static: the smallest box, moving: MovingTransform's; grown by 2^-22 of its largest coordinate
    // (4 float ulp), so that slabs rounded a few times still hold every point of the surface.
    Bounds bounds() const final;
    bool intersect(const Ray& ray, Hit& hit) const final;
    bool occludes(const Ray& ray) const final;
    void collect(const Ray& ray, std::vector<Hit>& hits) const final;
    bool seesFront(const Ray& ray, const Hit& hit) const final;
    Surface surface(const Ray& ray, const Hit& hit) const final { return surfaceFor(ray, hit, {}); }
    Surface surfaceFor(const Ray& ray, const Hit& hit, SurfaceNeeds needs) const final;
    const StillShape* stillToShade() const final {
        return still_.kind == StillShape::Kind::None ? nullptr : &still_;
    }
    SurfaceDerivatives derivatives(const Ray& ray, const Hit& hit) const final;

protected:
    // Up to four crossings in ascending t.
    class Roots {
    public:
        void add(Root root) { roots_[static_cast<std::size_t>(count_++)] = root; }
        void addEnds(const Interval& inside) {
            if (inside.isEmpty()) return;
            add(inside.enter);
            add(inside.exit);
        }
        const Root* begin() const { return roots_.data(); }
        const Root* end() const { return roots_.data() + count_; }

    private:
        std::array<Root, 4> roots_;
        int count_ = 0;
    };
    // A point of the surface in object space; the normal has any length but zero.
    struct Local {
        Vec3d p, normal;
        Vec2d uv;
        Vec3d dpdu, dpdv;
        bool isEven = false; // dpdu and dpdv are the same everywhere
    };

    // How far, in the world, the origin of a ray may be from the point that it leaves.
    struct Clearance {
        double distance;
        const AffineRows& objectFromWorld;
        bool wantsUv; // else describe() may leave them out
        // The most that the object's coordinates change over the distance.
        Vec3d inset() const;
        // How much n.p, of object space, changes over a unit of the world along the normal.
        double steepness(Vec3d n) const;
    };

    // Of the flat end of a cylinder or a cone, at z = -1 or z = 1: p pulled onto it and, if it is
    // closer to the rim, `inset` away from that. uv is the square around the disk, its u turned at
    // the bottom so that a picture is unmirrored from outside.
    static Local cap(Vec3d p, bool top, double radius, double inset);

    AnalyticShape(const MovingTransform& worldFromObject, std::uint32_t material,
                  std::uint32_t object, double radius = 0);

    // Called at the end of a constructor: what surface() would compute again for every hit. Lanes
    // do those `parts`, a bit each, where the shape stands still and the map has an inverse.
    void measure(StillShape::Kind kind, unsigned parts = 1, unsigned caps = 0);
    // Before that: what kernels look up in the shape itself, which is never moved.
    void lend(const StillCorners& corners) { still_.corners = &corners; }
    void lend(const StillCone& cone) { still_.cone = &cone; }

    double radius() const { return still_.radius; }
    bool isStill() const { return !motion_; }
    // Of a shape that moves: its first key.
    const StillShape& still() const { return still_; }
    const Transform& worldFromObject() const { return still_.worldFromObject; }
    // Of a shape that moves, and is at most `farthest` from the object's origin.
    SolidForm movingForm(double farthest) const;
    // Around disks of at most this radius about the z axis, of z from -1 to 1.
    SolidForm tubeForm(double radius) const;
    // By how much the map stretches disks across the axis of such a hull; 0: they are not round
    // there, or lean.
    double roundStretch(Vec3d axis) const;
    // Within a ball around the box, or one that moves.
    SolidForm facesForm(StillFaces::Of of, double farthest) const;

    // The whole line, in double; org and dir are finite, dir is not zero nor of unit length.
    virtual Roots roots(const RayD& ray) const = 0;
    // Pulls p, which is near the surface's `part`, onto it. Closed shapes also keep it away from
    // where parts meet: then an origin at the clearance's distance along the inward normal is
    // inside even after rounding to float.
    virtual Local describe(Vec3d p, std::uint32_t part, const Clearance& clearance) const = 0;
    // Its normal alone, about as exact.
    virtual Vec3d normalAt(Vec3d p, std::uint32_t part) const {
        return describe(p, part, {0, still_.objectFromWorld(), false}).normal;
    }
    // The smallest box of the mapped shape.
    virtual BoundsD boxUnder(const Transform& worldFromObject) const = 0;

private:
    Roots rootsOf(const Ray& ray) const;
    Transform worldFromObjectAt(float time) const {
        return isStill() ? still_.worldFromObject : motion_->at(static_cast<double>(time));
    }
    // As it is under a map, measured.
    StillShape stillUnder(const Transform& worldFromObject) const;
    Surface surfaceOf(const StillShape& shape, const Ray& ray, const Hit& hit,
                      SurfaceNeeds needs) const;

    StillShape still_;                              // of one that moves: at time 0, not measured
    std::unique_ptr<const MovingTransform> motion_; // of one that moves
};

// Smallest box of a disk about `centre` in a plane of constant z, mapped.
BoundsD diskBox(const Transform& worldFromObject, Vec3d centre, double radius);
