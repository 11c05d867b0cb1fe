#include <array>
#include <cmath>
#include <cstdio>

#include <bumpshadow/bumpshadow.hpp>

// A wall two texels high stands at the last column: from three columns away its horizon has the slope 2 / 3.
int main() {
    constexpr glm::ivec2 extent{4, 3};
    constexpr std::array<float, 12> samples{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    std::array<float, 24> slopes{};
    std::array<glm::dvec2, 2> directions{};
    bumpshadow::fill_directions(directions);

    auto heights = bumpshadow::tight_height_map(samples.data(), extent);
    heights.edge = bumpshadow::edge_mode::clamp;
    const bumpshadow::horizon_map out{.values = slopes, .extent = extent, .bearings = 2};
    const auto good = bumpshadow::bake_cascade(heights, directions, out, {}, bumpshadow::threads(2));
    const auto bad = bumpshadow::bake_cascade(heights, directions, out, {.steps = 0});
    std::printf("%s; %s\n", good.message().c_str(), bad.message().c_str());

    const bool right = std::abs(slopes[0] - 2.0f / 3.0f) < 1e-5f && std::abs(slopes[12]) < 1e-5f;
    return good && !bad && right ? 0 : 1;
}
