#include <bumpshadow/horizon/cascade.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/horizon/exact.hpp>

#include "support/counting.hpp"
#include "support/executors.hpp"
#include "support/shapes.hpp"

using namespace bumpshadow;
using shapes::field;
using shapes::sampled;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;
constexpr std::array edges{edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};
using slopes = std::vector<float>;
using list = std::vector<glm::dvec2>;

double degrees(double slope) { return std::atan(slope) * 180.0 / pi; }

template <height_sample Sample, class Executor = serial>
slopes baked(const height_map<Sample>& map, const list& directions, const bake_options& options = {},
             const Executor& execute = {}) {
    const glm::ivec2 extent = region_or_all(options.region, map.extent).extent;
    slopes values(required_size(extent, int(directions.size())), -7.0f);
    const horizon_map out{.values = values, .extent = extent, .bearings = int(directions.size())};
    const status s = bake_cascade(map, directions, out, options, execute);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return values;
}

bake_options with_steps(int steps) {
    bake_options options;
    options.steps = steps;
    return options;
}

// Steps that the bounds of this file are stated for.
const bake_options usual = {};

// Differences of elevation, in degrees.
struct difference {
    double mean = 0.0, percentile_99 = 0.0, largest = 0.0;
};

difference of(std::vector<double> errors) {
    REQUIRE(!errors.empty());
    difference d;
    for (const double e : errors) d.mean += e / double(errors.size());
    std::sort(errors.begin(), errors.end());
    d.percentile_99 = errors[std::size_t(0.99 * double(errors.size() - 1))];
    d.largest = errors.back();
    return d;
}

difference between(const slopes& a, const slopes& b) {
    REQUIRE(a.size() == b.size());
    std::vector<double> errors;
    for (std::size_t i = 0; i < a.size(); ++i)
        errors.push_back(std::abs(degrees(double(a[i])) - degrees(double(b[i]))));
    return of(errors);
}

double steepest(const slopes& values) {
    double most = 0.0;
    for (const float slope : values) most = std::fmax(most, std::abs(double(slope)));
    return most;
}

// Texels of a map: all of them, or a sample.
std::vector<glm::ivec2> some_texels(glm::ivec2 extent, int most) {
    std::vector<glm::ivec2> texels;
    if (extent.x * extent.y <= most) {
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) texels.emplace_back(x, y);
        return texels;
    }
    shapes::noise random(3);
    for (int i = 0; i < most; ++i) {
        const int x = random.between(0, extent.x - 1);
        texels.emplace_back(x, random.between(0, extent.y - 1));
    }
    return texels;
}

// A bake of the whole map against the exact horizons of some texels.
template <height_sample Sample>
class trial {
public:
    trial(const height_map<Sample>& map, const list& directions, const bake_options& options = usual)
        : map_(map), directions_(directions), options_(options), found_(baked(map, directions, options)) {}

    [[nodiscard]] double slope(std::size_t i, glm::ivec2 p) const {
        return double(found_[(i * std::size_t(map_.extent.y) + std::size_t(p.y)) * std::size_t(map_.extent.x) +
                             std::size_t(p.x)]);
    }
    [[nodiscard]] const slopes& all() const { return found_; }

    // visit(direction, texel, slope found, exact horizon)
    template <class Visit>
    void visit(int most, const Visit& visit) const {
        std::vector<Sample> storage(height_bounds<Sample>::required_size(map_.extent));
        const height_bounds<Sample> bounds(map_, storage);
        for (std::size_t i = 0; i < directions_.size(); ++i)
            for (const glm::ivec2 p : some_texels(map_.extent, most))
                visit(i, p, slope(i, p),
                      exact_horizon(map_, p, directions_[i], options_.radius, options_.curvature, &bounds));
    }

    // Where there is no horizon there has to be none, but for a few texels beside an open border whose rays end sooner
    // than those of the cells that they take far horizons from.
    [[nodiscard]] difference against_exact(int most = 1 << 20) const {
        std::vector<double> errors;
        int wrongly_absent = 0, wrongly_present = 0;
        visit(most, [&](std::size_t, glm::ivec2, double found, const horizon_sample& exact) {
            const bool absent = exact.slope == double(no_horizon);
            if (absent != (found == double(no_horizon)))
                ++(absent ? wrongly_present : wrongly_absent);
            else
                errors.push_back(std::abs(degrees(found) - degrees(exact.slope)));
        });
        CHECK(double(wrongly_absent) <= (map_.edge == edge_mode::open ? 0.005 * double(errors.size()) : 0.0));
        CHECK(double(wrongly_present) <= (map_.edge == edge_mode::open ? 0.02 * double(errors.size()) : 0.0));
        return of(errors);
    }

private:
    height_map<Sample> map_;
    list directions_;
    bake_options options_;
    slopes found_;
};

void check_within(const difference& d, double mean, double percentile_99, double largest) {
    CHECK(d.mean <= mean);
    CHECK(d.percentile_99 <= percentile_99);
    CHECK(d.largest <= largest);
}

// Slopes seen from texel p towards the others, as elevations.
template <height_sample Sample>
void check_slope(const trial<Sample>& t, std::size_t i, glm::ivec2 p, double known, double tolerance) {
    CAPTURE(i);
    CAPTURE(p.x);
    CAPTURE(p.y);
    CHECK(std::abs(degrees(t.slope(i, p)) - degrees(known)) <= tolerance);
}

// A surface with everything that is hard: slow waves, a plateau with steep rims, and noise of 0.4. Tiles with the
// extent; heights of about +-8.
template <height_sample Sample = float>
field<Sample> hard(glm::ivec2 extent, std::uint64_t seed, double roughness = 0.4) {
    shapes::noise random(seed);
    std::vector<double> column(std::size_t(extent.x)), row(std::size_t(extent.y));
    field<double> sum = sampled(extent, shapes::plane(0.0));
    for (const double length : {90.0, 90.0, 50.0, 50.0, 25.0, 12.0, 7.0}) {
        // Whole waves, so that the surface tiles.
        const double kx = std::round(extent.x / length * (0.3 + 0.7 * random.uniform())) * 2.0 * pi / extent.x;
        const double ky = std::round(extent.y / length * (0.3 + 0.7 * random.uniform())) * 2.0 * pi / extent.y;
        const double px = 2.0 * pi * random.uniform(), py = 2.0 * pi * random.uniform();
        for (int x = 0; x < extent.x; ++x) column[std::size_t(x)] = std::sin(kx * x + px);
        for (int y = 0; y < extent.y; ++y) row[std::size_t(y)] = 0.05 * length * std::sin(ky * y + py);
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) sum.at(x, y) += column[std::size_t(x)] * row[std::size_t(y)];
    }
    field<Sample> result = sampled<Sample>(extent, [&](double x, double y) {
        const double h = sum.at(int(x), int(y));
        // Multiples of 1/1024, so that sums and differences with round numbers are exact in float.
        return std::round(1024.0 * (h + (h > 0.8 ? 2.5 : 0.0) + roughness * random.uniform())) / 1024.0;
    });
    return result;
}

