#include <bumpshadow/horizon/sweep.hpp>

#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/horizon/exact.hpp>

#include "support/executors.hpp"

using namespace bumpshadow;

namespace {

constexpr float hole = std::numeric_limits<float>::quiet_NaN();
constexpr double nothing = -std::numeric_limits<double>::infinity();

// A map that owns its heights.
struct field {
    glm::ivec2 extent;
    std::vector<float> samples;
    edge_mode edge = edge_mode::repeat;
    glm::dvec2 texel_size{1.0, 1.0};

    template <class Height>
    field(glm::ivec2 size, const Height& height) : extent(size) {
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x) samples.push_back(static_cast<float>(height(x, y)));
    }

    float& at(int x, int y) { return samples[std::size_t(y) * std::size_t(extent.x) + std::size_t(x)]; }

    // NaN where there is nothing.
    double height(std::int64_t x, std::int64_t y) const {
        const std::int64_t i = resolve_edge(x, extent.x, edge), j = resolve_edge(y, extent.y, edge);
        return i < 0 || j < 0 ? double(hole) : double(samples[std::size_t(j * extent.x + i)]);
    }

    height_map<float> view() const {
        height_map<float> map = tight_height_map(samples.data(), extent);
        map.edge = edge;
        map.texel_size = texel_size;
        map.no_data = hole;
        return map;
    }
};

field rough(glm::ivec2 extent, unsigned seed) {
    std::mt19937 random(seed);
    return field(extent, [&](int, int) { return double(random() % 1024) / 256.0; });
}

using slopes = std::vector<float>;

template <class Executor = serial>
slopes bake(bool improved, const height_map<float>& heights, std::span<const glm::dvec2> directions,
            bake_options options = {}, Executor execute = {}) {
    const rectangle region = region_or_all(options.region, heights.extent);
    slopes values(required_size(region.extent, int(directions.size())), -7.0f);
    const horizon_map out{values, region.extent, int(directions.size())};
    const status s = improved ? bake_sweep(heights, directions, out, options, execute)
                              : bake_sweep_classic(heights, directions, out, options, execute);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return values;
}

std::vector<glm::dvec2> some_directions() {
    std::vector<glm::dvec2> d(8);
    fill_directions(d);
    for (const double degrees :
         {3.0, 22.5, 40.0, 44.9, 50.0, 85.0, 100.0, 130.0, 160.0, 195.0, 251.0, 280.0, 316.0, 359.9})
        d.push_back(exact_direction(degrees / 360.0) * 2.5);
    return d;
}

// What the two methods are defined to find, by looking at every column of a line up to `reach` columns away.
// Columns are counted along the axis with more crossings, in field coordinates (x or y), rows along the other.
struct line_scan {
    const field& map;
    double slant;   // rows a column, along growing columns
    double length;  // of a step from column to column
    int sign;       // columns a step
    bool along_y;
    int reach;

    line_scan(const field& heights, glm::dvec2 d, int columns) : map(heights), reach(columns) {
        double major = d.x / heights.texel_size.x, minor = d.y / heights.texel_size.y;
        along_y = std::abs(minor) > std::abs(major);
        if (along_y) std::swap(major, minor);
        slant = minor / major;
        sign = major > 0.0 ? 1 : -1;
        const double size = along_y ? heights.texel_size.y : heights.texel_size.x;
        const double across = along_y ? heights.texel_size.x : heights.texel_size.y;
        length = std::sqrt(size * size + slant * slant * across * across);
    }

