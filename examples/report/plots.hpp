#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "report/findings.hpp"

namespace examples {

struct plot_point {
    std::string name, family;
    double x = 0.0, y = 0.0;
};

// Points of one color and shape.
struct plot_series {
    std::string family;
    std::size_t style = 0;  // a family has the same in all plots
    std::vector<plot_point> points;
};

struct plot_axis {
    std::string label;
    bool is_logarithmic = false;
    bool are_marks_binary = false;
    double low = 0.0, high = 1.0;
    std::vector<double> marks = {};  // empty: gnuplot's choice

    // Zero has no place on a logarithmic axis.
    [[nodiscard]] bool holds(double value) const { return !is_logarithmic || value > 0.0; }
};

struct plot {
    std::string name;      // of its files: NAME.gp, NAME.dat, NAME.svg
    std::string title;     // one line
    std::string subtitle;  // what is drawn
    plot_axis x, y;
    bool has_lines = false;  // a line through the best of each family, instead of points
    std::vector<plot_series> series;
    std::vector<plot_point> front;  // what the plot says about it is in front_title
    std::string front_title;
    std::optional<plot_point> nothing;  // what costs nothing, drawn as a level where its place is not on the axis
};

// Those for which there are records, drawn for the mean over maps where there is one, else for the first map.
[[nodiscard]] std::vector<plot> plots_of(const findings& all);

}  // namespace examples
