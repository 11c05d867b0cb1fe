#include "common/stone_wall.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <glm/ext/vector_double2.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/quantize.hpp>
#include <bumpshadow/reference/lighting.hpp>

namespace examples {
namespace {

constexpr int size = 512;  // texels; lengths below are in texels too
constexpr double height_scale = 48.0;

// Hash after the mixing function "lowbias32" of Chris Wellons (2018).
std::uint32_t mix(std::uint32_t h) {
    h ^= h >> 16;
    h *= 0x7feb352du;
    h ^= h >> 15;
    h *= 0x846ca68bu;
    return h ^ h >> 16;
}

std::uint32_t hash(int x, int y, int seed) {
    return mix(std::uint32_t(x) + mix(std::uint32_t(y) + mix(std::uint32_t(seed))));
}

// A number in [low, high).
double pick(std::uint32_t h, double low, double high) { return low + (high - low) * double(h >> 8) / double(1u << 24); }

glm::vec3 to_linear(glm::vec3 srgb) {
    using bumpshadow::srgb_to_linear;
    return {srgb_to_linear(srgb.x), srgb_to_linear(srgb.y), srgb_to_linear(srgb.z)};
}

int wrap(int i, int n) { return (i % n + n) % n; }

double fade(double t) { return t * t * t * (t * (t * 6.0 - 15.0) + 10.0); }

// Gradient noise (Perlin 2002) in about [-1, 1] that repeats every `size` texels; the cell has to divide that.
double noise(glm::dvec2 p, int cell_x, int cell_y, int seed) {
    const double u = p.x / cell_x, v = p.y / cell_y;
    const int x = int(std::floor(u)), y = int(std::floor(v));
    const double fx = u - x, fy = v - y;
    const auto corner = [&](int dx, int dy) {
        const std::uint32_t h = hash(wrap(x + dx, size / cell_x), wrap(y + dy, size / cell_y), seed);
        const double gx = pick(h, -1.0, 1.0), gy = pick(mix(h), -1.0, 1.0);
        return 2.0 * (gx * (fx - dx) + gy * (fy - dy));
    };
    const double top = std::lerp(corner(0, 0), corner(1, 0), fade(fx));
    const double bottom = std::lerp(corner(0, 1), corner(1, 1), fade(fx));
    return std::lerp(top, bottom, fade(fy));
}

double noise(glm::dvec2 p, int cell, int seed) { return noise(p, cell, cell, seed); }

// Octaves of noise from cells of `coarse` down to `fine` texels, each with `gain` times the last one's amplitude.
double octaves(glm::dvec2 p, int coarse, int fine, double gain, int seed) {
    double sum = 0.0, amplitude = 1.0;
    for (int cell = coarse; cell >= fine; cell /= 2, amplitude *= gain) sum += amplitude * noise(p, cell, seed + cell);
    return sum;
}

double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3.0 - 2.0 * t);
}

double smooth_min(double a, double b, double width) {
    const double h = std::max(width - std::abs(a - b), 0.0) / width;
    return std::min(a, b) - h * h * width * 0.25;
}

struct stone {
    glm::dvec2 center{0.0};
    glm::dvec2 half{0.0};  // half its extent, joints left out
    int id = 0;

    [[nodiscard]] std::uint32_t key(int what) const { return hash(id, what, 77); }
    [[nodiscard]] double random(int what, double low, double high) const { return pick(key(what), low, high); }
};

// Splits [0, size) into `count` parts of uneven length; returns the count + 1 limits.
std::vector<double> split(int count, double unevenness, int seed) {
    std::vector<double> limits(std::size_t(count) + 1, 0.0);
    for (int i = 0; i < count; ++i)
        limits[std::size_t(i) + 1] = limits[std::size_t(i)] + pick(hash(i, count, seed), 1.0, 1.0 + unevenness);
    for (double& limit : limits) limit *= size / limits.back();
    limits.back() = size;
    return limits;
}

