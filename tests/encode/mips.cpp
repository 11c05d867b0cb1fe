// The mean shadow factor of every level within a percentage point of level 0's, for each encoding that has mips:
// horizons fitted to slices, mips made of them, packed by points, and decoded from the bytes.

#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <limits>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "support/horizons.hpp"

#if BUMPSHADOW_TESTS_READ_IMAGES
#include "support/real_maps.hpp"
#endif

using namespace bumpshadow;

namespace {

constexpr int directions_baked = 32;

// A map with room for its mips.
std::vector<horizons> with_mips(horizons map, int mips) {
    std::vector<horizons> levels;
    levels.push_back(std::move(map));
    for (int l = 1; l < mips; ++l) {
        const glm::ivec2 extent = levels[0].extent;
        levels.emplace_back(glm::ivec2(mip_extent(extent.x, l), mip_extent(extent.y, l)), levels[0].bearings);
    }
    return levels;
}

std::vector<horizon_map> views_of(const std::vector<horizons>& levels) {
    std::vector<horizon_map> views;
    for (const horizons& level : levels) views.push_back(level.view());
    return views;
}

// Horizons fitted to slices, and their mips.
std::vector<horizons> fitted(const horizons& baked, const slice_set& slices, const horizon_scale& scale, int mips) {
    horizons map(baked.extent, slices.count);
    fill_directions(map.directions, slices.phase, slices.function);
    REQUIRE(bool(fit_slices(baked.view(), baked.directions, slices, scale, {}, map.view())));
    std::vector<horizons> levels = with_mips(std::move(map), mips);
    const auto views = views_of(levels);
    REQUIRE(bool(make_mips(views[0], scale, std::span(views).subspan(1), {}, threads())));
    return levels;
}

// Largest difference of a level's mean hard shadow factor from level 0's, in percentage points, over `lights` bearings
// and five elevations. plane(level, bearing in turns, to): the stored quantity of every texel at a bearing.
using decode_plane = std::function<void(int level, double bearing, std::vector<float>& to)>;
std::vector<double> deviations(const texture_layout& layout, const horizon_scale& scale, int lights,
                               const decode_plane& plane) {
    std::vector<double> wanted, result;
    std::vector<float> horizons_there;
    for (int level = 0; level < layout.mips; ++level) {
        std::size_t next = 0;
        double worst = 0.0;
        for (int k = 0; k < lights; ++k) {
            const glm::ivec2 extent = layout.level_extent(level);
            horizons_there.resize(required_size(extent, 1));
            plane(level, double(k) / lights, horizons_there);
            for (const double degrees : {10.0, 20.0, 30.0, 45.0, 60.0}) {
                const float light =
                    quantity_of_slope(scale.stored, float(std::tan(degrees * std::numbers::pi / 180.0))) *
                    stored_scale(scale);
                const auto lit = std::count_if(horizons_there.begin(), horizons_there.end(),
                                               [&](float horizon) { return light >= horizon; });
                const double mean = 100.0 * double(lit) / double(horizons_there.size());
                if (level == 0) wanted.push_back(mean);
                worst = std::max(worst, std::abs(mean - wanted[next++]));
            }
        }
        if (level > 0) result.push_back(worst);
    }
    return result;
}

// Blocks of bc4 are off by more, the smaller the level: as documented.
void check_deviations(const std::string& what, const std::vector<double>& found, bool blocks = false) {
    for (std::size_t i = 0; i < found.size(); ++i) {
        CAPTURE(what);
        CAPTURE(i);
        CHECK(found[i] <= (!blocks || i == 0 ? 1.0 : i == 1 ? 3.0 : 5.0));
    }
}

// Linear between slices: at(level, slice, texels) are the stored values of a slice.
using read_slice = std::function<void(int level, int slice, std::vector<float>& to)>;
std::vector<double> deviations_of_slices(const texture_layout& layout, const horizon_scale& scale, int count,
                                         const read_slice& read) {
    std::vector<float> next;
    return deviations(layout, scale, 4 * count, [&](int level, double bearing, std::vector<float>& to) {
        const int quarter = int(std::lround(bearing * 4 * count));
        const float part = float(quarter % 4) / 4.0f;
        next.resize(to.size());
        read(level, quarter / 4, to);
        read(level, (quarter / 4 + 1) % count, next);
        for (std::size_t i = 0; i < to.size(); ++i) to[i] = to[i] * (1.0f - part) + next[i] * part;
    });
}

std::vector<float> channel(const const_texture& t, int level, int layer, int c) {
    const std::byte* const from = t.slice(layer, level);
    std::vector<float> values(required_size(t.layout.level_extent(level), 1));
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = float(std::to_integer<int>(from[4 * i + std::size_t(c)])) / 255.0f;
    return values;
}

void check_tangent(const horizons& baked, const std::string& name, int slices, texel_format format, quantity stored,
                   int mips) {
    tangent_volume e{{slices}, {stored, suggest_max_slope(baked.view())}, format, texture_kind::array};
    const auto levels = fitted(baked, e.slices, e.scale, mips);
    const texture_layout layout = layout_of(e, baked.extent, mips);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(bool(pack_tangent_volume(views_of(levels), levels[0].directions, e, {.fit = slice_fit::point},
                                     {bytes, layout}, threads())));
    const auto read = [&](int level, int slice, std::vector<float>& to) {
        const glm::ivec2 extent = layout.level_extent(level);
        for (int y = 0; y < extent.y; ++y)
            tangent_volume_detail::read_texels({bytes, layout}, level, slice, 0, y, extent.x, to.data() + y * extent.x);
    };
    check_deviations(name, deviations_of_slices(layout, e.scale, slices, read), format == texel_format::bc4);
}

void check_layers(const horizons& baked, const std::string& name, int slices, int mips) {
    const slice_layers e{{slices}, {quantity::slope, suggest_max_slope(baked.view())}, slice_grouping::overlapping};
    const auto levels = fitted(baked, e.slices, e.scale, mips);
    const texture_layout layout = layout_of(e, baked.extent, mips);
    std::vector<std::byte> bytes(layout.required_size());
    REQUIRE(bool(pack_slice_layers(views_of(levels), levels[0].directions, e, {.fit = slice_fit::point},
                                   {bytes, layout}, threads())));
    const const_texture t{bytes, layout};
    bool same = true;
    check_deviations(name,
                     deviations_of_slices(layout, e.scale, slices, [&](int level, int slice, std::vector<float>& to) {
                         to = channel(t, level, slice / 3, slice % 3);
                         // The last channel of a layer is the next one's first.
                         if (slice % 3 == 0)
                             same = same && channel(t, level, (slice / 3 + slices / 3 - 1) % (slices / 3), 3) == to;
                     }));
    CHECK(same);
}

void check_sines(const horizons& baked, const std::string& name, bool separate, int mips) {
    const sine_layers e{.separate = separate};
    const auto levels = fitted(baked, {8, 0.0, bearing_function::exact}, e.scale, mips);
    const texture_layout layout = layout_of(e, baked.extent, mips);
    std::vector<std::byte> bytes[2];
    std::vector<texture> views;
    for (int i = 0; i < texture_count(e); ++i) {
        bytes[i].resize(layout.required_size());
        views.push_back({bytes[i], layout});
    }
    REQUIRE(
        bool(pack_sine_layers(views_of(levels), levels[0].directions, e, {.fit = slice_fit::point}, views, threads())));
    const auto read = [&](int level, int slice, std::vector<float>& to) {
        const int layer = slice / 4;
        to = separate ? channel(views[std::size_t(layer)], level, 0, slice % 4)
                      : channel(views[0], level, layer, slice % 4);
    };
    check_deviations(name, deviations_of_slices(layout, e.scale, 8, read));
}

// The coefficients of a texture's bytes, evaluated by the sum of the series.
std::vector<double> deviations_of_series(const horizons& baked, fourier e, int mips) {
    e.scale.max_slope = suggest_max_slope(baked.view());
    const auto levels = with_mips(baked, mips);
    const auto maps = views_of(levels);
    REQUIRE(bool(make_fourier_mips(maps[0], baked.directions, e, std::span(maps).subspan(1), {}, threads())));
    REQUIRE(bool(tighten_ranges(maps, baked.directions, e, {}, threads())));
    std::vector<std::vector<std::byte>> bytes;
    std::vector<texture> views;
    for (int i = 0; i < texture_count(e); ++i) bytes.emplace_back(layout_of(e, baked.extent, mips, i).required_size());
    for (int i = 0; i < texture_count(e); ++i)
        views.push_back({bytes[std::size_t(i)], layout_of(e, baked.extent, mips, i)});
    REQUIRE(bool(pack_fourier(maps, baked.directions, e, {}, views, threads())));
    return deviations(views[0].layout, e.scale, 48, [&](int level, double bearing, std::vector<float>& to) {
        const fourier_terms terms = terms_of(shapes::direction(bearing));
        std::fill(to.begin(), to.end(), 0.0f);
        for (int t = 0; t < texture_count(e); ++t) {
            const texture& texels = views[std::size_t(t)];
            const std::size_t channels = std::size_t(traits_of(texels.layout.format).channels);
            for (std::size_t c = 0; c < channels; ++c) {
                const int i = channels_of(e, t)[c];
                if (i < 0) continue;
                const fourier_range r = stored_range(e, i);
                const float term = float(terms[std::size_t(i)]) * (i == 0 ? 1.0f : 2.0f);
                for (std::size_t x = 0; x < to.size(); ++x) {
                    const std::size_t at = x * channels + c;
                    const auto number = [&](std::size_t b) {
                        return float(std::to_integer<int>(texels.slice(0, level)[b]));
                    };
                    const float part =
                        e.bits == 8 ? number(at) / 255.0f : (number(2 * at) + 256.0f * number(2 * at + 1)) / 65535.0f;
                    to[x] += term * (r.low + (r.high - r.low) * part);
                }
            }
        }
    });
}

template <height_sample Sample>
horizons baked(const height_map<Sample>& heights) {
    horizons map(heights.extent, directions_baked);
    fill_directions(map.directions, 0.0);
    REQUIRE(bool(bake_cascade(heights, map.directions, map.view(), {}, threads())));
    return map;
}

void check_all(const horizons& map, const std::string& name) {
    const int mips = default_mips(map.extent);
    check_tangent(map, name + ": 8 slices in bc4", 8, texel_format::bc4, quantity::slope, mips);
    check_tangent(map, name + ": 16 slices in bc4", 16, texel_format::bc4, quantity::slope, mips);
    check_tangent(map, name + ": r16", 8, texel_format::r16, quantity::slope, mips);
    check_tangent(map, name + ": r16f", 8, texel_format::r16f, quantity::slope, mips);
    check_tangent(map, name + ": angles", 8, texel_format::r8, quantity::angle, mips);
    check_layers(map, name + ": overlapping layers", 12, mips);
    check_sines(map, name + ": sine layers", false, mips);
    check_sines(map, name + ": separate sine layers", true, mips);
    for (const int coefficients : {3, 5, 7}) {
        fourier e;
        e.coefficients = coefficients;
        if (coefficients == 7) e.bits = 16;
        check_deviations(name + ": fourier", deviations_of_series(map, e, mips));
    }
}

}  // namespace

