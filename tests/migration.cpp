// What examples/migration.md says of channels, directions and numbers, against what is written.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/normal_map.hpp>

using namespace bumpshadow;

namespace {

using texel = std::array<int, 4>;

texel texel_of(const std::vector<std::byte>& bytes, int width, int x, int y) {
    texel t{};
    for (std::size_t c = 0; c < 4; ++c)
        t[c] = std::to_integer<int>(bytes[4 * (std::size_t(y) * std::size_t(width) + std::size_t(x)) + c]);
    return t;
}

struct two_layers {
    std::vector<std::byte> first, second;
};

// The eight horizons of a map as the page's two textures.
template <class Bake>
two_layers layers_of(const std::vector<float>& heights, glm::ivec2 extent, const Bake& bake) {
    height_map<float> map = tight_height_map(heights.data(), extent);
    map.edge = edge_mode::clamp;
    std::vector<glm::dvec2> directions(8);
    fill_directions(directions);
    std::vector<float> slopes(required_size(extent, 8));
    const horizon_map horizons{.values = slopes, .extent = extent, .bearings = 8};
    REQUIRE(bake(map, directions, horizons));
    const sine_layers encoding{.separate = true};
    const texture_layout layout = layout_of(encoding, extent);
    two_layers result{std::vector<std::byte>(layout.required_size()), std::vector<std::byte>(layout.required_size())};
    const texture out[] = {{result.first, layout}, {result.second, layout}};
    REQUIRE(pack_sine_layers(horizons, directions, encoding, {.fit = slice_fit::point}, out));
    return result;
}

}  // namespace

TEST_CASE("migration: which horizon is in which channel of the two textures") {
    // Seen from (4, 4): a wall 3 high, 2 texels to the right; another, 4 high, 3 texels down. Slopes 3/2 and 4/3.
    const glm::ivec2 extent{9, 9};
    std::vector<float> heights(81);
    for (std::size_t i = 0; i < 9; ++i) heights[i * 9 + 6] = 3.0f;
    for (std::size_t i = 0; i < 9; ++i) heights[7 * 9 + i] = 4.0f;
    const two_layers found = layers_of(heights, extent, [](const auto& map, const auto& directions, const auto& out) {
        return bake_exact(map, directions, out);
    });
    const auto byte_of = [](double slope) { return int(255.0 * slope / std::sqrt(1.0 + slope * slope) + 0.5); };
    const texel first = texel_of(found.first, 9, 4, 4), second = texel_of(found.second, 9, 4, 4);
    CHECK(first[0] == byte_of(3.0 / 2.0));  // 0 degrees: right
    CHECK(first[0] == 212);
    CHECK(first[2] == byte_of(4.0 / 3.0));  // 90 degrees: down in the picture
    CHECK(first[2] == 204);
    CHECK(second[0] == 0);  // 180 and 270 degrees look away from both
    CHECK(second[2] == 0);
    CHECK(second[1] == 0);  // and so does 225 between them
    // 45 degrees: the right wall after 2 sqrt(2), the lower one after 3 sqrt(2).
    CHECK(first[1] == byte_of(3.0 / (2.0 * std::sqrt(2.0))));
    // 135 degrees: the lower wall alone. 315: the right one.
    CHECK(first[3] == byte_of(4.0 / (3.0 * std::sqrt(2.0))));
    CHECK(second[3] == byte_of(3.0 / (2.0 * std::sqrt(2.0))));
}

TEST_CASE("migration: for a light whose y points up the channels are exchanged as the page says") {
    const glm::ivec2 extent{12, 10};
    std::vector<float> heights, mirrored(120);
    for (std::size_t i = 0; i < 120; ++i) heights.push_back(float(i * 37 % 23) / 5.0f);
    for (std::size_t y = 0; y < 10; ++y)
        for (std::size_t x = 0; x < 12; ++x) mirrored[(9 - y) * 12 + x] = heights[y * 12 + x];
    const auto exact = [](const auto& map, const auto& directions, const auto& out) {
        return bake_exact(map, directions, out);
    };
    const two_layers down = layers_of(heights, extent, exact), up = layers_of(mirrored, extent, exact);
    for (int y = 0; y < 10; ++y)
        for (int x = 0; x < 12; ++x) {
            texel first = texel_of(down.first, 12, x, y), second = texel_of(down.second, 12, x, y);
            std::swap(first[1], second[3]);
            std::swap(first[2], second[2]);
            std::swap(first[3], second[1]);
            CHECK(first == texel_of(up.first, 12, x, 9 - y));
            CHECK(second == texel_of(up.second, 12, x, 9 - y));
        }
}

