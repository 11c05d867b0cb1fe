#include "report/pareto.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace examples {

std::vector<std::size_t> pareto_front(std::span<const cost_pair> choices) {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < choices.size(); ++i)
        if (!std::isnan(choices[i].x) && !std::isnan(choices[i].y)) order.push_back(i);
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return std::tuple(choices[a].x, choices[a].y, a) < std::tuple(choices[b].x, choices[b].y, b);
    });
    std::vector<std::size_t> front;
    double best = std::numeric_limits<double>::infinity();
    for (const std::size_t i : order) {
        if (!(choices[i].y < best)) continue;
        best = choices[i].y;
        front.push_back(i);
    }
    return front;
}

}  // namespace examples
