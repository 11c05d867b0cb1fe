// Maps packed in bands of rows, and bands that are baked one by one: the bytes of packing the whole map.

#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/reference/sampler.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cstddef>
#include <deque>
#include <vector>

#include "support/horizons.hpp"
#include "support/reserved.hpp"

using namespace bumpshadow;

namespace {

// Textures that own their bytes.
struct textures {
    std::vector<std::vector<std::byte>> bytes;
    std::vector<texture> views;

    explicit textures(const std::vector<texture_layout>& layouts) {
        for (const texture_layout& layout : layouts) bytes.emplace_back(layout.required_size(), std::byte{0xcd});
        for (std::size_t i = 0; i < layouts.size(); ++i) views.push_back({bytes[i], layouts[i]});
    }
    [[nodiscard]] bool untouched() const {
        for (const auto& b : bytes)
            if (!std::all_of(b.begin(), b.end(), [](std::byte v) { return v == std::byte{0xcd}; })) return false;
        return true;
    }
};

// Rows of a map, as a view of it.
horizon_map rows_of(const horizon_map& map, int first, int count) {
    horizon_map band = map;
    band.slice_stride = map.slice_step();
    band.values = map.values.subspan(std::size_t(first) * map.row_step());
    band.extent.y = count;
    return band;
}

// pack(map, options, textures): in bands of so many rows, from the last one to the first.
template <class Pack>
void check_bands(const horizons& map, const std::vector<texture_layout>& layouts, slice_fit fit, const Pack& pack) {
    textures whole(layouts);
    pack_report all;
    REQUIRE(bool(pack(map.view(), pack_options{.fit = fit, .report = &all}, whole.views)));
    for (const int rows : {4, 16, 40}) {
        textures bands(layouts);
        pack_report sum, one;
        const int count = (map.extent.y + rows - 1) / rows;
        for (int i = count; i-- > 0;) {
            const int first = i * rows;
            const horizon_map band = rows_of(map.view(), first, std::min(rows, map.extent.y - first));
            REQUIRE(bool(pack(band, pack_options{.fit = fit, .report = &one, .first_row = first}, bands.views)));
            sum.clamped += one.clamped;
            sum.steepest = std::max(sum.steepest, one.steepest);
        }
        CHECK(bands.bytes == whole.bytes);
        CHECK(sum.clamped == all.clamped);
        CHECK(sum.steepest == all.steepest);
    }
    // Rows that the texture does not have.
    textures out(layouts);
    const horizon_map band = rows_of(map.view(), 0, 16);
    for (const int first : {-4, map.extent.y - 12, 1 << 30})
        CHECK(pack(band, pack_options{.fit = fit, .first_row = first}, out.views).code() == error::out_of_range);
    CHECK(pack(map.view(), pack_options{.fit = fit, .first_row = 4}, out.views).code() == error::out_of_range);
    horizons wide({map.extent.x + 1, 16}, map.bearings), high({map.extent.x, map.extent.y + 1}, map.bearings);
    CHECK(pack(wide.view(), pack_options{.fit = fit}, out.views).code() == error::mismatch);
    CHECK(pack(high.view(), pack_options{.fit = fit}, out.views).code() == error::mismatch);
    CHECK(out.untouched());
}

// check(layouts, fit, pack) for every encoding that slices or a series are in, and all their formats.
template <class Check>
void for_encodings(glm::ivec2 extent, const std::vector<glm::dvec2>& directions, const Check& check) {
    const slice_fit fits[] = {slice_fit::least_squares, slice_fit::least_angle, slice_fit::point};
    const horizon_scale scale{quantity::slope, 1.5f};
    const slice_set slices{8, 0.0, bearing_function::exact};
    for (const slice_fit fit : fits) {
        for (const texture_kind kind : {texture_kind::volume, texture_kind::array})
            for (const texel_format format :
                 {texel_format::r8, texel_format::r16, texel_format::r16f, texel_format::bc4}) {
                const tangent_volume e{slices, scale, format, kind};
                check({layout_of(e, extent)}, fit, [&](const horizon_map& map, const pack_options& options, auto& out) {
                    return pack_tangent_volume(map, directions, e, options, out[0]);
                });
            }
        for (const int count : {8, 12}) {
            if (fit == slice_fit::point && count == 12) continue;
            const slice_layers e{{count, 0.0, bearing_function::exact},
                                 scale,
                                 count == 8 ? slice_grouping::four : slice_grouping::overlapping};
            check({layout_of(e, extent)}, fit, [&](const horizon_map& map, const pack_options& options, auto& out) {
                return pack_slice_layers(map, directions, e, options, out[0]);
            });
        }
        for (const bool separate : {false, true}) {
            const sine_layers e{.separate = separate};
            const std::vector<texture_layout> layouts(separate ? 2 : 1, layout_of(e, extent));
            check(layouts, fit, [&](const horizon_map& map, const pack_options& options, auto& out) {
                return pack_sine_layers(map, directions, e, options, out);
            });
            check(layouts, fit, [&](const horizon_map& map, const pack_options& options, auto& out) {
                return pack_sine_layers_averaged(map, directions, e, options, out);
            });
        }
    }
    for (const int coefficients : {3, 5, 7, 9})
        for (const int bits : {8, 16}) {
            fourier e;
            e.coefficients = coefficients;
            e.bits = bits;
            e.square_root = coefficients == 5;
            std::vector<texture_layout> layouts;
            for (int i = 0; i < texture_count(e); ++i) layouts.push_back(layout_of(e, extent, 1, i));
            check(layouts, slice_fit::point, [&](const horizon_map& map, const pack_options& options, auto& out) {
                return pack_fourier(map, directions, e, options, out);
            });
        }
}

}  // namespace