    double texel(std::int64_t column, std::int64_t row) const {
        return along_y ? map.height(row, column) : map.height(column, row);
    }
    double height(std::int64_t column, double row) const {
        const double below = std::floor(row + 1e-6), w = row - below;
        const double a = texel(column, std::int64_t(below));
        return w < 1e-6 ? a : a + w * (texel(column, std::int64_t(below) + 1) - a);
    }
    double horizon(std::int64_t column, double row, double own, int first) const {
        double best = map.edge == edge_mode::open ? nothing : 0.0;
        const auto offer = [&](double h, double steps) {
            if (steps > 0.0 && (h - own) / (steps * length) > best) best = (h - own) / (steps * length);
        };
        for (int k = first; k <= reach; ++k) offer(height(column + k * sign, row + slant * sign * k), k);
        // Far beyond a clamped border the bends of the line count, not the columns.
        const int last_column = (along_y ? map.extent.y : map.extent.x) - 1,
                  rows = along_y ? map.extent.x : map.extent.y;
        const int border = sign > 0 ? last_column : 0;
        if (map.edge == edge_mode::clamp && slant != 0.0)
            for (int r = 0; r < rows; ++r) {
                const double steps = (r - row) / (slant * sign);
                const std::int64_t near = (border - column) * sign + sweep_detail::near_columns + 1;
                if (steps > double(near)) offer(texel(border, r), steps);
            }
        return best;
    }

    double operator()(bool improved, int x, int y) const {
        const int column = along_y ? y : x, row = along_y ? x : y;
        const double own = texel(column, row);
        if (own != own) return double(no_horizon);
        double w = slant * column - std::floor(slant * column);
        if (w < 1e-6 || w > 1.0 - 1e-6) w = 0.0;
        const auto lines = [&](double own_a, double own_b, int first) {
            const double a = horizon(column, row + w, own_a, first);
            if (w == 0.0) return a;
            const double b = horizon(column, row + w - 1.0, own_b, first);
            return a == nothing || b == nothing ? nothing : (1.0 - w) * a + w * b;
        };
        if (!improved) {
            const auto own_of = [&](double at, int fallback) {
                const double h = height(column, at);
                return h == h ? h : texel(column, fallback) == texel(column, fallback) ? texel(column, fallback) : own;
            };
            const double found = lines(own_of(row + w, row), own_of(row + w - 1.0, row - 1), 1);
            return found == nothing ? double(no_horizon) : found;
        }
        double best = map.edge == edge_mode::open ? nothing : 0.0;
        const auto offer = [&](double slope) {
            if (slope > best) best = slope;
        };
        const double ahead = texel(column + sign, row) - own;
        const int side = slant * sign < 0.0 ? -1 : 1;
        const double beside = texel(column, row + side) - own;
        if (slant == 0.0)
            offer(ahead / length);
        else if (texel(column + sign, row + side) == texel(column + sign, row + side))
            offer((ahead + std::abs(slant) * beside) / length);
        for (int k = 1; k <= sweep_detail::near_columns; ++k)
            offer((height(column + k * sign, row + slant * sign * k) - own) / (k * length));
        offer(lines(own, own, sweep_detail::near_columns + 1));
        return best == nothing ? double(no_horizon) : best;
    }
};

constexpr edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};

void compare_with_scan(const field& map, std::span<const glm::dvec2> directions, bool improved) {
    const slopes values = bake(improved, map.view(), directions);
    constexpr double range = 4.0;
    int wrong = 0;
    std::string first;
    for (std::size_t i = 0; i < directions.size(); ++i) {
        // The sweep starts between 256 columns and this many from a texel.
        const line_scan at_least(map, directions[i], 256), at_most(map, directions[i], 700);
        for (int y = 0; y < map.extent.y; ++y)
            for (int x = 0; x < map.extent.x; ++x) {
                const std::size_t at = (i * std::size_t(map.extent.y) + std::size_t(y)) * std::size_t(map.extent.x);
                const double found = double(values[at + std::size_t(x)]);
                const double low = at_least(improved, x, y), high = at_most(improved, x, y);
                const double beyond = high == double(no_horizon) ? 0.0 : range / (256.0 * at_most.length);
                if (found >= low - 2e-5 && found <= high + beyond + 2e-5) continue;
                if (wrong++ == 0)
                    first = "direction " + std::to_string(i) + " texel " + std::to_string(x) + " " + std::to_string(y) +
                            ": " + std::to_string(found) + " not from " + std::to_string(low) + " to " +
                            std::to_string(high);
            }
    }
    CHECK_MESSAGE(wrong == 0, first);
}

}  // namespace

