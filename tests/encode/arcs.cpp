// Slices over an arc of bearings: where they stand, the fit against dense normal equations in double, the constants of
// the shader, a single slice, half the slices, bad input.

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/shader/shader.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <vector>

#include "support/horizons.hpp"

using namespace bumpshadow;

namespace {

constexpr bearing_function functions[] = {bearing_function::exact, bearing_function::cubic, bearing_function::diamond};

std::vector<float> packed(const horizons& map, const slice_set& slices, const horizon_scale& scale,
                          pack_options options = {}) {
    std::vector<float> result(required_size(map.extent, slices.count));
    const status s = for_slice_rows(
        map.view(), map.directions, slices, scale, options, serial{}, [&](int slice, int y, const float* values) {
            const std::size_t row = std::size_t(slice * map.extent.y + y);
            std::copy(values, values + map.extent.x, result.begin() + std::ptrdiff_t(row * std::size_t(map.extent.x)));
        });
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    return result;
}

// Turns from `phase` to a bearing, brought to within half a turn of the middle of the arc.
double along(double bearing, double phase, double arc) {
    const double from_middle = bearing - phase - 0.5 * arc;
    return from_middle - std::round(from_middle) + 0.5 * arc;
}

// Least squares by the book: Gauss-Jordan on A^T A, where row j of A has hat functions over the arc at bearing j.
std::vector<double> dense_fit(const std::vector<double>& bearings, const std::vector<double>& values,
                              const slice_set& slices) {
    const std::size_t n = std::size_t(slices.count);
    std::vector<std::vector<double>> matrix(n, std::vector<double>(n + 1));
    for (std::size_t j = 0; j < bearings.size(); ++j) {
        const double turns = along(bearings[j], slices.phase, slices.arc);
        if (turns < -1e-9 || turns > slices.arc + 1e-9) continue;
        std::vector<double> row(n, 1.0);
        for (std::size_t i = 0; n > 1 && i < n; ++i)
            row[i] = std::max(0.0, 1.0 - std::abs(turns / slices.arc * double(n - 1) - double(i)));
        for (std::size_t a = 0; a < n; ++a) {
            for (std::size_t b = 0; b < n; ++b) matrix[a][b] += row[a] * row[b];
            matrix[a][n] += row[a] * values[j];
        }
    }
    for (std::size_t a = 0; a < n; ++a)
        for (std::size_t b = 0; b < n; ++b) {
            if (b == a) continue;
            const double factor = matrix[b][a] / matrix[a][a];
            for (std::size_t c = a; c <= n; ++c) matrix[b][c] -= factor * matrix[a][c];
        }
    std::vector<double> result(n);
    for (std::size_t a = 0; a < n; ++a) result[a] = std::clamp(matrix[a][n] / matrix[a][a], 0.0, 1.0);
    return result;
}

// A texture that owns its bytes.
struct stored {
    texture_layout layout;
    std::vector<std::byte> bytes;

    stored(const tangent_volume& encoding, glm::ivec2 extent, int mips = 1)
        : layout(layout_of(encoding, extent, mips)), bytes(layout.required_size(), std::byte{0xcd}) {}
    [[nodiscard]] texture view() { return {bytes, layout}; }
    [[nodiscard]] double at(int level, int slice, int x, int y) const {
        float value = 0.0f;
        tangent_volume_detail::read_texels(const_texture{bytes, layout}, level, slice, x, y, 1, &value);
        return double(value);
    }
};

}  // namespace

TEST_CASE("slices of an arc stand from one end to the other") {
    const slice_set half{5, 0.25, bearing_function::exact, 0.5};
    for (int i = 0; i < 5; ++i) CHECK(bearing_of(half, i) == 0.25 + 0.125 * i);
    std::vector<glm::dvec2> directions(5);
    fill_directions(directions, half);
    const double s = std::sqrt(0.5);
    const glm::dvec2 by_hand[] = {{0, 1}, {-s, s}, {-1, 0}, {-s, -s}, {0, -1}};
    for (std::size_t i = 0; i < 5; ++i) {
        CHECK(directions[i].x == doctest::Approx(by_hand[i].x).epsilon(1e-12));
        CHECK(directions[i].y == doctest::Approx(by_hand[i].y).epsilon(1e-12));
    }
    CHECK(bearing_of({8, 0.5}, 3) == 0.875);
    CHECK(bearing_of({1, 0.3, bearing_function::cubic, 0.0}, 0) == 0.3);
    CHECK(bearing_of({1, 0.3, bearing_function::cubic, 0.7}, 0) == 0.3);
    for (const bearing_function function : functions) {
        const slice_set over_zero{4, -0.1, function, 0.3};
        directions.resize(4);
        fill_directions(directions, over_zero);
        for (int i = 0; i < 4; ++i) {
            const double apart = to_bearing(function, directions[std::size_t(i)]) - (-0.1 + 0.1 * i);
            CHECK(std::abs(apart - std::round(apart)) < 1e-12);
        }
    }
}