// Axes, diagonals, and others that pass through few texels.
list many_directions() {
    list all = shapes::directions(8);
    for (const glm::dvec2 d : shapes::directions(5, 0.013)) all.push_back(d);
    return all;
}

}  // namespace

TEST_SUITE_BEGIN("cascade");

// ---- Shapes with known horizons ----

TEST_CASE("cascade: a plane has horizon 0") {
    for (const glm::ivec2 extent : {glm::ivec2(7, 5), {64, 64}, {150, 33}}) {
        const auto flat = sampled(extent, shapes::plane(3.0));
        for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror})
            CHECK(steepest(baked(flat.view(edge), many_directions(), usual)) <= 1e-6);
        // From the border straight out there is nothing.
        const trial open(flat.view(edge_mode::open), many_directions());
        int wrong = 0;
        open.visit(500, [&](std::size_t, glm::ivec2, double found, const horizon_sample& exact) {
            wrong += exact.slope == double(no_horizon) ? found != exact.slope : std::abs(found) > 1e-6;
        });
        CAPTURE(extent.x);
        CHECK(wrong == 0);
    }
}

TEST_CASE("cascade: a ramp keeps its slope uphill, and downhill where the map ends") {
    const glm::dvec2 gradient(0.5, -0.25);
    const auto ramp = sampled({120, 90}, shapes::ramp(gradient));
    const list directions = shapes::directions(24, 0.01);
    const trial open(ramp.view(edge_mode::open), directions);
    for (std::size_t i = 0; i < directions.size(); ++i)
        check_slope(open, i, {60, 45}, gradient.x * directions[i].x + gradient.y * directions[i].y, 0.5);
    check_within(open.against_exact(500), 0.15, 2.0, 5.0);

    const trial clamped(ramp.view(edge_mode::clamp), {{1, 0}, {-1, 0}, {0, -1}});
    for (const glm::ivec2 p : {glm::ivec2(3, 10), {60, 45}, {117, 80}}) {
        // Beside a border far cells are not quite what their neighbors lead to expect.
        const double tolerance = p.x == 60 ? 0.15 : 0.7;
        check_slope(clamped, 0, p, 0.5, tolerance);
        check_slope(clamped, 1, p, 0.0, 0.001);
        check_slope(clamped, 2, p, 0.25, tolerance);
    }
    check_within(trial(ramp.view(edge_mode::clamp), directions).against_exact(500), 0.05, 0.6, 1.2);
}

TEST_CASE("cascade: the edge of a step is the horizon below it") {
    const auto map = sampled({200, 60}, shapes::step(160.0, 20.0));
    const list directions = {{1, 0}, {2, 1}, {1, 1}, {2, -3}, {-1, 0}};
    const trial t(map.view(edge_mode::clamp), directions);
    for (const int x : {0, 30, 100, 130, 150, 158, 159})
        for (std::size_t i = 0; i < 4; ++i) {
            const glm::dvec2 d = directions[i];
            check_slope(t, i, {x, 30}, 20.0 * (d.x / std::hypot(d.x, d.y)) / (160 - x), 0.5);
        }
    for (const glm::ivec2 p : {glm::ivec2(160, 30), {199, 3}, {100, 59}}) check_slope(t, 4, p, 0.0, 0.001);
    check_within(t.against_exact(1000), 0.07, 0.7, 3.0);
}

