// The order of a tile's places.
#include "film/tile.h"

#include "check.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace test_tile {

namespace {

using Place = std::pair<int, int>;

std::vector<Place> placesOf(const Tile& tile) {
    std::vector<Place> places;
    forEachPlace(tile, [&](int x, int y) { places.emplace_back(x, y); });
    return places;
}

} // namespace

TEST(tile_has_every_place_once) {
    for (const auto& [x, y] : {Place{0, 0}, Place{3, 5}, Place{-7, 1000}})
        for (int width = 0; width <= 40; width += 1 + width / 7)
            for (int height = 0; height <= 40; height += 1 + height / 7) {
                const Tile tile{x, y, x + width, y + height};
                std::vector<Place> places = placesOf(tile), expected;
                for (int i = tile.x0; i < tile.x1; ++i)
                    for (int j = tile.y0; j < tile.y1; ++j) expected.emplace_back(i, j);
                std::sort(places.begin(), places.end());
                CHECK_INFO(places == expected, x << ", " << y << ": " << width << " x " << height);
            }
}

// As many as registers have lanes, wherever the tile begins.
TEST(tile_places_of_a_register_are_a_square) {
    const std::vector<Place> places = placesOf({5, 3, 5 + 48, 3 + 32});
    for (const std::size_t lanes : {4u, 8u, 16u, 64u, 256u})
        for (std::size_t first = 0; first + lanes <= places.size(); first += lanes) {
            int x0 = places[first].first, x1 = x0, y0 = places[first].second, y1 = y0;
            for (std::size_t i = first; i < first + lanes; ++i) {
                x0 = std::min(x0, places[i].first), x1 = std::max(x1, places[i].first);
                y0 = std::min(y0, places[i].second), y1 = std::max(y1, places[i].second);
            }
            const int width = x1 - x0 + 1, height = y1 - y0 + 1;
            CHECK_EQUAL(static_cast<std::size_t>(width * height), lanes);
            CHECK(width == height || width == 2 * height);
        }
}

} // namespace test_tile
