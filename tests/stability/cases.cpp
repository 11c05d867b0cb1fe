#include "stability/cases.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <utility>

namespace stability {
namespace {

using bumpshadow::edge_mode;

// No multiple of what cells are wide, so that coarse levels have to continue or resample it.
constexpr glm::ivec2 usual{160, 144};

template <class Height>
stiff_map made(const Height& height, glm::ivec2 extent = usual) {
    stiff_map map;
    map.extent = extent;
    map.heights.reserve(std::size_t(extent.x) * std::size_t(extent.y));
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) map.heights.push_back(height(x, y));
    return map;
}

// In [0, 1), by SplitMix64 (Steele, Lea and Flood 2014).
double random_at(int x, int y) {
    std::uint64_t z = (std::uint64_t(std::uint32_t(x)) << 32 | std::uint32_t(y)) + 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
}

// From -6 to 6; tiles.
double waves(int x, int y) {
    const double u = 2.0 * std::numbers::pi * x / usual.x, v = 2.0 * std::numbers::pi * y / usual.y;
    return 2.0 * std::sin(4.0 * u) + 3.0 * std::cos(3.0 * v + u) + std::sin(7.0 * u - 5.0 * v);
}

double cliff(int x, int) { return x < 80 ? 0.0 : 1.0; }
double spike(int x, int y) { return x == 70 && y == 60 ? 1.0 : 0.0; }

stiff_map scaled(stiff_map map, double heights) {
    map.height_scale = heights;
    map.slope_unit = std::max(1.0, std::abs(heights));
    return map;
}
stiff_map in_units(stiff_map map, double heights, glm::dvec2 texels) {
    map.height_scale = heights;
    map.texel_size = texels;
    map.slope_unit = std::max(1.0, heights / texels.x);
    return map;
}
stiff_map with(stiff_map map, const bumpshadow::bake_options& options) {
    map.options = options;
    return map;
}
stiff_map with(stiff_map map, edge_mode edge) {
    map.edge = edge;
    return map;
}
stiff_map in_double(stiff_map map) {
    map.as_double = true;
    return map;
}

template <class Height>
stiff_case plain(std::string name, Height height, std::vector<exception> exceptions = {}) {
    return {std::move(name), [height] { return made(height); }, std::move(exceptions)};
}

const std::string narrow = "what occludes is narrower than the cells that look for it";
const std::string between = "what occludes lies between the points that hulls stand on";

std::vector<stiff_case> shapes() {
    std::vector<stiff_case> all;
    all.push_back(plain("smooth waves", waves));
    all.push_back(plain("cliff, 1 texel", cliff));
    all.push_back({"cliff, 10^6 texels", [] { return scaled(made(cliff), 1e6); }});
    all.push_back({"oblique cliff, 10^6 texels", [] {
                       return with(scaled(made([](int x, int y) { return 3 * x + 2 * y < 300 ? 0.0 : 1.0; }), 1e6),
                                   edge_mode::clamp);
                   }});
    all.push_back(
        plain("spike, 20 texels", [](int x, int y) { return 20.0 * spike(x, y); }, {{fine, {0.32, 2.7}, narrow}}));
    all.push_back({"spike, 10^6 texels", [] { return scaled(made(spike), 1e6); }});
    all.push_back(plain("pit, 20 texels", [](int x, int y) { return -20.0 * spike(x, y); }));
    all.push_back({"pit, 10^6 texels", [] { return scaled(made(spike), -1e6); }});
    all.push_back(plain("checkerboard, 1 texel", [](int x, int y) { return double((x + y) % 2); }));
    all.push_back({"checkerboard, 1000 texels",
                   [] { return scaled(made([](int x, int y) { return double((x + y) % 2); }), 1000.0); }});
    all.push_back(plain("sawtooth, 8 texels", [](int x, int) { return double(x % 8); },
                        {{cascade, {0.66, 11.2}, narrow}, {fine, {0.15, 2.6}, narrow}, {sweep, {0.25, 6.7}, between}}));
    all.push_back(plain("steep sawtooth, 5 texels", [](int x, int) { return 3.0 * (x % 5); },
                        {{cascade, {1.2, 20.0}, narrow}, {fine, {0.29, 6.0}, narrow}, {sweep, {0.34, 7.8}, between}}));
    all.push_back(plain("needles, 1 in 500", [](int x, int y) { return random_at(x, y) < 0.002 ? 30.0 : 0.0; },
                        {{cascade, {7.3, 41.0}, narrow}, {fine, {3.2, 18.0}, narrow}, {sweep, {2.3, 23.0}, between}}));
    all.push_back(plain("white noise", [](int x, int y) { return 10.0 * random_at(x, y); },
                        {{cascade, {0.36, 7.2}, narrow}, {sweep, {0.4, 9.5}, between}}));
    all.push_back(
        plain("plateaus", [](int x, int y) { return std::floor(waves(x, y)); }, {{sweep, {0.11, 2.8}, between}}));
    all.push_back(plain("8-bit stairs",
                        [](int x, int y) { return std::round((waves(x, y) + 6.0) / 12.0 * 255.0) / 255.0 * 12.0; }));
    all.push_back({"8-bit stairs, in bytes", [] {
                       stiff_map map =
                           made([](int x, int y) { return std::round((waves(x, y) + 6.0) / 12.0 * 255.0) / 255.0; });
                       map.height_scale = 12.0;
                       map.as_bytes = true;
                       return map;
                   }});
    return all;
}

// Where a stiff surface meets its reflection, or ends.
std::vector<stiff_case> borders() {
    std::vector<stiff_case> all;
    for (const edge_mode edge : {edge_mode::mirror, edge_mode::open}) {
        const std::string text = edge == edge_mode::mirror ? ", mirrored" : ", open";
        all.push_back({"cliff, 10^6 texels" + text, [=] { return with(scaled(made(cliff), 1e6), edge); }});
        all.push_back({"pit, 10^6 texels" + text, [=] { return with(scaled(made(spike), -1e6), edge); }});
        all.push_back({"checkerboard, 1000 texels" + text, [=] {
                           return with(scaled(made([](int x, int y) { return double((x + y) % 2); }), 1000.0), edge);
                       }});
        all.push_back({"steep sawtooth, 5 texels" + text,
                       [=] { return with(made([](int x, int) { return 3.0 * (x % 5); }), edge); },
                       {{cascade, {1.2, 20.0}, narrow}, {fine, {0.29, 6.0}, narrow}, {sweep, {0.34, 7.8}, between}}});
    }
    return all;
}

double rippled(int x, int y) { return 0.5 * x + 1e-6 * std::sin(1.7 * x + 0.9 * y); }
double detail(int x, int y) { return 1e7 + 1e-3 * waves(x, y); }

std::vector<stiff_case> offsets() {
    std::vector<stiff_case> all;
    all.push_back({"slope with ripples of 10^-6", [] { return with(made(rippled), edge_mode::clamp); }});
    all.push_back({"the same in double", [] { return in_double(with(made(rippled), edge_mode::clamp)); }});
    all.push_back({"detail of 0.001 at 10^7", [] { return made(detail); }});
    all.push_back({"the same in double", [] { return in_double(made(detail)); }});
    all.push_back(
        {"waves at 10^7, in double", [] { return in_double(made([](int x, int y) { return 1e7 + waves(x, y); })); }});
    return all;
}

std::vector<stiff_case> scales() {
    std::vector<stiff_case> all;
    for (const int power : {-30, -20, -12, 12, 20, 30}) {
        const double size = std::pow(10.0, power);
        const std::string text = "10^" + std::to_string(power);
        all.push_back({"heights in " + text, [=] { return in_units(made(waves), size, {1.0, 1.0}); }});
        all.push_back({"texels of " + text, [=] { return in_units(made(waves), 1.0, {size, size}); }});
        all.push_back({"both in " + text, [=] { return in_units(made(waves), size, {size, size}); }});
        all.push_back({"samples and texels in " + text, [=] {
                           stiff_map map = made([=](int x, int y) { return size * waves(x, y); });
                           map.texel_size = {size, size};
                           return map;
                       }});
    }
    // Below the least normal float: with denormals flushed all of it is flat, and 10^-39 degrees off.
    all.push_back({"samples in 10^-40", [] { return made([](int x, int y) { return 1e-40 * waves(x, y); }); }});
    all.push_back({"samples and texels in 10^-40, in double", [] {
                       stiff_map map = in_double(made([](int x, int y) { return 1e-40 * waves(x, y); }));
                       map.texel_size = {1e-40, 1e-40};
                       return map;
                   }});
    all.push_back(plain("hills on a plain of 10^-41", [](int x, int y) { return std::max(waves(x, y), 1e-41); }));
    all.push_back({"height scale 0", [] { return scaled(made(waves), 0.0); }});
    all.push_back({"height scale -1", [] { return scaled(made(waves), -1.0); }});
    all.push_back({"texels 1 : 1000", [] { return in_units(made(waves), 1.0, {1.0, 1000.0}); }});
    all.push_back({"texels 1000 : 1", [] { return in_units(made(waves), 1.0, {1000.0, 1.0}); }});
    all.push_back({"texels 1 : 1000, heights of 300",
                   [] {
                       stiff_map map = made(waves);
                       map.height_scale = 300.0;
                       map.texel_size = {1.0, 1000.0};
                       return map;
                   },
                   {{cascade, {0.76, 24.0}, narrow}, {fine, {0.25, 5.4}, narrow}}});
    return all;
}

std::vector<stiff_case> bases() {
    std::vector<stiff_case> all;
    const auto add = [&](std::string name, const bumpshadow::bake_options& options) {
        all.push_back({std::move(name), [=] { return with(made(waves), options); }});
    };
    add("curvature 10^-30", {.curvature = {1e-30, 1e-30}});
    add("curvature 10^-6", {.curvature = {1e-6, 1e-6}});
    add("curvature 0.01", {.curvature = {0.01, 0.01}});
    add("a cylinder that closes", {.curvature = {2.0 * std::numbers::pi / usual.x, 0.0}});
    add("curvature 10", {.curvature = {10.0, 10.0}});
    add("curvature 10^20", {.curvature = {1e20, 1e20}});
    add("hollow base, radius 50", {.radius = 50.0, .curvature = {-0.01, -0.01}});
    for (const double radius : {1e-30, 1e-6, 0.5, 1.0, 3.3, 1e30})
        add("radius " + std::to_string(radius).substr(0, 8), {.radius = radius});
    return all;
}

}  // namespace

std::vector<stiff_case> all_cases() {
    std::vector<stiff_case> all = shapes();
    for (const auto& more : {borders(), offsets(), scales(), bases()}) all.insert(all.end(), more.begin(), more.end());
    return all;
}

}  // namespace stability