TEST_CASE("cascade: a single spike") {
    const auto map = sampled({100, 100}, shapes::spike({50, 50}, 8.0));
    const list directions = {{1, 0}, {1, 1}, {0, -1}, {-1, 1}};
    const trial t(map.view(edge_mode::clamp), directions);
    const glm::ivec2 steps[] = {{1, 0}, {1, 1}, {0, -1}, {-1, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        // Near by it is looked at texel by texel.
        for (const int away : {1, 2, 3, 5, 8, 11})
            check_slope(t, i, glm::ivec2(50) - away * steps[i], 8.0 / (away * std::hypot(steps[i].x, steps[i].y)),
                        0.001);
        check_slope(t, i, {50, 50}, 0.0, 0.001);
        check_slope(t, i, glm::ivec2(50) + 20 * steps[i], 0.0, 0.001);
        // Farther on it blends with what is around it: never higher than it is, and at most a few texels off.
        for (const int away : {25, 40}) {
            const glm::ivec2 p = glm::ivec2(50) - away * steps[i];
            CHECK(t.slope(i, p) >= 0.0);
            CHECK(t.slope(i, p) <= 8.0 / ((away - 4) * std::hypot(steps[i].x, steps[i].y)));
        }
    }
    check_within(trial(map.view(edge_mode::clamp), many_directions()).against_exact(1000), 0.1, 3.0, 45.0);
}

TEST_CASE("cascade: a cone and its tip") {
    const glm::dvec2 center(64, 64);
    const double height = 30.0, gradient = 0.8;
    const auto map = sampled({129, 129}, shapes::cone(center, height, gradient));
    const glm::ivec2 from[] = {{4, 64}, {64, 1}, {4, 4}, {124, 4}, {2, 95}, {20, 13}};
    list towards;
    for (const glm::ivec2 p : from) towards.emplace_back(center.x - p.x, center.y - p.y);
    const trial t(map.view(edge_mode::clamp), towards);
    for (std::size_t i = 0; i < 6; ++i)
        check_slope(t, i, from[i], height / std::hypot(towards[i].x, towards[i].y), 1.0);
    // On its flank, along a grid line through the tip.
    check_slope(t, 0, {50, 64}, gradient, 0.001);
    check_slope(t, 1, {64, 50}, gradient, 0.001);
    check_slope(t, 0, {70, 64}, 0.0, 0.001);
    check_within(trial(map.view(edge_mode::clamp), many_directions()).against_exact(1000), 0.02, 0.4, 2.0);
}

TEST_CASE("cascade: a hemisphere is seen along its tangent") {
    const glm::dvec2 center(60, 60);
    const double radius = 30.0;
    const auto map = sampled({121, 121}, shapes::hemisphere(center, radius));
    const glm::ivec2 from[] = {{5, 60}, {60, 118}, {20, 8}, {110, 20}, {28, 60}};
    list towards;
    for (const glm::ivec2 p : from) towards.emplace_back(center.x - p.x, center.y - p.y);
    const trial t(map.view(edge_mode::clamp), towards);
    for (std::size_t i = 0; i < 5; ++i) {
        const double away = std::hypot(towards[i].x, towards[i].y);
        check_slope(t, i, from[i], radius / std::sqrt(away * away - radius * radius), 0.5);
    }
    check_within(trial(map.view(edge_mode::clamp), many_directions()).against_exact(1000), 0.06, 1.5, 22.0);
}

TEST_CASE("cascade: a V groove is seen from its bottom and across") {
    const auto map = sampled({161, 40}, shapes::v_groove(80.0, 0.75));
    const list directions = shapes::directions(32);
    const trial t(map.view(edge_mode::clamp), directions);
    // Cells that lie across the bottom are higher than it is on average, which shows most where nothing else rises.
    for (std::size_t i = 0; i < directions.size(); ++i)
        check_slope(t, i, {80, 20}, 0.75 * std::abs(directions[i].x), std::abs(directions[i].x) > 0.1 ? 0.8 : 2.7);
    // From the near wall over to the rim of the far one, 80 texels from the bottom.
    for (const int up : {3, 10, 30, 60}) {
        check_slope(t, 0, {80 - up, 20}, 0.75 * (80.0 - up) / (80.0 + up), 0.3);
        check_slope(t, 16, {80 - up, 20}, 0.75, 0.2);
    }
    check_within(t.against_exact(500), 0.1, 0.8, 2.7);
}

TEST_CASE("cascade: a 45-degree hill at diagonal bearings") {
    const auto map = sampled({100, 100}, shapes::diagonal_hill(120.0, 12.0));
    const trial t(map.view(edge_mode::open), {{1, 1}, {-1, -1}, {1, -1}});
    for (int x = 2; x < 60; x += 3) {
        const double to_crest = (120.0 - 2.0 * x) / std::sqrt(2.0);
        // Far cells look at the diagonal half way between its texels, and the crest is sharp.
        check_slope(t, 0, {x, x}, to_crest > 12.0 ? 12.0 / to_crest : 1.0, 1.3);
    }
    for (const int x : {61, 64, 68}) check_slope(t, 1, {x, x}, 1.0, 0.01);
    check_slope(t, 1, {98, 98}, 12.0 / (76.0 / std::sqrt(2.0)), 0.7);
    // Along a contour nothing rises.
    for (const glm::ivec2 p : {glm::ivec2(57, 57), {30, 84}, {70, 44}}) check_slope(t, 2, p, 0.0, 0.4);
    // Where the map ends, downhill horizons are as far off as far cells are from the border.
    check_within(t.against_exact(1000), 0.2, 2.5, 5.0);
}

// ---- Hard surfaces, of all extents and edges ----

TEST_CASE("cascade: any extent and edge against exact") {
    // Directions in small whole numbers: over a map of a few texels the exact horizon of any other takes long.
    const list whole = {{1, 0}, {0, -1}, {-1, 1}, {2, 1}, {-1, 3}, {-3, -2}, {4, -1}};
    for (const glm::ivec2 extent :
         {glm::ivec2(1, 1), {1, 9}, {9, 1}, {1, 70}, {70, 1}, {2, 2}, {3, 5}, {17, 31}, {33, 32}, {65, 63}}) {
        const auto map = hard(extent, 11);
        for (const edge_mode edge : edges) {
            CAPTURE(extent.x);
            CAPTURE(extent.y);
            CAPTURE(int(edge));
            check_within(trial(map.view(edge), whole).against_exact(150), 0.25, 4.0, 45.0);
        }
    }
    const list odd = shapes::directions(3, 0.29);
    for (const glm::ivec2 extent : {glm::ivec2(403, 344), {1024, 669}}) {
        const auto map = hard(extent, 12);
        for (const edge_mode edge : edges) {
            if (extent.x == 1024 && edge != edge_mode::repeat && edge != edge_mode::clamp) continue;
            CAPTURE(extent.x);
            CAPTURE(int(edge));
            check_within(trial(map.view(edge), odd).against_exact(400), 0.2, 2.5, 45.0);
        }
    }
}

TEST_CASE("cascade: a map of an odd extent tiles without a seam") {
    const glm::ivec2 extent(203, 171);
    const auto map = hard(extent, 13, 0.0);
    const list directions = shapes::directions(8, 0.03);
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::mirror}) {
        std::vector<double> beside, elsewhere;
        trial(map.view(edge), directions)
            .visit(4000, [&](std::size_t, glm::ivec2 p, double found, const horizon_sample& exact) {
                const bool near = (std::min)({p.x, p.y, extent.x - 1 - p.x, extent.y - 1 - p.y}) < 16;
                (near ? beside : elsewhere).push_back(std::abs(degrees(found) - degrees(exact.slope)));
            });
        const difference a = of(beside), b = of(elsewhere);
        CHECK(beside.size() > 5000);
        CHECK(a.mean <= 1.3 * b.mean);
        CHECK(a.percentile_99 <= 1.3 * b.percentile_99);
    }
}

TEST_CASE("cascade: texels that are not square") {
    const auto map = hard({160, 130}, 14);
    for (const glm::dvec2 size : {glm::dvec2(1, 10), {10, 1}, {74.5, 92.7}, {0.3, 0.4}})
        for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp}) {
            CAPTURE(size.x);
            CAPTURE(int(edge));
            height_map<float> view = map.view(edge);
            view.texel_size = size;
            view.height_scale = (std::min)(size.x, size.y);
            check_within(trial(view, many_directions()).against_exact(300), 0.2, 2.5, 45.0);
        }
}

TEST_CASE("cascade: units do not matter") {
    const auto map = hard<double>({40, 33}, 15);
    for (const edge_mode edge : edges) {
        const slopes expected = baked(map.view(edge), many_directions(), usual);
        for (const double unit : {1e-20, 1e-3, 1e15, 1e30}) {
            CAPTURE(unit);
            height_map<double> view = map.view(edge);
            view.height_scale = unit;
            view.texel_size = glm::dvec2(unit);
            const slopes found = baked(view, many_directions(), usual);
            check_within(between(found, expected), 1e-4, 1e-4, 1e-3);
        }
    }
}

