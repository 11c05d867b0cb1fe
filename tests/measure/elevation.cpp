#include <bumpshadow/measure/elevation.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/horizon/cascade.hpp>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

float slope(double degrees) { return static_cast<float>(std::tan(degrees * std::numbers::pi / 180.0)); }

// Found slopes of a map of 3 x 2 texels in 2 bearings, as elevations: 10 everywhere but at the texels below.
struct case_by_hand {
    std::vector<float> values = std::vector<float>(12, slope(10.0));
    std::vector<glm::ivec2> texels{{2, 0}, {0, 1}};
    std::vector<float> exact = std::vector<float>(4, slope(10.0));

    void set(int bearing, std::size_t texel, float found, float truth) {
        const glm::ivec2 at = texels[texel];
        values[std::size_t(bearing * 6 + at.y * 3 + at.x)] = found;
        exact[std::size_t(bearing) * 2 + texel] = truth;
    }
    [[nodiscard]] horizon_map view() { return {values, {3, 2}, 2}; }
    error_figures figures() {
        error_figures result, again;
        const status s = elevation_error(view(), texels, exact, result);
        CHECK_MESSAGE(bool(s), s.message().c_str());
        std::vector<float> listed;
        for (int b = 0; b < 2; ++b)
            for (const glm::ivec2 t : texels) listed.push_back(values[std::size_t(b * 6 + t.y * 3 + t.x)]);
        CHECK(elevation_error(listed, texels.size(), exact, again));
        CHECK(again.count == result.count);
        if (result.count != 0) CHECK(again.mean == result.mean);
        return result;
    }
};

}  // namespace

TEST_CASE("errors of elevations in degrees") {
    case_by_hand c;
    CHECK(c.figures().mean == 0.0);
    c.set(0, 0, slope(33.0), slope(30.0));  // texel (2, 0): 3 too high, 1 too low; texel (0, 1): 0 and 6 too high
    c.set(1, 0, slope(-2.0), slope(-1.0));
    c.set(1, 1, slope(66.0), slope(60.0));
    const error_figures f = c.figures();
    CHECK(f.count == 4);
    CHECK(f.mean == doctest::Approx(10.0 / 4.0));
    CHECK(f.bias == doctest::Approx(8.0 / 4.0));
    CHECK(f.largest == doctest::Approx(6.0));
    CHECK(f.percentile_99 == doctest::Approx(6.0));
    CHECK(f.rms == doctest::Approx(std::sqrt((9.0 + 1.0 + 36.0) / 4.0)));
    // Texels sum to 4 and 6, the mean is 5: sqrt(2 (1 + 1)) / 4.
    CHECK(f.interval == doctest::Approx(standard_errors_95(1) * 0.5));
}

TEST_CASE("holes on both sides are left out, on one side they count in full") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float hole : {no_horizon, nan}) {
        case_by_hand c;
        for (int b = 0; b < 2; ++b) c.set(b, 0, hole, no_horizon);
        c.set(0, 1, slope(12.0), slope(10.0));
        CHECK(c.figures().count == 2);
        CHECK(c.figures().mean == doctest::Approx(1.0));
        CHECK(std::isinf(c.figures().interval));

        // From 30 degrees down to -90.
        for (int b = 0; b < 2; ++b) c.set(b, 0, hole, slope(30.0));
        CHECK(c.figures().count == 4);
        CHECK(c.figures().largest == doctest::Approx(120.0));
        CHECK(c.figures().bias == doctest::Approx((-120.0 - 120.0 + 2.0) / 4.0));
        for (int b = 0; b < 2; ++b) c.set(b, 0, slope(30.0), hole);
        CHECK(c.figures().bias == doctest::Approx((120.0 + 120.0 + 2.0) / 4.0));

        // A texel of an open map from which one bearing leads straight out is no hole.
        c.set(0, 0, hole, hole);
        c.set(1, 0, slope(10.0), slope(10.0));
        CHECK(c.figures().count == 4);
        CHECK(c.figures().mean == doctest::Approx(0.5));
    }
    case_by_hand c;
    for (int b = 0; b < 2; ++b)
        for (std::size_t t = 0; t < 2; ++t) c.set(b, t, no_horizon, no_horizon);
    CHECK(c.figures().count == 0);
    CHECK(std::isnan(c.figures().mean));
}