TEST_CASE("over an arc: a fit by hand") {
    // Bearings 0, 1/8, 1/4 with values a, b, c to slices at 0 and 1/4: the rows are (1 0), (1/2 1/2), (0 1), so A^T A
    // has 5/4 on the diagonal and 1/4 beside it, and the right side is (a + b / 2, c + b / 2). Nothing else counts.
    horizons map({1, 1}, 8);
    const float a = 0.25f, b = 0.75f, c = 0.5f;
    for (int i = 0; i < 8; ++i) map.at(i, 0, 0) = i == 0 ? a : i == 1 ? b : i == 2 ? c : 40.0f;
    pack_report report;
    const auto found = packed(map, {2, 0.0, bearing_function::exact, 0.25}, {quantity::slope, 1.0f},
                              {.fit = slice_fit::least_squares, .report = &report});
    const float p = a + b / 2.0f, q = c + b / 2.0f;
    CHECK(found[0] == doctest::Approx(double((1.25f * p - 0.25f * q) / 1.5f)).epsilon(1e-6));
    CHECK(found[1] == doctest::Approx(double((1.25f * q - 0.25f * p) / 1.5f)).epsilon(1e-6));
    CHECK(report.clamped == 0);
    CHECK(report.steepest == b);
    // One slice: the mean.
    const auto one = packed(map, {1, 0.0, bearing_function::exact, 0.25}, {quantity::slope, 1.0f});
    CHECK(one[0] == doctest::Approx(0.5).epsilon(1e-6));
}

TEST_CASE("over an arc: least squares solve the dense normal equations") {
    for (const int count : {1, 2, 3, 5, 9, 17})
        for (const double phase : {0.3, -0.01, 7.9})
            for (const double arc : {0.5, 0.11, 0.97})
                for (const bearing_function function : functions) {
                    const int many = int(5 * count / arc) + 12;  // stands nowhere with the slices
                    const horizons map = horizons::random({21, 3}, many, 7);
                    const slice_set slices{count, phase, function, arc};
                    const std::vector<float> found = packed(map, slices, {quantity::slope, 1.5f});
                    double worst = 0.0;
                    for (int y = 0; y < map.extent.y; ++y)
                        for (int x = 0; x < map.extent.x; ++x) {
                            std::vector<double> bearings, values;
                            for (int j = 0; j < many; ++j) {
                                bearings.push_back(to_bearing(function, map.directions[std::size_t(j)]));
                                values.push_back(std::clamp(double(map.at(j, x, y)) / 1.5, 0.0, 1.0));
                            }
                            const std::vector<double> wanted = dense_fit(bearings, values, slices);
                            for (int i = 0; i < count; ++i)
                                worst = std::max(worst, std::abs(wanted[std::size_t(i)] -
                                                                 double(found[std::size_t((i * 3 + y) * 21 + x)])));
                        }
                    CAPTURE(count);
                    CAPTURE(phase);
                    CAPTURE(arc);
                    CHECK(worst < 4e-6);
                }
}

TEST_CASE("over an arc: horizons that are linear in the bearing are reproduced, whatever lies beyond") {
    for (const slice_fit fit : {slice_fit::least_squares, slice_fit::least_angle})
        for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
            for (const int count : {2, 5, 8}) {
                const slice_set slices{count, 0.9, bearing_function::octant, 0.4};
                const horizon_scale scale{stored, 2.0f};
                horizons map = horizons::random({5, 1}, 100, 3);
                const auto value = [](int x, double turns) { return 0.05 + 0.1 * x + (0.5 - 0.3 * x) * turns; };
                for (int j = 0; j < 100; ++j)
                    for (int x = 0; x < 5; ++x) {
                        const double turns = along(octant_bearing(map.directions[std::size_t(j)]), 0.9, 0.4);
                        if (turns < -1e-9 || turns > 0.4 + 1e-9) continue;
                        map.at(j, x, 0) = slope_of_quantity(stored, float(value(x, turns)) / stored_scale(scale));
                    }
                const auto found = packed(map, slices, scale, {.fit = fit});
                for (int i = 0; i < count; ++i)
                    for (int x = 0; x < 5; ++x)
                        CHECK(double(found[std::size_t(i * 5 + x)]) ==
                              doctest::Approx(value(x, 0.4 * i / (count - 1))).epsilon(1e-5));
            }
}

