#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace examples {

// Two costs of a choice; smaller is better in both.
struct cost_pair {
    double x = 0.0, y = 0.0;
};

// Indices of the choices that no other one beats: none is as good in both and better in one. By growing x. Of choices
// that are equal in both, the first. Not-a-number is never chosen.
[[nodiscard]] std::vector<std::size_t> pareto_front(std::span<const cost_pair> choices);

}  // namespace examples