TEST_CASE("sweeps find what a scan of every line finds") {
    const std::vector<glm::dvec2> directions = some_directions();
    for (const bool improved : {false, true})
        for (const edge_mode edge : edges)
            for (const glm::ivec2 extent : {glm::ivec2(1, 1), {1, 7}, {7, 1}, {2, 2}, {3, 5}, {9, 6}}) {
                CAPTURE(improved);
                CAPTURE(int(edge));
                CAPTURE(extent.x);
                CAPTURE(extent.y);
                field map = rough(extent, 5);
                map.edge = edge;
                compare_with_scan(map, directions, improved);
                map.texel_size = {0.7, 1.9};
                compare_with_scan(map, std::span(directions).subspan(7, 9), improved);
            }
}

TEST_CASE("sweeps leave out holes as a scan does") {
    const std::vector<glm::dvec2> directions = some_directions();
    for (const bool improved : {false, true})
        for (const edge_mode edge : edges) {
            CAPTURE(improved);
            CAPTURE(int(edge));
            field map = rough({9, 7}, 11);
            map.edge = edge;
            for (const glm::ivec2 p : {glm::ivec2(0, 0), {3, 2}, {4, 2}, {8, 5}, {6, 6}, {1, 4}})
                map.at(p.x, p.y) = hole;
            compare_with_scan(map, directions, improved);
        }
}

TEST_CASE("a plane without an edge has its slope everywhere, signed") {
    const std::vector<glm::dvec2> directions = some_directions();
    field plane({23, 17}, [](int x, int y) { return 0.25 * x - 0.5 * y; });
    plane.edge = edge_mode::open;
    plane.texel_size = {0.5, 2.0};
    for (const bool improved : {false, true}) {
        CAPTURE(improved);
        const slopes values = bake(improved, plane.view(), directions);
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const glm::dvec2 unit = directions[i] / std::hypot(directions[i].x, directions[i].y);
            const double expected = 0.5 * unit.x - 0.25 * unit.y;
            double worst = 0.0;
            // Two texels from the border, where lines leave the map.
            for (int y = 2; y < 15; ++y)
                for (int x = 2; x < 21; ++x)
                    worst = std::fmax(
                        worst, std::abs(double(values[(i * 17 + std::size_t(y)) * 23 + std::size_t(x)]) - expected));
            // Two lines seen from a texel's own height: one climbs to its farthest point, the other falls from its
            // nearest, so that their mean is above the plane by up to w (1 - w) * (rise a row) / (nearest distance).
            const double bias = 0.25 * 0.5 / (0.5 * (sweep_detail::near_columns + 1));
            CHECK(worst < (improved ? bias : 3e-6));
        }
    }
}

TEST_CASE("at the end of an open map nothing occludes") {
    field map = rough({6, 5}, 2);
    map.edge = edge_mode::open;
    const glm::dvec2 east[] = {{1.0, 0.0}}, north[] = {{0.0, -3.0}};
    for (const bool improved : {false, true}) {
        const slopes to_east = bake(improved, map.view(), east), to_north = bake(improved, map.view(), north);
        for (int y = 0; y < 5; ++y) CHECK(to_east[std::size_t(y * 6 + 5)] == no_horizon);
        for (int x = 0; x < 6; ++x) CHECK(to_north[std::size_t(x)] == no_horizon);
        CHECK(to_east[4] == doctest::Approx(double(map.at(5, 0) - map.at(4, 0))));
    }
}

