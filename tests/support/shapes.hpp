#pragma once

// Height fields with horizons that are known or easy to state, shared by the tests.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>

namespace shapes {

// Samples that own their memory, tightly packed.
template <bumpshadow::height_sample Sample = double>
struct field {
    glm::ivec2 extent{0};
    std::vector<Sample> samples = {};

    [[nodiscard]] Sample& at(int x, int y) { return samples[index(x, y)]; }
    [[nodiscard]] const Sample& at(int x, int y) const { return samples[index(x, y)]; }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return std::size_t(y) * std::size_t(extent.x) + std::size_t(x);
    }

    [[nodiscard]] bumpshadow::height_map<Sample> view(
        bumpshadow::edge_mode edge = bumpshadow::edge_mode::repeat) const {
        auto map = bumpshadow::tight_height_map(samples.data(), extent);
        map.edge = edge;
        return map;
    }
};

// height(x, y) at every texel.
template <bumpshadow::height_sample Sample = double, class Height>
[[nodiscard]] field<Sample> sampled(glm::ivec2 extent, Height&& height) {
    field<Sample> result{extent, std::vector<Sample>(std::size_t(extent.x) * std::size_t(extent.y))};
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) result.at(x, y) = static_cast<Sample>(height(double(x), double(y)));
    return result;
}

// The functions below give a height at (x, y), in texels, for sampled().

[[nodiscard]] inline auto plane(double height) {
    return [=](double, double) { return height; };
}
// Rises by gradient.x a texel along x and gradient.y along y.
[[nodiscard]] inline auto ramp(glm::dvec2 gradient) {
    return [=](double x, double y) { return gradient.x * x + gradient.y * y; };
}
// 0 before x = edge, height from there on; between the texels edge - 1 and edge the surface rises linearly.
[[nodiscard]] inline auto step(double edge, double height) {
    return [=](double x, double) { return x < edge ? 0.0 : height; };
}
// One raised texel: a bilinear tent of height (1 - |x - center.x|) (1 - |y - center.y|).
[[nodiscard]] inline auto spike(glm::dvec2 center, double height) {
    return [=](double x, double y) { return x == center.x && y == center.y ? height : 0.0; };
}
// Falls by `gradient` a texel from its tip, down to 0.
[[nodiscard]] inline auto cone(glm::dvec2 center, double height, double gradient) {
    return
        [=](double x, double y) { return (std::max)(0.0, height - gradient * std::hypot(x - center.x, y - center.y)); };
}
[[nodiscard]] inline auto hemisphere(glm::dvec2 center, double radius) {
    return [=](double x, double y) {
        const double dx = x - center.x, dy = y - center.y;
        return std::sqrt((std::max)(0.0, radius * radius - dx * dx - dy * dy));
    };
}
// Bottom at x = center, both walls rise by `gradient` a texel.
[[nodiscard]] inline auto v_groove(double center, double gradient) {
    return [=](double x, double) { return gradient * std::abs(x - center); };
}
// A ridge along the line x + y = crest whose flanks rise at 45 degrees towards it.
[[nodiscard]] inline auto diagonal_hill(double crest, double height) {
    return [=](double x, double y) { return (std::max)(0.0, height - std::abs(x + y - crest) / std::sqrt(2.0)); };
}
// Smooth, tiles with the extent, heights within +-2.
[[nodiscard]] inline auto waves(glm::ivec2 extent) {
    const double kx = 2.0 * 3.14159265358979323846 / extent.x, ky = 2.0 * 3.14159265358979323846 / extent.y;
    return [=](double x, double y) {
        return std::sin(kx * x) * std::cos(2.0 * ky * y) + 0.6 * std::sin(3.0 * kx * x + ky * y + 1.0) +
               0.4 * std::cos(2.0 * kx * x - 3.0 * ky * y);
    };
}

// Numbers that look random and are the same everywhere (SplitMix64; Steele, Lea and Flood 2014).
class noise {
public:
    explicit noise(std::uint64_t seed) : state_(seed) {}

    [[nodiscard]] std::uint64_t bits() {
        std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    // In [0, 1), a multiple of 2^-24: exact in float too.
    [[nodiscard]] double uniform() { return double(bits() >> 40) * 0x1p-24; }
    // In [first, last].
    [[nodiscard]] int between(int first, int last) { return first + int(bits() % std::uint64_t(last - first + 1)); }

private:
    std::uint64_t state_;
};

// Independent heights in [0, 1): as rough as a map can be.
[[nodiscard]] inline auto rough(noise& source) {
    return [&source](double, double) { return source.uniform(); };
}

// Unit vector of a bearing, in turns; exact along the axes.
[[nodiscard]] inline glm::dvec2 direction(double turns) {
    const double angle = 2.0 * 3.14159265358979323846 * turns;
    const double quarter = turns * 4.0;
    if (quarter == std::floor(quarter)) {
        const int side = ((int(quarter) % 4) + 4) % 4;
        return {side == 0 ? 1.0 : side == 2 ? -1.0 : 0.0, side == 1 ? 1.0 : side == 3 ? -1.0 : 0.0};
    }
    return {std::cos(angle), std::sin(angle)};
}

// `count` directions, the first at +x, evenly around the circle.
[[nodiscard]] inline std::vector<glm::dvec2> directions(int count, double phase = 0.0) {
    std::vector<glm::dvec2> result(static_cast<std::size_t>(count));
    for (int i = 0; i < count; ++i) result[std::size_t(i)] = direction(phase + double(i) / count);
    return result;
}

}  // namespace shapes
