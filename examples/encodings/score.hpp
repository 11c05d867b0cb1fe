#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include <bumpshadow/encode/quantity.hpp>

#include "encodings/sample.hpp"

namespace examples {

// Wrong answers about what is lit, patch by patch: texels of one patch lie close together and share their errors, so
// that patches are what a confidence interval may count.
struct score {
    using counts = std::array<double, light_elevations.size()>;  // by elevation of the light
    std::vector<counts> wrong, all;                              // [patch]

    // In percent, of all lights or of those at one elevation (an index of light_elevations).
    [[nodiscard]] double percent() const;
    [[nodiscard]] double percent(std::size_t elevation) const;
    // Half width of the 95 % confidence interval of the same; not-a-number for a single patch.
    [[nodiscard]] double interval() const;
    [[nodiscard]] double interval(std::size_t elevation) const;
    // Answers.
    [[nodiscard]] double size() const;
};

// Half width of the 95 % confidence interval of the mean of values that do not depend on each other; not-a-number for
// fewer than two.
[[nodiscard]] double confidence(const std::vector<double>& values);

// Compares what a shader reads with the exact horizons of a map, a bearing of the light at a time.
class judge {
public:
    // scale: of the horizons that it will be shown; texels less than `margin` from the border of their patch do not
    // count
    judge(const sample_map& map, const bumpshadow::horizon_scale& scale, int margin = 0);

    // horizons: of all texels of the map, in the unit of the texture, over what stands for 1
    void look(int bearing, const float* horizons);
    // The same for light at one elevation.
    void look(int bearing, const float* horizons, std::size_t elevation);

    [[nodiscard]] const score& result() const { return score_; }

private:
    void look(int bearing, const float* horizons, std::size_t first, std::size_t end);

    const sample_map& map_;
    bumpshadow::horizon_scale scale_;
    int margin_;
    score score_;
};

}  // namespace examples
