// Small scenes that together use everything, for the same-bits tests and the golden pictures.
#pragma once

#include <string>
#include <vector>

namespace scenes {

struct Named {
    std::string name, text;
};
// 64 x 48 pixels, a few samples each. Writes the textures that they name.
const std::vector<Named>& all();

} // namespace scenes
