// Tile: a rectangle of places of the picture that one worker does at a time.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

struct Tile {
    int x0, y0, x1, y1; // x1, y1 exclusive
    int width() const { return x1 - x0; }
    int height() const { return y1 - y0; }
};

// Places in an order that keeps neighbours together: along Morton's curve through squares, so that
// as many places as a register has lanes are a square as well. Their rays meet fewer boxes than
// those of a row.
struct TileSquare {
    static constexpr int kSide = 16;
    static constexpr std::size_t kPlaces = kSide * kSide;
    struct Step {
        std::uint8_t x, y;
    };
    static constexpr auto kCurve = [] { // from the square's upper left place
        std::array<Step, kPlaces> steps{};
        for (unsigned i = 0; i < steps.size(); ++i)
            for (unsigned bit = 0; bit < 4; ++bit) {
                steps[i].x |= static_cast<std::uint8_t>((i >> (2 * bit) & 1) << bit);
                steps[i].y |= static_cast<std::uint8_t>((i >> (2 * bit + 1) & 1) << bit);
            }
        return steps;
    }();
};

// All places of the tile in order: whole(left, top) for those of a whole square, as most are,
// fn(x, y) for each of the others.
template <class SquareFn, class Fn>
void forEachSquare(const Tile& tile, const SquareFn& whole, const Fn& fn) {
    constexpr int kSide = TileSquare::kSide;
    for (int top = tile.y0; top < tile.y1; top += kSide)
        for (int left = tile.x0; left < tile.x1; left += kSide) {
            if (tile.x1 - left >= kSide && tile.y1 - top >= kSide) {
                whole(left, top);
                continue;
            }
            for (const TileSquare::Step step : TileSquare::kCurve) {
                const int x = left + step.x, y = top + step.y;
                if (x < tile.x1 && y < tile.y1) fn(x, y);
            }
        }
}
// The places of a whole square in that order, two at once, which are neighbours in a row: fn(x, y)
// for the left ones.
template <class Fn> void forEachTwo(int left, int top, const Fn& fn) {
    for (std::size_t i = 0; i < TileSquare::kPlaces; i += 2)
        fn(left + TileSquare::kCurve[i].x, top + TileSquare::kCurve[i].y);
}
// fn(x, y) for all places of the tile, in that order.
template <class Fn> void forEachPlace(const Tile& tile, const Fn& fn) {
    forEachSquare(
        tile,
        [&](int left, int top) {
            for (const TileSquare::Step step : TileSquare::kCurve) fn(left + step.x, top + step.y);
        },
        fn);
}
