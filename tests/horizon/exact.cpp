#include <bumpshadow/horizon/exact.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <doctest/doctest.h>

#include "support/shapes.hpp"

using namespace bumpshadow;
using shapes::field;
using shapes::sampled;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double pi = 3.14159265358979323846;
constexpr std::array edges{edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open};
const double root2 = std::sqrt(2.0);

bool near(double a, double b, double tolerance = 1e-12) { return std::abs(a - b) <= tolerance; }

bool absent(const horizon_sample& h) { return h.slope == double(no_horizon) && h.distance == infinity; }

// The bilinear surface at a point, written from the definition and without regard to speed; NaN where there is none.
template <height_sample Sample>
double surface(const height_map<Sample>& map, double x, double y) {
    const auto texel = [&](double column, double row) {
        double at[2] = {column, row};
        const double count[2] = {double(map.extent.x), double(map.extent.y)};
        for (int k = 0; k < 2; ++k) {
            if (map.edge == edge_mode::open && (at[k] < 0.0 || at[k] >= count[k])) return std::nan("");
            if (map.edge == edge_mode::clamp) at[k] = std::fmin(std::fmax(at[k], 0.0), count[k] - 1.0);
            if (map.edge == edge_mode::repeat) at[k] -= count[k] * std::floor(at[k] / count[k]);
            if (map.edge == edge_mode::mirror) {
                at[k] -= 2.0 * count[k] * std::floor(at[k] / (2.0 * count[k]));
                if (at[k] >= count[k]) at[k] = 2.0 * count[k] - 1.0 - at[k];
            }
        }
        const Sample sample = map.samples[std::ptrdiff_t(at[1]) * map.row_stride + std::ptrdiff_t(at[0])];
        if (map.no_data && (sample == *map.no_data || (sample != sample && *map.no_data != *map.no_data)))
            return std::nan("");
        const double full = std::is_integral_v<Sample> ? double(std::numeric_limits<Sample>::max()) : 1.0;
        return double(sample) / full * map.height_scale;
    };
    const double x0 = std::floor(x), y0 = std::floor(y), u = x - x0, v = y - y0;
    const double upper = u == 0.0 ? texel(x0, y0) : texel(x0, y0) * (1.0 - u) + texel(x0 + 1.0, y0) * u;
    if (v == 0.0) return upper;
    const double under =
        u == 0.0 ? texel(x0, y0 + 1.0) : texel(x0, y0 + 1.0) * (1.0 - u) + texel(x0 + 1.0, y0 + 1.0) * u;
    return upper * (1.0 - v) + under * v;
}

// Dense sampling of the definition: 256 points a texel, then 64 times denser about every point that may be near the
// top. The true horizon is at least as high, and at most `slack` higher.
struct sampled_horizon {
    double slope = -infinity;
    double slack = 0.0;
};

template <height_sample Sample>
sampled_horizon brute_force(const height_map<Sample>& map, glm::ivec2 texel, glm::dvec2 direction, double radius,
                            glm::dvec2 curvature, double range) {
    const double length = std::hypot(direction.x, direction.y);
    const glm::dvec2 d(direction.x / length, direction.y / length);
    const double k = curvature.x * d.x * d.x + curvature.y * d.y * d.y;
    const double own = surface(map, texel.x, texel.y);
    const auto slope = [&](double t) {
        const double h = surface(map, texel.x + t * d.x / map.texel_size.x, texel.y + t * d.y / map.texel_size.y);
        return (h - 0.5 * k * t * t - own) / t;
    };
    const double size = std::fmin(map.texel_size.x, map.texel_size.y);
    const double last = std::fmin(radius, 40.0 * size), step = size / 256.0;
    // Odd multiples of half a step: never on a corner that a ray passes through, where a hole may be.
    std::vector<double> slopes;
    for (double t = 0.5 * step; t < last; t += step) slopes.push_back(slope(t));
    sampled_horizon result;
    for (const double s : slopes)
        if (s > result.slope) result.slope = s;
    const double at_end = slope(last);
    if (at_end > result.slope) result.slope = at_end;

    // The slope of the line to the surface changes by at most (gradient + |slope|) / t for t beyond the first cell and
    // by the twist of the cell within it; all of that is below `steepness`.
    const double steepness = 4.0 * range / (size * size) + std::abs(k);
    const double coarse = result.slope - steepness * step;
    for (std::size_t n = 0; n < slopes.size(); ++n) {
        if (!(slopes[n] >= coarse) && slopes[n] == slopes[n]) continue;
        for (int m = -32; m <= 32; ++m) {
            const double t = (double(n) + 0.5 + (m + 0.5) / 64.0) * step;
            const double s = t > 0.0 && t <= last ? slope(t) : result.slope;
            if (s > result.slope) result.slope = s;
        }
    }
    result.slack = steepness * step / 64.0 + 1e-12;
    if (radius > last) {
        // Beyond the samples nothing is higher than this.
        const double far = range / last - (k > 0.0 ? 0.5 * k * last : 0.0);
        if (far > result.slope) result.slack += far - result.slope;
        if (horizon_is_never_negative(map.edge, radius, k) && result.slope < 0.0) result.slope = 0.0;
    }
    return result;
}

template <height_sample Sample>
std::vector<float> baked(const height_map<Sample>& map, std::span<const glm::dvec2> directions,
                         bake_options options = {}) {
    const glm::ivec2 extent = region_or_all(options.region, map.extent).extent;
    std::vector<float> values(required_size(extent, int(directions.size())));
    const horizon_map out{.values = values, .extent = extent, .bearings = int(directions.size())};
    REQUIRE(bool(bake_exact(map, directions, out, options)));
    return values;
}

}  // namespace

TEST_SUITE_BEGIN("exact");

TEST_CASE("a plane has horizon 0") {
    const auto flat = sampled({7, 5}, shapes::plane(3.0));
    for (const edge_mode edge : edges) {
        for (const glm::dvec2 d : shapes::directions(16)) {
            const horizon_sample h = exact_horizon(flat.view(edge), {3, 2}, d);
            CHECK(h.slope == 0.0);
            CHECK(h.distance == (edge == edge_mode::open ? 0.0 : infinity));
            const horizon_sample cut = exact_horizon(flat.view(edge), {3, 2}, d, 1.5);
            CHECK(cut.slope == 0.0);
            CHECK(cut.distance == 0.0);
        }
    }
}