std::vector<stone> lay_stones() {
    std::vector<stone> stones;
    const auto lay = [&](double left, double right, double top, double bottom) {
        const int id = int(stones.size());
        const double joint = pick(hash(id, 1, 5), 0.6, 1.9);
        stones.push_back({{0.5 * (left + right), 0.5 * (top + bottom)},
                          {0.5 * (right - left) - joint, 0.5 * (bottom - top) - joint},
                          id});
    };
    const std::vector<double> courses = split(7, 0.9, 11);
    for (std::size_t c = 0; c + 1 < courses.size(); ++c) {
        const double top = courses[c], bottom = courses[c + 1], thickness = bottom - top;
        const int count = std::max(3, int(std::lround(size / (thickness * pick(hash(int(c), 2, 3), 1.35, 1.9)))));
        const std::vector<double> joints = split(count, 1.5, 100 + int(c));
        const double shift = pick(hash(int(c), 7, 3), 0.0, size);
        for (std::size_t s = 0; s + 1 < joints.size(); ++s) {
            const double left = joints[s] + shift, right = joints[s + 1] + shift;
            const std::uint32_t h = hash(int(c), int(s), 19);
            // Now and then two flat stones take the place of one.
            if (thickness > 62.0 && right - left > 55.0 && h % 4 == 0) {
                const double middle = top + thickness * pick(mix(h), 0.42, 0.6);
                lay(left, right, top, middle);
                lay(left, right, middle, bottom);
            } else {
                lay(left, right, top, bottom);
            }
        }
    }
    return stones;
}

// Distance to the outline, positive inside: a slightly turned and wedged box with rounded, chipped corners.
double depth_inside(const stone& s, glm::dvec2 p, double chips) {
    const double turn = s.random(20, -0.022, 0.022);
    const glm::dvec2 q{p.x + turn * p.y, p.y - turn * p.x};
    const glm::dvec2 half{s.half.x + s.random(21, -0.05, 0.05) * q.y, s.half.y + s.random(22, -0.035, 0.035) * q.x};
    const int corner = (q.x > 0.0 ? 1 : 0) + (q.y > 0.0 ? 2 : 0);
    const double radius = std::min(s.random(24 + corner, 5.0, 20.0), 0.8 * std::min(half.x, half.y));
    const glm::dvec2 d{std::abs(q.x) - half.x + radius, std::abs(q.y) - half.y + radius};
    const glm::dvec2 outer{std::max(d.x, 0.0), std::max(d.y, 0.0)};
    return radius - glm::length(outer) - std::min(std::max(d.x, d.y), 0.0) + chips;
}

// Height of the face: the lowest of a few leaning planes, which leaves the ridges of a roughly split stone.
double split_face(const stone& s, glm::dvec2 p) {
    const int planes = 3 + int(s.key(30) % 4);
    double lowest = 0.0;
    for (int i = 0; i < planes; ++i) {
        const std::uint32_t h = s.key(31 + i);
        const glm::dvec2 lean{pick(h, -0.26, 0.26), pick(mix(h), -0.26, 0.26)};
        const double height = pick(mix(h + 1u), 0.5, 5.0) + glm::dot(lean, p);
        lowest = i == 0 ? height : smooth_min(lowest, height, 0.9);
    }
    return lowest;
}

// Round holes where grains broke out, and their rims; depth in texels.
double pits(glm::dvec2 p, int cell, int seed) {
    const int x = int(std::floor(p.x / cell)), y = int(std::floor(p.y / cell));
    double depth = 0.0;
    for (int dy = -1; dy <= 1; ++dy)
        for (int dx = -1; dx <= 1; ++dx) {
            const std::uint32_t h = hash(wrap(x + dx, size / cell), wrap(y + dy, size / cell), seed);
            if (h % 4 != 0) continue;
            const glm::dvec2 center{(x + dx + pick(mix(h), 0.0, 1.0)) * cell,
                                    (y + dy + pick(mix(h + 1u), 0.0, 1.0)) * cell};
            const double radius = pick(mix(h + 2u), 0.06, 0.2) * cell;
            const double r = glm::length(p - center) / radius;
            depth = std::max(depth, 0.6 * radius * (1.0 - smooth_step(0.3, 1.0, r)));
        }
    return depth;
}

