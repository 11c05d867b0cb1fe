// The ends of what functions take: sizes that would wrap, numbers whose squares overflow or vanish, counts of 0.

#include <array>
#include <climits>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <span>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/measure/flip.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/plan/tiles.hpp>
#include <bumpshadow/reference/lighting.hpp>
#include <bumpshadow/reference/pixel_shadow.hpp>
#include <bumpshadow/reference/reflection.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/reference/triangle.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/texture.hpp>

using namespace bumpshadow;

namespace {

constexpr std::size_t most = (std::numeric_limits<std::size_t>::max)();
constexpr float infinity = std::numeric_limits<float>::infinity(),
                not_a_number = std::numeric_limits<float>::quiet_NaN();
constexpr float largest = (std::numeric_limits<float>::max)();

void refused(const status& s, error code, std::string_view argument) {
    CAPTURE(s.message().c_str());
    CHECK(s.code() == code);
    CHECK(s.argument() == argument);
}

}  // namespace

TEST_CASE("sums and products that a size does not hold are the largest one") {
    CHECK(saturated_sum(most - 3, 3) == most);
    CHECK(saturated_sum(most - 3, 4) == most);
    CHECK(saturated_product(0, most) == 0);
    CHECK(saturated_product(most, 0) == 0);
    CHECK(saturated_product(most, 1) == most);
    CHECK(saturated_product(most / 3, 3) == most);  // 2^32 - 1 and 2^64 - 1 are multiples of 3
    CHECK(saturated_product(most / 3 + 1, 3) == most);
    constexpr std::size_t root = std::size_t(1) << (std::numeric_limits<std::size_t>::digits / 2);
    CHECK(saturated_product(root, root) == most);
    CHECK(saturated_product(root - 1, root + 1) == most);  // root^2 - 1
    CHECK(saturated_product(root - 1, root - 1) == most - 2 * (root - 1));
    CHECK(part_count(0, 16) == 0);
    CHECK(part_count(-3, 16) == 0);
    CHECK(part_count(16, 16) == 1);
    CHECK(part_count(17, 16) == 2);
    CHECK(part_count(INT_MAX, 16) == 1 << 27);
    CHECK(part_count(INT_MAX, INT_MAX) == 1);
}

TEST_CASE("views whose sizes would wrap are refused by name") {
    constexpr std::size_t half = most / 2 + 1;  // twice it is 0
    constexpr int edge = 1 << 30;
    const texture_layout wide{.format = texel_format::rgba32f, .extent = {edge, edge}};
    CHECK(wide.required_size() == most);
    refused(check(const_texture{{}, wide}), error::too_small, "texture size");
    const texture_layout deep{
        .format = texel_format::rg8, .kind = texture_kind::volume, .extent = {edge, edge}, .depth = 8};
    CHECK(deep.required_size() == most);
    refused(check(const_texture{{}, deep}), error::too_small, "texture size");
    const texture_layout many{
        .format = texel_format::r8, .kind = texture_kind::array, .extent = {edge, edge}, .layers = 16, .mips = 31};
    refused(check(const_texture{{}, many}), error::too_small, "texture size");

    std::vector<float> floats(45);
    std::vector<std::byte> bytes(60);
    constexpr glm::ivec2 extent{5, 3};
    const auto both = [&](const horizon_map& map, std::string_view output, std::string_view input) {
        CHECK(map.required_size() == most);
        refused(check_output(map, extent, std::size_t(map.bearings)), error::too_small, output);
        refused(check_horizons(map), error::too_small, input);
    };
    both({floats, extent, 1, half}, "output size", "horizon map size");
    both({floats, extent, 3, 0, half}, "output size", "horizon map size");
    // Tightly packed slices of rows that are not: 3 half is half again.
    both({floats, extent, 2, half}, "output slice_stride", "horizon map size");
    CHECK(required_size({INT_MAX, INT_MAX}, INT_MAX) == most);

    refused(check(const_pixels{bytes, extent, 4, half}, extent, 3), error::too_small, "picture size");
    refused(check(rgb_image{floats, extent, half}), error::too_small, "image size");
    refused(check(normal_map{floats, extent, 0, half}, extent), error::too_small, "normals size");
    refused(check(normal_map{floats, extent, half}, extent), error::too_small, "normals plane_stride");

    // Three rows of five.
    CHECK(bool(check(const_pixels{bytes, extent, 4}, extent, 3)));
    CHECK(bool(check(rgb_image{floats, extent})));
    CHECK(bool(check(normal_map{floats, extent}, extent)));
    CHECK(bool(check_output({floats, extent, 3}, extent, 3)));
    if constexpr (sizeof(std::size_t) == 8) {
        refused(check(const_pixels{bytes, {INT_MAX, INT_MAX}, 4}, {INT_MAX, INT_MAX}, 3), error::too_small,
                "picture size");
        // 4 (2^31 - 1)^2 = 2^64 - 2^34 + 4 is the largest that is counted.
        const texture_layout longest{.format = texel_format::rgba8, .extent = {INT_MAX, INT_MAX}};
        CHECK(longest.required_size() == most - ((std::size_t(1) << 34) - 5));
        CHECK(texture_layout{.format = texel_format::bc4, .extent = {INT_MAX, INT_MAX}}.required_size() ==
              std::size_t(1) << 61);
    }
}

