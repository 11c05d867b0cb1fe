#include "encodings/speed.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/stb_blocks.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/progress.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr int directions = 32;

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

template <class Work>
double time_of(Work&& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// Packs one kind of texture again and again, into the same memory.
class packer {
public:
    packer(const bs::horizon_map& slopes, std::span<const glm::dvec2> ways, int slices, bs::texel_format format,
           bs::slice_fit fit)
        : slopes_(slopes), ways_(ways), fit_(fit) {
        encoding_.slices.count = slices;
        encoding_.format = format;
        layout_ = bs::layout_of(encoding_, slopes.extent);
        bytes_.resize(layout_.required_size());
        scratch_.resize(bs::slice_scratch_size(slopes.extent, ways.size(), slices));
    }
    void operator()() {
        bs::pack_options options;
        options.fit = fit_;
        options.scratch = scratch_;
        require(bs::pack_tangent_volume(slopes_, ways_, encoding_, options, {bytes_, layout_}));
    }
    [[nodiscard]] const bs::tangent_volume& encoding() const { return encoding_; }
    [[nodiscard]] bs::const_texture texture() const { return {bytes_, layout_}; }

private:
    const bs::horizon_map& slopes_;
    std::span<const glm::dvec2> ways_;
    bs::slice_fit fit_;
    bs::tangent_volume encoding_;
    bs::texture_layout layout_;
    std::vector<std::byte> bytes_, scratch_;
};

}  // namespace

speeds measure_speed(const height_samples& heights, const height_source& source, double height_scale, int repeats) {
    const glm::ivec2 extent = heights.extent;
    std::vector<glm::dvec2> ways(directions);
    bs::fill_directions(ways);
    std::vector<float> values(bs::required_size(extent, directions));
    const bs::horizon_map slopes{.values = values, .extent = extent, .bearings = directions};

    const auto bake = [&] {
        with_height_map(heights, source, height_scale,
                        [&](const auto& view) { require(bs::bake_cascade(view, ways, slopes)); });
    };
    bake();
    // What is packed, for the bars and for the shading first.
    struct kind {
        const char* what;
        packer pack;
        std::vector<double> times = {}, shares = {};
    };
    const auto kind_of = [&](const char* what, int count, bs::texel_format format, bs::slice_fit fit) {
        return kind{what, packer(slopes, ways, count, format, fit)};
    };
    using enum bs::texel_format;
    using enum bs::slice_fit;
    std::array kinds{kind_of("8 slices in R8 fitted to them by angle", 8, r8, least_angle),
                     kind_of("8 slices in R8 fitted to them", 8, r8, least_squares),
                     kind_of("16 slices in R8 fitted to them by angle", 16, r8, least_angle),
                     kind_of("16 slices in R8 fitted to them", 16, r8, least_squares),
                     kind_of("16 slices in BC4 fitted to them by angle", 16, bc4, least_angle),
                     kind_of("16 slices in BC4 fitted to them", 16, bc4, least_squares)};
    for (kind& k : kinds) k.pack();
    std::vector<float> picture(3 * std::size_t(extent.x) * std::size_t(extent.y));
    const bs::encoded_shadow<bs::tangent_volume> shadow{.encoding = kinds[0].pack.encoding(),
                                                        .textures = kinds[0].pack.texture()};
    bs::shade_options light;
    light.light.direction = {0.8f, 0.5f, 0.4f};
    const auto shade = [&] { require(bs::shade(light, shadow, bs::flat_surface{extent}, {picture, extent})); };
    shade();

    std::vector<float> normal_values(3 * std::size_t(extent.x) * std::size_t(extent.y));
    const bs::normal_map normals{.values = normal_values, .extent = extent};
    with_height_map(heights, source, height_scale, [&](const auto& view) { require(bs::bake_normals(view, normals)); });
    const bs::texture_layout layout = bs::layout_of(bs::ssbump{}, extent);
    std::vector<std::byte> masks(layout.required_size());
    const auto mask = [&] { require(bs::pack_ssbump(slopes, ways, normals, {}, {masks, layout})); };
    mask();

    // By turns, so that a machine that becomes slower or faster meanwhile does not matter to the shares.
    std::vector<double> bakes, shades, maskings;
    for (int i = 0; i < repeats; ++i) {
        if (stderr_is_terminal()) std::fprintf(stderr, "\rspeed: %d of %d\033[K", i + 1, repeats);
        bakes.push_back(time_of(bake));
        for (kind& k : kinds) {
            k.times.push_back(time_of(k.pack));
            k.shares.push_back(k.times.back() / bakes.back());
        }
        shades.push_back(time_of(shade));
        maskings.push_back(time_of(mask));
    }
    if (stderr_is_terminal()) std::fputs("\r\033[K", stderr);

    const double texels = double(extent.x) * double(extent.y);
    const auto nanoseconds = [&](const std::vector<double>& times) { return median(times) * 1e9 / texels; };
    speeds result;
    result.pack_share = median(kinds[0].shares);
    result.shade_rate = 1e-6 * texels / median(shades);
    result.figures = {{"bake of 32 directions, ns a texel", nanoseconds(bakes)}};
    for (const kind& k : kinds) {
        result.figures.push_back({std::string(k.what) + ", ns a texel", nanoseconds(k.times)});
        result.figures.push_back({"the same as a share of the bake", median(k.shares)});
    }
    result.figures.push_back({"SSBump masks from 32 directions, ns a texel", nanoseconds(maskings)});
    result.figures.push_back({"shading with one light and 8 slices in R8, million texels a second", result.shade_rate});
    return result;
}

}  // namespace examples