TEST_CASE("mips of every encoding keep the mean shadow factor: waves and grooves") {
    const auto waves = shapes::sampled<float>({128, 128}, [](double x, double y) {
        return 3.0 * shapes::waves({128, 128})(x, y) + 2.0 * std::abs(std::sin(x * std::numbers::pi / 16.0));
    });
    check_all(baked(waves.view()), "waves");
    const auto odd = shapes::sampled<float>({97, 150}, [](double x, double y) {
        return 2.0 * shapes::waves({97, 150})(x, y) + 1.5 * std::sin(8.0 * std::numbers::pi * y / 150.0);
    });
    check_all(baked(odd.view()), "odd extents");
}

TEST_CASE("mips of a series do not depend on the executor, nor on where scratch comes from") {
    const horizons map = horizons::random({70, 45}, 16, 12);
    for (const int coefficients : {3, 9}) {
        fourier e;
        e.coefficients = coefficients;
        const auto one = with_mips(map, 3), many = with_mips(map, 3);
        const auto a = views_of(one), b = views_of(many);
        REQUIRE(bool(make_fourier_mips(a[0], map.directions, e, std::span(a).subspan(1))));
        std::vector<std::byte> scratch(fourier_mip_scratch_size(map.extent, 16, e, 3));
        const mip_options options{.scratch = scratch, .memory = std::pmr::null_memory_resource()};
        REQUIRE(bool(make_fourier_mips(b[0], map.directions, e, std::span(b).subspan(1), options, threads(3))));
        for (std::size_t l = 1; l < 3; ++l) CHECK(one[l].slopes == many[l].slopes);
    }
    // Without it they are plain averages.
    const auto plain = with_mips(map, 2), averages = with_mips(map, 2);
    const horizon_map first[] = {plain[1].view()}, second[] = {averages[1].view()};
    REQUIRE(bool(make_fourier_mips(map.view(), map.directions, {}, first, {.keep_distribution = false})));
    REQUIRE(bool(make_mips(map.view(), fourier{}.scale, second, {.keep_distribution = false})));
    CHECK(plain[1].slopes == averages[1].slopes);
}