TEST_CASE("a ramp keeps its slope uphill, and downhill where the map ends") {
    const glm::dvec2 gradient(0.5, -0.25);
    const auto ramp = sampled({9, 8}, shapes::ramp(gradient));
    for (const glm::dvec2 d : shapes::directions(24, 0.01)) {
        const double along = gradient.x * d.x + gradient.y * d.y;
        const horizon_sample open = exact_horizon(ramp.view(edge_mode::open), {4, 4}, d);
        CHECK(near(open.slope, along));
        CHECK(open.distance == 0.0);
    }
    const auto clamped = ramp.view(edge_mode::clamp);
    CHECK(exact_horizon(clamped, {4, 4}, {1, 0}).slope == 0.5);
    CHECK(exact_horizon(clamped, {4, 4}, {1, 0}).distance == 0.0);
    // Downhill: 4 texels to the border, 2 lower, level from there on.
    CHECK(exact_horizon(clamped, {4, 4}, {-1, 0}).slope == 0.0);
    CHECK(exact_horizon(clamped, {4, 4}, {-1, 0}).distance == infinity);
    CHECK(exact_horizon(clamped, {4, 4}, {-1, 0}, 3.0).slope == -0.5);
    CHECK(near(exact_horizon(clamped, {4, 4}, {-1, 0}, 10.0).slope, -0.2));
    CHECK(near(exact_horizon(clamped, {4, 4}, {-1, 0}, 10.0).distance, 10.0));
}

TEST_CASE("the edge of a step is the horizon below it") {
    const auto map = sampled({20, 20}, shapes::step(12.0, 3.0));
    for (const double angle : {-60.0, -30.0, 0.0, 20.0, 45.0, 50.0}) {
        const double c = std::cos(angle * pi / 180.0), s = std::sin(angle * pi / 180.0);
        for (int x = 5; x < 11; ++x) {
            const horizon_sample h = exact_horizon(map.view(edge_mode::clamp), {x, 10}, {c, s});
            CHECK(near(h.slope, 3.0 * c / (12 - x)));
            CHECK(near(h.distance, (12 - x) / c, 1e-9));
        }
        CHECK(near(exact_horizon(map.view(edge_mode::clamp), {11, 10}, {c, s}).slope, 3.0 * c));
        CHECK(exact_horizon(map.view(edge_mode::clamp), {11, 10}, {c, s}).distance == 0.0);
        CHECK(exact_horizon(map.view(edge_mode::clamp), {12, 10}, {c, s}).slope == 0.0);
    }
}

TEST_CASE("a spike is a bilinear tent") {
    const auto map = sampled({17, 17}, shapes::spike({8, 8}, 1.0));
    const auto view = map.view(edge_mode::clamp);
    CHECK(exact_horizon(view, {3, 8}, {1, 0}).slope == 0.2);
    CHECK(exact_horizon(view, {3, 8}, {1, 0}).distance == 5.0);
    CHECK(exact_horizon(view, {8, 3}, {0, 4}).slope == 0.2);
    CHECK(exact_horizon(view, {7, 8}, {1, 0}).slope == 1.0);
    CHECK(exact_horizon(view, {7, 8}, {1, 0}).distance == 0.0);
    CHECK(exact_horizon(view, {8, 8}, {1, 0}).slope == 0.0);
    CHECK(exact_horizon(view, {3, 7}, {1, 0}).slope == 0.0);
    // Through the corners: 3 diagonals away.
    CHECK(near(exact_horizon(view, {5, 5}, {1, 1}).slope, 1.0 / (3.0 * root2)));
    CHECK(near(exact_horizon(view, {5, 5}, {1, 1}).distance, 3.0 * root2));
    CHECK(near(exact_horizon(view, {11, 5}, {-1, 1}).slope, 1.0 / (3.0 * root2)));
    // s texels along x on the line y = 8 + s / 10 the tent is (s - 4) (1 - s / 10) high, and highest over s at s = 5.
    CHECK(near(exact_horizon(view, {3, 8}, {10, 1}).slope, 0.1 / std::sqrt(1.01)));
    CHECK(near(exact_horizon(view, {3, 8}, {10, 1}).distance, 5.0 * std::sqrt(1.01)));
    // On y = 8 + s / 5 it is (s - 4) (1 - s / 5): over s that is 1.8 - 4 / s - s / 5, highest inside the cell at
    // sqrt(20).
    CHECK(near(exact_horizon(view, {3, 8}, {5, 1}).slope, (1.8 - 2.0 * std::sqrt(0.8)) / std::sqrt(1.04)));
    CHECK(near(exact_horizon(view, {3, 8}, {5, 1}).distance, std::sqrt(20.0 * 1.04)));
}

TEST_CASE("a cone and its tip") {
    const glm::dvec2 center(24, 24);
    const double height = 8.0, gradient = 0.8;
    const auto map = sampled({49, 49}, shapes::cone(center, height, gradient));
    const auto view = map.view(edge_mode::clamp);
    // The tip stands on a texel, and towards it the slope only grows.
    for (const glm::ivec2 p : {glm::ivec2(4, 24), {24, 1}, {4, 4}, {44, 4}, {2, 35}, {9, 3}}) {
        const glm::dvec2 to_tip(center.x - p.x, center.y - p.y);
        const double away = std::hypot(to_tip.x, to_tip.y);
        CHECK(near(exact_horizon(view, p, to_tip).slope, height / away));
        CHECK(near(exact_horizon(view, p, to_tip).distance, away, 1e-9));
    }
    // On its flank, along a grid line through the tip.
    CHECK(near(exact_horizon(view, {18, 24}, {1, 0}).slope, gradient));
    CHECK(near(exact_horizon(view, {18, 24}, {-1, 0}).slope, 0.0));
    // Elsewhere against the smooth cone. It changes by at most `gradient` a texel and a corner of a cell is at most
    // sqrt(1/2) texel away from its middle, so the bilinear surface differs by less than gradient * sqrt(1/2).
    for (const glm::ivec2 p : {glm::ivec2(4, 24), {3, 9}, {24, 46}}) {
        const double to_foot = std::hypot(center.x - p.x, center.y - p.y) - height / gradient;
        for (const glm::dvec2 d : shapes::directions(64)) {
            double smooth = 0.0;
            for (double t = 0.01; t < 60.0; t += 0.01)
                smooth = std::fmax(smooth, shapes::cone(center, height, gradient)(p.x + t * d.x, p.y + t * d.y) / t);
            CHECK(near(exact_horizon(view, p, d).slope, smooth, gradient * std::sqrt(0.5) / (to_foot - 1.5)));
        }
    }
}

