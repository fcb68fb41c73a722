// SeenLamps: lamps that some rays see although they have no body among the shapes of the scene:
// rays take their light along and go on.
#pragma once

#include "desc/scene_desc.h"
#include "light/light.h"
#include "render/shape_set.h"

#include <memory>
#include <vector>

class SeenLamps {
public:
    // `body`: null for a sun, and for a lamp without a size, which nothing can see. The light has
    // to stay.
    void add(LightDesc::SeenBy by, const Light& light, std::unique_ptr<const Shape> body);
    // Call once when all are there.
    void finish();

    bool isEmpty() const { return lamps_.empty() && suns_.empty(); }
    bool areSeenByCamera() const { return areSeenByCamera_; }
    // The sum of what the ray sees [W/(m^2 sr)] up to its end; lamps in the sky if it has none.
    // `hits` is room to work in.
    Rgb seen(const Ray& ray, bool asCamera, std::vector<Hit>& hits) const;

private:
    struct Lamp {
        const Light* light;
        bool byCamera, byReflections;
        bool isSeen(bool asCamera) const { return asCamera ? byCamera : byReflections; }
    };
    std::vector<Lamp> lamps_, suns_; // lamps_ by the number of their shape
    ShapeSet bodies_;
    bool areSeenByCamera_ = false;
};