TEST_CASE("over an arc: the least error of the elevation is less than that of least squares") {
    // Mean |miss| of angles, which are stored here as they are, over the directions within.
    constexpr int width = 300, many = 64;
    for (const int count : {3, 5, 9}) {
        const slice_set slices{count, 0.0, bearing_function::exact, 0.5};
        const horizon_scale scale{quantity::angle, std::numeric_limits<float>::infinity()};
        const horizons map = horizons::random({width, 1}, many, 21);
        const auto mean_miss = [&](slice_fit fit) {
            const auto found = packed(map, slices, scale, {.fit = fit});
            double sum = 0.0;
            for (int x = 0; x < width; ++x)
                for (int j = 0; j <= many / 2; ++j) {
                    const double position = 2.0 * j / many * (count - 1);
                    const int i = std::min(int(position), count - 2);
                    const double here = double(found[std::size_t(i * width + x)]),
                                 next = double(found[std::size_t((i + 1) * width + x)]);
                    const double is = std::atan(std::max(0.0, double(map.at(j, x, 0)))) / (0.5 * std::numbers::pi);
                    sum += std::abs(here + (position - i) * (next - here) - is);
                }
            const int looked_at = many / 2 + 1;
            return sum / width / looked_at;
        };
        CHECK(mean_miss(slice_fit::least_angle) < 0.99 * mean_miss(slice_fit::least_squares));
    }
}

TEST_CASE("over an arc: the shader's coordinate is that of the slice, and of the nearer end beyond") {
    for (const int count : {1, 2, 5, 17})
        for (const double phase : {0.0, 0.8, -3.3, 1000.25})
            for (const double arc : {0.5, 0.1, 0.9, 0.004})
                for (const texture_kind kind : {texture_kind::volume, texture_kind::array}) {
                    const tangent_volume e{{count, phase, bearing_function::exact, arc}, {}, texel_format::r8, kind};
                    const arc_coordinate c = arc_coordinate_of(e);
                    // Bearings are floats within a turn, off by 3e-8, and so are the constants.
                    const double rounding = 4e-7 * (count - 1) / arc + 1e-6;
                    for (int k = -120; k <= 1000; ++k) {
                        const float bearing = float(k) / 1024.0f + (k % 2 == 0 ? 0.0f : 0.13f);
                        const double turns = along(double(bearing), phase, arc);
                        const double beyond = 0.5 * (1.0 - arc) - std::max(-turns, turns - arc);
                        if (beyond < 1e-6) continue;  // as near to either end
                        const double wanted = std::clamp(turns / arc, 0.0, 1.0) * (count - 1);
                        if (kind == texture_kind::volume) {
                            const float w = shader::bumpshadow_arc_coordinate(bearing, c.start, c.scale, c.offset);
                            // A texture unit that clamps reads position w * count - 0.5 within [0, count - 1].
                            CHECK(std::abs(std::clamp(double(w) * count - 0.5, 0.0, count - 1.0) - wanted) < rounding);
                        } else {
                            const shader::vec3 l =
                                shader::bumpshadow_arc_layers(bearing, c.start, c.scale, c.offset, float(count));
                            CHECK(l.x == std::floor(l.x));
                            CHECK((l.x >= 0.0f && l.x <= float(count - 1)));
                            CHECK(l.y == l.x + 1.0f);
                            CHECK((l.z >= 0.0f && l.z < 1.0f));
                            CHECK((l.y < float(count) || l.z == 0.0f));
                            CHECK(std::abs(double(l.x + l.z) - wanted) < rounding);
                        }
                    }
                }
}