TEST_CASE("a hemisphere is seen along its tangent") {
    const glm::dvec2 center(60, 60);
    const double radius = 30.0;
    const auto map = sampled({121, 121}, shapes::hemisphere(center, radius));
    for (const glm::ivec2 p : {glm::ivec2(5, 60), {60, 118}, {20, 8}, {110, 20}}) {
        const glm::dvec2 to_center(center.x - p.x, center.y - p.y);
        const double away = std::hypot(to_center.x, to_center.y);
        const double smooth = radius / std::sqrt(away * away - radius * radius);
        // The tangent point: `foot` from p on the ground, `top` high. A concave surface lies above its bilinear copy,
        // by at most an eighth of its two second derivatives, which are no larger than radius^2 / height^3 a texel
        // nearer to p.
        const double foot = away - radius * radius / away;
        const double across = radius * radius / away + 1.5;
        const double top = std::sqrt(radius * radius - across * across);
        const double bound = 0.25 * radius * radius / (top * top * top) / foot;
        const horizon_sample h = exact_horizon(map.view(edge_mode::clamp), p, to_center);
        CHECK(h.slope <= smooth + 1e-12);
        CHECK(h.slope >= smooth - bound);
        CHECK(near(h.distance, foot, 2.0));
    }
}

TEST_CASE("a V groove is seen from its bottom and across") {
    const auto map = sampled({21, 9}, shapes::v_groove(8.0, 0.75));
    const auto view = map.view(edge_mode::clamp);
    for (const glm::dvec2 d : shapes::directions(32)) {
        CHECK(near(exact_horizon(view, {8, 4}, d).slope, 0.75 * std::abs(d.x)));
        CHECK(exact_horizon(view, {8, 4}, d).distance == (d.x == 0.0 ? infinity : 0.0));
    }
    // From 3 texels up the near wall over to the rim of the far one, 12 texels from the bottom.
    CHECK(near(exact_horizon(view, {5, 4}, {1, 0}).slope, 0.75 * (12.0 - 3.0) / 15.0));
    CHECK(exact_horizon(view, {5, 4}, {1, 0}).distance == 15.0);
    CHECK(near(exact_horizon(view, {5, 4}, {-1, 0}).slope, 0.75));
}

TEST_CASE("a 45-degree hill at diagonal bearings") {
    const auto map = sampled({40, 40}, shapes::diagonal_hill(40.0, 5.0));
    const auto view = map.view(edge_mode::open);
    const glm::dvec2 uphill(std::sqrt(0.5), std::sqrt(0.5));
    // Crest at x + y = 40; its foot is 5 units before, at x + y = 32.9.
    for (int x = 2; x < 12; x += 2) {
        const double to_crest = (40.0 - 2.0 * x) / root2;
        CHECK(near(exact_horizon(view, {x, x}, uphill).slope, 5.0 / to_crest));
        CHECK(near(exact_horizon(view, {x, x}, uphill).distance, to_crest, 1e-9));
    }
    for (const glm::ivec2 p : {glm::ivec2(17, 17), {18, 18}, {10, 24}, {25, 11}, {19, 19}}) {
        CHECK(near(exact_horizon(view, p, uphill).slope, 1.0));
        // Along the slope's contour nothing rises; down it, the map is open and it goes on falling.
        CHECK(near(exact_horizon(view, p, {1, -1}).slope, 0.0));
    }
    CHECK(near(exact_horizon(view, {23, 23}, {-1, -1}).slope, 1.0));
    CHECK(near(exact_horizon(view, {18, 18}, {-1, -1}, root2).slope, -1.0));
}

TEST_CASE("curvature lets the base fall away") {
    const auto flat = sampled({6, 6}, shapes::plane(0.0));
    for (const edge_mode edge : edges) {
        CHECK(exact_horizon(flat.view(edge), {2, 2}, {1, 0}, infinity, {0.1, 0.1}).slope == 0.0);
        CHECK(exact_horizon(flat.view(edge), {2, 2}, {1, 0}, infinity, {0.1, 0.1}).distance == 0.0);
        CHECK(exact_horizon(flat.view(edge), {2, 2}, {1, 2}, 1.5, {0.1, 0.0}).slope == 0.0);
    }
    // A hollow base rises by k t / 2 as a slope, up to the radius.
    const horizon_sample hollow = exact_horizon(flat.view(), {2, 2}, {3, 4}, 1000.0, {-0.1, 0.05});
    const double k = -0.1 * 0.36 + 0.05 * 0.64;
    CHECK(near(hollow.slope, -0.5 * k * 1000.0, 1e-9));
    CHECK(near(hollow.distance, 1000.0, 1e-9));

    // A bump of height 1, 5 texels away on a cylinder: its top is seen at 1/5 - 5 k / 2 as long as the tent rises
    // faster than the base falls, that is for (t - 4) / t - k t / 2 growing up to t = 5, or k < 8 / 25.
    const auto bump = sampled({17, 17}, shapes::spike({8, 8}, 1.0));
    const auto view = bump.view(edge_mode::clamp);
    CHECK(near(exact_horizon(view, {3, 8}, {1, 0}, infinity, {0.04, 0.0}).slope, 0.1));
    CHECK(near(exact_horizon(view, {3, 8}, {1, 0}, infinity, {0.04, 0.0}).distance, 5.0));
    CHECK(near(exact_horizon(view, {8, 3}, {0, 1}, infinity, {0.04, 0.0}).slope, 0.2));
    CHECK(near(exact_horizon(view, {5, 5}, {1, 1}, infinity, {0.04, 0.0}).slope,
               1.0 / (3.0 * root2) - 0.01 * 3.0 * root2));
    CHECK(exact_horizon(view, {3, 8}, {1, 0}, infinity, {0.4, 0.0}).slope == 0.0);
    // From the bump down to its foot the slope is -1; the plane beyond is -1/t - k t / 2, highest at t = sqrt(2 / k).
    const horizon_sample down = exact_horizon(view, {8, 8}, {1, 0}, infinity, {0.02, 0.0});
    CHECK(near(down.slope, -std::sqrt(2.0 * 0.02)));
    CHECK(near(down.distance, 10.0, 1e-9));
    CHECK(near(exact_horizon(view, {8, 8}, {1, 0}, infinity, {1e-6, 0.0}).slope, -std::sqrt(2e-6)));
    CHECK(near(exact_horizon(bump.view(), {8, 3}, {1, 0}, infinity, {1e-300, 0.0}).slope, 0.0));
}

