// From the tree of geometries to the flat list of objects: transforms multiplied out, materials
// handed down, and a name for each that says where it came from ("stack/box/lid").
#pragma once

#include "read/json/geometry.h"
#include "read/unique_names.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

class JsonObjects {
public:
    JsonObjects(JsonProblems& problems, std::size_t expected);

    // A geometry that stands in the list "objects", with all that is below it.
    void addRoot(const std::vector<JsonGeometry>& all, std::size_t root);

    // An empty list after an error.
    std::vector<ObjectDesc> take();

private:
    using Handles = std::span<const Handle>;

    void flatten(const std::vector<JsonGeometry>& all, const JsonGeometry& geometry,
                 const Keys& worldFromParent, Handles inherited, const std::string& path);
    bool hasRoomFor(const Keys& keys, std::size_t materials, SourceLoc loc);
    void failKeys(const JsonGeometry& geometry, const Keys& worldFromParent);

    JsonProblems& problems_;
    std::vector<ObjectDesc> objects_;
    UniqueNames names_;
    std::size_t size_ = 0; // of all keys and material lists
    bool failed_ = false;
};