TEST_CASE("a spike, a step and a hill where lines pass through texels") {
    std::vector<glm::dvec2> directions(8);
    fill_directions(directions);
    const field spike({32, 32}, [](int x, int y) { return x == 10 && y == 20 ? 6.0 : 0.0; });
    const field step({32, 32}, [](int x, int) { return x >= 8 && x < 16 ? 3.0 : 0.0; });
    // A roof along the diagonal x + y = 31, falling by 1 a unit on both sides; clamped.
    field roof({32, 32}, [](int x, int y) { return -std::abs(x + y - 31) * std::sqrt(0.5); });
    roof.edge = edge_mode::clamp;
    for (const bool improved : {false, true}) {
        CAPTURE(improved);
        const slopes at_spike = bake(improved, spike.view(), directions);
        const auto of_spike = [&](int b, int x, int y) { return double(at_spike[std::size_t((b * 32 + y) * 32 + x)]); };
        CHECK(of_spike(0, 7, 20) == doctest::Approx(2.0));          // 6 over 3 texels
        CHECK(of_spike(0, 11, 20) == doctest::Approx(6.0 / 31.0));  // the next tile's
        CHECK(of_spike(4, 14, 20) == doctest::Approx(1.5));
        CHECK(of_spike(2, 10, 8) == doctest::Approx(0.5));
        CHECK(of_spike(6, 10, 21) == doctest::Approx(6.0));
        CHECK(of_spike(1, 7, 17) == doctest::Approx(std::sqrt(2.0)));  // 6 over 3 diagonals
        CHECK(of_spike(3, 13, 17) == doctest::Approx(std::sqrt(2.0)));
        CHECK(of_spike(5, 13, 23) == doctest::Approx(std::sqrt(2.0)));
        CHECK(of_spike(7, 8, 22) == doctest::Approx(6.0 / std::sqrt(8.0)));
        CHECK(of_spike(0, 10, 20) == 0.0);
        CHECK(of_spike(2, 20, 20) == 0.0);

        const slopes at_step = bake(improved, step.view(), directions);
        CHECK(at_step[5] == doctest::Approx(1.0));    // 3 over 3
        CHECK(at_step[20] == doctest::Approx(0.15));  // 3 over 20, in the next tile
        CHECK(at_step[9] == 0.0);
        CHECK(at_step[4 * 32 * 32 + 16] == doctest::Approx(3.0));

        const slopes at_roof = bake(improved, roof.view(), directions);
        const auto of_roof = [&](int b, int x, int y) { return double(at_roof[std::size_t((b * 32 + y) * 32 + x)]); };
        CHECK(of_roof(1, 5, 9) == doctest::Approx(1.0));
        CHECK(of_roof(5, 25, 16) == doctest::Approx(1.0));
        CHECK(of_roof(5, 5, 9) == 0.0);
        CHECK(of_roof(0, 5, 9) == doctest::Approx(std::sqrt(0.5)));
    }
}

TEST_CASE("no horizon of an endless map is negative, and a flat map has none") {
    const std::vector<glm::dvec2> directions = some_directions();
    for (const bool improved : {false, true})
        for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror}) {
            field map = rough({11, 14}, 3);
            map.edge = edge;
            for (const float slope : bake(improved, map.view(), directions)) CHECK(slope >= 0.0f);
            field flat({11, 14}, [](int, int) { return 123.456; });
            flat.edge = edge;
            for (const float slope : bake(improved, flat.view(), directions)) CHECK(slope == 0.0f);
        }
}