TEST_CASE("the radius ends a ray, in the middle of a cell too") {
    const auto map = sampled({17, 17}, shapes::spike({8, 8}, 1.0));
    for (const edge_mode edge : edges) {
        const auto view = map.view(edge);
        CHECK(exact_horizon(view, {3, 8}, {2, 0}, 4.0).slope == 0.0);
        CHECK(near(exact_horizon(view, {3, 8}, {2, 0}, 4.5).slope, 0.5 / 4.5));
        CHECK(near(exact_horizon(view, {3, 8}, {2, 0}, 4.5).distance, 4.5));
        CHECK(exact_horizon(view, {3, 8}, {2, 0}, 5.0).slope == 0.2);
        CHECK(exact_horizon(view, {3, 8}, {2, 0}, 1000.0).slope == 0.2);
        CHECK(near(exact_horizon(view, {5, 5}, {1, 1}, 2.5 * root2).slope, 0.25 / (2.5 * root2)));
        CHECK(near(exact_horizon(view, {8, 8}, {0, 1}, 1e-3).slope, -1.0));
        CHECK(near(exact_horizon(view, {8, 8}, {0, 1}, 1e-30).slope, -1.0));
        CHECK(near(exact_horizon(view, {8, 8}, {0, 1}, 4.0).slope, -0.25));
    }
}

TEST_CASE("what lies beyond the border") {
    // 10 texels wide; the spike stands at x = 2 and is looked for from x = 8 towards +x.
    const auto map = sampled({10, 6}, shapes::spike({2, 3}, 1.0));
    CHECK(exact_horizon(map.view(edge_mode::repeat), {8, 3}, {1, 0}).slope == 0.25);
    CHECK(near(exact_horizon(map.view(edge_mode::mirror), {8, 3}, {1, 0}).slope, 1.0 / 9.0));  // its image is at 17
    CHECK(exact_horizon(map.view(edge_mode::clamp), {8, 3}, {1, 0}).slope == 0.0);
    CHECK(exact_horizon(map.view(edge_mode::open), {8, 3}, {1, 0}).slope == 0.0);
    CHECK(exact_horizon(map.view(edge_mode::repeat), {8, 3}, {1, 0}).distance == 4.0);
    CHECK(near(exact_horizon(map.view(edge_mode::mirror), {8, 3}, {1, 0}).distance, 9.0));
    // Its own next image is a period away; seen from a hollow beside it, over the wrap.
    CHECK(exact_horizon(map.view(edge_mode::repeat), {3, 3}, {1, 0}).slope == doctest::Approx(1.0 / 9.0));

    // A spike on the border texel of a clamped map is a ridge that runs out for ever.
    const auto border = sampled({10, 10}, shapes::spike({9, 8}, 1.0));
    CHECK(near(exact_horizon(border.view(edge_mode::clamp), {9, 4}, {1, 1}).slope, 1.0 / (4.0 * root2)));
    CHECK(near(exact_horizon(border.view(edge_mode::clamp), {9, 4}, {1e-4, 1e-4}).distance, 4.0 * root2, 1e-9));
    CHECK(near(exact_horizon(border.view(edge_mode::clamp), {3, 5}, {1e6, 3}).slope, 1.0 / 1e6, 1e-15));
    CHECK(absent(exact_horizon(border.view(edge_mode::open), {9, 4}, {1, 1})));
    CHECK(absent(exact_horizon(border.view(edge_mode::open), {9, 9}, {1, 0})));
    CHECK(absent(exact_horizon(border.view(edge_mode::open), {0, 9}, {-1, -1e-3})));
    // Along the border of an open map there is a surface, also where the direction is straight to rounding only.
    CHECK(exact_horizon(border.view(edge_mode::open), {9, 4}, {0, 1}).slope == 0.25);
    for (const double tiny : {6e-17, -6e-17, 2e-16, -2e-16}) {
        CHECK(near(exact_horizon(border.view(edge_mode::open), {9, 4}, {tiny, 1}).slope, 0.25));
        CHECK(near(exact_horizon(border.view(edge_mode::open), {0, 4}, {tiny, 1}).slope, 0.0));
    }
}

TEST_CASE("holes do not occlude and are never shadowed") {
    constexpr std::uint8_t hole = 255;
    field<std::uint8_t> map = sampled<std::uint8_t>({12, 12}, shapes::plane(10.0));
    map.at(8, 5) = 250;
    const auto view = [&] {
        auto v = map.view(edge_mode::clamp);
        v.no_data = hole;
        v.height_scale = 255.0;
        return v;
    };
    CHECK(near(exact_horizon(view(), {4, 5}, {1, 0}).slope, 60.0));
    map.at(6, 5) = hole;
    CHECK(absent(exact_horizon(view(), {6, 5}, {1, 0})));
    CHECK(near(exact_horizon(view(), {4, 5}, {1, 0}).slope, 60.0));  // the hole hides nothing behind it
    map.at(8, 6) = hole;
    CHECK(near(exact_horizon(view(), {4, 5}, {1, 0}).slope, 60.0));  // on a grid line only its own two texels count
    map.at(9, 5) = hole;
    CHECK(near(exact_horizon(view(), {4, 5}, {1, 0}).slope, 60.0));
    map.at(7, 5) = hole;
    CHECK(exact_horizon(view(), {4, 5}, {1, 0}).slope == 0.0);  // no cell on the ray has that texel any more
    map.at(9, 5) = 10;
    CHECK(near(exact_horizon(view(), {4, 5}, {1, 0}).slope, 60.0));
    // Diagonally through corners only the cells passed through count, not those touched at a corner.
    map.at(7, 5) = map.at(6, 5) = map.at(8, 6) = 10;
    CHECK(near(exact_horizon(view(), {5, 2}, {1, 1}).slope, 240.0 / (3.0 * root2)));
    map.at(8, 4) = map.at(8, 6) = hole;
    CHECK(exact_horizon(view(), {5, 2}, {1, 1}).slope == 0.0);
    CHECK(exact_horizon(view(), {5, 2}, {std::cos(pi / 4), std::sin(pi / 4)}).slope == 0.0);
    CHECK(exact_horizon(view(), {11, 2}, {std::cos(0.75 * pi), std::sin(0.75 * pi)}).slope == 0.0);
    // The same on the line from (0, 0) through (2, 1), whose direction is known to rounding only: of the cells at that
    // corner, the two that the line passes through have a hole.
    field<double> corner = sampled({4, 3}, shapes::spike({2, 1}, 1.0));
    corner.at(1, 0) = corner.at(3, 2) = -1.0;
    auto corner_view = corner.view(edge_mode::open);
    corner_view.no_data = -1.0;
    for (const double more : {0.0, 1e-15, -1e-15}) CHECK(absent(exact_horizon(corner_view, {0, 0}, {2.0, 1.0 + more})));
    CHECK(exact_horizon(corner_view, {0, 0}, {2.0, 1.01}).slope > 0.4);
    CHECK(exact_horizon(corner_view, {0, 0}, {2.0, 0.99}).slope > 0.4);

    field<float> floats = sampled<float>({8, 3}, shapes::step(5.0, 2.0));
    floats.at(5, 1) = std::numeric_limits<float>::quiet_NaN();
    auto with_nan = floats.view(edge_mode::repeat);
    with_nan.no_data = std::numeric_limits<float>::quiet_NaN();
    CHECK(near(exact_horizon(with_nan, {1, 1}, {1, 0}).slope, 2.0 / 5.0));
    CHECK(absent(exact_horizon(with_nan, {5, 1}, {1, 0})));
    floats.at(2, 1) = floats.at(0, 1) = std::numeric_limits<float>::quiet_NaN();
    CHECK(exact_horizon(with_nan, {1, 1}, {1, 0}).slope == doctest::Approx(2.0 / 5.0));
    for (float& f : floats.samples) f = std::numeric_limits<float>::quiet_NaN();
    CHECK(absent(exact_horizon(with_nan, {1, 1}, {1, 0})));
    floats.at(1, 1) = 1.0f;
    CHECK(absent(exact_horizon(with_nan, {1, 1}, {1, 0}, 100.0)));
    CHECK(absent(exact_horizon(with_nan, {1, 1}, {1, 0.3}, infinity, {0.1, 0.1})));
}

