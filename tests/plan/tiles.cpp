#include <bumpshadow/plan/tiles.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "support/horizons.hpp"

using namespace bumpshadow;

namespace {

constexpr std::array edges = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};

// Every texel from one before a tile to one behind it, looked up beyond the map by hand.
float steepest_near(const horizons& map, edge_mode edge, int side, glm::ivec2 tile) {
    const auto index = [edge](int i, int n) {
        if (i >= 0 && i < n) return i;
        if (edge == edge_mode::repeat) return i < 0 ? n - 1 : 0;
        return edge == edge_mode::open ? -1 : i < 0 ? 0 : n - 1;  // clamped and mirrored: the border texel
    };
    const glm::ivec2 first = tile * side,
                     last(std::min(first.x + side, map.extent.x), std::min(first.y + side, map.extent.y));
    float most = no_horizon;
    for (int b = 0; b < map.bearings; ++b)
        for (int y = first.y - 1; y <= last.y; ++y)
            for (int x = first.x - 1; x <= last.x; ++x) {
                const int i = index(x, map.extent.x), j = index(y, map.extent.y);
                if (i >= 0 && j >= 0) most = std::max(most, map.at(b, i, j));
            }
    return most;
}

}  // namespace

TEST_CASE("the steepest horizon of each tile, against all of its texels") {
    for (const glm::ivec2 extent : {glm::ivec2(16, 16), {13, 7}, {1, 9}, {5, 1}, {1, 1}})
        for (const int side : {1, 3, 4, 8, 32})
            for (const edge_mode edge : edges) {
                const horizons map = horizons::random(extent, 3, std::uint64_t(extent.x * 100 + side));
                const glm::ivec2 tiles = tile_count(extent, side);
                CHECK(tiles.x == (extent.x + side - 1) / side);
                std::vector<float> found(std::size_t(tiles.x * tiles.y) + 1, -7.0f);
                REQUIRE(tile_horizons(map.view(), edge, side, found));
                for (int y = 0; y < tiles.y; ++y)
                    for (int x = 0; x < tiles.x; ++x)
                        CHECK(found[std::size_t(y * tiles.x + x)] == steepest_near(map, edge, side, {x, y}));
                CHECK(found.back() == -7.0f);
            }
}

TEST_CASE("one steep texel counts where filtering reaches it, and nowhere else") {
    horizons map({12, 12}, 2);
    std::fill(map.slopes.begin(), map.slopes.end(), 0.0f);
    map.at(1, 4, 6) = 3.0f;  // the first column of tile 1, the middle of row 1
    std::array<float, 9> found{};
    REQUIRE(tile_horizons(map.view(), edge_mode::repeat, 4, found));
    CHECK(found == std::array<float, 9>{0, 0, 0, 3, 3, 0, 0, 0, 0});
    // In a corner of the map, only repeating carries it across.
    map.at(1, 4, 6) = 0.0f;
    map.at(0, 0, 0) = 2.0f;
    REQUIRE(tile_horizons(map.view(), edge_mode::repeat, 4, found));
    CHECK(found == std::array<float, 9>{2, 0, 2, 0, 0, 0, 2, 0, 2});
    for (const edge_mode edge : {edge_mode::clamp, edge_mode::mirror, edge_mode::open}) {
        REQUIRE(tile_horizons(map.view(), edge, 4, found));
        CHECK(found == std::array<float, 9>{2, 0, 0, 0, 0, 0, 0, 0, 0});
    }
}

TEST_CASE("holes shadow no tile") {
    horizons map({8, 4}, 1);
    std::fill(map.slopes.begin(), map.slopes.end(), no_horizon);
    map.at(0, 7, 0) = -0.5f;
    std::array<float, 2> found{};
    REQUIRE(tile_horizons(map.view(), edge_mode::open, 4, found));
    CHECK(found[0] == no_horizon);
    CHECK(found[1] == -0.5f);
}

TEST_CASE("tiles: bad sizes are named, and nothing is written") {
    const horizons map = horizons::random({8, 8}, 2, 1);
    std::array<float, 4> found;
    found.fill(-7.0f);
    const auto refused = [&](const status& s, error code, const char* argument) {
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        CHECK(found == std::array<float, 4>{-7.0f, -7.0f, -7.0f, -7.0f});
    };
    refused(tile_horizons(map.view(), edge_mode::repeat, 0, found), error::not_positive, "side of a tile");
    refused(tile_horizons(map.view(), edge_mode::repeat, -4, found), error::not_positive, "side of a tile");
    refused(tile_horizons(map.view(), edge_mode::repeat, 3, found), error::too_small, "tiles");
    refused(tile_horizons({}, edge_mode::repeat, 4, found), error::not_positive, "horizon map extent.x");
    horizon_map cut = map.view();
    cut.values = cut.values.first(127);
    refused(tile_horizons(cut, edge_mode::repeat, 4, found), error::too_small, "horizon map size");
}
