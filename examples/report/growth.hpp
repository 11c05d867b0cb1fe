#pragma once

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "report/record.hpp"

namespace examples {

// A bar that the growth of the cost is held to.
struct growth_check {
    std::string what;
    double value = 0.0;
    double least = -std::numeric_limits<double>::infinity();
    double most = std::numeric_limits<double>::infinity();

    [[nodiscard]] bool held() const { return value >= least && value <= most; }
};

// From the records of the section "growth" among these; what was not measured is left out.
[[nodiscard]] std::vector<growth_check> checks_of_growth(std::span<const record> records);

// "held: ...", or "NOT held: ...".
[[nodiscard]] std::string text_of(const growth_check& check);

// Slope of the straight line that is nearest to the logarithms, by least squares: y grows as x to this power.
[[nodiscard]] double fitted_exponent(std::span<const double> x, std::span<const double> y);

}  // namespace examples