TEST_CASE("cascade: all sample types, strides and scales are read alike") {
    const auto map = sampled<float>({40, 33}, [](double x, double y) { return std::fmod(x * 37 + y * 101, 256.0); });
    const list directions = many_directions();
    height_map<float> view = map.view();
    view.texel_size = {20, 20};
    const slopes expected = baked(view, directions, usual);
    const auto check_type = [&]<class Sample>(Sample, double scale, double offset, double factor) {
        std::vector<Sample> samples(33 * 45);
        for (int y = 0; y < 33; ++y)
            for (int x = 0; x < 40; ++x)
                samples[std::size_t(y * 45 + x)] = static_cast<Sample>(double(map.at(x, y)) * factor + offset);
        height_map<Sample> heights = tight_height_map(samples.data(), {40, 33});
        heights.row_stride = 45;
        heights.height_scale = scale;
        heights.datum = offset;
        heights.texel_size = {20, 20};
        check_within(between(baked(heights, directions, usual), expected), 1e-4, 1e-4, 1e-3);
    };
    check_type(std::uint8_t{}, 255.0, 0.0, 1.0);
    check_type(std::uint16_t{}, 65535.0 / 16.0, 0.0, 16.0);
    check_type(float{}, 0.5, 0.0, 2.0);
    check_type(double{}, 1.0, 1e9, 1.0);
}

TEST_CASE("cascade: more steps, less error") {
    const auto map = hard({180, 150}, 16);
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp}) {
        double last = infinity;
        for (const int steps : {1, 4, 8, 16, 32, 64}) {
            CAPTURE(steps);
            const difference d = trial(map.view(edge), many_directions(), with_steps(steps)).against_exact(200);
            CHECK(d.mean < last);
            last = d.mean;
        }
        CHECK(last <= 0.03);
    }
}

// ---- Options ----

TEST_CASE("cascade: occluders beyond the radius do not count") {
    const auto map = hard({150, 120}, 17);
    for (const edge_mode edge : edges)
        for (const double radius : {0.5, 1.0, 3.7, 10.0, 50.0, 200.0}) {
            CAPTURE(int(edge));
            CAPTURE(radius);
            bake_options options = usual;
            options.radius = radius;
            std::vector<double> errors;
            int negative = 0;
            trial(map.view(edge), many_directions(), options)
                .visit(200, [&](std::size_t, glm::ivec2, double found, const horizon_sample& exact) {
                    if (exact.slope == double(no_horizon) || found == double(no_horizon)) return;
                    errors.push_back(std::abs(degrees(found) - degrees(exact.slope)));
                    if (degrees(exact.slope) > -10.0) return;
                    ++negative;
                    CHECK(found < 0.0);
                });
            CHECK((radius > 10.0 || negative > 0));
            check_within(of(errors), 0.2, 2.5, 45.0);
        }
}

TEST_CASE("cascade: relief beyond what floats can hold is refused") {
    auto map = hard<double>({40, 30}, 12);
    slopes values(40 * 30, 7.0f);
    const horizon_map out{.values = values, .extent = map.extent, .bearings = 1};
    const glm::dvec2 direction(1.0, 0.3);
    const auto bake = [&](double height, bool holes) {
        map.at(20, 10) = height;
        height_map<double> view = map.view(edge_mode::clamp);
        if (holes) view.no_data = -12345.0;
        return bake_cascade(view, std::span(&direction, 1), out);
    };
    for (const double height : {1e36, -1e36, 1e300, -1e300}) {
        const status s = bake(height, false);
        CHECK(s.code() == error::out_of_range);
        CHECK(s.value() / height > 0.0);
    }
    CHECK(bake(-1e20, true).code() == error::out_of_range);
    CHECK(std::all_of(values.begin(), values.end(), [](float v) { return v == 7.0f; }));
    for (const double height : {1e34, -1e34}) {
        CHECK(bool(bake(height, false)));
        CHECK(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }));
    }
    CHECK(bool(bake(-1e19, true)));
    CHECK(std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); }));
}

TEST_CASE("cascade: a radius inside the texel's own cell") {
    // There the slope is linear, so that nothing but rounding is left.
    auto map = hard({150, 120}, 17);
    map.at(40, 50) = -1e6f;
    for (const edge_mode edge : edges)
        for (const bool holes : {false, true})
            for (const double radius : {0.5, 0.01, 1e-6, 1e-12}) {
                CAPTURE(int(edge));
                CAPTURE(holes);
                CAPTURE(radius);
                height_map<float> view = map.view(edge);
                if (holes) view.no_data = -1e6f;
                bake_options options = usual;
                options.radius = radius;
                slopes values(required_size(map.extent, 16));
                options.distances = {.values = values, .extent = map.extent, .bearings = 16};
                int far = 0;
                trial(view, shapes::directions(16, 0.01), options)
                    .visit(100, [&](std::size_t i, glm::ivec2 p, double found, const horizon_sample& exact) {
                        if (p.x > 38 && p.x < 42 && p.y > 48 && p.y < 52) return;
                        CHECK(found == doctest::Approx(exact.slope).epsilon(2e-5).scale(1.0));
                        const float distance = options.distances.row(int(i), p.y)[p.x];
                        if (std::isinf(exact.distance)) return;
                        CHECK(double(distance) <= radius * 1.000001);
                        far += distance > 0.0f;
                    });
                CHECK((radius < 0.01 || far > 100));
            }
}

TEST_CASE("cascade: a curved base") {
    const auto map = hard({90, 80}, 18);
    for (const edge_mode edge : edges)
        for (const glm::dvec2 curvature :
             {glm::dvec2(0.001, 0.001), {0.02, 0.0}, {0.1, 0.05}, {-0.01, -0.02}, {-0.1, 0.1}})
            for (const double radius : {infinity, 30.0}) {
                if ((curvature.x < 0.0 || curvature.y < 0.0) && radius == infinity) continue;
                CAPTURE(int(edge));
                CAPTURE(curvature.x);
                CAPTURE(radius);
                bake_options options = usual;
                options.curvature = curvature;
                options.radius = radius;
                check_within(trial(map.view(edge), many_directions(), options).against_exact(100), 0.25, 3.5, 45.0);
            }
    // A flat map on a hollow base rises by k t / 2 as a slope, up to the radius; on a ball nothing is above 0.
    const auto flat = sampled({40, 40}, shapes::plane(0.0));
    bake_options hollow = usual;
    hollow.curvature = {-0.02, 0.005};
    hollow.radius = 57.0;
    const trial t(flat.view(), {{3, 4}, {1, 0}}, hollow);
    check_slope(t, 0, {20, 20}, 0.5 * (0.02 * 0.36 - 0.005 * 0.64) * 57.0, 0.01);
    check_slope(t, 1, {20, 20}, 0.5 * 0.02 * 57.0, 0.01);
    bake_options ball = usual;
    ball.curvature = {0.02, 0.02};
    CHECK(steepest(baked(flat.view(), many_directions(), ball)) <= 1e-6);
}