TEST_CASE("symmetries of the map are symmetries of its horizons") {
    // Lines are counted from column 0, so those of a mirrored map lie elsewhere, unless they pass through texels.
    constexpr std::size_t through_texels = 8;
    const std::vector<glm::dvec2> directions = some_directions();
    const glm::ivec2 n(17, 31);
    for (const bool improved : {false, true})
        for (const edge_mode edge : edges) {
            CAPTURE(improved);
            CAPTURE(int(edge));
            field map = rough(n, 7);
            map.edge = edge;
            const slopes values = bake(improved, map.view(), directions);
            const auto value = [&](std::size_t b, int x, int y) {
                return values[(b * 31 + std::size_t(y)) * 17 + std::size_t(x)];
            };

            field transposed({n.y, n.x}, [&](int x, int y) { return map.at(y, x); });
            field mirrored(n, [&](int x, int y) { return map.at(n.x - 1 - x, y); });
            field turned({n.y, n.x},
                         [&](int x, int y) { return map.at(y, n.y - 1 - x); });  // a quarter from +x towards +y
            field doubled(n, [&](int x, int y) { return 2.0f * map.at(x, y); });
            field raised(n, [&](int x, int y) { return 8.0f + map.at(x, y); });
            for (field* f : {&transposed, &mirrored, &turned, &doubled, &raised}) f->edge = edge;
            std::vector<glm::dvec2> across, aside, around;
            for (const glm::dvec2 d : directions) {
                across.emplace_back(d.y, d.x);
                aside.emplace_back(-d.x, d.y);
                around.emplace_back(-d.y, d.x);
            }
            const slopes a = bake(improved, transposed.view(), across), b = bake(improved, mirrored.view(), aside);
            const slopes c = bake(improved, turned.view(), around), twice = bake(improved, doubled.view(), directions);
            const slopes same = bake(improved, raised.view(), directions);
            int wrong = 0;
            for (std::size_t i = 0; i < directions.size(); ++i)
                for (int y = 0; y < n.y; ++y)
                    for (int x = 0; x < n.x; ++x) {
                        const float expected = value(i, x, y);
                        const auto differs = [&](float found, float factor = 1.0f) {
                            if (expected == no_horizon) return found != no_horizon;
                            return std::abs(found - factor * expected) > 2e-5f;
                        };
                        const std::size_t slice = i * 17 * 31;
                        wrong += differs(a[slice + std::size_t(x * 31 + y)]);
                        if (i < through_texels) {
                            wrong += differs(b[slice + std::size_t(y * 17 + 16 - x)]);
                            wrong += differs(c[slice + std::size_t(x * 31 + 30 - y)]);
                        }
                        wrong += differs(twice[slice + std::size_t(y * 17 + x)], 2.0f);
                        wrong += differs(same[slice + std::size_t(y * 17 + x)]);
                    }
            CHECK(wrong == 0);
        }
}

TEST_CASE("a shifted tiling map shifts its horizons") {
    // Lines start at column 0, so only shifts that keep them apart by whole rows leave a result as it is.
    std::vector<glm::dvec2> eighths(8);
    fill_directions(eighths);
    std::vector<glm::dvec2> flat, steep;
    for (const glm::dvec2 d : some_directions()) (std::abs(d.x) >= std::abs(d.y) ? flat : steep).push_back(d);
    const glm::ivec2 n(17, 31);
    field map = rough(n, 8);
    // Heights are rounded to float above that of the first texel, so every shift has to put the same height there.
    for (const glm::ivec2 by : {glm::ivec2(5, 0), {3, 12}, {0, 9}, {4, 0}})
        map.at((n.x - by.x) % n.x, (n.y - by.y) % n.y) = map.at(0, 0);
    for (const bool improved : {false, true}) {
        const auto check_shift = [&](glm::ivec2 by, std::span<const glm::dvec2> directions) {
            const field shifted(n, [&](int x, int y) { return map.height(x - by.x, y - by.y); });
            const slopes before = bake(improved, map.view(), directions);
            const slopes after = bake(improved, shifted.view(), directions);
            int wrong = 0;
            for (std::size_t i = 0; i < directions.size(); ++i)
                for (int y = 0; y < n.y; ++y)
                    for (int x = 0; x < n.x; ++x) {
                        const int u = (x + by.x) % n.x, v = (y + by.y) % n.y;
                        const std::size_t slice = i * 17 * 31;
                        wrong += before[slice + std::size_t(y * 17 + x)] != after[slice + std::size_t(v * 17 + u)];
                    }
            CHECK(wrong == 0);
        };
        check_shift({5, 0}, eighths);
        check_shift({3, 12}, eighths);
        check_shift({0, 9}, flat);
        check_shift({4, 0}, steep);
    }
}

