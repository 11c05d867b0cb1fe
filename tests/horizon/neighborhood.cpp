#include <bumpshadow/horizon/neighborhood.hpp>

#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

constexpr float hole = std::numeric_limits<float>::quiet_NaN();
using slopes = std::vector<float>;

struct field {
    glm::ivec2 extent;
    std::vector<float> samples;
    edge_mode edge = edge_mode::repeat;
    glm::dvec2 texel_size{1.0, 1.0};

    explicit field(glm::ivec2 size) : extent(size), samples(required_size(size, 1), 0.0f) {}
    float& at(int x, int y) { return samples[std::size_t(y * extent.x + x)]; }
    height_map<float> view() const {
        height_map<float> map = tight_height_map(samples.data(), extent);
        map.edge = edge;
        map.texel_size = texel_size;
        map.no_data = hole;
        return map;
    }
};

field rough(glm::ivec2 extent, unsigned seed) {
    field map(extent);
    std::mt19937 random(seed);
    for (float& h : map.samples) h = float(random() % 1024) / 128.0f;
    return map;
}

std::vector<glm::dvec2> turns(std::size_t count) {
    std::vector<glm::dvec2> d(count);
    fill_directions(d);
    return d;
}

template <class Executor = serial>
slopes bake(const height_map<float>& heights, std::span<const glm::dvec2> directions, bake_options options = {},
            Executor execute = {}) {
    const rectangle region = region_or_all(options.region, heights.extent);
    slopes values(required_size(region.extent, int(directions.size())), -7.0f);
    const horizon_map out{values, region.extent, int(directions.size())};
    const status s = bake_neighborhood(heights, directions, out, options, execute);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return values;
}

// Slope of an averaged sine.
double slope_of(double sine) { return sine / std::sqrt(1.0 - sine * sine); }

// What the texel at (x, y) stores in each of the 32 directions.
std::vector<double> all_directions(const field& map, int x, int y, const bake_options& options = {}) {
    const slopes values = bake(map.view(), turns(32), options);
    std::vector<double> at;
    for (std::size_t n = 0; n < 32; ++n)
        at.push_back(double(
            values[(n * std::size_t(map.extent.y) + std::size_t(y)) * std::size_t(map.extent.x) + std::size_t(x)]));
    return at;
}

// Checks the 32 averages against a list of the directions that are marked, all with the same sine.
void check_marked(const std::vector<double>& found, const std::vector<int>& marked, double sine) {
    for (int n = 0; n < 32; ++n) {
        CAPTURE(n);
        int hits = 0;
        for (const int m : marked)
            for (int k = -2; k <= 2; ++k) hits += (n + k + 32) % 32 == m;
        CHECK(found[std::size_t(n)] == doctest::Approx(slope_of(hits * sine / 5.0)).epsilon(1e-5));
    }
}

}  // namespace

TEST_CASE("a spike three texels away") {
    // tan^2 = 4^2 / 3^2, sine 4 / 5. Half its diagonal is seen under atan(0.7071 / 3) = 13.3 degrees, which holds the
    // directions at 0 and 11.25 degrees to both sides.
    field map({64, 64});
    map.at(30 + 3, 30) = 4.0f;
    check_marked(all_directions(map, 30, 30), {31, 0, 1}, 0.8);
    // The same to the other sides.
    check_marked(all_directions(map, 36, 30), {15, 16, 17}, 0.8);
    field below({64, 64});
    below.at(30, 30 + 3) = 4.0f;
    check_marked(all_directions(below, 30, 30), {7, 8, 9}, 0.8);
    check_marked(all_directions(below, 30, 36), {23, 24, 25}, 0.8);
}

TEST_CASE("a spike at (3, 4)") {
    // 53.13 degrees, distance 5, half its diagonal under 8.05 degrees: only 56.25 degrees, direction 5, lies within.
    field map({64, 64});
    map.at(20 + 3, 20 + 4) = 12.0f;
    check_marked(all_directions(map, 20, 20), {5}, 12.0 / 13.0);
}

TEST_CASE("a texel next to the center affects many directions, a far one at most one") {
    // atan(0.7071) = 35.26 degrees: three directions to both sides. Along the diagonal atan(0.5) = 26.57: two.
    field beside({64, 64});
    beside.at(11, 10) = 1.0f;
    check_marked(all_directions(beside, 10, 10), {29, 30, 31, 0, 1, 2, 3}, std::sqrt(0.5));
    field diagonal({64, 64});
    diagonal.at(11, 11) = 1.0f;
    check_marked(all_directions(diagonal, 10, 10), {2, 3, 4, 5, 6}, 1.0 / std::sqrt(3.0));
    // 16 texels along x: 2.5 degrees, direction 0. (15, 1): 3.8 degrees away from x, half size 2.7: none.
    field far_away({64, 64});
    far_away.at(26, 10) = 16.0f;
    check_marked(all_directions(far_away, 10, 10), {0}, std::sqrt(0.5));
    field between({64, 64});
    between.at(25, 11) = 16.0f;
    check_marked(all_directions(between, 10, 10), {}, 0.0);
}