// The exact slopes written into a map with strides are off by nothing.
TEST_CASE("a bake with strides, sampled") {
    const glm::ivec2 extent{48, 40};
    const auto field = shapes::sampled(extent, shapes::waves(extent));
    const auto directions = shapes::directions(4);
    std::vector<float> values(4 * 50 * 45, std::numeric_limits<float>::quiet_NaN());
    const horizon_map found{values, extent, 4, 50, 50 * 45};
    std::vector<glm::ivec2> texels(64);
    REQUIRE(sample_texels(extent, 1, texels));
    std::vector<float> exact(4 * 64);
    REQUIRE(sample_horizons(field.view(), texels, directions, exact));
    for (std::size_t b = 0; b < 4; ++b)
        for (std::size_t t = 0; t < 64; ++t) found.row(int(b), texels[t].y)[texels[t].x] = exact[b * 64 + t];
    error_figures f;
    REQUIRE(elevation_error(found, texels, exact, f));
    CHECK(f.count == 256);
    CHECK(f.largest == 0.0);
    CHECK(f.interval == 0.0);

    // bake_cascade states a mean of 0.13 degrees on surfaces that are rougher than this one.
    REQUIRE(bake_cascade(field.view(), directions, found));
    REQUIRE(elevation_error(found, texels, exact, f));
    CHECK(f.mean < 0.25);
    CHECK(f.mean > 0.0);
    CHECK(f.percentile_99 <= f.largest);
    CHECK(f.rms >= f.mean);
    CHECK(std::abs(f.bias) <= f.mean);
}

TEST_CASE("bad input is named, and the result stays") {
    case_by_hand c;
    error_figures f;
    f.mean = -7.0;
    const auto refused = [&](const status& s, error code, const char* argument) {
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        CHECK(f.mean == -7.0);
    };
    horizon_map found = c.view();
    found.extent.x = 0;
    refused(elevation_error(found, c.texels, c.exact, f), error::not_positive, "horizon map extent.x");
    found = c.view();
    found.bearings = 0;
    refused(elevation_error(found, c.texels, c.exact, f), error::not_positive, "horizon map bearings");
    found = c.view();
    found.values = found.values.first(11);
    refused(elevation_error(found, c.texels, c.exact, f), error::too_small, "horizon map size");
    found = c.view();
    found.bearings = 1;
    refused(elevation_error(found, c.texels, c.exact, f), error::mismatch, "exact size");
    refused(elevation_error(c.view(), {}, {}, f), error::missing, "texels");
    const glm::ivec2 outside[] = {{0, 0}, {3, 1}};
    refused(elevation_error(c.view(), outside, c.exact, f), error::out_of_range, "texels x");

    refused(elevation_error(c.exact, 0, c.exact, f), error::missing, "texels");
    refused(elevation_error(c.exact, 2, {}, f), error::missing, "texels");
    refused(elevation_error(c.exact, 3, c.exact, f), error::not_a_multiple, "exact size");
    refused(elevation_error(std::span(c.exact).first(2), 2, c.exact, f), error::mismatch, "found size");

    std::vector<std::byte> scratch(elevation_scratch_size(2, 2));
    refused(elevation_error(c.view(), c.texels, c.exact, f, {.scratch = std::span(scratch).first(scratch.size() - 1)}),
            error::too_small, "options.scratch");
    CHECK(elevation_error(c.view(), c.texels, c.exact, f,
                          {.scratch = scratch, .memory = std::pmr::null_memory_resource()}));
    CHECK(f.mean == 0.0);
}