TEST_CASE("the result does not depend on the executor, the region or the number of directions, bit for bit") {
    const std::vector<glm::dvec2> directions = some_directions();
    for (const bool improved : {false, true})
        for (const edge_mode edge : edges) {
            CAPTURE(improved);
            CAPTURE(int(edge));
            field map = rough({70, 41}, 9);
            map.edge = edge;
            map.at(12, 30) = edge == edge_mode::mirror ? hole : 1.0f;
            const slopes all = bake(improved, map.view(), directions);
            CHECK(all == bake(improved, map.view(), directions, {}, threads{2}));
            CHECK(all == bake(improved, map.view(), directions, {}, threads{5}));
            CHECK(all == bake(improved, map.view(), directions, {}, executors::unruly{}));
            CHECK(slopes(all.begin() + 9 * 70 * 41, all.begin() + 10 * 70 * 41) ==
                  bake(improved, map.view(), std::span(directions).subspan(9, 1), {}, threads{3}));
            for (const rectangle region :
                 {rectangle{{0, 0}, {1, 1}}, {{69, 40}, {1, 1}}, {{13, 7}, {31, 20}}, {{0, 39}, {70, 2}}}) {
                bake_options options;
                options.region = region;
                const slopes part = bake(improved, map.view(), directions, options, threads{2});
                int wrong = 0;
                std::size_t next = 0;
                for (std::size_t i = 0; i < directions.size(); ++i)
                    for (int y = 0; y < region.extent.y; ++y)
                        for (int x = 0; x < region.extent.x; ++x)
                            wrong += part[next++] != all[(i * 41 + std::size_t(y + region.origin.y)) * 70 +
                                                         std::size_t(x + region.origin.x)];
                CHECK(wrong == 0);
            }
        }
}

TEST_CASE("sweeps write only the texels of a strided output") {
    const field map = rough({7, 5}, 10);
    const glm::dvec2 directions[] = {{1.0, 0.2}, {0.1, -1.0}};
    for (const bool improved : {false, true}) {
        const slopes tight = bake(improved, map.view(), directions);
        slopes loose(2 * 60, -7.0f);
        const horizon_map out{loose, {7, 5}, 2, 11, 60};
        REQUIRE(
            bool(improved ? bake_sweep(map.view(), directions, out) : bake_sweep_classic(map.view(), directions, out)));
        for (std::size_t i = 0; i < loose.size(); ++i) {
            const std::size_t b = i / 60, y = i % 60 / 11, x = i % 60 % 11;
            CHECK(loose[i] == (x < 7 && y < 5 ? tight[(b * 5 + y) * 7 + x] : -7.0f));
        }
    }
}

TEST_CASE("sweeps read all sample types, strides and scales alike") {
    const field map({8, 6}, [](int x, int y) { return (x * 37 + y * 101) % 256; });
    const glm::dvec2 directions[] = {{1.0, 0.3}, {-0.4, 1.0}};
    for (const bool improved : {false, true}) {
        const slopes expected = bake(improved, map.view(), directions);
        const auto check_type = [&]<class T>(T, double scale, double offset, double factor) {
            std::vector<T> samples(6 * 9);
            for (int y = 0; y < 6; ++y)
                for (int x = 0; x < 8; ++x)
                    samples[std::size_t(y * 9 + x)] = static_cast<T>(map.height(x, y) * factor + offset);
            height_map<T> heights = tight_height_map(samples.data(), {8, 6});
            heights.row_stride = 9;
            heights.height_scale = scale;
            heights.datum = offset;
            slopes values(expected.size());
            const horizon_map out{values, {8, 6}, 2};
            REQUIRE(
                bool(improved ? bake_sweep(heights, directions, out) : bake_sweep_classic(heights, directions, out)));
            for (std::size_t i = 0; i < values.size(); ++i)
                CHECK(double(values[i]) == doctest::Approx(double(expected[i])).epsilon(1e-5));
        };
        check_type(std::uint8_t{}, 255.0, 0.0, 1.0);
        check_type(std::uint16_t{}, 65535.0 / 16.0, 0.0, 16.0);
        check_type(double{}, 1.0, 1e9, 1.0);
    }
}