TEST_CASE("texels need not be square, nor the scale positive") {
    const auto map = sampled({13, 13}, shapes::spike({6, 6}, 1.0));
    auto view = map.view(edge_mode::clamp);
    view.texel_size = {2.0, 3.0};
    view.height_scale = 6.0;
    CHECK(near(exact_horizon(view, {1, 6}, {1, 0}).slope, 0.6));
    CHECK(near(exact_horizon(view, {6, 1}, {0, 1}).slope, 0.4));
    CHECK(near(exact_horizon(view, {6, 1}, {0, 1}).distance, 15.0));
    CHECK(near(exact_horizon(view, {2, 2}, {2, 3}).slope, 6.0 / (4.0 * std::sqrt(13.0))));
    CHECK(near(exact_horizon(view, {2, 2}, {2, 3}).distance, 4.0 * std::sqrt(13.0)));
    CHECK(near(exact_horizon(view, {4, 2}, {1, 3}).slope, 6.0 / std::hypot(4.0, 12.0)));
    CHECK(near(exact_horizon(view, {2, 2}, {2, 3}, 3.5 * std::sqrt(13.0)).slope, 1.5 / (3.5 * std::sqrt(13.0))));
    view.height_scale = -6.0;  // now a dent
    CHECK(near(exact_horizon(view, {6, 6}, {1, 0}).slope, 3.0));
    CHECK(near(exact_horizon(view, {6, 6}, {0, 1}).slope, 2.0));
    CHECK(exact_horizon(view, {1, 6}, {1, 0}).slope == 0.0);
    view.height_scale = 6.0;
    view.datum = 1e6;
    CHECK(near(exact_horizon(view, {1, 6}, {1, 0}).slope, 0.6));
}

TEST_CASE("all sample types mean the same") {
    shapes::noise source(5);
    const field<std::uint8_t> bytes =
        sampled<std::uint8_t>({11, 9}, [&](double, double) { return source.between(0, 255); });
    field<std::uint16_t> words{bytes.extent, {}};
    field<float> floats{bytes.extent, {}};
    field<double> doubles{bytes.extent, {}};
    for (const std::uint8_t b : bytes.samples) {
        words.samples.push_back(std::uint16_t(b * 257));
        floats.samples.push_back(float(b));
        doubles.samples.push_back(double(b));
    }
    const double scale = 12.0;
    auto b = bytes.view(), w = bytes.view();
    b.height_scale = w.height_scale = scale;
    auto words_view = words.view();
    words_view.height_scale = scale;
    auto floats_view = floats.view();
    auto doubles_view = doubles.view();
    floats_view.height_scale = doubles_view.height_scale = scale / 255.0;
    for (const glm::dvec2 d : shapes::directions(16, 0.013)) {
        for (int n = 0; n < 99; n += 7) {
            const glm::ivec2 p(n % 11, n / 11);
            const double expected = exact_horizon(doubles_view, p, d).slope;
            CHECK(exact_horizon(floats_view, p, d).slope == expected);
            CHECK(near(exact_horizon(b, p, d).slope, expected));
            CHECK(near(exact_horizon(words_view, p, d).slope, expected));
        }
    }
}

TEST_CASE("a row stride longer than a row") {
    const auto map = sampled({8, 6}, shapes::spike({5, 3}, 1.0));
    std::vector<double> padded(6 * 11, 99.0);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 8; ++x) padded[std::size_t(y) * 11 + std::size_t(x)] = map.at(x, y);
    height_map<double> view{.samples = padded.data(), .extent = {8, 6}, .row_stride = 11};
    for (const edge_mode edge : edges) {
        view.edge = edge;
        for (const glm::dvec2 d : shapes::directions(16, 0.02))
            CHECK(exact_horizon(view, {2, 2}, d).slope == exact_horizon(map.view(edge), {2, 2}, d).slope);
    }
}