TEST_CASE("migration: masks of flat and of tilted ground") {
    const glm::ivec2 extent{3, 3};
    const auto masks_of = [&](glm::vec3 normal, const ssbump& encoding) {
        std::vector<float> planes(27);
        const normal_map normals{.values = planes, .extent = extent};
        for (int y = 0; y < 3; ++y)
            for (int x = 0; x < 3; ++x) normals.set(x, y, normal);
        const texture_layout layout = layout_of(encoding, extent);
        std::vector<std::byte> bytes(layout.required_size());
        REQUIRE(pack_ssbump(normals, encoding, {bytes, layout}));
        return texel_of(bytes, 3, 1, 1);
    };
    const glm::vec3 flat{0.0f, 0.0f, 1.0f};
    CHECK(masks_of(flat, {.occlusion = mask_occlusion::none}) == texel{147, 147, 147, 255});
    CHECK(masks_of(flat, {.occlusion = mask_occlusion::none, .detail = true}) == texel{128, 128, 128, 255});
    // 30 degrees towards the bottom of the picture: 0.5774 cos 30 +- 0.7071 sin 30, and 0.5774 cos 30.
    const glm::vec3 downwards{0.0f, 0.5f, std::sqrt(0.75f)};
    const texel source = masks_of(downwards, {.occlusion = mask_occlusion::none});
    CHECK(std::abs(source[0] - 127.5) < 1.0);
    CHECK(source[1] == int(255.0 * (0.5 + 0.5 * std::sqrt(0.5)) + 0.5));
    CHECK(source[2] == int(255.0 * (0.5 - 0.5 * std::sqrt(0.5)) + 0.5));
    const texel other = masks_of(downwards, {.y = normal_y::up, .occlusion = mask_occlusion::none});
    CHECK(other == texel{source[0], source[2], source[1], 255});
    // Towards the right: red.
    const texel right = masks_of({0.5f, 0.0f, std::sqrt(0.75f)}, {.occlusion = mask_occlusion::none});
    CHECK(right[0] > right[1]);
    CHECK(right[1] == right[2]);
}

TEST_CASE("migration: masks of open ground are those of no occlusion") {
    const glm::ivec2 extent{4, 4};
    const std::vector<float> heights(16);
    std::vector<glm::dvec2> directions(32);
    fill_directions(directions);
    std::vector<float> slopes(required_size(extent, 32)), planes(48);
    const horizon_map horizons{.values = slopes, .extent = extent, .bearings = 32};
    const normal_map normals{.values = planes, .extent = extent};
    const auto map = tight_height_map(heights.data(), extent);
    REQUIRE(bake_cascade(map, directions, horizons));
    REQUIRE(bake_normals(map, normals));
    const texture_layout layout = layout_of(ssbump{}, extent);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(pack_ssbump(horizons, directions, normals, {}, {bytes, layout}));
    CHECK(texel_of(bytes, 4, 2, 1) == texel{147, 147, 147, 255});
}

TEST_CASE("migration: green of a normal map") {
    // Ground that falls by 3/4 a row faces down in the picture: normal (0, 0.6, 0.8).
    const glm::ivec2 extent{5, 5};
    std::vector<float> heights, planes(75);
    for (int y = 0; y < 5; ++y) heights.insert(heights.end(), 5, -0.75f * float(y));
    const normal_map normals{.values = planes, .extent = extent};
    REQUIRE(bake_normals(tight_height_map(heights.data(), extent), normals));
    for (const auto& [y, green] : {std::pair{normal_y::down, 204}, std::pair{normal_y::up, 51}}) {
        std::vector<std::byte> bytes(100);
        REQUIRE(encode_normals(normals, {.y = y}, {.bytes = bytes, .extent = extent}));
        CHECK(texel_of(bytes, 5, 2, 2) == texel{128, green, 230, 255});
    }
}
