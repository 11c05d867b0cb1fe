#include "report/slice_product.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

#include "common/choices.hpp"
#include "common/report_text.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

const char* word_of(bs::slice_fit fit) {
    switch (fit) {
        case bs::slice_fit::point: return "point";
        case bs::slice_fit::least_squares: return "least squares";
        case bs::slice_fit::least_angle: break;
    }
    return "least angle";
}

}  // namespace

slice_axes slice_axes_of(bool quick) {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    using enum bs::quantity;
    using enum bs::bearing_function;
    using enum bs::slice_fit;
    const bs::horizon_scale slopes{slope, 4.0f}, sines{sine, infinite}, angles{angle, infinite};
    slice_axes axes;
    axes.counts = {4, 8, 16, 32};
    axes.overlapping = {12, 24};
    axes.blocks = {4, 5, 6};
    if (quick) {
        axes.reductions = {1, 2};
        axes.scales = {slopes, sines};
        axes.functions = {cubic};
        axes.fits = {point, least_squares};
        axes.layer_reductions = {1};
        axes.layer_scales = {slopes};
        axes.layer_fits = {least_squares};
    } else {
        axes.reductions = axes.layer_reductions = {1, 2, 4, 8};
        axes.scales = axes.layer_scales = {slopes, sines, angles};
        axes.functions = {exact, quintic, cubic, octant, diamond};
        axes.fits = axes.layer_fits = {point, least_squares, least_angle};
    }
    return axes;
}

bool picks_points(const std::vector<bs::slice_fit>& fits) {
    return std::find(fits.begin(), fits.end(), bs::slice_fit::point) != fits.end();
}

int side_of(int block, int reduction, int most) { return most / (block * reduction) * (block * reduction); }

int margin_of(int reduction) { return reduction / 2; }

bool is_default(const slice_choice& c) {
    return (c.count == 8 || c.count == 12) && c.fit == bs::slice_fit::least_squares && c.function == layer_function &&
           c.scale.stored == bs::quantity::slope && c.reduction == 1;
}

void describe(record& r, const slice_choice& c, const std::string& kind) {
    r.fit = word_of(c.fit);
    r.function = word_of(bearing_function_names, c.function);
    r.quantity = name_of(c.scale.stored);
    r.name =
        format("%d %s, %s%s, %s, %s, %s%s", c.count, kind.c_str(), r.quantity.c_str(), name_of_limit(c.scale).c_str(),
               r.fit.c_str(), r.function.c_str(), r.format.c_str(), words_of_reduction(c.reduction).c_str());
    r[column::bearings] = c.count;
    r[column::reduction] = c.reduction;
}

std::string words_of_reduction(int reduction) {
    return reduction > 1 ? format(", extent / %d", reduction) : std::string();
}

slice_source::slice_source(const sample_map& map, const bs::horizon_scale& scale, int reduction)
    : map_(map), scale_(scale), reduction_(reduction), all_(made_small(map.every(light_bearings), all_memory_)) {}

void slice_source::prepare_points(bs::bearing_function function) {
    points_ = made_small(map_.slices_of(function, function_slices), points_memory_);
}

planes slice_source::fit(const slice_choice& choice) const {
    const bs::slice_set set{choice.count, 0.0, choice.function};
    if (choice.fit != bs::slice_fit::point) return fit_planes(all_, map_.directions, set, scale_, choice.fit);
    std::vector<glm::dvec2> directions(std::size_t(choice.count));
    bs::fill_directions(directions, 0.0, choice.function);
    bs::horizon_map some = points_;
    some.slice_stride = some.slice_step() * std::size_t(function_slices / choice.count);
    some.bearings = choice.count;
    return fit_planes(some, directions, set, scale_, choice.fit);
}

bs::horizon_map slice_source::made_small(const bs::horizon_map& slopes, horizons& memory) const {
    if (reduction_ == 1) return slopes;
    memory = reduced(slopes, scale_, reduction_);
    return memory.view;
}

}  // namespace examples