TEST_CASE("not below and hardly above a dense sampling of the surface") {
    shapes::noise source(1);
    int checked = 0;
    for (int round = 0; round < 160; ++round) {
        const glm::ivec2 extent(source.between(1, 9), source.between(1, 9));
        field<double> map = sampled(extent, shapes::rough(source));
        auto view = map.view(edges[std::size_t(round % 4)]);
        if (round % 3 == 1) view.texel_size = {1.5, 1.0};
        if (round % 5 == 2) view.texel_size.y = 1.25;
        if (round % 7 == 3) {
            for (double& h : map.samples)
                if (source.uniform() < 0.1) h = -1.0;
            view.no_data = -1.0;
        }
        const double radius = round % 2 != 0 ? 0.3 + 9.0 * source.uniform() : infinity;
        glm::dvec2 curvature(0.0);
        if (round % 8 >= 4) curvature = {0.2 * source.uniform(), 0.2 * source.uniform()};
        if (round % 16 >= 12 && radius < infinity) curvature.x = -curvature.x;

        for (int n = 0; n < 8; ++n) {
            glm::dvec2 d = shapes::direction(double(source.between(0, 7)) / 8.0);
            if (n % 4 == 1) d = shapes::direction(source.uniform());
            if (n % 4 == 2) d = glm::dvec2(source.between(-3, 3), source.between(1, 3)) * view.texel_size;
            if (n % 4 == 3) d = shapes::direction(source.uniform() + 0.25 * source.between(0, 3) * 1e-3);
            const glm::ivec2 p(source.between(0, extent.x - 1), source.between(0, extent.y - 1));
            const horizon_sample exact = exact_horizon(view, p, d, radius, curvature);
            if (view.no_data && map.at(p.x, p.y) == *view.no_data) {
                CHECK(absent(exact));
                continue;
            }
            const sampled_horizon brute = brute_force(view, p, d, radius, curvature, 1.0);
            CAPTURE(round);
            CAPTURE(n);
            CAPTURE(p.x);
            CAPTURE(p.y);
            if (brute.slope == -infinity) {
                CHECK(absent(exact));
            } else {
                CHECK(exact.slope >= brute.slope - 1e-9);
                CHECK(exact.slope <= brute.slope + brute.slack);
            }
            ++checked;
        }
    }
    CHECK(checked > 1000);
}

TEST_CASE("the distance is where the slope is reached") {
    shapes::noise source(2);
    int checked = 0;
    for (const edge_mode edge : edges) {
        const auto map = sampled({9, 8}, shapes::rough(source));
        for (int n = 0; n < 60; ++n) {
            const glm::dvec2 d = shapes::direction(source.uniform());
            const glm::ivec2 p(source.between(0, 8), source.between(0, 7));
            const horizon_sample h = exact_horizon(map.view(edge), p, d);
            if (h.distance == 0.0 || h.distance == infinity) continue;
            const double there = surface(map.view(edge), p.x + h.distance * d.x, p.y + h.distance * d.y);
            if (there != there) continue;  // rounded over the border of the open map
            CHECK(near((there - map.at(p.x, p.y)) / h.distance, h.slope, 1e-11));
            ++checked;
        }
    }
    CHECK(checked > 80);
}

TEST_CASE("jumping over blocks leaves nothing out") {
    shapes::noise source(3);
    const glm::ivec2 extent(83, 45);
    // Rolling ground, and scattered peaks that are met far away only.
    for (const int power : {4, 100}) {
        const field<double> map =
            sampled(extent, [&](double, double) { return 5.0 * std::pow(source.uniform(), power); });
        for (const edge_mode edge : edges) {
            auto view = map.view(edge);
            for (const double scale : {1.0, -1.0}) {
                view.height_scale = scale;
                std::vector<double> fine(height_bounds<double>::required_size(extent)), single(1);
                const height_bounds<double> levels(view, fine), one(view, single);
                CHECK(levels.levels() == 5);
                CHECK(one.levels() == 1);
                for (int n = 0; n < 150; ++n) {
                    const glm::ivec2 p(source.between(0, extent.x - 1), source.between(0, extent.y - 1));
                    const glm::dvec2 d =
                        shapes::direction(n % 3 == 0 ? source.between(0, 15) / 16.0 : source.uniform());
                    const double radius = n % 4 == 0 ? 200.0 * source.uniform() + 0.1 : infinity;
                    glm::dvec2 curvature(0.0);
                    if (n % 5 == 0) curvature = glm::dvec2(n % 4 == 0 && n % 8 == 0 ? -0.01 : 0.01);
                    const horizon_sample a = exact_horizon(view, p, d, radius, curvature, &levels);
                    const horizon_sample b = exact_horizon(view, p, d, radius, curvature, &one);
                    const horizon_sample c = exact_horizon(view, p, d, radius, curvature);
                    CHECK(near(a.slope, b.slope));
                    CHECK(near(c.slope, b.slope));
                    CHECK(((a.distance == b.distance) || near(a.distance, b.distance, 1e-6)));
                }
            }
        }
    }
}

TEST_CASE("bounds hold in every cell around a block") {
    shapes::noise source(4);
    for (const edge_mode edge : edges) {
        const auto map = sampled<std::uint16_t>({21, 37}, [&](double, double) { return source.between(0, 65535); });
        std::vector<std::uint16_t> storage(height_bounds<std::uint16_t>::required_size(map.extent));
        const height_bounds<std::uint16_t> bounds(map.view(edge), storage);
        for (int level = 0; level < bounds.levels(); ++level)
            for (int y = 0; y < 37; ++y)
                for (int x = 0; x < 21; ++x)
                    for (int dy = -1; dy <= 1; ++dy)
                        for (int dx = -1; dx <= 1; ++dx) {
                            const std::int64_t u = resolve_edge(x + dx, 21, edge), v = resolve_edge(y + dy, 37, edge);
                            if (u >= 0 && v >= 0) REQUIRE(bounds.highest(level, x, y) >= map.at(int(u), int(v)));
                        }
        CHECK(bounds.highest() == *std::max_element(map.samples.begin(), map.samples.end()));
        CHECK(bounds.lowest() == *std::min_element(map.samples.begin(), map.samples.end()));
    }
}

TEST_CASE("rays that never meet anything higher come to an end") {
    // One texel is higher than the one looked from. Rays in the first directions recur without touching its tent (the
    // ways they are apart from it leave other remainders by 16, 32 or 64); the others do touch it after many periods.
    const glm::ivec2 extent(64, 48);
    auto map = sampled(extent, shapes::spike({10, 13}, 10.0));
    map.at(20, 20) = 9.5;
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::mirror}) {
        const auto view = map.view(edge);
        std::vector<double> storage(height_bounds<double>::required_size(extent));
        const height_bounds<double> bounds(view, storage);
        for (const glm::dvec2 d : {glm::dvec2(1, 0), {0, -1}, {1, 1}, {1, 0.5}, {0.2, 0.3}}) {
            CHECK(near(exact_horizon(view, {20, 20}, d, infinity, {0, 0}, &bounds).slope, 0.0, 1e-8));
            CHECK(near(exact_horizon(view, {20, 20}, d, 1e12, {0, 0}, &bounds).slope, 0.0, 1e-6));
        }
        for (const glm::dvec2 d :
             {glm::dvec2(1, 1.6180339887498949), {-1, 2.718281828}, {1, 1e-3}, {1e-6, 1}, {1, 1e-9}}) {
            const horizon_sample h = exact_horizon(view, {20, 20}, d, infinity, {0, 0}, &bounds);
            CHECK(h.slope >= 0.0);
            CHECK(h.slope <= 0.5 / 10.0);
            // Nothing is missed on the texels that the other end condition, the radius, walks through.
            CHECK(h.slope >= exact_horizon(view, {20, 20}, d, 2e5, {0, 0}, &bounds).slope - 1e-8);
        }
    }
    const auto dot = sampled({1, 1}, shapes::plane(4.0));
    const auto pair = sampled({3, 2}, shapes::spike({1, 1}, 1.0));
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror}) {
        for (const glm::dvec2 d : shapes::directions(16, 0.003)) {
            CHECK(exact_horizon(dot.view(edge), {0, 0}, d).slope == 0.0);
            CHECK(exact_horizon(pair.view(edge), {1, 1}, d).slope == 0.0);
        }
    }
}