TEST_CASE("views of negative extents need more than there is") {
    constexpr std::size_t half = most / 2;
    for (const int rows : {0, -1, INT_MIN}) {
        CHECK(const_pixels{{}, {5, rows}, 4}.required_size() > half);
        CHECK(rgb_image{{}, {5, rows}}.required_size() > half);
        CHECK(normal_map{{}, {5, rows}}.required_size() > half);
        CHECK(horizon_map{{}, {5, rows}, 2}.required_size() > half);
        CHECK(horizon_map{{}, {5, 3}, rows}.required_size() > half);
    }
}

TEST_CASE("mips beyond the chain are texels") {
    CHECK(mip_extent(8, 3) == 1);
    CHECK(mip_extent(8, 40) == 1);
    CHECK(mip_extent(INT_MAX, 30) == 1);
    CHECK(mip_extent(INT_MAX, INT_MAX) == 1);
    const texture_layout layout{.extent = {8, 8}, .mips = 40};
    CHECK(layout.required_size() == 64 + 16 + 4 + 1 + 36);
    refused(check(const_texture{{}, layout}), error::out_of_range, "texture mips");
    CHECK(full_mips({INT_MAX, 1}) == 31);
    CHECK(full_mips({-5, -7}) == 1);
}

namespace {

// Asked for nothing, and has nothing.
struct counting_nothing : std::pmr::memory_resource {
    int calls = 0;

private:
    void* do_allocate(std::size_t, std::size_t) override {
        ++calls;
        return nullptr;
    }
    void do_deallocate(void*, std::size_t, std::size_t) override {}
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }
};

}  // namespace

TEST_CASE("scratch of huge extents is not less than that of large ones") {
    const fourier nine{.coefficients = 9, .scale = {.max_slope = 2.0f}};
    // Four threads have four items at these heights; the size does not depend on more.
    CHECK(slice_scratch_size({8, INT_MAX}, 32, 8, 4) == slice_scratch_size({8, 1000}, 32, 8, 4));
    CHECK(fourier_scratch_size({8, INT_MAX}, 32, nine, 4) == fourier_scratch_size({8, 1000}, 32, nine, 4));
    CHECK(flip_scratch_size({8, INT_MAX}, {}, 4) == flip_scratch_size({8, 1000}, {}, 4));
    CHECK(slice_scratch_size({8, 16}, 32, 8, 4) == slice_scratch_size({8, 16}, 32, 8, 1));
    if constexpr (sizeof(std::size_t) == 8) {
        // 8 slices of 4 rows of 2^31 floats.
        CHECK(slice_scratch_size({INT_MAX, INT_MAX}, 32, 8) > std::size_t(32) << 33);
        // 9 floats for each of the 2^60 texels of level 1 are more than 2^64 bytes.
        CHECK(fourier_mip_scratch_size({INT_MAX, INT_MAX}, 32, nine) == most);
    }
    CHECK(slice_scratch_size({8, 8}, most / 2, 8) == most);
    CHECK(fourier_scratch_size({8, 8}, most / 2, nine) == most);
    CHECK(elevation_scratch_size(most, most) == most);

    CHECK(scratch_layout().add<char>(1).bytes() == 2 * scratch_alignment);
    CHECK(scratch_layout().add<double>(8, 2).bytes() == 3 * scratch_alignment);
    CHECK(scratch_layout().add<double>(most / 4).bytes() == most);
    CHECK(scratch_layout().add<char>(most).bytes() == most);
    CHECK(scratch_layout().add<char>(most / 2).add<char>(most / 2).add<char>(most / 2).bytes() == most);
    counting_nothing memory;
    bake_options options;
    options.memory = &memory;
    refused(scratch_block().allocate(options, most, "the test"), error::out_of_memory, "the test");
    CHECK(memory.calls == 0);
}