TEST_CASE("the radius is 16 texels, or what the options say") {
    field map({64, 64});
    map.at(10 + 17, 10) = 17.0f;
    check_marked(all_directions(map, 10, 10), {}, 0.0);
    bake_options options;
    options.radius = 17.0;
    check_marked(all_directions(map, 10, 10, options), {0}, std::sqrt(0.5));
    options.radius = 16.9;
    check_marked(all_directions(map, 10, 10, options), {}, 0.0);

    // In units: texels of 2 by 2, radius 34.
    map.texel_size = {2.0, 2.0};
    map.at(10 + 17, 10) = 34.0f;
    options.radius = 34.0;
    check_marked(all_directions(map, 10, 10, options), {0}, std::sqrt(0.5));
}

TEST_CASE("the largest of several texels counts, lower ones and holes do not") {
    field map({64, 64});
    map.at(33, 30) = 4.0f;   // 4 / 3
    map.at(38, 30) = 8.0f;   // 1
    map.at(27, 30) = -9.0f;  // lower
    map.at(30, 27) = hole;
    check_marked(all_directions(map, 30, 30), {31, 0, 1}, 0.8);
    CHECK(all_directions(map, 30, 27)[8] == double(no_horizon));
}

TEST_CASE(
    "the eight outputs of the paper average five directions each, and a direction between takes the nearest five") {
    field map({64, 64});
    map.at(23, 24) = 12.0f;  // direction 5 from (20, 20), in reach of outputs 3 to 7
    const slopes eight = bake(map.view(), turns(8));
    for (std::size_t n = 0; n < 8; ++n)
        CHECK(double(eight[(n * 64 + 20) * 64 + 20]) ==
              doctest::Approx(n == 1 ? slope_of(12.0 / 65.0) : 0.0).epsilon(1e-5));
    // 2.6, 7.4 and 7.6 thirty-seconds of a turn.
    const glm::dvec2 between[] = {exact_direction(2.6 / 32.0) * 9.0, exact_direction(7.4 / 32.0),
                                  exact_direction(7.6 / 32.0)};
    const slopes values = bake(map.view(), between);
    CHECK(double(values[20 * 64 + 20]) == doctest::Approx(slope_of(12.0 / 65.0)).epsilon(1e-5));
    CHECK(double(values[(64 + 20) * 64 + 20]) == doctest::Approx(slope_of(12.0 / 65.0)).epsilon(1e-5));
    CHECK(values[(128 + 20) * 64 + 20] == 0.0f);
}

TEST_CASE("texels that are not square") {
    // Two texels of 3 units along x, height 8: 8 / 6, sine 0.8. Half the diagonal of a 3 by 2 texel is 1.803, seen
    // under 16.7 degrees: 0 and 11.25 to both sides.
    field map({40, 40});
    map.texel_size = {3.0, 2.0};
    map.at(12, 10) = 8.0f;
    check_marked(all_directions(map, 10, 10), {31, 0, 1}, 0.8);
}

TEST_CASE("a map in any unit has the same neighborhoods") {
    const field map = rough({40, 23}, 9);
    const slopes wanted = bake(map.view(), turns(8));
    for (const double unit : {1e-100, 1e-30, 1e-7, 1e7, 1e30, 1e100}) {
        height_map<float> other = map.view();
        other.height_scale = unit;
        other.texel_size = {unit, unit};
        const slopes found = bake(other, turns(8));
        for (std::size_t i = 0; i < wanted.size(); ++i)
            CHECK(found[i] == doctest::Approx(double(wanted[i])).epsilon(1e-5));
    }
}

TEST_CASE("neighborhoods continue over each kind of edge") {
    // From (0, 2) and (0, 0) of a 5 by 4 map towards -x.
    const glm::dvec2 west[] = {{-1.0, 0.0}};
    const auto found = [&](edge_mode edge) {
        field map({20, 40});
        map.edge = edge;
        map.at(17, 20) = 4.0f;
        map.at(2, 30) = 4.0f;
        const slopes values = bake(map.view(), west);
        return std::pair<double, double>(double(values[20 * 20]), double(values[30 * 20]));
    };
    // Repeat: (17, 20) stands at (-3, 20), three of five directions. Mirror: (2, 30) stands at (-3, 30).
    const double seen = slope_of(3.0 * 0.8 / 5.0);
    CHECK(found(edge_mode::repeat).first == doctest::Approx(seen).epsilon(1e-5));
    CHECK(found(edge_mode::repeat).second == 0.0);
    CHECK(found(edge_mode::mirror).second == doctest::Approx(seen).epsilon(1e-5));
    CHECK(found(edge_mode::mirror).first == 0.0);
    CHECK(found(edge_mode::clamp).first == 0.0);
    CHECK(found(edge_mode::clamp).second == 0.0);
    CHECK(found(edge_mode::open).first == 0.0);

    // Clamp: a border texel of height 3 goes on beyond the border.
    field wall({20, 40});
    wall.edge = edge_mode::clamp;
    for (int y = 0; y < 40; ++y) wall.at(19, y) = 3.0f;
    CHECK(bake(wall.view(), turns(1))[20 * 20 + 15] == bake(wall.view(), turns(1))[12 * 20 + 15]);
    CHECK(bake(wall.view(), turns(1))[20 * 20 + 19] == 0.0f);
}

