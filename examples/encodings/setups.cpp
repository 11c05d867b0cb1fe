#include "encodings/setups.hpp"

#include <limits>
#include <utility>

#include "encodings/eight.hpp"
#include "encodings/series.hpp"
#include "encodings/slices.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

// A setup of slices in few words.
volume_setup slices(int count, bs::texel_format format, int directions, float max_slope = 4.0f,
                    bs::quantity stored = bs::quantity::slope) {
    volume_setup s;
    s.encoding.slices.count = count;
    s.encoding.scale = {stored, max_slope};
    s.encoding.format = format;
    s.directions = directions;
    return s;
}

layers_setup grouped_slices(int count, bs::slice_grouping grouping, std::optional<codec> compressed = {},
                            const std::string& block = {}, bs::horizon_scale scale = {}) {
    layers_setup s;
    s.encoding.slices.count = count;
    s.encoding.grouping = grouping;
    s.encoding.scale = scale;
    s.compressed = compressed;
    s.block = block;
    return s;
}

}  // namespace

std::vector<section> all_setups() {
    using enum bs::texel_format;
    using enum bs::quantity;
    using enum bs::slice_grouping;
    using enum bs::slice_fit;
    constexpr float infinite = std::numeric_limits<float>::infinity();
    std::vector<section> all;

    constexpr std::optional<double> no_bar;
    section published{"As published", {published_sine_layers()}};
    for (const bs::quantity q : {sine, slope, angle}) {
        volume_setup s = slices(8, r8, 8, q == slope ? 4.0f : infinite, q);
        s.fit = point;
        published.setups.push_back(volume(s));
    }
    for (const bs::factor_form form : {bs::factor_form::published, bs::factor_form::biased}) {
        eight_setup s;
        s.cube = bs::factor_cube{16, form};
        published.setups.push_back(eight(s));
    }
    published.setups.push_back(series({bs::fourier_as_posted(), false, true}));
    all.push_back(published);

    section fitted{"Slices of one channel, fitted", {}};
    for (const bs::slice_fit fit : {least_squares, least_angle}) {
        const auto add = [&](int count, bs::texel_format format, int directions, std::optional<double> most = {},
                             bs::horizon_scale scale = {}) {
            volume_setup s = slices(count, format, directions, scale.max_slope, scale.stored);
            s.fit = fit;
            fitted.setups.push_back(volume(s, most));
        };
        const std::optional<double> most = fit == least_angle ? std::optional(0.66) : std::nullopt;
        add(8, r8, 32, most);
        add(8, r8, 96, most);
        for (const int n : {16, 32}) add(n, r8, 96);
        for (const int n : {8, 16, 32}) add(n, r16, 96);
        for (const bs::quantity q : {sine, angle})
            for (const int n : {8, 16, 32}) add(n, r8, 96, {}, {q, infinite});
    }
    eight_setup eight_slopes;
    eight_slopes.encoding.scale = {slope, 4.0f};
    eight_slopes.averaged = false;
    fitted.setups.push_back(eight(eight_slopes));
    all.push_back(fitted);

    section blocks{"BC4", {}};
    for (const bs::slice_fit fit : {least_squares, least_angle})
        for (const auto& [count, most] :
             {std::pair{8, std::optional(0.72)}, std::pair{16, std::optional(0.42)}, std::pair{32, no_bar}}) {
            volume_setup s = slices(count, bc4, 96);
            s.fit = fit;
            blocks.setups.push_back(volume(s, most));
        }
    for (const int n : {8, 16, 32}) {
        volume_setup s = slices(n, bc4, 96);
        s.blocks = block_encoder::stb;
        blocks.setups.push_back(volume(s));
    }
    for (const bs::quantity q : {sine, angle})
        for (const int n : {8, 16, 32}) blocks.setups.push_back(volume(slices(n, bc4, 96, infinite, q)));
    all.push_back(blocks);

    section limits{"What stands for 1", {}};
    for (const auto& [count, stored_as] : {std::pair{8, r8}, std::pair{16, r8}, std::pair{16, bc4}}) {
        limits.setups.push_back(volume(slices(count, stored_as, 96, 2.0f)));
        volume_setup s = slices(count, stored_as, 96);
        for (const ceiling c : {ceiling::steepest, ceiling::best}) {
            s.most = c;
            limits.setups.push_back(volume(s));
        }
    }
    all.push_back(limits);

    section grouped{"Slices in the channels of layers", {}};
    for (const int n : {8, 16, 32}) grouped.setups.push_back(layers(grouped_slices(n, four)));
    for (const int n : {12, 24}) grouped.setups.push_back(layers(grouped_slices(n, overlapping)));
    const auto bar = [](int n, const std::string& block) -> std::optional<double> {
        if (n == 32 && block == "4x4") return 0.37;
        if (n == 16 && block == "4x4") return 0.55;
        if (n == 8 && block == "4x4") return 0.85;
        if (n == 8 && block == "5x5") return 1.0;
        return std::nullopt;
    };
    for (const int n : {8, 16, 32})
        for (const char* block : {"4x4", "5x5", "6x6", "8x8"})
            grouped.setups.push_back(layers(grouped_slices(n, four, codec::astc, block), bar(n, block)));
    for (const int n : {12, 24})
        for (const char* block : {"4x4", "5x5", "6x6"})
            grouped.setups.push_back(layers(grouped_slices(n, overlapping, codec::astc, block)));
    for (const auto& [n, block] :
         {std::pair{32, "4x4"}, std::pair{16, "4x4"}, std::pair{24, "5x5"}, std::pair{24, "10x5"}, std::pair{16, "6x6"},
          std::pair{16, "10x5"}, std::pair{8, "5x5"}, std::pair{16, "8x8"}})
        grouped.setups.push_back(layers(grouped_slices(n, four, codec::astc, block, {sine, infinite})));
    for (const int n : {12, 24})
        grouped.setups.push_back(layers(grouped_slices(n, overlapping, codec::astc, "4x4", {sine, infinite})));
    for (const int n : {8, 16, 32}) grouped.setups.push_back(layers(grouped_slices(n, four, codec::bc7)));
    for (const int n : {12, 24}) grouped.setups.push_back(layers(grouped_slices(n, overlapping, codec::bc7)));
    for (const int n : {8, 16, 32})
        grouped.setups.push_back(layers(grouped_slices(n, four, codec::bc7, {}, {sine, infinite})));
    all.push_back(grouped);

    section fourier{"Fourier series", {}};
    const auto add_series = [&](int coefficients, bs::horizon_scale scale, bool root, bool tightened,
                                std::optional<double> most = {}) {
        series_setup s;
        s.encoding.coefficients = coefficients;
        s.encoding.scale = scale;
        s.encoding.square_root = root;
        s.tightened = tightened;
        fourier.setups.push_back(series(s, most));
    };
    for (const int n : {3, 5, 7, 9}) {
        add_series(n, {slope, 4.0f}, false, true, n == 5 ? std::optional(1.0) : std::nullopt);
        add_series(n, {slope, 4.0f}, true, true);
        add_series(n, {slope, 4.0f}, false, false);
        add_series(n, {slope, 2.0f}, false, true);
        add_series(n, {sine, infinite}, false, true);
        add_series(n, {sine, infinite}, true, true);
        add_series(n, {sine, infinite}, false, false);
    }
    all.push_back(fourier);

    section reduced{"Less extent", {}};
    for (const int factor : {2, 4, 8})
        for (const auto& [count, stored_as] : {std::pair{8, r8}, std::pair{16, bc4}, std::pair{32, r8}}) {
            volume_setup s = slices(count, stored_as, 96);
            s.reduced = factor;
            reduced.setups.push_back(volume(s));
        }
    all.push_back(reduced);
    return all;
}

}  // namespace examples
