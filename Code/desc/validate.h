// What can be wrong with a description: ErrorList, boxes around it, and validate().
#pragma once

#include "base/bounds.h"
#include "base/error.h"
#include "base/source.h"
#include "desc/scene_desc.h"

#include <cstddef>
#include <string>
#include <vector>

// Errors that need not stop at the first one, thrown together as one Error.
class ErrorList {
public:
    explicit ErrorList(const SourceFile& source) : source_(source) {}

    // The text is made only when it will be shown: a file can hold a million errors.
    template <class MakeText> void add(SourceLoc loc, MakeText&& makeText) {
        if (hasRoom())
            addComplete(locatedAt(loc, makeText(), "error"));
        else
            ++count_;
    }
    void addComplete(std::string message);
    // Puts the errors of another list behind these.
    void append(const ErrorList& other) {
        for (const std::string& message : other.messages_)
            if (hasRoom()) messages_.push_back(message);
        count_ += other.count_;
    }
    std::size_t count() const { return count_; }
    const std::vector<std::string>& messages() const { return messages_; } // the first ones
    void throwIfAny() const;
    // located(), or only the file where the place is not known.
    std::string locatedAt(SourceLoc loc, std::string_view what, std::string_view severity) const;

private:
    static constexpr std::size_t kShown = 20;
    bool hasRoom() const { return messages_.size() < kShown; }

    const SourceFile& source_;
    std::vector<std::string> messages_;
    std::size_t count_ = 0;
};

// ---- boxes in double around what a description says

// Around all bounded objects at all their keys, in the world; empty when there are none.
BoundsD boundsOf(const SceneDesc& desc, int threads = 1);
// The same, but only until they are as long as `enough` along an axis.
BoundsD boundsUpTo(const SceneDesc& desc, double enough, int threads = 1);
// Around its points; empty when they are still to be read from a file.
BoundsD boundsOf(const MeshDesc& mesh, int threads = 1);

// What of a scene is near an eye, for coordinates that are fine where the eye sees details.
struct NearBounds {
    BoundsD near, all;  // around the objects that are not far, and around all
    double nearest = 0; // the distance of the nearest object
};
// `farTimes`: an object is far when it is more than so many times as distant as the nearest one.
// An object around the eye counts as 1/64 of its size away: what it is made of may be that near.
// No distance counts as less than `least`.
NearBounds boundsNear(const SceneDesc& desc, Vec3d eye, double farTimes, double least,
                      int threads = 1);

// ---- the rules of a scene that do not depend on the format it came from

// Throws one Error with all mistakes (the first 20, with their places). What only looks wrong, as a
// scene without light, becomes a warning. After it, every handle and index is in range, every
// number that has an effect is finite and in its range (desc/properties.h), every transform can be
// inverted. Meshes that still name a file
// (read/mesh_files.h) are not looked into.
// The same for any number of threads.
void validate(const SceneDesc& desc, const SourceFile& source, Diagnostics& diagnostics,
              int threads = 1);

// What is wrong with the part of the picture that is wanted; empty when nothing is.
std::string faultOfCrop(const SettingsDesc& settings);

// Whether a light shines by a surface, and has none. Such a light is left out, with a warning.
bool hasNoArea(const LightDesc& light);
