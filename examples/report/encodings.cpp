// What every encoding costs in memory and fetches, and how often it is wrong about what is lit.
//
// Lights are judged at the texels of a few patches: their share of wrong answers is that of the map within the
// confidence interval, which counts patches. What is left out of the product of all axes is said where the axes are
// (slice_product.hpp, cube_choices, series_choices).

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "common/choices.hpp"
#include "common/report_text.hpp"
#include "encodings/eight.hpp"
#include "encodings/series.hpp"
#include "encodings/stored.hpp"
#include "report/sections.hpp"
#include "report/slice_product.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr const char* section_name = "encoding";
constexpr double texels_of_a_map = 1024.0 * 1024.0;  // that share a factor cube
constexpr float infinite = std::numeric_limits<float>::infinity();

// A setup, what a record says about it besides, and whether it stands for its family.
struct choice {
    setup what;
    record about;
    bool is_default = false;
};

// Setups on one map, on all cores.
void add_all(std::span<const choice> choices, sampled_map& map) {
    for (const choice& c : choices) static_cast<void>(map.cut(c.what.side));  // which is no work for many threads
    std::vector<score> scores(choices.size());
    on_all_cores(choices.size(), [&](std::size_t i) {
        const setup& s = choices[i].what;
        scores[i] = s.measure({{}, {}}, {&map.cut(s.side), 1}).front();
    });
    for (std::size_t i = 0; i < choices.size(); ++i) {
        const choice& c = choices[i];
        if (c.is_default)
            map.add_with_elevations(c.about, scores[i], c.what.side, c.what.margin);
        else
            map.add(c.about, scores[i], c.what.side, c.what.margin);
    }
}

// The zero line: a surface without shadows.
void add_unshadowed(sampled_map& map) {
    const sample_map& sample = map.cut(patch_side);
    judge judge(sample, {});
    const std::vector<float> nothing(sample.texels());
    for (int b = 0; b < light_bearings; ++b) judge.look(b, nothing.data());
    record r;
    r.family = r.name = "no shadows";
    r[column::bytes] = 0.0;
    r[column::fetches] = 0.0;
    map.add_with_elevations(r, judge.result());
}

// ---- Eight horizons in two layers ----

// How horizons become the eight.
struct eight_kind {
    bs::horizon_scale scale;
    bool averaged;
};
constexpr std::array eight_kinds{
    eight_kind{{bs::quantity::sine, infinite}, true}, eight_kind{{bs::quantity::sine, infinite}, false},
    eight_kind{{bs::quantity::slope, 4.0f}, true}, eight_kind{{bs::quantity::slope, 4.0f}, false}};

choice eight_choice(const eight_kind& kind, int reduction, std::optional<bs::factor_cube> cube = {}) {
    eight_setup s;
    s.encoding.scale = kind.scale;
    s.averaged = kind.averaged;
    s.cube = cube;
    s.reduced = reduction;
    s.side = side_of(1, reduction);
    s.margin = margin_of(reduction);
    choice c{.what = eight(s), .about = {}};
    record& r = c.about;
    const bool sines = kind.scale.stored == bs::quantity::sine;
    r.family = cube ? "sine layers, factor cube" : "sine layers";
    r.name = c.what.name + (cube ? format(" of %d a side", cube->size) : std::string());
    r.format = "RGBA8";
    r.fit = kind.averaged ? "five averaged" : "least squares";
    r.quantity = name_of(kind.scale.stored);
    if (!cube)
        r.snippet = std::string("eight channels, no cube, ") + (sines ? "sines, soft" : "slopes, soft");
    else
        r.snippet =
            std::string("eight channels, ") +
            (cube->form == bs::factor_form::published ? "published cube, sines, soft" : "biased cube, sines, soft");
    r[column::bearings] = 8.0;
    r[column::reduction] = reduction;
    if (cube) r[column::cube_side] = cube->size;
    r[column::bytes] = c.what.bytes + (cube ? double(bs::layout_of(*cube).required_size()) / texels_of_a_map : 0.0);
    r[column::fetches] = c.what.fetches;
    const bool published_cube = cube && cube->size == 16 && cube->form == bs::factor_form::published;
    c.is_default = sines && kind.averaged && reduction == 1 && (!cube || published_cube);
    return c;
}

std::vector<choice> eight_choices(const slice_axes& axes) {
    std::vector<choice> all;
    for (const int reduction : axes.reductions)
        for (const eight_kind& kind : eight_kinds) all.push_back(eight_choice(kind, reduction));
    return all;
}