TEST_CASE("cascade: holes neither occlude nor are shadowed") {
    auto map = hard({120, 100}, 19);
    shapes::noise random(4);
    // Lone texels, and a lake.
    for (int i = 0; i < 120; ++i) {
        const int x = random.between(0, 119);
        map.at(x, random.between(0, 99)) = 500.0f;
    }
    for (int y = 40; y < 60; ++y)
        for (int x = 30; x < 70; ++x) map.at(x, y) = 500.0f;
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        height_map<float> view = map.view(edge);
        view.no_data = 500.0f;
        const trial t(view, many_directions());
        int own = 0;
        t.visit(400, [&](std::size_t, glm::ivec2 p, double found, const horizon_sample&) {
            if (map.at(p.x, p.y) != 500.0f) return;
            ++own;
            CHECK(found == double(no_horizon));
        });
        CHECK(own > 100);
        check_within(t.against_exact(400), 0.15, edge == edge_mode::open ? 2.6 : 2.0, 30.0);
        // NaN marks the same holes.
        auto marked = map;
        for (float& h : marked.samples)
            if (h == 500.0f) h = std::numeric_limits<float>::quiet_NaN();
        height_map<float> nan_view = marked.view(edge);
        nan_view.no_data = std::numeric_limits<float>::quiet_NaN();
        CHECK(baked(nan_view, many_directions(), usual) == baked(view, many_directions(), usual));
    }
}

TEST_CASE("cascade: a cell with a hole in any corner does not occlude") {
    // The texel's two neighbors are higher, but the corner beyond them is a hole; all else is level.
    for (const glm::ivec2 way : {glm::ivec2(1, 1), {-1, 1}, {1, -1}, {-1, -1}}) {
        auto map = sampled<float>({16, 16}, shapes::plane(0.0));
        map.at(5 + way.x, 5) = map.at(5, 5 + way.y) = 3.0f;
        map.at(5 + way.x, 5 + way.y) = -99.0f;
        height_map<float> view = map.view(edge_mode::clamp);
        view.no_data = -99.0f;
        for (const glm::dvec2 d : {glm::dvec2(1, 1), {2, 1}, {1, 2}, {3, 2}, {5, 4}}) {
            CAPTURE(way.x);
            CAPTURE(way.y);
            CAPTURE(d.x);
            const trial t(view, {d * glm::dvec2(way)});
            REQUIRE(exact_horizon(view, {5, 5}, d * glm::dvec2(way)).slope == 0.0);
            check_slope(t, 0, {5, 5}, 0.0, 0.001);
        }
    }
}

TEST_CASE("cascade: distances of the occluders") {
    const auto map = hard({150, 120}, 20);
    const list directions = many_directions();
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        bake_options options = usual;
        slopes values(required_size(map.extent, int(directions.size())));
        options.distances = {.values = values, .extent = map.extent, .bearings = int(directions.size())};
        const trial t(map.view(edge), directions, options);
        CHECK(t.all() == baked(map.view(edge), directions, usual));
        std::vector<double> errors;
        t.visit(300, [&](std::size_t i, glm::ivec2 p, double found, const horizon_sample& exact) {
            const double distance = double(options.distances.row(int(i), p.y)[p.x]);
            CHECK(distance >= 0.0);
            if (found == double(no_horizon)) CHECK(distance == infinity);
            if (degrees(exact.slope) > 5.0)
                errors.push_back(std::abs(distance - exact.distance) / (std::max)(exact.distance, 1.0));
        });
        REQUIRE(errors.size() > 1000);
        std::sort(errors.begin(), errors.end());
        CHECK(errors[errors.size() / 2] <= 0.02);
        CHECK(errors[errors.size() * 9 / 10] <= 0.3);
    }
    // Towards a tall step, in units of 2.5; where the ground is level the horizon is infinitely far.
    const auto step = sampled({100, 40}, shapes::step(60.0, 50.0));
    height_map<double> view = step.view(edge_mode::clamp);
    view.texel_size = {2.5, 2.5};
    slopes values(2 * 4000);
    bake_options options = usual;
    options.distances = {.values = values, .extent = {100, 40}, .bearings = 2};
    (void)baked(view, {{1, 0}, {-1, 0}}, options);
    CHECK(double(options.distances.row(0, 20)[50]) == doctest::Approx(25.0).epsilon(1e-4));
    CHECK(double(options.distances.row(0, 20)[30]) == doctest::Approx(75.0).epsilon(0.05));
    CHECK(options.distances.row(0, 20)[59] <= 2.5f);
    CHECK(options.distances.row(1, 20)[30] == std::numeric_limits<float>::infinity());
}

TEST_CASE("cascade: directions of any length and number") {
    const auto map = hard({50, 40}, 21);
    const list unit = shapes::directions(64, 0.003);
    const slopes expected = baked(map.view(), unit, usual);
    for (const double length : {1e-300, 7.0, 1e300}) {
        list other;
        for (const glm::dvec2 d : unit) other.push_back(d * length);
        const difference d = between(baked(map.view(), other, usual), expected);
        CHECK(d.largest <= 1e-3);
    }
    check_within(trial(map.view(edge_mode::clamp), unit).against_exact(100), 0.2, 2.5, 45.0);
    // As good as along an axis or a diagonal, and right beside them.
    const list beside = {{1, 1e-12}, {1, -1e-7}, {-1e-3, 1}, {1, 1 + 1e-9}, {1 - 1e-7, -1}, {-1, 1e-300}};
    const list on = {{1, 0}, {1, 0}, {0, 1}, {1, 1}, {1, -1}, {-1, 0}};
    check_within(between(baked(map.view(), beside, usual), baked(map.view(), on, usual)), 0.02, 0.3, 2.0);
}

// ---- What has to be the same, bit for bit ----

namespace {

// Texels where a and b differ at all.
int differing(const slopes& a, const slopes& b) {
    REQUIRE(a.size() == b.size());
    int count = 0;
    // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bit for bit
    for (std::size_t i = 0; i < a.size(); ++i) count += std::memcmp(&a[i], &b[i], sizeof(float)) != 0;
    return count;
}

}  // namespace

TEST_CASE("cascade: the result does not depend on the executor or on the other directions") {
    const list directions = {{1, 0}, {1, 1}, {0.3, 1}, {-1, 0.7}, {-0.2, -1}, {0, -1}, {0.9, -0.6}};
    for (const glm::ivec2 extent : {glm::ivec2(70, 257), {75, 41}})
        for (const edge_mode edge : edges) {
            CAPTURE(int(edge));
            const auto map = hard(extent, 22);
            const auto view = map.view(edge);
            const slopes all = baked(view, directions, usual);
            for (const int count : {2, 3, 7})
                CHECK(differing(all, baked(view, directions, usual, threads{count})) == 0);
            CHECK(differing(all, baked(view, directions, usual, executors::backwards{})) == 0);
            CHECK(differing(all, baked(view, directions, usual, executors::unruly{})) == 0);
            const std::size_t slice = required_size(extent, 1);
            for (std::size_t i = 0; i < directions.size(); i += 3) {
                const slopes alone = baked(view, {directions[i]}, usual, threads{int(i % 5) + 1});
                CHECK(differing(alone, slopes(all.begin() + std::ptrdiff_t(i * slice),
                                              all.begin() + std::ptrdiff_t((i + 1) * slice))) == 0);
            }
        }
}

