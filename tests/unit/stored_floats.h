// Pictures of one channel of floats, for the tests that look things up in them.
#pragma once

#include "image/image.h"

#include <utility>
#include <vector>

inline StoredImage floats(int width, int height, std::vector<float> values) {
    StoredImage image;
    image.width = width;
    image.height = height;
    image.channels = 1;
    image.depth = StoredImage::Depth::Float;
    image.floats = std::move(values);
    return image;
}