glm::vec3 stone_color(const stone& s) {
    constexpr std::array<glm::vec3, 8> tints{{{202, 182, 148},
                                              {190, 165, 128},
                                              {208, 190, 158},
                                              {178, 157, 128},
                                              {196, 173, 136},
                                              {184, 167, 142},
                                              {186, 154, 122},
                                              {172, 160, 142}}};
    const glm::vec3 srgb = tints[s.key(60) % tints.size()] / 255.0f;
    return to_linear(srgb) * float(s.random(61, 0.78, 1.1));
}

}  // namespace

stone_wall make_stone_wall() {
    const std::vector<stone> stones = lay_stones();
    stone_wall wall;
    wall.extent = {size, size};
    wall.height_scale = height_scale;
    wall.heights.resize(std::size_t(size) * size);
    wall.diffuse = image8(wall.extent, 3);
    const glm::vec3 mortar_color = to_linear(glm::vec3(176, 166, 150) / 255.0f);

    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const glm::dvec2 p{double(x), double(y)};
            // Masons lay by eye: everything is bent a little.
            const glm::dvec2 bent = p + glm::dvec2{5.0 * noise(p, 128, 1) + 2.0 * noise(p, 32, 2),
                                                   7.0 * noise(p, 128, 3) + 2.2 * noise(p, 32, 4)};
            const double chips = 1.6 * octaves(p, 16, 4, 0.6, 6);
            double inside = -1e9;
            const stone* nearest = nullptr;
            glm::dvec2 offset{0.0};
            for (const stone& s : stones) {
                glm::dvec2 d = bent - s.center;
                d.x -= size * std::round(d.x / size);
                d.y -= size * std::round(d.y / size);
                // Stones overlap no others, so one that is this far outside cannot be the nearest.
                if (std::abs(d.x) > s.half.x + 20.0 || std::abs(d.y) > s.half.y + 20.0) continue;
                const double depth = depth_inside(s, d, chips);
                if (depth <= inside) continue;
                inside = depth;
                nearest = &s;
                offset = d;
            }

            const double grain = octaves(p, 8, 2, 0.75, 40);
            const double mortar =
                5.5 + 1.3 * noise(p, 32, 50) + 0.9 * octaves(p, 8, 2, 0.8, 51) - 0.8 * pits(p, 16, 53);

            const double chamfer = nearest->random(10, 7.0, 14.0);
            const double t = std::clamp(inside / chamfer, 0.0, 1.0);
            const double rounding = std::pow(1.0 - (1.0 - t) * (1.0 - t), 0.62);
            const double rough = nearest->random(11, 0.5, 1.2);
            const double face = nearest->random(12, 15.0, 34.0) + split_face(*nearest, offset) +
                                rough * 3.2 * octaves(p, 64, 8, 0.55, 41 + nearest->id) + 0.55 * rough * grain -
                                rough * pits(p, 32, 42) - 0.8 * pits(p, 16, 43);
            const double rock = rounding * face;
            const double height = -smooth_min(-rock, -mortar, 1.5);
            const std::size_t i = std::size_t(y) * size + std::size_t(x);
            wall.heights[i] = std::uint16_t(std::lround(65535.0 * std::clamp(height / height_scale, 0.0, 1.0)));

            // Sandstone: bedding streaks, blotches, grain; darker where dust has settled in pits.
            const double streaks = noise(bent, 128, 8, 70 + nearest->id);
            const double blotches = octaves(p, 64, 16, 0.6, 90);
            const double shade = 1.0 + 0.09 * streaks + 0.1 * blotches + 0.07 * grain - 0.1 * pits(p, 32, 42);
            const float of_stone = float(smooth_step(-0.5, 1.5, rock - mortar));
            const glm::vec3 rock_color = stone_color(*nearest) * float(shade);
            const glm::vec3 joint_color = mortar_color * float(0.92 + 0.1 * blotches + 0.1 * grain);
            const glm::vec3 color = joint_color + (rock_color - joint_color) * of_stone;
            for (int c = 0; c < 3; ++c)
                wall.diffuse.at(x, y)[c] = bumpshadow::to_unorm8(bumpshadow::linear_to_srgb(color[c]));
        }
    return wall;
}

}  // namespace examples
