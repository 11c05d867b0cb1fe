#include <array>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <vector>

#include <bumpshadow/bumpshadow.hpp>

// What a program of someone else does with the library, from heights to a lit picture. It prints one line for each
// step: the same numbers, whichever road the library came by.

namespace {

int failures = 0;

void require(const bumpshadow::status& s, const char* what) {
    if (s) return;
    ++failures;
    std::printf("%s: %s\n", what, s.message().c_str());
}

// The mean of all, and their mean with weights that grow, so that the order counts.
template <class Values>
void print(const char* what, const Values& values) {
    double sum = 0.0, ordered = 0.0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        sum += double(values[i]);
        ordered += double(values[i]) * double(i % 61);
    }
    const double count = double(values.size());
    std::printf("%s: %.5f %.5f\n", what, sum / count, ordered / count);
}

// A wall two texels high stands at the last column: from three columns away its horizon has the slope 2 / 3.
void wall() {
    const glm::ivec2 extent{4, 3};
    const std::array<float, 12> samples{0, 0, 0, 2, 0, 0, 0, 2, 0, 0, 0, 2};
    std::array<float, 24> slopes{};
    std::array<glm::dvec2, 2> directions{};
    bumpshadow::fill_directions(directions);

    auto heights = bumpshadow::tight_height_map(samples.data(), extent);
    heights.edge = bumpshadow::edge_mode::clamp;
    const bumpshadow::horizon_map out{.values = slopes, .extent = extent, .bearings = 2};
    require(bumpshadow::bake_cascade(heights, directions, out, {}, bumpshadow::threads(2)), "wall");
    const auto bad = bumpshadow::bake_cascade(heights, directions, out, {.steps = 0});
    std::printf("wall: %.5f %.5f; %s\n", double(slopes[0]), double(slopes[12]), bad.message().c_str());
    if (bad || !(std::abs(slopes[0] - 2.0f / 3.0f) < 1e-5f) || !(std::abs(slopes[12]) < 1e-5f)) ++failures;
}

}  // namespace

int main() {
    wall();

    const glm::ivec2 extent{32, 16};
    constexpr std::size_t texels = 512;
    std::vector<float> samples(texels);
    for (std::size_t i = 0; i < texels; ++i) samples[i] = float(i * i % 37) / 64.0f;
    auto heights = bumpshadow::tight_height_map(samples.data(), extent);
    heights.height_scale = 4.0;
    heights.texel_size = {1.0, 1.5};

    std::vector<glm::dvec2> directions(16);
    bumpshadow::fill_directions(directions);
    std::vector<float> slopes(bumpshadow::required_size(extent, 16)), exact(slopes.size());
    const bumpshadow::horizon_map horizons{.values = slopes, .extent = extent, .bearings = 16};
    const bumpshadow::horizon_map judge{.values = exact, .extent = extent, .bearings = 16};
    bumpshadow::bake_options options;
    options.curvature = {0.01, 0.02};
    require(bumpshadow::bake_cascade(heights, directions, horizons), "cascade");
    require(bumpshadow::bake_exact(heights, directions, judge, options), "exact");
    print("cascade", slopes);
    print("exact on a curved base", exact);
    require(bumpshadow::bake_sweep(heights, directions, judge), "sweep");
    print("sweep", exact);

    bumpshadow::tangent_volume volume;
    volume.scale.max_slope = bumpshadow::suggest_max_slope(horizons);
    const auto layout = layout_of(volume, extent);
    std::vector<std::byte> bytes(layout.required_size());
    const bumpshadow::texture texture{bytes, layout};
    require(pack_tangent_volume(horizons, directions, volume, {}, texture), "tangent volume");
    std::vector<int> stored;
    for (const std::byte b : bytes) stored.push_back(int(b));
    print("tangent volume", stored);

    std::vector<float> normals(3 * texels), picture(3 * texels);
    require(bumpshadow::bake_normals(heights, {.values = normals, .extent = extent}), "normals");
    print("normals", normals);

    bumpshadow::shade_options how;
    how.light.direction = {0.6f, 0.3f, 0.4f};
    how.normals = {.values = normals, .extent = extent};
    how.specular = glm::vec3(0.25f);
    const bumpshadow::encoded_shadow<bumpshadow::tangent_volume> shadow{volume, texture};
    require(shade(how, shadow, bumpshadow::flat_surface{extent}, {.values = picture, .extent = extent}), "picture");
    print("picture", picture);

    bumpshadow::ssbump masks;
    std::vector<std::byte> mask_bytes(layout_of(masks, extent).required_size());
    require(pack_ssbump(horizons, directions, {.values = normals, .extent = extent}, masks,
                        {mask_bytes, layout_of(masks, extent)}),
            "masks");
    stored.clear();
    for (const std::byte b : mask_bytes) stored.push_back(int(b));
    print("masks", stored);
    return failures == 0 ? 0 : 1;
}