TEST_CASE("tiles larger than a map, and counts of 0") {
    std::vector<float> slopes(20);
    for (std::size_t i = 0; i < slopes.size(); ++i) slopes[i] = float(i);
    const horizon_map map{slopes, {5, 4}, 1};
    for (const int side : {5, 1 << 30, INT_MAX - 1, INT_MAX})
        for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open}) {
            CAPTURE(side);
            std::array<float, 2> out{-7.0f, -7.0f};
            CHECK(bool(tile_horizons(map, edge, side, out)));
            CHECK(out == std::array<float, 2>{19.0f, -7.0f});
        }
    CHECK(tile_count({INT_MAX, 3}, 2) == glm::ivec2(1 << 30, 2));
    CHECK(tile_count({5, 4}, INT_MAX) == glm::ivec2(1, 1));
    for (const int none : {0, -1, INT_MIN}) {
        CHECK(tile_count({5, 4}, none) == glm::ivec2(5, 4));
        CHECK(reduced_extent({5, 4}, none) == glm::ivec2(5, 4));
        refused(tile_horizons(map, edge_mode::clamp, none, slopes), error::not_positive, "side of a tile");
    }
}

TEST_CASE("derivatives: the ends of max_slope") {
    std::array<float, 3> values{};
    const normal_map normals{values, {1, 1}};
    std::array<std::byte, 2> bytes{std::byte(255), std::byte(128)};
    const pixels picture{bytes, {1, 1}, 2};
    const auto of = [](float slope) { return normal_encoding{normal_form::derivatives, normal_y::down, slope}; };
    for (const float slope : {1e-39f, 1e-19f, 2e19f, largest}) {
        CAPTURE(slope);
        refused(encode_normals(normals, of(slope), picture), error::out_of_range, "max_slope");
        refused(decode_normals(picture, of(slope), normals), error::out_of_range, "max_slope");
        CHECK(bool(check(normal_encoding{normal_form::unit, normal_y::down, slope})));
    }
    // The slopes are max_slope and 1/255 of it.
    REQUIRE(bool(decode_normals(picture, of(1e18f), normals)));
    CHECK(values[0] == doctest::Approx(-1.0 / std::sqrt(1.0 + 1.0 / 65025.0)));
    CHECK(values[1] == doctest::Approx(-1.0 / 255.0).epsilon(1e-4));
    CHECK(values[2] == doctest::Approx(1e-18).epsilon(1e-4));
    REQUIRE(bool(decode_normals(picture, of(1e-18f), normals)));
    CHECK(values[0] == doctest::Approx(-1e-18));
    CHECK(values[2] == 1.0f);

    const auto stored = [&](float slope, glm::vec3 normal) {
        normals.set(0, 0, normal);
        REQUIRE(bool(encode_normals(normals, of(slope), picture)));
        return glm::ivec2(std::to_integer<int>(bytes[0]), std::to_integer<int>(bytes[1]));
    };
    for (const float slope : {1e-18f, 1.0f, 1e18f}) {
        CAPTURE(slope);
        CHECK(stored(slope, {0.0f, 0.0f, 1.0f}) == glm::ivec2(128));
        CHECK(stored(slope, glm::vec3(0.0f)) == glm::ivec2(128));
        // In the surface: the slope along the axis is infinite, the other one 0.
        CHECK(stored(slope, {0.0f, 1.0f, 0.0f}) == glm::ivec2(128, 0));
        CHECK(stored(slope, {-1.0f, 0.0f, 0.0f}) == glm::ivec2(255, 128));
    }
}

