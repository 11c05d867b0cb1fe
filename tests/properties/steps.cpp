// More steps of the cascade do not make it worse, on the hard cases of tests/stability.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <span>
#include <vector>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/height_bounds.hpp>

#include "properties/maps.hpp"
#include "stability/cases.hpp"

namespace properties {
namespace {

namespace bs = bumpshadow;

constexpr int steps[] = {4, 8, 12, 24, 48};
// Where next to nothing is left of the error, on pits and checkerboards, cells that are looked at more finely see a
// horizon of 0 as one of a thousandth of a degree. It is far below the 1/1024 (0.06 degrees) at which a cascade stops
// looking on maps that repeat.
constexpr double tolerance = 0.002;
constexpr std::size_t levels = std::size(steps);

// Mean error in degrees for each number of steps, over texels and directions of the map.
std::vector<double> errors_of(const stability::stiff_map& map) {
    list directions(6);
    bs::fill_directions(directions, 0.0);
    directions.insert(directions.end(), {{1.0, 1.0}, {0.3, 0.9}, {-0.7, -0.2}});
    bs::height_map<double> heights = bs::tight_height_map(map.heights.data(), map.extent);
    heights.height_scale = map.height_scale;
    heights.texel_size = map.texel_size;
    heights.edge = map.edge;
    std::vector<double> storage(bs::height_bounds<double>::required_size(map.extent));
    const bs::height_bounds<double> bounds(heights, storage);
    std::vector<glm::ivec2> texels;
    for (int i = 0; i < 400; ++i) texels.emplace_back(i * 61 % map.extent.x, (i * 37 + i / 7) % map.extent.y);
    const auto angle = [&](double slope) { return std::atan(slope / map.slope_unit) * 180.0 / 3.14159265358979; };

    std::vector<double> exact;
    for (const glm::dvec2 d : directions)
        for (const glm::ivec2 p : texels)
            exact.push_back(
                angle(bs::exact_horizon(heights, p, d, map.options.radius, map.options.curvature, &bounds).slope));
    std::vector<double> errors;
    slopes values(bs::required_size(map.extent, int(directions.size())));
    const bs::horizon_map out{.values = values, .extent = map.extent, .bearings = int(directions.size())};
    for (const int count : steps) {
        bs::bake_options options = map.options;
        options.steps = count;
        double sum = 0.0;
        if (!bs::bake_cascade(heights, directions, out, options)) return {};
        for (std::size_t i = 0; i < exact.size(); ++i) {
            const glm::ivec2 p = texels[i % texels.size()];
            sum += std::abs(angle(double(out.row(int(i / texels.size()), p.y)[p.x])) - exact[i]);
        }
        errors.push_back(sum / double(exact.size()));
    }
    return errors;
}

}  // namespace

bool check_steps() {
    bool all = true;
    std::printf(
        "\nMean error of the cascade in degrees, by steps\n\n| case | 4 | 8 | 12 | 24 | 48 | |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for (const stability::stiff_case& one : stability::all_cases()) {
        const std::vector<double> errors = errors_of(one.make());
        bool held = errors.size() == levels;
        std::printf("| %s |", one.name.c_str());
        for (const double e : errors) std::printf(" %.2g |", e);
        for (std::size_t i = 1; i < errors.size(); ++i) held = held && errors[i] <= errors[i - 1] + tolerance;
        std::printf(" %s |\n", held ? "held" : "BROKEN");
        all = all && held;
    }
    return all;
}

}  // namespace properties