TEST_CASE("rays over a hollow base come to an end at any radius") {
    // h(t) / t + k t / 2 with 0 <= h <= 1: the spike 5 texels away, or the radius, up to 1 / radius.
    const auto map = sampled({17, 17}, shapes::spike({8, 8}, 1.0));
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::mirror, edge_mode::clamp})
        for (const double radius : {1e3, 1e9, 1e15, 1e300})
            for (const double k : {1e-300, 1e-17, 1e-9, 0.1, 1e6}) {
                CAPTURE(int(edge));
                CAPTURE(radius);
                CAPTURE(k);
                const double end = std::min(radius, 1e15);  // no texels beyond count
                const double slope = exact_horizon(map.view(edge), {3, 8}, {1, 0}, radius, {-k, 0.0}).slope;
                const double least = std::max(0.2 + 0.5 * k * 5.0, 0.5 * k * end);
                CHECK(slope >= least - 1e-9 * least);
                CHECK(slope <= least + 1e-9 * least + 1.0 / end + 1e-7);
            }
}

TEST_CASE("the least of hollow bases is as soon at its end as any") {
    // Flat: the farthest point is the highest, at 1e15 texels. A walk that does not jump there takes minutes.
    const field<double> map{{5, 3}, std::vector<double>(15, 7.0)};
    const glm::dvec2 directions[] = {{1.0, 0.0}, {-3.3e-9, 1.0}, {1.0, 0.3}};
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::mirror, edge_mode::clamp})
        for (const glm::dvec2 d : directions)
            for (const double k : {1e-323, 1e-320, 1.1e-317, 1e-308, 1e-304, 1e-290}) {
                CAPTURE(int(edge));
                CAPTURE(d.x);
                CAPTURE(k);
                const double slope = exact_horizon(map.view(edge), {3, 1}, d, 1e300, glm::dvec2(-k)).slope;
                const double reach = std::hypot(d.x, d.y) / std::max(std::abs(d.x), std::abs(d.y));
                CHECK(near(slope, 0.5 * k * 1e15 * reach, 1e-6 * slope + 5e-324 * 1e15));
            }
}

TEST_CASE("symmetries of the map are symmetries of its horizons") {
    shapes::noise source(6);
    const glm::ivec2 extent(12, 7);
    const field<double> map = sampled(extent, shapes::rough(source));
    field<double> transposed{{7, 12}, std::vector<double>(84)}, mirrored{extent, std::vector<double>(84)};
    field<double> turned = transposed, shifted = mirrored;
    for (int y = 0; y < 7; ++y) {
        for (int x = 0; x < 12; ++x) {
            transposed.at(y, x) = map.at(x, y);
            mirrored.at(11 - x, y) = map.at(x, y);
            turned.at(6 - y, x) = map.at(x, y);  // +x to +y, +y to -x
            shifted.at((x + 5) % 12, (y + 3) % 7) = map.at(x, y);
        }
    }
    for (const edge_mode edge : edges) {
        for (const double radius : {infinity, 6.3}) {
            for (const glm::dvec2 d : shapes::directions(16)) {
                for (int n = 0; n < 84; n += 5) {
                    const int x = n % 12, y = n / 12;
                    const horizon_sample h = exact_horizon(map.view(edge), {x, y}, d, radius);
                    const auto same = [&](const horizon_sample& other) {
                        return near(other.slope, h.slope) &&
                               (other.distance == h.distance || near(other.distance, h.distance, 1e-9));
                    };
                    CHECK(same(exact_horizon(transposed.view(edge), {y, x}, {d.y, d.x}, radius)));
                    CHECK(same(exact_horizon(mirrored.view(edge), {11 - x, y}, {-d.x, d.y}, radius)));
                    CHECK(same(exact_horizon(turned.view(edge), {6 - y, x}, {-d.y, d.x}, radius)));
                    if (edge == edge_mode::repeat)
                        CHECK(same(exact_horizon(shifted.view(edge), {(x + 5) % 12, (y + 3) % 7}, d, radius)));
                }
            }
        }
    }
}

TEST_CASE("constants, factors and raised texels") {
    shapes::noise source(7);
    const glm::ivec2 extent(10, 9);
    const field<double> map = sampled(extent, shapes::rough(source));
    field<double> higher = map, twice = map;
    for (double& h : higher.samples) h += 16.0;
    for (double& h : twice.samples) h *= 2.0;
    for (const edge_mode edge : edges) {
        for (int n = 0; n < 100; ++n) {
            const glm::dvec2 d = shapes::direction(n % 2 == 0 ? source.between(0, 7) / 8.0 : source.uniform());
            const glm::ivec2 p(source.between(0, 9), source.between(0, 8));
            const horizon_sample h = exact_horizon(map.view(edge), p, d);
            CHECK(exact_horizon(higher.view(edge), p, d).slope == h.slope);
            CHECK(exact_horizon(higher.view(edge), p, d).distance == h.distance);
            if (h.slope != double(no_horizon)) CHECK(exact_horizon(twice.view(edge), p, d).slope == 2.0 * h.slope);

            field<double> raised = map;
            const glm::ivec2 q(source.between(0, 9), source.between(0, 8));
            raised.at(q.x, q.y) += source.uniform();
            const double after = exact_horizon(raised.view(edge), p, d).slope;
            if (q.x == p.x && q.y == p.y) {
                if (edge == edge_mode::open) CHECK(after <= h.slope);  // elsewhere its own images rise with it
            } else {
                CHECK(after >= h.slope - 1e-12);
            }
        }
    }
}