TEST_CASE("bytes and fetches of an arc") {
    tangent_volume e{{5, 0.25, bearing_function::cubic, 0.5}};
    CHECK(layout_of(e, {64, 32}).bytes_per_texel({64, 32}) == 5.0);
    CHECK(layout_of(e, {64, 32}).depth == 5);
    CHECK(fetches(e) == 1);
    e.kind = texture_kind::array;
    CHECK(layout_of(e, {64, 32}).layers == 5);
    CHECK(fetches(e) == 2);
    e.slices.count = 1;
    e.kind = texture_kind::flat;
    CHECK(layout_of(e, {64, 32}).bytes_per_texel({64, 32}) == 1.0);
    CHECK(fetches(e) == 1);
}

TEST_CASE("a light that is fixed: one slice is the baked horizon") {
    // Not one of the evenly spaced directions.
    const double bearing = 0.3871;
    horizons map = horizons::random({37, 19}, 1, 5);
    map.directions = {2.0 * to_direction(bearing_function::cubic, bearing)};
    for (const slice_fit fit : {slice_fit::point, slice_fit::least_squares, slice_fit::least_angle})
        for (const texel_format format : {texel_format::r8, texel_format::r16, texel_format::r16f})
            for (const texture_kind kind : {texture_kind::flat, texture_kind::volume, texture_kind::array}) {
                const tangent_volume e{
                    {1, bearing, bearing_function::cubic, 0.0}, {quantity::slope, 1.25f}, format, kind};
                stored t(e, map.extent);
                REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, e, {.fit = fit}, t.view())));
                const double bound = format == texel_format::r8 ? 1.0 / 510.0 : 1.0 / 4096.0;
                double worst = 0.0;
                for (int y = 0; y < 19; ++y)
                    for (int x = 0; x < 37; ++x)
                        worst = std::max(
                            worst, std::abs(t.at(0, 0, x, y) - std::clamp(double(map.at(0, x, y)) / 1.25, 0.0, 1.0)));
                CHECK(worst <= bound + 3e-7);
            }
}

TEST_CASE("over an arc: points, fitted slices and mips of an array") {
    const tangent_volume e{
        {5, 0.25, bearing_function::exact, 0.5}, {quantity::slope, 1.5f}, texel_format::r16, texture_kind::array};
    // Directions 4 ... 12 of 16 are at 1/4 ... 3/4, every other one a slice's own.
    const horizons map = horizons::random({16, 8}, 16, 11);
    stored t(e, map.extent);
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, e, {.fit = slice_fit::point}, t.view())));
    double worst = 0.0;
    for (int i = 0; i < 5; ++i)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x)
                worst = std::max(
                    worst, std::abs(t.at(0, i, x, y) - std::clamp(double(map.at(4 + 2 * i, x, y)) / 1.5, 0.0, 1.0)));
    CHECK(worst < 1e-5);

    horizons fitted({16, 8}, 5), half({8, 4}, 5);
    fill_directions(fitted.directions, e.slices);
    REQUIRE(bool(fit_slices(map.view(), map.directions, e.slices, e.scale, {}, fitted.view())));
    const horizon_map mips[] = {half.view()};
    REQUIRE(bool(make_mips(fitted.view(), e.scale, mips, {})));
    const horizon_map levels[] = {fitted.view(), half.view()};
    stored all(e, map.extent, 2), direct(e, map.extent);
    REQUIRE(bool(pack_tangent_volume(levels, fitted.directions, e, {.fit = slice_fit::point}, all.view())));
    REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, e, {}, direct.view())));
    double first = 0.0, second = 0.0;
    for (int i = 0; i < 5; ++i)
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 16; ++x) {
                first = std::max(first, std::abs(all.at(0, i, x, y) - direct.at(0, i, x, y)));
                second = std::max(second, std::abs(all.at(1, i, x / 2, y / 2) -
                                                   std::clamp(double(half.at(i, x / 2, y / 2)) / 1.5, 0.0, 1.0)));
            }
    CHECK(first < 2e-5);
    CHECK(second < 1e-5);
}

