// A picture as text for a terminal: two pixels per cell, by the upper half block and 24-bit
// colours.
#pragma once

#include "image/image.h"

#include <string>

// At most `columns` wide and `rows` high, the shape of the picture kept; every cell is the mean of
// the pixels below it. Cells are taken as twice as high as wide.
std::string previewText(const Image& image, int columns, int rows);