TEST_CASE("mips of a series that has none of its energy beyond its terms: as those of the horizons") {
    // A quarter of the texels is 1 all around, the others 0: levels hold these two values again, in every direction.
    horizons map({64, 64}, 16);
    shapes::noise random(5);
    std::vector<int> order(64 * 64);
    for (int i = 0; i < 64 * 64; ++i) order[std::size_t(i)] = i;
    for (int i = 64 * 64 - 1; i > 0; --i) std::swap(order[std::size_t(i)], order[std::size_t(random.between(0, i))]);
    for (int i = 0; i < 1024; ++i)
        for (int j = 0; j < 16; ++j) map.at(j, order[std::size_t(i)] % 64, order[std::size_t(i)] / 64) = 1.0f;
    const auto levels = with_mips(map, 3);
    const auto maps = views_of(levels);
    fourier e;
    e.scale.max_slope = 1.0f;
    REQUIRE(bool(make_fourier_mips(maps[0], map.directions, e, std::span(maps).subspan(1))));
    for (std::size_t l = 1; l < 3; ++l) {
        const auto ones =
            std::count_if(levels[l].slopes.begin(), levels[l].slopes.end(), [](float v) { return v > 0.99f; });
        const auto zeros =
            std::count_if(levels[l].slopes.begin(), levels[l].slopes.end(), [](float v) { return v < 0.01f; });
        CHECK(ones == std::ptrdiff_t(levels[l].slopes.size() / 4));
        CHECK(zeros == std::ptrdiff_t(levels[l].slopes.size()) - ones);
    }
}

