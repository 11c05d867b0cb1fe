#include <array>
#include <atomic>
#include <cstdio>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon_map.hpp>

int main() {
    constexpr glm::ivec2 extent{4, 3};
    const std::array<float, 12> samples{};
    std::array<float, 12> slopes{};
    const std::array<glm::dvec2, 1> directions{glm::dvec2(1.0, 0.0)};
    const bumpshadow::horizon_map out{slopes, extent, 1};

    const auto heights = bumpshadow::tight_height_map(samples.data(), extent);
    const bumpshadow::status good = bumpshadow::check_bake(heights, directions, out, {});
    const bumpshadow::status bad = bumpshadow::check_bake(heights, directions, out, {.steps = 0});
    std::printf("%s; %s\n", good.message().c_str(), bad.message().c_str());

    std::atomic<int> items = 0;
    bumpshadow::threads(2)(8, [&](std::size_t) { ++items; });
    return good && !bad && items == 8 ? 0 : 1;
}