TEST_CASE("tiny maps, and a lone texel sees itself and nothing higher") {
    for (const edge_mode edge : {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror, edge_mode::open})
        for (const glm::ivec2 extent : {glm::ivec2(1, 1), {1, 9}, {3, 5}}) {
            field map = rough(extent, 3);
            map.edge = edge;
            for (const float slope : bake(map.view(), turns(8))) {
                CHECK(slope >= 0.0f);
                CHECK(slope <= 1000.0f);
                if (extent.x * extent.y == 1) CHECK(slope == 0.0f);
            }
        }
    field cliff({8, 8});
    cliff.at(4, 4) = 1e30f;
    for (const float slope : bake(cliff.view(), turns(8))) CHECK(slope <= 1000.0f);
}

TEST_CASE("a quarter turn of the map turns its neighborhoods") {
    field map = rough({21, 34}, 4), turned({34, 21});
    for (int y = 0; y < 21; ++y)
        for (int x = 0; x < 34; ++x) turned.at(x, y) = map.at(y, 33 - x);
    const slopes a = bake(map.view(), turns(32)), b = bake(turned.view(), turns(32));
    int wrong = 0;
    for (std::size_t n = 0; n < 32; ++n)
        for (int y = 0; y < 34; ++y)
            for (int x = 0; x < 21; ++x) {
                const float before = a[n * 21 * 34 + std::size_t(y * 21 + x)];
                const float after = b[(n + 8) % 32 * 21 * 34 + std::size_t(x * 34 + 33 - y)];
                wrong += std::abs(before - after) > 1e-5f * (1.0f + before);
            }
    CHECK(wrong == 0);
}

TEST_CASE("the neighborhood does not depend on the executor, the region or the other directions, bit for bit") {
    field map = rough({150, 37}, 5);
    map.at(70, 20) = hole;
    const std::vector<glm::dvec2> directions = turns(8);
    const slopes all = bake(map.view(), directions);
    CHECK(all == bake(map.view(), directions, {}, threads{2}));
    CHECK(all == bake(map.view(), directions, {}, threads{7}));
    CHECK(slopes(all.begin() + 5 * 150 * 37, all.begin() + 6 * 150 * 37) ==
          bake(map.view(), std::span(directions).subspan(5, 1)));
    for (const rectangle region : {rectangle{{0, 0}, {1, 1}}, {{149, 36}, {1, 1}}, {{60, 9}, {70, 20}}}) {
        bake_options options;
        options.region = region;
        const slopes part = bake(map.view(), directions, options, threads{2});
        int wrong = 0;
        std::size_t next = 0;
        for (std::size_t i = 0; i < 8; ++i)
            for (int y = region.origin.y; y < region.origin.y + region.extent.y; ++y)
                for (int x = region.origin.x; x < region.origin.x + region.extent.x; ++x)
                    wrong += part[next++] != all[i * 150 * 37 + std::size_t(y * 150 + x)];
        CHECK(wrong == 0);
    }
}

TEST_CASE("the neighborhood refuses what it cannot do and writes nothing") {
    field map = rough({4, 3}, 1);
    const auto code = [&](bake_options options, const char* argument) {
        slopes values(12, -7.0f);
        const status s = bake_neighborhood(map.view(), turns(1), horizon_map{values, {4, 3}, 1}, options);
        CHECK(std::string(s.argument()) == argument);
        for (const float v : values) CHECK(v == -7.0f);
        return s.code();
    };
    bake_options options;
    options.curvature = {0.1, 0.0};
    CHECK(code(options, "curvature.x") == error::not_supported);
    options = {};
    slopes distances(12);
    options.distances = {distances, {4, 3}, 1};
    CHECK(code(options, "distances") == error::not_supported);
    options = {};
    options.radius = 1025.0;
    CHECK(code(options, "radius") == error::out_of_range);
    options.radius = 1e300;
    CHECK(code(options, "radius") == error::out_of_range);
    options.radius = -1.0;
    CHECK(code(options, "radius") == error::not_positive);
    options = {};
    std::byte little[100];
    options.scratch = little;
    CHECK(code(options, "options.scratch") == error::too_small);
    options = {};
    std::vector<std::byte> enough(neighborhood_scratch_size(map.view()));
    options.scratch = enough;
    CHECK(bake(map.view(), turns(8), options) == bake(map.view(), turns(8)));
    options = {};
    map.at(1, 2) = std::numeric_limits<float>::infinity();
    CHECK(code(options, "height") == error::not_finite);
}