TEST_CASE("mips of a series: bad input is named and nothing is written") {
    const horizons map = horizons::random({8, 8}, 8, 1);
    const horizons out({4, 4}, 8), odd({3, 4}, 8);
    const horizon_map levels[] = {out.view()}, odds[] = {odd.view()};
    fourier e;
    CHECK(make_fourier_mips(map.view(), map.directions, e, odds).code() == error::mismatch);
    CHECK(make_fourier_mips(map.view(), shapes::directions(7), e, levels).code() == error::mismatch);
    e.coefficients = 9;
    CHECK(make_fourier_mips(map.view(), map.directions, e, levels).code() == error::too_small);
    e.coefficients = 4;
    CHECK(make_fourier_mips(map.view(), map.directions, e, levels).code() == error::not_supported);
    e.coefficients = 5;
    CHECK(make_fourier_mips(map.view(), std::vector<glm::dvec2>(8, {1.0, 0.0}), e, levels).code() ==
          error::out_of_range);
    std::vector<std::byte> scratch(64);
    CHECK(make_fourier_mips(map.view(), map.directions, e, levels, {.scratch = scratch}).code() == error::too_small);
    CHECK(std::all_of(out.slopes.begin(), out.slopes.end(), [](float v) { return v == 0.0f; }));
    CHECK(bool(make_fourier_mips(map.view(), map.directions, e, {})));
}

#if !BUMPSHADOW_TESTS_READ_IMAGES

TEST_CASE("mips of every encoding keep the mean shadow factor: real maps") {
    MESSAGE("skipped: built without the programs, which read images");
}

#else

TEST_SUITE("slow") {
    TEST_CASE("mips of every encoding keep the mean shadow factor: real maps") {
        for_real_maps({}, [](const std::string& name, const auto& map) {
            if (map.extent.x <= 256) check_all(baked(map), name);
        });
    }
}

#endif