TEST_CASE("snippets: lengths whose squares neither overflow nor vanish, and what lies beyond") {
    using namespace shader;
    for (const float length : {1.01e-15f, 1e-10f, 1.0f, 1e10f, 1e18f, 1e19f}) {
        CAPTURE(length);
        CHECK(bumpshadow_emboss_shift({0.6f * length, -0.8f * length, 0.0f}, {0.5f, 0.25f}).x ==
              doctest::Approx(0.3).epsilon(1e-5));
        const glm::vec3 direction = bumpshadow_vertex_direction({0.6f * length, -0.8f * length, 0.0f}, 4.0f);
        CHECK(direction.x == doctest::Approx(0.6).epsilon(1e-5));
        CHECK(direction.y == doctest::Approx(-0.8).epsilon(1e-5));
        CHECK(bumpshadow_vertex_direction_sine({0.0f, length, 0.0f}).y == doctest::Approx(1.0).epsilon(1e-5));
    }
    CHECK(bumpshadow_emboss_shift({1e-16f, 0.0f, 0.0f}, {1.0f, 1.0f}).x == doctest::Approx(0.1));
    CHECK(bumpshadow_vertex_direction({1e-16f, 0.0f, 0.0f}, 4.0f).x == doctest::Approx(0.1));
    CHECK(bumpshadow_emboss_shift({1e20f, 0.0f, 0.0f}, {1.0f, 1.0f}).x == 0.0f);
    CHECK(bumpshadow_vertex_direction({1e20f, 0.0f, 0.0f}, 4.0f).x == 0.0f);

    const glm::vec3 up(0.0f, 0.0f, 1.0f);
    for (const float size : {1e-3f, 1.0f, 1e15f}) {
        CAPTURE(size);
        const glm::vec3 white(size), bright(1e6f);
        CHECK(bumpshadow_ssbump_normal(white).z == doctest::Approx(1.0));
        CHECK(bumpshadow_ssbump_world_normal(white, {1.0f, 0.0f, 0.0f}, {0.0f, 1.0f, 0.0f}, up).x ==
              doctest::Approx(1.0 / std::sqrt(3.0)));
        CHECK(bumpshadow_normal_lightmaps(size * up, bright, bright, bright).x == doctest::Approx(1e6));
        CHECK(bumpshadow_ssbump_lightmaps(white, bright, bright, bright).x == doctest::Approx(3e6 * double(size)));
        CHECK(bumpshadow_reflection(white, up) == glm::vec3(-size, -size, size));
        const glm::vec3 weights = bumpshadow_ssbump_weights(size * up);
        CHECK(bumpshadow_ssbump_light(white, weights) ==
              doctest::Approx(std::sqrt(3.0) * double(size) * double(size)).epsilon(1e-5));
    }
    CHECK(bumpshadow_ssbump_normal(glm::vec3(1e-5f)) == up);
    CHECK(bumpshadow_normal_of_derivatives({0.0f, 0.5f}, 1e18f, 1.0f).x == doctest::Approx(1.0));
}

TEST_CASE("scaled_emboss: heights and ranges that a double does not hold are refused") {
    std::array<double, 2> heights{};
    auto map = tight_height_map<double>(heights.data(), {2, 1});
    const auto scaled = [&](double a, double b, double height_scale = 1.0, double datum = 0.0) {
        heights = {a, b};
        map.height_scale = height_scale;
        map.datum = datum;
        emboss out{-7.0, -7.0};
        const status s = scaled_emboss(map, out);
        CHECK((out.scale == -7.0) == !s);
        return std::pair(s, out);
    };
    refused(scaled(-1.7e298, 1.7e298, 1e10).first, error::out_of_range, "range of heights");
    refused(scaled(0.0, 5e-324).first, error::out_of_range, "range of heights");
    const status place = scaled(1.0, 1e300, 1e150).first;
    refused(place, error::out_of_range, "height");
    CHECK(place.texel() == glm::ivec2(1, 0));
    refused(scaled(1e298, 1e298, 1e10, -1e308).first, error::out_of_range, "height");
    CHECK(scaled(0.0, 1e298, 1e10).second.scale == doctest::Approx(5e-309).epsilon(1e-9));
    CHECK(scaled(1e-300, 2e-300).second.scale == doctest::Approx(5e299));
    CHECK(scaled(3.0, 3.0).second.scale == 0.0);

    // Heights that overflow against an encoding of one's own are outside, and counted.
    heights = {1.0, 1e300};
    map.height_scale = 1e150;
    map.datum = 0.0;
    for (const double scale : {0.0, 1e-300}) {
        std::array<std::byte, 2> bytes{};
        std::size_t clamped = 0;
        CHECK(bool(pack_emboss(map, emboss{1e150, scale}, {bytes, layout_of(emboss{}, {2, 1})}, {}, &clamped)));
        CHECK(clamped == 1);
        CHECK(bytes[0] == std::byte(0));
    }
}