TEST_CASE("cascade: a rectangle alone is what a full bake gives there") {
    // Thirds put lanes where places between texels are rounded in both ways.
    const list directions = {{1, 0}, {1, 1}, {0.3, 1}, {-1, 0.7}, {0, -1}, {1, 3}, {-3, 1}};
    const glm::ivec2 extent(203, 171);
    auto map = hard(extent, 23);
    map.at(60, 70) = -1000.0f;
    const rectangle regions[] = {{{0, 0}, {1, 1}},    {{202, 170}, {1, 1}},  {{101, 83}, {1, 1}},
                                 {{13, 7}, {31, 20}}, {{0, 77}, {203, 5}},   {{0, 0}, {203, 64}},
                                 {{57, 0}, {3, 171}}, {{37, 51}, {129, 66}}, {{1, 1}, {202, 170}}};
    for (const edge_mode edge : edges)
        for (const int variant : {0, 1, 2}) {
            CAPTURE(int(edge));
            CAPTURE(variant);
            height_map<float> view = map.view(edge);
            bake_options options = usual;
            if (variant == 1) view.no_data = -1000.0f;
            if (variant == 2) options.radius = 23.3, options.curvature = {-0.01, 0.02};
            const auto count = int(directions.size());
            slopes far(required_size(extent, count));
            options.distances = {.values = far, .extent = extent, .bearings = count};
            const slopes all = baked(view, directions, options);
            for (const rectangle region : regions) {
                CAPTURE(region.origin.x);
                CAPTURE(region.extent.x);
                slopes part_far(required_size(region.extent, count));
                options.region = region;
                options.distances = {.values = part_far, .extent = region.extent, .bearings = count};
                const slopes part = baked(view, directions, options, threads{region.extent.x % 3 + 1});
                options.distances = {};
                const slopes plain = baked(view, directions, options);
                int wrong = 0;
                std::size_t next = 0;
                for (std::size_t i = 0; i < directions.size(); ++i)
                    for (int y = region.origin.y; y < region.origin.y + region.extent.y; ++y)
                        for (int x = region.origin.x; x < region.origin.x + region.extent.x; ++x, ++next) {
                            const std::size_t at = (i * 171 + std::size_t(y)) * 203 + std::size_t(x);
                            wrong += part[next] != all[at] || plain[next] != all[at] || part_far[next] != far[at];
                        }
                CHECK(wrong == 0);
            }
        }
}

TEST_CASE("cascade: rectangles with rays that pass through thirds of texels") {
    // Their places between cells lie where rounding goes either way, and fall on the cells themselves now and then.
    const glm::ivec2 extent(148, 196);
    const auto map = hard(extent, 32);
    const list directions = {{1, 3}, {-3, 1}, {3, 2}, {-2, 3}};
    shapes::noise random(5);
    bake_options options = with_steps(1);
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        options.region = {};
        const slopes all = baked(map.view(edge), directions, options);
        int wrong = 0;
        for (int n = 0; n < 30; ++n) {
            const int left = random.between(0, extent.x - 1);
            const glm::ivec2 origin(left, random.between(0, extent.y - 1));
            options.region = {origin, extent - origin};
            const slopes part = baked(map.view(edge), directions, options);
            std::size_t next = 0;
            for (std::size_t i = 0; i < directions.size(); ++i)
                for (int y = origin.y; y < extent.y; ++y)
                    for (int x = origin.x; x < extent.x; ++x, ++next)
                        wrong += part[next] != all[(i * 196 + std::size_t(y)) * 148 + std::size_t(x)];
        }
        CHECK(wrong == 0);
    }
}

TEST_CASE("cascade: only the texels of a strided output are written") {
    const auto map = hard({37, 19}, 24);
    const list directions = {{1.0, 0.2}, {0.1, -1.0}};
    const slopes tight = baked(map.view(), directions, usual);
    slopes loose(2 * 1000, -7.0f), far(2 * 1000, -7.0f);
    bake_options options = usual;
    options.distances = {.values = far, .extent = {37, 19}, .bearings = 2, .row_stride = 41, .slice_stride = 1000};
    const horizon_map out{.values = loose, .extent = {37, 19}, .bearings = 2, .row_stride = 41, .slice_stride = 1000};
    REQUIRE(bool(bake_cascade(map.view(), directions, out, options)));
    int wrong = 0;
    for (std::size_t i = 0; i < loose.size(); ++i) {
        const std::size_t b = i / 1000, y = i % 1000 / 41, x = i % 1000 % 41;
        const bool inside = x < 37 && y < 19;
        wrong += loose[i] != (inside ? tight[(b * 19 + y) * 37 + x] : -7.0f);
        wrong += inside != (far[i] != -7.0f);
    }
    CHECK(wrong == 0);
}

// ---- Symmetries ----

TEST_CASE("cascade: transposing, mirroring and turning the map permutes its horizons") {
    // Sides that can be halved often: others are not divided into cells alike from both ends.
    const glm::ivec2 n(128, 64);
    const auto map = hard(n, 25);
    const list directions = many_directions();
    list across, aside, around;
    for (const glm::dvec2 d : directions) {
        across.emplace_back(d.y, d.x);
        aside.emplace_back(-d.x, d.y);
        around.emplace_back(-d.y, d.x);
    }
    const auto at = [](const field<float>& f, int x, int y) { return double(f.at(x, y)); };
    const auto transposed = sampled<float>({n.y, n.x}, [&](double x, double y) { return at(map, int(y), int(x)); });
    const auto mirrored = sampled<float>(n, [&](double x, double y) { return at(map, n.x - 1 - int(x), int(y)); });
    const auto turned =  // a quarter from +x towards +y
        sampled<float>({n.y, n.x}, [&](double x, double y) { return at(map, int(y), n.y - 1 - int(x)); });
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        const slopes values = baked(map.view(edge), directions, usual);
        const slopes a = baked(transposed.view(edge), across, usual), b = baked(mirrored.view(edge), aside, usual),
                     c = baked(turned.view(edge), around, usual);
        slopes from_a, from_b, from_c;
        for (int i = 0; i < int(directions.size()); ++i)
            for (int y = 0; y < n.y; ++y)
                for (int x = 0; x < n.x; ++x) {
                    const auto slice = std::size_t(i * n.x * n.y);
                    from_a.push_back(a[slice + std::size_t(x * n.y + y)]);
                    from_b.push_back(b[slice + std::size_t(y * n.x + n.x - 1 - x)]);
                    from_c.push_back(c[slice + std::size_t(x * n.y + n.y - 1 - y)]);
                }
        check_within(between(from_a, values), 1e-4, 1e-4, 1e-2);
        check_within(between(from_b, values), 1e-4, 1e-4, 1e-2);
        check_within(between(from_c, values), 1e-4, 1e-4, 1e-2);
    }
}

