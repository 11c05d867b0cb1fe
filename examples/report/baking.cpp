#include "report/baking.hpp"

#include <algorithm>
#include <chrono>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>

#include "common/progress.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

bs::bake_options options_of(const bake_setup& setup, const height_source& source) {
    bs::bake_options options;
    options.steps = setup.steps;
    options.radius = setup.radius * source.texel_size.x;
    return options;
}

}  // namespace

baker::baker(const height_samples& heights, const height_source& source, double scale, int bearings)
    : heights_(heights),
      source_(source),
      scale_(scale),
      directions_(std::size_t(bearings)),
      slopes_(bs::required_size(heights.extent, bearings)) {
    bs::fill_directions(directions_);
    horizons_ = {.values = slopes_, .extent = heights.extent, .bearings = bearings};
}

std::size_t baker::scratch_bytes(const bake_setup& setup) const {
    const bs::bake_options options = options_of(setup, source_);
    const bs::threads run(setup.threads);
    return with_height_map(heights_, source_, scale_, [&](const auto& map) {
        switch (setup.how) {
            case method::exact: return bs::exact_scratch_size(map, directions_, options);
            case method::sweep: return bs::sweep_scratch_size(map, directions_, options, run);
            case method::sweep_classic: return bs::sweep_classic_scratch_size(map, directions_, options, run);
            case method::neighborhood: return bs::neighborhood_scratch_size(map, directions_, options);
            case method::cascade: break;
        }
        return bs::cascade_scratch_size(map, options, run.concurrency());
    });
}

void baker::reserve(const bake_setup& setup) { scratch_.resize(std::max(scratch_.size(), scratch_bytes(setup))); }

void baker::bake(const bake_setup& setup, std::size_t first, std::size_t count) {
    const auto directions =
        std::span<const glm::dvec2>(directions_).subspan(first, std::min(count, directions_.size() - first));
    bs::bake_options options = options_of(setup, source_);
    options.scratch = scratch_;
    bs::horizon_map out = horizons_;
    out.values = out.values.subspan(first * out.slice_step());
    out.bearings = int(directions.size());
    if (setup.rows > 0) {
        options.region = {glm::ivec2(0), {out.extent.x, setup.rows}};
        out.slice_stride = out.slice_step();
        out.extent.y = setup.rows;
    }
    height_source source = source_;
    source.height_scale = scale_;
    const progress execute(bs::threads(setup.threads), "", false);
    bake_horizons(heights_, source, {setup.how, options}, directions, out, execute);
}

double baker::time(const bake_setup& setup, std::size_t first, std::size_t count) {
    const auto start = std::chrono::steady_clock::now();
    bake(setup, first, count);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace examples