namespace {

// A tangent volume of one texel, all of its slices 50/255.
struct even_volume {
    tangent_volume encoding;
    std::vector<std::byte> bytes;
    const_texture view;

    explicit even_volume(texture_kind kind) : encoding{.slices = {.count = 8}, .kind = kind} {
        const texture_layout layout = layout_of(encoding, {1, 1});
        bytes.assign(layout.required_size(), std::byte(50));
        view = {bytes, layout};
    }
};

}  // namespace

TEST_CASE("a pixel's light that is not a number gives a factor all the same") {
    for (const texture_kind kind : {texture_kind::volume, texture_kind::array}) {
        const even_volume volume(kind);
        const auto factor = [&](float bearing, float slope, shadow_edge edge = {}) {
            return shadow_factor(volume.encoding, volume.view, sampler{}, glm::vec2(0.3f), pixel_light{bearing, slope},
                                 edge);
        };
        for (const float bad : {not_a_number, infinity, -infinity}) CHECK(factor(bad, 1.0f) == 0.0f);
        CHECK(factor(0.0f, not_a_number) == 0.0f);
        CHECK(factor(0.0f, infinity) == 1.0f);
        CHECK(factor(0.0f, -infinity) == 0.0f);
        for (const float bearing : {0.0f, 0.3f, -7.0f, 1e30f, largest, -largest, 1e-45f, not_a_number, infinity})
            for (const float slope : {0.0f, 1e-45f, 1.0f, 1e20f, largest, -largest, not_a_number, infinity, -infinity})
                for (const float k : {0.0f, 8.0f, largest, infinity})
                    for (const float c : {0.0f, 0.5f, 1.0f}) {
                        CAPTURE(bearing);
                        CAPTURE(slope);
                        CAPTURE(k);
                        const float found = factor(bearing, slope, {k, c});
                        CHECK((found >= 0.0f && found <= 1.0f));
                    }
    }
}

TEST_CASE("emboss: a shift that no float holds reads height 0") {
    const std::array<std::byte, 1> height{std::byte(64)};
    const texture_layout layout = layout_of(emboss{}, {1, 1});
    for (const float amount : {infinity, -infinity, not_a_number})
        for (const glm::vec2 way : {glm::vec2(amount, 0.1f), glm::vec2(0.1f, amount)}) {
            const emboss_texture from{{height, layout}, way};
            // Twice 64 and the inverse of 0, which is 128, over 255.
            CHECK(shadow_factor(emboss{}, from, sampler{}, glm::vec2(0.5f), {1.0f, 1.0f, 1.0f}) ==
                  doctest::Approx(2.0 * 192.0 / 255.0));
        }
    const emboss_texture far{{height, layout}, glm::vec2(largest)};
    CHECK(shadow_factor(emboss{}, far, sampler{}, glm::vec2(0.5f), {1.0f, 1.0f, 1.0f}) ==
          doctest::Approx(2.0 * 128.0 / 255.0));
}

namespace {

// An encoding whose factor is 1 everywhere, and that counts how often it is asked.
struct lit {
    int* asked;
};
float shadow_factor(const lit& encoding, int, const sampler&, glm::vec2, glm::vec3, const shadow_edge&, float) {
    ++*encoding.asked;
    return 1.0f;
}

}  // namespace