TEST_CASE("directions of any length") {
    shapes::noise source(8);
    const field<double> map = sampled({8, 8}, shapes::rough(source));
    for (const glm::dvec2 d : shapes::directions(12, 0.04)) {
        const double slope = exact_horizon(map.view(), {3, 3}, d).slope;
        for (const double length : {1e-300, 1e-10, 0.125, 3.0, 1e10, 1e300})
            CHECK(near(exact_horizon(map.view(), {3, 3}, d * length).slope, slope));
    }
}

TEST_CASE("a bake is the horizon of every texel") {
    shapes::noise source(9);
    for (const glm::ivec2 extent : {glm::ivec2(1, 1), {1, 6}, {7, 1}, {3, 5}, {19, 17}}) {
        const auto map = sampled<float>(extent, shapes::rough(source));
        const std::vector<glm::dvec2> directions = shapes::directions(6, 0.02);
        for (const edge_mode edge : edges) {
            bake_options options;
            std::vector<float> distances(required_size(extent, 6));
            options.distances = {.values = distances, .extent = extent, .bearings = 6};
            if (extent.x > 6) options.radius = 5.5, options.curvature = {0.01, 0.02};
            const std::vector<float> slopes = baked(map.view(edge), directions, options);
            std::size_t at = 0;
            for (const glm::dvec2 d : directions) {
                for (int y = 0; y < extent.y; ++y) {
                    for (int x = 0; x < extent.x; ++x, ++at) {
                        const horizon_sample h =
                            exact_horizon(map.view(edge), {x, y}, d, options.radius, options.curvature);
                        CHECK(double(slopes[at]) == doctest::Approx(h.slope).epsilon(1e-6));
                        if (h.distance == infinity)
                            CHECK(distances[at] == std::numeric_limits<float>::infinity());
                        else
                            CHECK(double(distances[at]) == doctest::Approx(h.distance).epsilon(1e-5));
                    }
                }
            }
        }
    }
}

TEST_CASE("threads, regions, strides and scratch change no bit") {
    shapes::noise source(10);
    const glm::ivec2 extent(37, 29);
    const auto map = sampled<std::uint8_t>(extent, [&](double, double) { return source.between(0, 255); });
    auto view = map.view();
    view.height_scale = 9.0;
    const std::vector<glm::dvec2> directions = shapes::directions(5, 0.03);
    const std::vector<float> whole = baked(view, directions);

    std::vector<float> other(whole.size());
    const horizon_map out{.values = other, .extent = extent, .bearings = 5};
    for (const int count : {2, 3, 7}) {
        std::fill(other.begin(), other.end(), -9.0f);
        CHECK(bool(bake_exact(view, directions, out, {}, threads(count))));
        CHECK(other == whole);
    }

    std::vector<std::byte> scratch(exact_scratch_size(view) + 1);
    bake_options options;
    options.memory = std::pmr::null_memory_resource();
    options.scratch = std::span(scratch).subspan(1);
    options.region = {{30, 3}, {6, 21}};
    std::vector<float> part(5 * 21 * 8 + 100, -9.0f);
    const horizon_map strided{
        .values = part, .extent = {6, 21}, .bearings = 5, .row_stride = 8, .slice_stride = 21 * 8 + 3};
    REQUIRE(bool(bake_exact(view, directions, strided, options)));
    for (int i = 0; i < 5; ++i)
        for (int y = 0; y < 21; ++y) {
            for (int x = 0; x < 6; ++x)
                CHECK(strided.row(i, y)[x] ==
                      whole[(std::size_t(i) * 29 + std::size_t(y + 3)) * 37 + std::size_t(x + 30)]);
            CHECK(strided.row(i, y)[6] == -9.0f);
        }
}

TEST_CASE("bad input is refused by name and nothing is written") {
    const auto good = sampled<float>({6, 4}, shapes::plane(0.0));
    const std::vector<glm::dvec2> east{{1.0, 0.0}};
    std::vector<float> values(24, -9.0f);
    const horizon_map out{.values = values, .extent = {6, 4}, .bearings = 1};
    const auto refused = [&](const status& s, error code) {
        for (const float v : values)
            if (v != -9.0f) return false;
        return s.code() == code;
    };

    auto map = good.view();
    map.samples = nullptr;
    CHECK(refused(bake_exact(map, east, out), error::missing));
    map = good.view();
    map.extent.y = 0;
    CHECK(refused(bake_exact(map, east, out), error::not_positive));
    map = good.view();
    map.row_stride = 5;
    CHECK(refused(bake_exact(map, east, out), error::too_small));
    map = good.view();
    map.texel_size.y = -1.0;
    CHECK(refused(bake_exact(map, east, out), error::not_positive));
    map = good.view();
    CHECK(refused(bake_exact(map, {}, out), error::not_positive));
    CHECK(refused(bake_exact(map, std::vector<glm::dvec2>{{0.0, 0.0}}, out), error::not_positive));
    CHECK(refused(bake_exact(map, std::vector<glm::dvec2>{{0.0, std::nan("")}}, out), error::not_finite));
    CHECK(refused(bake_exact(map, east, out, {.radius = 0.0}), error::not_positive));
    CHECK(refused(bake_exact(map, east, out, {.radius = -3.0}), error::not_positive));
    CHECK(refused(bake_exact(map, east, out, {.curvature = {-0.1, 0.0}}), error::out_of_range));
    CHECK(refused(bake_exact(map, std::vector<glm::dvec2>{{1e-200, 0.0}}, out, {.curvature = {-0.1, 0.0}}),
                  error::out_of_range));
    CHECK(refused(bake_exact(map, east, out, {.region = {{4, 0}, {3, 4}}}), error::out_of_range));
    const horizon_map small{.values = std::span(values).first(23), .extent = {6, 4}, .bearings = 1};
    CHECK(refused(bake_exact(map, east, small), error::too_small));

    field<float> broken = good;
    broken.at(3, 2) = std::numeric_limits<float>::quiet_NaN();
    const status s = bake_exact(broken.view(), east, out);
    CHECK(refused(s, error::not_finite));
    CHECK(s.texel().x == 3);
    CHECK(s.texel().y == 2);

    std::vector<std::byte> scratch(exact_scratch_size(map) - 1);
    CHECK(refused(bake_exact(map, east, out, {.scratch = scratch}), error::too_small));
#if defined(__cpp_exceptions)
    CHECK(refused(bake_exact(map, east, out, {.memory = std::pmr::null_memory_resource()}), error::out_of_memory));
#endif
    CHECK(bool(bake_exact(map, east, out)));
    CHECK(values == std::vector<float>(24, 0.0f));
}

TEST_SUITE_END();
