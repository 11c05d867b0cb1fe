// Normals and textures of maps of any extent: one texel, one row, primes, a side of 65536 texels (suite "slow").

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/texture.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

constexpr edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};

// What is fitted, and mips of it. Slices in the directions that were baked are fitted by what is there.
void check_fits(const horizon_map& horizons, const std::vector<glm::dvec2>& directions, const horizon_scale& scale) {
    const glm::ivec2 extent = horizons.extent;
    const slice_layers grouped{.slices = {.count = 8, .function = bearing_function::exact}, .scale = scale};
    const texture_layout layout = layout_of(grouped, extent);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(bool(pack_slice_layers(horizons, directions, grouped, {}, {bytes, layout})));
    double worst = 0.0;
    for (int i = 0; i < 8; ++i)
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const double wanted = double(horizons.row(i, y)[x] / scale.max_slope);
                const glm::vec4 found = fetch({bytes, layout}, {x, y, 0}, 0, i / 4);
                worst = std::max(worst, std::abs(double(found[i % 4]) - std::min(wanted, 1.0)));
            }
    CHECK(worst <= 1.0 / 509.0);

    // Down to one texel a side: each a mean of shares of texels, so that none is beyond what it was made of.
    std::vector<std::vector<float>> storage;
    std::vector<horizon_map> mips;
    for (glm::ivec2 half = extent; half.x > 1 || half.y > 1;) {
        half = glm::max(half / 2, glm::ivec2(1));
        storage.emplace_back(required_size(half, 8), -7.0f);
        mips.push_back({.values = storage.back(), .extent = half, .bearings = 8});
    }
    const float most = *std::max_element(horizons.values.begin(), horizons.values.end());
    const auto within = [&] {
        std::size_t wrong = 0;
        for (const std::vector<float>& level : storage)
            for (const float s : level) wrong += s >= 0.0f && s <= most * 1.00001f ? 0 : 1;
        return wrong == 0;
    };
    if (mips.empty()) return;
    for (const bool keep : {true, false}) {
        CHECK(bool(make_mips(horizons, scale, mips, {.keep_distribution = keep})));
        CHECK(within());
    }
    CHECK(bool(make_fourier_mips(horizons, directions, fourier{.coefficients = 5, .scale = scale}, mips)));
}

void check_emboss(const height_map<float>& map) {
    emboss encoding;
    REQUIRE(bool(scaled_emboss(map, encoding)));
    const texture_layout layout = layout_of(encoding, map.extent, default_mips(map.extent));
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(bool(pack_emboss(map, encoding, {bytes, layout})));
    double worst = 0.0;
    for (int y = 0; y < map.extent.y; ++y)
        for (int x = 0; x < map.extent.x; ++x) {
            const double wanted = (double(sample_at(map, x, y)) - encoding.lowest) * encoding.scale;
            worst = std::max(worst, std::abs(double(fetch({bytes, layout}, {x, y, 0}).x) - wanted));
        }
    CHECK(worst <= 1.0 / 509.0);
}

// Normals and textures of every extent: finite, and as near to what they were made of as anywhere.
void check_textures(glm::ivec2 extent) {
    CAPTURE(extent.x);
    CAPTURE(extent.y);
    const auto map = shapes::sampled<float>(extent, [](double x, double y) {
        return float(4.0 * std::sin(0.11 * x + 0.05 * y) + 3.0 * std::cos(0.23 * y - 0.31 * x));
    });
    std::vector<float> values(required_size(extent, 3));
    const normal_map normals{.values = values, .extent = extent};
    for (const edge_mode edge : edges) {
        std::fill(values.begin(), values.end(), -7.0f);
        REQUIRE(bool(bake_normals(map.view(edge), normals)));
        double worst = 0.0;
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const glm::vec3 n = normals.at(x, y);
                worst = std::max(worst, std::abs(double(n.x * n.x + n.y * n.y + n.z * n.z) - 1.0));
            }
        CHECK(worst < 1e-6);
    }

    std::vector<glm::dvec2> directions(8);
    fill_directions(directions);
    std::vector<float> slopes(required_size(extent, 8));
    const horizon_map horizons{.values = slopes, .extent = extent, .bearings = 8};
    REQUIRE(bool(bake_cascade(map.view(), directions, horizons)));
    const tangent_volume volume{.slices = {.count = 8}, .scale = {.max_slope = suggest_max_slope(horizons)}};
    const pack_options by_points{.fit = slice_fit::point};
    for (const texel_format format : {texel_format::r8, texel_format::r16, texel_format::bc4}) {
        tangent_volume encoding = volume;
        encoding.format = format;
        encoding.kind = texture_kind::array;
        const texture_layout layout = layout_of(encoding, extent);
        std::vector<std::byte> bytes(layout.required_size());
        REQUIRE(bool(pack_tangent_volume(horizons, directions, encoding, by_points, {bytes, layout})));
        // Blocks of four by four hold eight values.
        const double bound = format == texel_format::r8 ? 1.0 / 509.0 : format == texel_format::r16 ? 1e-5 : 0.1;
        double worst = 0.0;
        for (int i = 0; i < 8; ++i)
            for (int y = 0; y < extent.y; ++y)
                for (int x = 0; x < extent.x; ++x) {
                    const double wanted = double(horizons.row(i, y)[x] / encoding.scale.max_slope);
                    const double found = double(fetch({bytes, layout}, {x, y, 0}, 0, i).x);
                    worst = std::max(worst, std::abs(found - std::min(wanted, 1.0)));
                }
        CHECK(worst <= bound);
    }
    const sine_layers sines;
    const texture_layout layout = layout_of(sines, extent);
    std::vector<std::byte> bytes(layout.required_size());
    const texture out{bytes, layout};
    REQUIRE(bool(pack_sine_layers(horizons, directions, sines, by_points, std::span(&out, 1))));
    std::vector<glm::dvec2> around(32);
    fill_directions(around);
    std::vector<float> many(required_size(extent, 32));
    const horizon_map published{.values = many, .extent = extent, .bearings = 32};
    REQUIRE(bool(bake_neighborhood(map.view(), around, published)));
    CHECK(bool(pack_sine_layers_averaged(published, around, sines, {}, std::span(&out, 1))));
    for (const ssbump& masks : {ssbump{}, ssbump{.occlusion = mask_occlusion::directional}}) {
        const texture_layout flat = layout_of(masks, extent, default_mips(extent));
        std::vector<std::byte> texels(flat.required_size());
        CHECK(bool(pack_ssbump(horizons, directions, normals, masks, {texels, flat})));
    }
    const fourier series{.coefficients = 5, .scale = volume.scale};
    std::vector<std::vector<std::byte>> storage;
    std::vector<texture> textures;
    for (int i = 0; i < texture_count(series); ++i)
        storage.emplace_back(layout_of(series, extent, 1, i).required_size());
    for (int i = 0; i < texture_count(series); ++i)
        textures.push_back({storage[std::size_t(i)], layout_of(series, extent, 1, i)});
    CHECK(bool(pack_fourier(horizons, directions, series, {}, textures)));
    check_fits(horizons, directions, volume.scale);
    check_emboss(map.view());
}

}  // namespace

TEST_CASE("normals and textures of one texel, of one row and column, of primes") {
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {2, 3}, {1, 1021}, {1021, 1}, {127, 131}}) check_textures(extent);
}

TEST_CASE("normals and textures of 65536 by one and of long primes" * doctest::test_suite("slow")) {
    for (const glm::ivec2 extent : {glm::ivec2(1, 65536), {65536, 1}, {127, 8191}}) check_textures(extent);
}
