// What a scene needs, found by looking at it; --stats lists it, and what is not needed is skipped.
#pragma once

#include <string>
#include <vector>

struct Feature {
    std::string name;
    bool needed = false;
    std::string reason; // why it is skipped
};
using Features = std::vector<Feature>;
