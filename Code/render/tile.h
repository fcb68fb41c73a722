// Tile: a rectangle of places of the picture that one worker does at a time.
#pragma once

struct Tile {
    int x0, y0, x1, y1; // x1, y1 exclusive
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};