TEST_CASE("cascade: a shifted tiling map shifts its horizons") {
    const glm::ivec2 n(128, 128);
    const auto map = hard(n, 26);
    const list directions = many_directions();
    const slopes before = baked(map.view(), directions, usual);
    const auto shifted_back = [&](glm::ivec2 by) {
        const auto shifted = sampled<float>(n, [&](double x, double y) {
            return double(map.at((int(x) - by.x + n.x) % n.x, (int(y) - by.y + n.y) % n.y));
        });
        const slopes after = baked(shifted.view(), directions, usual);
        slopes back;
        for (int i = 0; i < int(directions.size()); ++i)
            for (int y = 0; y < n.y; ++y)
                for (int x = 0; x < n.x; ++x)
                    back.push_back(after[std::size_t((i * n.y + (y + by.y) % n.y) * n.x + (x + by.x) % n.x)]);
        return back;
    };
    // By whole cells of the coarsest level these are the same, but not where lanes stand between them.
    for (const glm::ivec2 by : {glm::ivec2(64, 0), {32, 96}})
        check_within(between(shifted_back(by), before), 0.02, 0.4, 5.0);
    // By anything else: cells are cut in other places, which is one more error of the size that there is anyway.
    for (const glm::ivec2 by : {glm::ivec2(1, 0), {5, 3}, {17, 100}})
        check_within(between(shifted_back(by), before), 0.06, 0.8, 20.0);
}

TEST_CASE("cascade: only differences of heights matter") {
    // Sums with 2^24 are exact.
    const auto smooth = hard<double>({90, 70}, 27);
    const auto map = sampled<double>(smooth.extent, [&](double x, double y) {
        return std::round(smooth.at(int(x), int(y)) * 1048576.0) / 1048576.0;
    });
    const list directions = many_directions();
    const auto raised =
        sampled<double>(map.extent, [&](double x, double y) { return map.at(int(x), int(y)) + 16777216.0; });
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        const slopes expected = baked(map.view(edge), directions, usual);
        CHECK(differing(baked(raised.view(edge), directions, usual), expected) == 0);
        height_map<double> named = raised.view(edge);
        named.datum = 16777216.0;
        CHECK(differing(baked(named, directions, usual), expected) == 0);
    }
}

TEST_CASE("cascade: twice the heights, twice the slopes") {
    const auto map = hard({90, 70}, 28);
    const list directions = many_directions();
    for (const edge_mode edge : edges) {
        CAPTURE(int(edge));
        slopes expected = baked(map.view(edge), directions, usual);
        for (float& s : expected)
            if (s != no_horizon) s *= 2.0f;
        height_map<float> scaled = map.view(edge);
        scaled.height_scale = 2.0;
        CHECK(differing(baked(scaled, directions, usual), expected) == 0);
    }
}

// ---- Memory and errors ----

TEST_CASE("cascade: scratch") {
    const list directions = many_directions();
    const threads three(3);
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {3, 5}, {100, 70}, {203, 171}})
        for (const edge_mode edge : edges) {
            CAPTURE(extent.x);
            CAPTURE(int(edge));
            const auto map = hard(extent, 29);
            const auto view = map.view(edge);
            const slopes expected = baked(view, directions, usual);
            bake_options options = usual;
            for (const int concurrency : {1, 3}) {
                const std::size_t size = cascade_scratch_size(view, usual, concurrency);
                // Any place in memory will do.
                std::vector<std::byte> scratch(size + 7, std::byte(0xa5));
                options.scratch = std::span(scratch).subspan(7, size);
                CHECK(differing(
                          concurrency == 1 ? baked(view, directions, options) : baked(view, directions, options, three),
                          expected) == 0);
                options.scratch = std::span(scratch).subspan(0, size - 1);
                slopes values(expected.size(), -7.0f);
                const horizon_map out{.values = values, .extent = extent, .bearings = int(directions.size())};
                const status s = concurrency == 1 ? bake_cascade(view, directions, out, options)
                                                  : bake_cascade(view, directions, out, options, three);
                CHECK(s.code() == error::too_small);
                CHECK(std::string(s.argument()) == "options.scratch");
                CHECK(s.value() == double(size - 1));
                CHECK(s.limit() == double(size));
                CHECK(std::count(values.begin(), values.end(), -7.0f) == std::ptrdiff_t(values.size()));
            }
        }
}

TEST_CASE("cascade: memory comes from the resource in one block that grows with the map, not with the directions") {
    std::size_t peak[3];
    int i = 0;
    for (const int count : {4, 32}) {
        const auto map = hard({256, 256}, 30);
        counting memory;
        bake_options options = usual;
        options.memory = &memory;
        (void)baked(map.view(), shapes::directions(count), options);
        CHECK(memory.calls == 1);
        CHECK(memory.out == 0);
        peak[i++] = memory.most;
    }
    CHECK(peak[0] == peak[1]);
    CHECK(peak[0] <= cascade_scratch_size(hard({256, 256}, 30).view(), usual));
    CHECK(peak[0] <= 256 * 256 * 100);

    counting none(0);
    const auto map = hard({30, 30}, 31);
    bake_options options = usual;
    options.memory = &none;
    slopes values(900, -7.0f);
    const glm::dvec2 direction(1, 0);
    const status s = bake_cascade(map.view(), std::span(&direction, 1),
                                  horizon_map{.values = values, .extent = {30, 30}, .bearings = 1}, options);
    CHECK(s.code() == error::out_of_memory);
    CHECK(s.value() > 900.0 * 4.0);
    CHECK(std::count(values.begin(), values.end(), -7.0f) == 900);
}