// A cube is read before the horizons and does not know their extent: sizes of it are compared at full extent alone.
std::vector<choice> cube_choices(bool quick) {
    const std::vector<int> sides = quick ? std::vector{4, 16, 64} : std::vector{4, 8, 16, 32, 64};
    std::vector<choice> all;
    for (const bs::factor_form form : {bs::factor_form::published, bs::factor_form::biased})
        for (const int side : sides) all.push_back(eight_choice(eight_kinds.front(), 1, bs::factor_cube{side, form}));
    return all;
}

// ---- Fourier series ----

constexpr std::array coefficient_counts{3, 5, 7, 9};

std::string series_snippet(const bs::fourier& e) {
    const bool sines = e.scale.stored == bs::quantity::sine;
    const std::string start = format("Fourier, %d", e.coefficients);
    if (e.scale.stored == bs::quantity::slope && !e.square_root) return start + ", soft";
    if (e.coefficients != 5 || sines == e.square_root) return {};
    return start + (sines ? " of sines, soft" : ", roots, soft");
}

choice series_choice(const series_setup& s) {
    choice c{.what = series(s), .about = {}};
    record& r = c.about;
    r.family = format("Fourier series, %d bits", s.encoding.bits);
    r.name = c.what.name;
    r.format = format("unorm%d", s.encoding.bits);
    r.quantity = name_of(s.encoding.scale.stored);
    r.snippet = series_snippet(s.encoding);
    r[column::coefficients] = s.encoding.coefficients;
    r[column::reduction] = s.reduced;
    r[column::bytes] = c.what.bytes;
    r[column::fetches] = c.what.fetches;
    c.is_default = s.encoding.coefficients == 5 && s.encoding.scale.stored == bs::quantity::slope &&
                   !s.encoding.square_root && s.tightened && s.reduced == 1;
    return c;
}

// 16 bits at full extent alone: smaller textures blur more than 8 bits round.
std::vector<choice> series_choices(const slice_axes& axes, bool quick, int coefficients) {
    std::vector<choice> all;
    for (const int bits : {8, 16})
        for (const int reduction : axes.reductions)
            for (const bs::horizon_scale& scale : axes.scales)
                for (const bool root : {false, true})
                    for (const bool tightened : {true, false}) {
                        if (bits == 16 && (reduction > 1 || quick)) continue;
                        series_setup s;
                        s.encoding.coefficients = coefficients;
                        s.encoding.scale = scale;
                        s.encoding.bits = bits;
                        s.encoding.square_root = root;
                        s.tightened = tightened;
                        s.reduced = reduction;
                        s.side = side_of(1, reduction);
                        s.margin = margin_of(reduction);
                        all.push_back(series_choice(s));
                    }
    if (coefficients == 5) all.push_back(series_choice({bs::fourier_as_posted(), false, true}));
    return all;
}

// ---- All of it ----

void measure(const report_context& context, const report_map& from) {
    const slice_axes axes = slice_axes_of(context.quick);
    const codecs programs;
    sample_map sample = *sample_of(context, from);
    for (const bs::bearing_function function : axes.functions)
        if (function != bs::bearing_function::exact)
            add_slices(sample, named(from), function, [&] { context.step("exact horizons of " + from.name); });
    sampled_map map(context, section_name, std::move(sample));

    add_unshadowed(map);
    add_all(eight_choices(axes), map);
    context.step("sine layers of " + from.name);
    add_all(cube_choices(context.quick), map);
    context.step("factor cubes of " + from.name);
    for (const int coefficients : coefficient_counts) {
        add_all(series_choices(axes, context.quick, coefficients), map);
        context.step("Fourier series of " + from.name);
    }
    add_volumes(context, axes, map);
    add_layers(context, axes, programs, map);
}

int steps_of(const report_context& context, const report_map& map) {
    const slice_axes axes = slice_axes_of(context.quick);
    int baked = 1;
    for (const bs::bearing_function function : axes.functions) baked += function != bs::bearing_function::exact ? 1 : 0;
    return sampled_patches(context, map) * baked + 2 + int(coefficient_counts.size()) + volume_steps(axes) +
           layer_steps(axes, {});
}

}  // namespace

report_section encoding_section() {
    return section_of({.name = section_name,
                       .title = "Encodings: wrong answers about what is lit, over exact horizons",
                       .steps = steps_of,
                       .seconds = 40.0,
                       .quick_seconds = 4.0,
                       .measure = measure});
}

}  // namespace examples