TEST_CASE("bands of rows: the bytes of the whole map") {
    for (const glm::ivec2 extent : {glm::ivec2(21, 48), glm::ivec2(37, 55)}) {
        const horizons map = horizons::random(extent, 32, 7);
        for_encodings(extent, map.directions,
                      [&](const std::vector<texture_layout>& layouts, slice_fit fit, const auto& pack) {
                          check_bands(map, layouts, fit, pack);
                      });
    }
}

TEST_CASE("bands of rows: baked one by one") {
    const glm::ivec2 extent(40, 39);
    const auto heights =
        shapes::sampled<float>(extent, [&](double x, double y) { return 3.0 * shapes::waves(extent)(x, y); });
    horizons map(extent, 32);
    REQUIRE(bool(bake_cascade(heights.view(), map.directions, map.view())));
    for_encodings(extent, map.directions,
                  [&](const std::vector<texture_layout>& layouts, slice_fit fit, const auto& pack) {
                      textures whole(layouts), bands(layouts);
                      REQUIRE(bool(pack(map.view(), pack_options{.fit = fit}, whole.views)));
                      for (int first = 0; first < extent.y; first += 16) {
                          horizons band({extent.x, std::min(16, extent.y - first)}, 32);
                          bake_options options;
                          options.region = {{0, first}, band.extent};
                          REQUIRE(bool(bake_cascade(heights.view(), map.directions, band.view(), options)));
                          REQUIRE(bool(pack(band.view(), pack_options{.fit = fit, .first_row = first}, bands.views)));
                      }
                      CHECK(bands.bytes == whole.bytes);
                  });
}

TEST_CASE("bands of rows: more than 2^31 bytes into a texture") {
    constexpr int first = 1 << 26;
    const glm::ivec2 extent(36, 16), whole(extent.x, first + extent.y);
    const horizons map = horizons::random(extent, 32, 7);
    for_encodings(extent, map.directions,
                  [&](const std::vector<texture_layout>& layouts, slice_fit fit, const auto& pack) {
                      if (fit != slice_fit::point) return;
                      textures expected(layouts);
                      REQUIRE(bool(pack(map.view(), pack_options{.fit = fit}, expected.views)));
                      std::deque<reserved> places;
                      std::vector<texture> views;
                      for (texture_layout layout : layouts) {
                          layout.extent = whole;
                          const reserved& place = places.emplace_back(layout.required_size());
                          REQUIRE(place.bytes() > std::size_t(1) << 31);
                          if (place.data() == nullptr) {
                              MESSAGE("skipped: no address space of ", place.bytes(), " bytes here");
                              return;
                          }
                          views.push_back({{static_cast<std::byte*>(place.data()), place.bytes()}, layout});
                      }
                      REQUIRE(bool(pack(map.view(), pack_options{.fit = fit, .first_row = first}, views)));
                      for (std::size_t i = 0; i < views.size(); ++i) {
                          const texture_layout& l = views[i].layout;
                          const std::size_t before = l.row_bytes(0) * std::size_t(first / traits_of(l.format).block);
                          for (int layer = 0; layer < l.layers; ++layer)
                              for (int slice = 0; slice < l.depth; ++slice) {
                                  const std::byte* const near = expected.views[i].slice(layer, 0, slice);
                                  CHECK(std::equal(near, near + layouts[i].slice_bytes(0),
                                                   views[i].slice(layer, 0, slice) + before));
                                  const glm::ivec3 last(extent - 1, slice);
                                  CHECK(fetch(views[i], last + glm::ivec3(0, first, 0), 0, layer) ==
                                        fetch(expected.views[i], last, 0, layer));
                              }
                      }
                  });
}