TEST_CASE("places of a pixel: 1 to 1024 along a side") {
    int asked = 0;
    const auto factor = [&](int taps) {
        asked = 0;
        return pixel_factor(lit{&asked}, 0, sampler{}, glm::vec2(0.5f), glm::vec2(0.1f), taps, glm::vec3(1.0f));
    };
    for (const int taps : {0, -1, INT_MIN, 1}) {
        CHECK(factor(taps) == 1.0f);
        CHECK(asked == 1);
    }
    CHECK(factor(46341) == 1.0f);
    CHECK(asked == 1024 * 1024);
    // Each place is that of its row and column.
    int wrong = 0;
    for (int row = 0; row < 1024; ++row)
        for (int column = 0; column < 1024; ++column) {
            const glm::vec2 place = tap_offset(row * 1024 + column, 1024);
            const double x = (column + 0.5) / 1024.0 - 0.5, y = (row + 0.5) / 1024.0 - 0.5;
            wrong += std::abs(double(place.x) - x) > 1e-6 || std::abs(double(place.y) - y) > 1e-6;
        }
    CHECK(wrong == 0);
}

TEST_CASE("suggested slopes pass the check, whatever the limit") {
    std::vector<float> slopes(4, 0.0f);
    const horizon_map map{slopes, {2, 2}, 1};
    const auto suggested = [&](float limit) {
        const float slope = suggest_max_slope(map, limit);
        CAPTURE(limit);
        CHECK(bool(check(horizon_scale{quantity::slope, slope})));
        return slope;
    };
    for (const float limit : {not_a_number, infinity, largest}) CHECK(suggested(limit) == 1e14f);
    for (const float limit : {0.0f, -1.0f, -infinity, 1e-40f}) CHECK(suggested(limit) == 1e-18f);
    slopes[2] = 2.0f;
    for (const float limit : {not_a_number, infinity, 3.0f}) CHECK(suggested(limit) == 2.0f);
    CHECK(suggested(1.5f) == 1.5f);
    slopes[1] = infinity;
    CHECK(suggested(infinity) == 1e14f);
}

TEST_CASE("figures of errors that are infinite or whose squares are") {
    constexpr double endless = std::numeric_limits<double>::infinity();
    std::array<double, 3> both{endless, 1.0, -endless}, one{1.0, -endless, 2.0}, large{2e200, -1e200, 3e200};
    const error_figures a = figures_of(both);
    CHECK(a.mean == endless);
    CHECK(a.largest == endless);
    CHECK(a.rms == endless);
    CHECK(a.interval == endless);
    CHECK(std::isnan(a.bias));
    const error_figures b = figures_of(one);
    CHECK(b.bias == -endless);
    CHECK(b.interval == endless);
    const error_figures c = figures_of(large);
    CHECK(c.mean == doctest::Approx(2e200));
    CHECK(c.bias == doctest::Approx(4e200 / 3.0));
    CHECK(c.largest == 3e200);
    CHECK(c.rms == endless);
    CHECK(c.interval == endless);
}

TEST_CASE("reflection: an eye at any distance") {
    // White masks: the normal is straight up, and what is beside it is turned round.
    const ssbump encoding;
    const texture_layout layout = layout_of(encoding, {1, 1});
    const std::vector<std::byte> white(layout.required_size(), std::byte(255));
    std::array<std::byte, 24> faces{};
    for (std::size_t face = 0; face < 6; ++face) faces[4 * face] = std::byte(40 * face);
    const const_texture cube{
        faces, {.format = texel_format::rgba8, .kind = texture_kind::cube, .extent = {1, 1}, .layers = 6}};
    const auto face = [&](glm::vec3 eye) {
        sampler nearest;
        nearest.texels = filter_mode::point;
        return int(reflected(encoding, {white, layout}, nearest, surface_point{}, eye, cube).x * 255.0f / 40.0f + 0.5f);
    };
    for (const float length : {1e-45f, 1e-30f, 1.0f, 1e20f, largest}) {
        CAPTURE(length);
        CHECK(face({length, 0.0f, 0.0f}) == 1);
        CHECK(face({0.0f, -length, 0.0f}) == 2);
        CHECK(face({0.0f, 0.0f, length}) == 4);
        CHECK(face({0.0f, 0.0f, -length}) == 5);
    }
    CHECK(face(glm::vec3(0.0f)) == 4);
}
