// SkyCells: how bright a picture around the scene is, cell by cell, for who samples it as a lamp.
#pragma once

#include "texture/environment.h"

#include <optional>
#include <string>
#include <vector>

struct SkyCells {
    int width = 0, height = 0;
    std::vector<float> luminance; // rows from the bottom, from the left
};
// The mean over all texels that have a say in a cell, between texels those of the next cell too: a
// cell is black only where the picture is. The cells are the picture's texels, or larger ones.
SkyCells skyCells(const Environment& environment, int mostColumns, int mostRows, int threads = 1);

// What is wrong with a picture that is to light the scene, with the place of the first such pixel
// from the left and from the top: one that is negative, or no number. Nothing if all is well.
std::optional<std::string> whyNoLight(const StoredImage& image);