TEST_CASE("bands of rows: blocks are whole, mips have no bands") {
    const horizons map = horizons::random({20, 48}, 16, 3);
    tangent_volume e{{8}, {}, texel_format::bc4, texture_kind::array};
    textures out({layout_of(e, map.extent)});
    const auto code = [&](int first, int rows) {
        return pack_tangent_volume(rows_of(map.view(), first, rows), map.directions, e, {.first_row = first},
                                   out.views[0])
            .code();
    };
    CHECK(code(2, 16) == error::not_a_multiple);
    CHECK(code(4, 15) == error::not_a_multiple);
    CHECK(code(34, 14) == error::not_a_multiple);
    CHECK(out.untouched());
    CHECK(code(4, 16) == error::none);
    CHECK(code(44, 4) == error::none);

    e.format = texel_format::r8;
    const horizons half = horizons::random({10, 24}, 16, 4);
    const horizon_map levels[] = {map.view(), half.view()};
    textures two({layout_of(e, map.extent, 2)});
    CHECK(pack_tangent_volume(levels, map.directions, e, {.first_row = 16}, two.views[0]).code() ==
          error::out_of_range);
    const horizon_map band[] = {rows_of(map.view(), 0, 16), half.view()};
    CHECK(pack_tangent_volume(band, map.directions, e, {}, two.views[0]).code() == error::mismatch);
    // A band of a texture with mips would leave them empty.
    CHECK(pack_tangent_volume(rows_of(map.view(), 0, 16), map.directions, e, {}, two.views[0]).code() ==
          error::mismatch);
    CHECK(two.untouched());
}

TEST_CASE("bands of rows: ssbump, with mips after the last one") {
    const glm::ivec2 extent(37, 55);
    const horizons map = horizons::random(extent, 16, 5);
    shapes::noise noise(9);
    std::vector<float> planes(3 * required_size(extent, 1));
    const normal_map normals{.values = planes, .extent = extent};
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x)
            normals.set(x, y, {float(0.6 * noise.uniform() - 0.3), float(0.6 * noise.uniform() - 0.3), 0.9f});
    for (const texel_format format : {texel_format::rgba8, texel_format::rgb565}) {
        const ssbump e{.format = format};
        textures whole({layout_of(e, extent, 4)}), bands({layout_of(e, extent, 4)});
        REQUIRE(bool(pack_ssbump(map.view(), map.directions, normals, e, whole.views[0])));
        const auto pack = [&](int first, int rows) {
            normal_map band = normals;
            band.plane_stride = normals.plane_step();
            band.values = normals.values.subspan(std::size_t(first) * normals.row_step());
            band.extent.y = rows;
            return pack_ssbump(rows_of(map.view(), first, rows), map.directions, band, e, bands.views[0], serial{},
                               first);
        };
        for (int first = 0; first < extent.y; first += 16) REQUIRE(bool(pack(first, std::min(16, extent.y - first))));
        CHECK(bands.bytes == whole.bytes);
        const auto before = bands.bytes;
        normal_map band = normals;
        band.plane_stride = normals.plane_step();
        band.extent.y = 16;
        for (const int first : {-1, 40, 1 << 30})
            CHECK(pack_ssbump(rows_of(map.view(), 0, 16), map.directions, band, e, bands.views[0], serial{}, first)
                      .code() == error::out_of_range);
        CHECK(bands.bytes == before);
    }
    // More than 2^31 bytes into a texture.
    constexpr int first = 1 << 27;
    for (const texel_format format : {texel_format::rgba8, texel_format::rgb565}) {
        const ssbump e{.format = format};
        textures expected({layout_of(e, extent)});
        REQUIRE(bool(pack_ssbump(map.view(), map.directions, normals, e, expected.views[0])));
        const texture_layout l = layout_of(e, {extent.x, first + extent.y});
        const reserved place(l.required_size());
        REQUIRE(place.bytes() > std::size_t(1) << 31);
        if (place.data() == nullptr) {
            MESSAGE("skipped: no address space of ", place.bytes(), " bytes here");
            continue;
        }
        const texture far{{static_cast<std::byte*>(place.data()), place.bytes()}, l};
        REQUIRE(bool(pack_ssbump(map.view(), map.directions, normals, e, far, serial{}, first)));
        CHECK(std::equal(expected.bytes[0].begin(), expected.bytes[0].end(),
                         far.bytes.begin() + std::ptrdiff_t(l.row_bytes(0)) * first));
    }
}