TEST_CASE("half the slices of an arc: both ends stay") {
    const horizons map = horizons::random({12, 8}, 64, 4);
    for (const texel_format format : {texel_format::r8, texel_format::r16, texel_format::bc4})
        for (const texture_kind kind : {texture_kind::volume, texture_kind::array}) {
            const tangent_volume e{{17, 0.125, bearing_function::exact, 0.5}, {quantity::slope, 2.0f}, format, kind};
            const tangent_volume half = halved(e);
            CHECK(half.slices.count == 9);
            CHECK(half.slices.arc == 0.5);
            stored whole(e, map.extent), dropped(half, map.extent), direct(half, map.extent), fitted(half, map.extent);
            const pack_options point{.fit = slice_fit::point};
            REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, e, point, whole.view())));
            REQUIRE(bool(pack_tangent_volume(map.view(), map.directions, half, point, direct.view())));
            REQUIRE(bool(halve_slices(whole.view(), e, point, dropped.view())));
            CHECK(dropped.bytes == direct.bytes);
            REQUIRE(bool(halve_slices(whole.view(), e, {}, fitted.view())));
            double error_of_dropped = 0.0, error_of_fitted = 0.0;
            for (int i = 0; i < 17; ++i)
                for (int k = 0; k < 96; ++k) {
                    const int x = k % 12, y = k / 12, a = i / 2, b = a + i % 2;
                    const auto error = [&](const stored& s) {
                        const double off = 0.5 * (s.at(0, a, x, y) + s.at(0, b, x, y)) - whole.at(0, i, x, y);
                        return off * off;
                    };
                    error_of_dropped += error(dropped);
                    error_of_fitted += error(fitted);
                }
            CHECK(error_of_fitted < 0.9 * error_of_dropped);
        }
    const tangent_volume even{{8, 0.0, bearing_function::cubic, 0.5}};
    stored t(even, {4, 4});
    const status s = halve_slices(t.view(), even, {}, t.view());
    CHECK(s.code() == error::not_a_multiple);
    CHECK(s.value() == 7.0);
}

TEST_CASE("a bad arc is named and nothing is written") {
    const double nan = std::nan(""), infinite = std::numeric_limits<double>::infinity();
    const auto code = [](const slice_set& slices) {
        const status s = check(slices);
        if (!s) CHECK(s.message().view().starts_with("arc is "));
        return s.code();
    };
    const auto arc = [](int count, double turns) { return slice_set{count, 0.0, bearing_function::cubic, turns}; };
    CHECK(code(arc(4, nan)) == error::not_finite);
    CHECK(code(arc(4, infinite)) == error::not_finite);
    CHECK(code(arc(4, 0.0)) == error::not_positive);
    CHECK(code(arc(4, -0.25)) == error::not_positive);
    CHECK(code(arc(1, -0.25)) == error::not_positive);
    CHECK(code(arc(4, 1.25)) == error::out_of_range);
    CHECK(code(arc(4, 1e-9)) == error::out_of_range);
    CHECK(code(arc(4, smallest_arc)) == error::none);
    CHECK(code(arc(1, 0.0)) == error::none);
    CHECK(code(arc(4, 1.0)) == error::none);

    const horizons map = horizons::random({8, 4}, 16, 1);
    tangent_volume e{arc(5, 0.5)};
    const auto refused = [&](const pack_options& options = {}) {
        stored t(e, map.extent);
        const status s = pack_tangent_volume(map.view(), map.directions, e, options, t.view());
        if (!s) CHECK(std::all_of(t.bytes.begin(), t.bytes.end(), [](std::byte b) { return b == std::byte{0xcd}; }));
        return s.code();
    };
    CHECK(refused() == error::none);
    e.kind = texture_kind::flat;
    CHECK(refused() == error::mismatch);  // five slices
    e.kind = texture_kind::volume;
    e.slices.arc = 2.0;
    CHECK(refused() == error::out_of_range);
    e.slices = arc(5, 0.125);  // three directions within, which leave slices undetermined
    CHECK(refused() == error::out_of_range);
    CHECK(refused({.fit = slice_fit::point}) == error::mismatch);
    e.slices = {1, 0.03, bearing_function::exact, 0.01};  // none within
    CHECK(refused() == error::out_of_range);

    e.slices = arc(5, 0.5);
    const horizons half = horizons::random({4, 2}, 16, 1);
    const horizon_map levels[] = {map.view(), half.view()};
    stored mips(e, map.extent, 2), out(halved(e), map.extent, 2);
    CHECK(pack_tangent_volume(levels, map.directions, e, {}, mips.view()).code() == error::not_supported);
    CHECK(halve_slices(mips.view(), e, {}, out.view()).code() == error::not_supported);

    for (const slice_grouping grouping : {slice_grouping::four, slice_grouping::overlapping}) {
        const status s = check(slice_layers{arc(12, 0.5), {}, grouping});
        CHECK(s.code() == error::not_supported);
        CHECK(s.message().view() == "arc is 0.5, which this method does not support");
    }
}
