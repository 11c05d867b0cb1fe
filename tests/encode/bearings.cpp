// How often slices at the directions of a bearing function are wrong about what is lit, against slices at true angles.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "support/shapes.hpp"
#if BUMPSHADOW_TESTS_READ_IMAGES
#include "support/real_maps.hpp"
#endif

using namespace bumpshadow;

namespace {

constexpr int slices = 16, lights = 48, functions = 5;
constexpr float max_slope = 4.0f;

float bearing_of(int function, glm::vec2 v) {
    using namespace bumpshadow::shader;
    switch (bearing_function(function)) {
        case bearing_function::quintic: return bumpshadow_bearing_quintic(v);
        case bearing_function::cubic: return bumpshadow_bearing_cubic(v);
        case bearing_function::octant: return bumpshadow_bearing_octant(v);
        case bearing_function::diamond: return bumpshadow_bearing_diamond(v);
        case bearing_function::exact: break;
    }
    return bumpshadow_bearing_exact(v);
}

// Exact horizons of a part of a map, [direction][texel].
template <class Sample>
std::vector<float> horizons(const height_map<Sample>& map, rectangle part, const std::vector<glm::dvec2>& directions) {
    std::vector<float> slopes(required_size(part.extent, int(directions.size())));
    bake_options options;
    options.region = part;
    const status s = bake_exact(map, directions, {slopes, part.extent, int(directions.size())}, options);
    REQUIRE_MESSAGE(bool(s), s.message().c_str());
    return slopes;
}

// Wrong answers, lit or in shadow, for each function: the horizon between two slices is interpolated.
struct wrong_answers {
    double count[functions] = {};
    double misplaced = 0.0;  // octant's bearing in slices at true angles

    template <class Sample>
    void add(const height_map<Sample>& map, rectangle part) {
        std::vector<glm::dvec2> towards(lights), sliced(slices);
        // Off the slices of every function.
        fill_directions(towards, 0.3 / lights);
        const std::vector<float> truth = horizons(map, part, towards);
        const std::size_t texels = truth.size() / lights;
        for (int k = 0; k <= functions; ++k) {
            const int function = k < functions ? k : int(bearing_function::octant);
            double& wrong = k < functions ? count[k] : misplaced;
            fill_directions(sliced, 0.0, bearing_function(k % functions));
            const std::vector<float> stored = horizons(map, part, sliced);
            for (std::size_t light = 0; light < lights; ++light) {
                const float bearing = bearing_of(function, glm::vec2(towards[light]));
                const float position = (bearing - std::floor(bearing)) * slices, first = std::floor(position);
                const std::size_t here = std::size_t(first) % slices, next = (here + 1) % slices;
                for (std::size_t i = 0; i < texels; ++i) {
                    const auto at = [&](std::size_t slice) {
                        return std::clamp(stored[slice * texels + i], 0.0f, max_slope);
                    };
                    const float found = at(here) + (position - first) * (at(next) - at(here));
                    wrong += disagreements(found, truth[light * texels + i]);
                }
            }
        }
    }
    // Elevations of 5 to 60 degrees between the two slopes.
    static int disagreements(float a, float b) {
        int n = 0;
        for (int degrees = 5; degrees <= 60; degrees += 5) {
            const float light = float(std::tan(degrees * 3.14159265358979 / 180.0));
            n += (light >= a) != (light >= b) ? 1 : 0;
        }
        return n;
    }
    [[nodiscard]] double ratio(bearing_function function) const { return count[int(function)] / count[0]; }

    void check(const char* name) const {
        std::printf(
            "%s: wrong answers over those with true angles: quintic %.3f, cubic %.3f, octant %.3f, diamond %.3f\n",
            name, ratio(bearing_function::quintic), ratio(bearing_function::cubic), ratio(bearing_function::octant),
            ratio(bearing_function::diamond));
        CHECK(count[0] > 1000.0);
        CHECK(ratio(bearing_function::quintic) <= 1.02);
        CHECK(ratio(bearing_function::cubic) <= 1.02);
        CHECK(ratio(bearing_function::octant) <= 1.06);
        CHECK(misplaced > 1.06 * count[0]);
    }
};

}  // namespace

// Domes with joints between them and some grain, which tile.
TEST_CASE("16 slices at the directions of a bearing function: octant within 6 %, cubic within 2 % of true angles") {
    constexpr glm::ivec2 extent(64, 64);
    shapes::noise noise(21);
    std::vector<glm::dvec3> domes(30);  // and radius
    for (glm::dvec3& d : domes) d = {64.0 * noise.uniform(), 64.0 * noise.uniform(), 5.0 + 6.0 * noise.uniform()};
    const auto field = shapes::sampled<float>(extent, [&](double x, double y) {
        double height = 0.0;
        for (const glm::dvec3& d : domes) {
            const double dx = std::remainder(x - d.x, 64.0), dy = std::remainder(y - d.y, 64.0);
            const double square = d.z * d.z - dx * dx - dy * dy;
            if (square > 0.0) height = std::max(height, std::min(std::sqrt(square), 0.7 * d.z));
        }
        return height + 0.3 * noise.uniform();
    });
    wrong_answers wrong;
    wrong.add(field.view(edge_mode::repeat), {{0, 0}, {40, 40}});
    wrong.check("domes");
}

#if !BUMPSHADOW_TESTS_READ_IMAGES

TEST_CASE("the same over real maps") { MESSAGE("skipped: built without the programs, which read images"); }

#else

TEST_CASE("the same over real maps") {
    wrong_answers wrong;
    int maps = 0;
    for_real_maps({"acg_Bricks059_1024", "acg_RoofingTiles013A_1024", "dx_stones_256", "dx_rocks_256",
                   "pk01_floor01_512", "ogre_Rock20_1024"},
                  [&](const std::string&, const auto& map) {
                      for (const int k : {1, 2, 3})
                          wrong.add(map, {{map.extent.x * k / 5, map.extent.y * (4 - k) / 5}, {14, 14}});
                      ++maps;
                  });
    if (maps > 0) wrong.check("real maps, together");
}

#endif