TEST_CASE("sweeps against the analytic horizon of a smooth tiling map") {
    const glm::ivec2 n(64, 48);
    const field map(n, [&](int x, int y) {
        const double u = 2.0 * std::numbers::pi * x / n.x, v = 2.0 * std::numbers::pi * y / n.y;
        return 3.0 * std::sin(u) * std::cos(2.0 * v) + 1.5 * std::sin(3.0 * u + 2.0 * v + 1.0) + std::cos(5.0 * v - u);
    });
    std::vector<glm::dvec2> directions(16);
    fill_directions(directions, 0.01);
    slopes exact(required_size(n, 16));
    REQUIRE(bool(bake_exact(map.view(), directions, horizon_map{exact, n, 16})));
    double mean[2] = {}, worst[2] = {};
    for (const bool improved : {false, true}) {
        const slopes values = bake(improved, map.view(), directions);
        for (std::size_t i = 0; i < values.size(); ++i) {
            const double off = std::abs(std::atan(double(values[i])) - std::atan(double(exact[i])));
            const double degrees = off * 180.0 / std::numbers::pi;
            mean[improved] += degrees / double(values.size());
            worst[improved] = std::fmax(worst[improved], degrees);
        }
    }
    CAPTURE(mean[0]);
    CAPTURE(mean[1]);
    CAPTURE(worst[0]);
    CAPTURE(worst[1]);
    CHECK(mean[0] < 1.0);
    CHECK(mean[1] < 0.1);
    CHECK(mean[1] < 0.25 * mean[0]);
    CHECK(worst[1] < worst[0]);
}

TEST_CASE("sweeps refuse what they cannot do and write nothing") {
    const glm::dvec2 directions[] = {{1.0, 0.0}, {0.0, 1.0}};
    for (const bool improved : {false, true}) {
        field map = rough({4, 3}, 1);
        const auto code = [&](bake_options options, const char* argument) {
            slopes values(24, -7.0f);
            const horizon_map out{values, {4, 3}, 2};
            const status s = improved ? bake_sweep(map.view(), directions, out, options)
                                      : bake_sweep_classic(map.view(), directions, out, options);
            CHECK(std::string(s.argument()) == argument);
            for (const float v : values) CHECK(v == -7.0f);
            return s.code();
        };
        bake_options options;
        options.radius = 16.0;
        CHECK(code(options, "radius") == error::not_supported);
        options = {};
        options.curvature = {0.0, 0.5};
        CHECK(code(options, "curvature.y") == error::not_supported);
        options = {};
        slopes distances(24);
        options.distances = {distances, {4, 3}, 2};
        CHECK(code(options, "distances") == error::not_supported);
        options = {};
        std::byte little[100];
        options.scratch = little;
        CHECK(code(options, "options.scratch") == error::too_small);
        options = {};
        map.at(2, 1) = std::numeric_limits<float>::infinity();
        CHECK(code(options, "height") == error::not_finite);
        slopes values(24);
        CHECK(bake_sweep(map.view(), {}, horizon_map{values, {4, 3}, 2}).code() == error::not_positive);
    }
}

TEST_CASE("scratch does not grow with the directions, and a span of its size is enough") {
    const field map = rough({40, 30}, 6);
    const std::vector<glm::dvec2> directions = some_directions();
    const std::span<const glm::dvec2> few = std::span(directions).first(3);
    CHECK(sweep_scratch_size(map.view(), directions) == sweep_scratch_size(map.view(), few));
    CHECK(sweep_classic_scratch_size(map.view(), directions) == sweep_classic_scratch_size(map.view(), few));
    for (const bool improved : {false, true}) {
        const threads two{2};
        const std::size_t size = improved ? sweep_scratch_size(map.view(), directions, {}, two)
                                          : sweep_classic_scratch_size(map.view(), directions, {}, two);
        std::vector<std::byte> scratch(size);
        bake_options options;
        options.scratch = scratch;
        CHECK(bake(improved, map.view(), directions, options, threads{2}) == bake(improved, map.view(), directions));
    }
}