TEST_CASE("cascade: bad input is named, and nothing is written") {
    struct call {
        field<float> map = sampled<float>({6, 4}, shapes::waves({6, 4}));
        height_map<float> heights = map.view();
        list directions = shapes::directions(3);
        slopes values = slopes(72, -7.0f);
        slopes far = slopes(72, -7.0f);
        horizon_map out{.values = values, .extent = {6, 4}, .bearings = 3};
        bake_options options = {};
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    // change: makes one thing wrong; what the message has to say
    const auto refused = [](error code, const char* name, const char* value, auto&& change) {
        call c;
        c.options.distances = {.values = c.far, .extent = {6, 4}, .bearings = 3};
        change(c);
        const status s = bake_cascade(c.heights, c.directions, c.out, c.options);
        const status_text message = s.message();
        const std::string text = message.c_str();
        CAPTURE(text);
        CHECK(s.code() == code);
        CHECK(text.find(name) != std::string::npos);
        CHECK(text.find(value) != std::string::npos);
        CHECK(std::count(c.values.begin(), c.values.end(), -7.0f) == std::ptrdiff_t(c.values.size()));
        CHECK(std::count(c.far.begin(), c.far.end(), -7.0f) == std::ptrdiff_t(c.far.size()));
    };
    refused(error::missing, "heights.samples", "", [](call& c) { c.heights.samples = nullptr; });
    refused(error::not_positive, "heights.extent.x", "0", [](call& c) { c.heights.extent.x = 0; });
    refused(error::not_positive, "heights.extent.y", "-4", [](call& c) { c.heights.extent.y = -4; });
    refused(error::too_small, "row_stride", "5", [](call& c) { c.heights.row_stride = 5; });
    refused(error::not_finite, "height_scale", "nan", [=](call& c) { c.heights.height_scale = nan; });
    refused(error::not_finite, "datum", "inf", [](call& c) { c.heights.datum = infinity; });
    refused(error::not_positive, "texel_size.x", "0", [](call& c) { c.heights.texel_size.x = 0.0; });
    refused(error::not_positive, "texel_size.y", "-2", [](call& c) { c.heights.texel_size.y = -2.0; });
    refused(error::not_finite, "texel_size.y", "inf", [](call& c) { c.heights.texel_size.y = infinity; });
    refused(error::not_finite, "height", "nan at texel (2, 1)", [=](call& c) { c.map.at(2, 1) = float(nan); });
    refused(error::not_finite, "height", "inf", [](call& c) { c.map.at(5, 3) = float(infinity); });
    refused(error::not_positive, "bearings", "0", [](call& c) { c.directions.clear(); });
    refused(error::not_positive, "direction", "0", [](call& c) { c.directions[1] = {0.0, -0.0}; });
    refused(error::not_finite, "direction", "nan", [=](call& c) { c.directions[2].y = nan; });
    refused(error::not_finite, "direction", "inf", [](call& c) { c.directions[0].x = infinity; });
    refused(error::not_positive, "steps", "0", [](call& c) { c.options.steps = 0; });
    refused(error::not_positive, "steps", "-8", [](call& c) { c.options.steps = -8; });
    refused(error::not_positive, "radius", "0", [](call& c) { c.options.radius = 0.0; });
    refused(error::not_positive, "radius", "-3", [](call& c) { c.options.radius = -3.0; });
    refused(error::not_positive, "radius", "nan", [=](call& c) { c.options.radius = nan; });
    refused(error::not_finite, "curvature.x", "inf", [](call& c) { c.options.curvature.x = infinity; });
    refused(error::not_finite, "curvature.y", "nan", [=](call& c) { c.options.curvature.y = nan; });
    refused(error::out_of_range, "curvature", "-0.25", [](call& c) { c.options.curvature = {-0.25, 0.0}; });
    refused(error::out_of_range, "region.origin.x", "-1", [](call& c) { c.options.region = {{-1, 0}, {6, 4}}; });
    refused(error::out_of_range, "region.origin.y", "2", [](call& c) { c.options.region = {{0, 2}, {6, 4}}; });
    refused(error::mismatch, "output extent.x", "5", [](call& c) { c.out.extent.x = 5; });
    refused(error::mismatch, "output extent.y", "6", [](call& c) { c.out.extent.y = 6; });
    refused(error::mismatch, "output bearings", "4", [](call& c) { c.out.bearings = 4; });
    refused(error::too_small, "output size", "71", [](call& c) { c.out.values = c.out.values.first(71); });
    refused(error::too_small, "output row_stride", "5", [](call& c) { c.out.row_stride = 5; });
    refused(error::too_small, "output slice_stride", "20", [](call& c) { c.out.slice_stride = 20; });
    refused(error::too_small, "output size", "70",
            [](call& c) { c.options.distances.values = c.options.distances.values.first(70); });
    refused(error::too_small, "options.scratch", "1", [](call& c) {
        static std::byte one;
        c.options.scratch = {&one, 1};
    });
}

TEST_SUITE_END();

TEST_CASE("cascade: what a change of heights influences, and nothing else") {
    const glm::ivec2 n(180, 140);
    const auto before = hard(n, 31);
    const rectangle changed{{70, 60}, {9, 4}};
    auto after = before;
    for (int y = 0; y < changed.extent.y; ++y)
        for (int x = 0; x < changed.extent.x; ++x)
            after.samples[std::size_t((changed.origin.y + y) * n.x + changed.origin.x + x)] += 9.0f;
    const list directions = many_directions();
    for (const edge_mode edge : edges)
        for (const double radius : {0.7, 5.0, 16.0, 45.0}) {
            CAPTURE(int(edge));
            CAPTURE(radius);
            bake_options options = usual;
            options.radius = radius;
            const rectangle again = influence(before.view(edge), changed, options);
            CHECK(again.extent.x < n.x);
            const slopes old_ones = baked(before.view(edge), directions, options);
            const slopes new_ones = baked(after.view(edge), directions, options);
            int outside = 0, inside = 0;
            for (std::size_t i = 0; i < old_ones.size(); ++i) {
                const int x = int(i) % n.x, y = int(i) / n.x % n.y;
                const bool within = x >= again.origin.x && x < again.origin.x + again.extent.x && y >= again.origin.y &&
                                    y < again.origin.y + again.extent.y;
                (within ? inside : outside) += old_ones[i] != new_ones[i];
            }
            CHECK(outside == 0);
            CHECK(inside > 0);
        }
    CHECK(influence(before.view(), changed, usual).extent == n);
    // All heights are rounded above that of the first texel, or of the first that is no hole.
    bake_options near = usual;
    near.radius = 5.0;
    CHECK(influence(before.view(), {{0, 0}, {3, 3}}, near).extent == n);
    CHECK(influence(before.view(edge_mode::clamp), {{1, 0}, {3, 3}}, near).extent.x < n.x);
    height_map<float> holed = before.view(edge_mode::clamp);
    holed.no_data = before.at(0, 0);
    CHECK(reference_texel(holed) == glm::ivec2(1, 0));
    CHECK(influence(holed, {{1, 0}, {3, 3}}, near).extent == n);
    holed.extent = {1, 1};
    CHECK(reference_texel(holed) == glm::ivec2(-1, -1));
    CHECK(influence(holed, {{0, 0}, {1, 1}}, near).extent == glm::ivec2(1, 1));
}
