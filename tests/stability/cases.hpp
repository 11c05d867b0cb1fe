#pragma once

#include <functional>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon_map.hpp>

namespace stability {

// A height field that is hard on some method. Heights are made in double, which is what exact gets; the fast methods
// get them as float unless `as_double` or `as_bytes`.
struct stiff_map {
    std::vector<double> heights;  // [y][x], before the scale
    glm::ivec2 extent{0};
    double height_scale = 1.0;
    glm::dvec2 texel_size{1.0, 1.0};
    bumpshadow::edge_mode edge = bumpshadow::edge_mode::repeat;
    bumpshadow::bake_options options = {};  // radius and curvature
    bool as_double = false;
    bool as_bytes = false;  // heights before the scale are multiples of 1/255 from 0 to 1
    // Slopes are divided by this before they become angles, where all would be 90 degrees otherwise.
    double slope_unit = 1.0;
};

// The map as a method gets it.
template <bumpshadow::height_sample Sample>
[[nodiscard]] bumpshadow::height_map<Sample> view(const stiff_map& map, const std::vector<Sample>& samples) {
    bumpshadow::height_map<Sample> heights = bumpshadow::tight_height_map(samples.data(), map.extent);
    heights.height_scale = map.height_scale;
    heights.texel_size = map.texel_size;
    heights.edge = map.edge;
    return heights;
}

enum method { cascade, fine, sweep, sweep_classic, neighborhood, method_count };
inline constexpr const char* method_names[method_count] = {"cascade", "cascade, 48 steps", "sweep", "sweep-classic",
                                                           "neighborhood"};

// Error of the elevation in degrees: mean and 99th percentile.
struct error {
    double mean = 0.0, percentile_99 = 0.0;
};

// What every method promises, whatever the map. sweep-classic is the yardstick and promises nothing, and neighborhood
// answers another question; of both it is only known that they are finite.
inline constexpr error promised[method_count] = {{0.5, 5.0}, {0.15, 2.0}, {0.15, 2.0}, {90.0, 90.0}, {90.0, 90.0}};

// Where a method does not hold what it promises: why, and what it may be off at most, which is no promise but makes a
// change for the worse known. A reason may stand for several methods.
struct exception {
    method which = cascade;
    error most;
    std::string reason;
};

struct stiff_case {
    std::string name;
    std::function<stiff_map()> make;
    std::vector<exception> exceptions = {};
};

[[nodiscard]] std::vector<stiff_case> all_cases();

}  // namespace stability
