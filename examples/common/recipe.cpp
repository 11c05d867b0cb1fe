#include "common/recipe.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>

#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/plan.hpp>

#include "common/file.hpp"
#include "common/progress.hpp"
#include "common/report_text.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point start) { return std::chrono::duration<double>(clock::now() - start).count(); }

recipe_horizons make_horizons(glm::ivec2 extent, std::vector<glm::dvec2> directions) {
    recipe_horizons h;
    h.directions = std::move(directions);
    h.values.resize(bs::required_size(extent, int(h.directions.size())));
    h.map = {.values = h.values, .extent = extent, .bearings = int(h.directions.size())};
    return h;
}

// The horizons and their mips, and what is left to fit: of an array the slices themselves, of a volume, whose mips have
// fewer slices, nothing is fitted yet.
std::vector<recipe_horizons> with_mips(recipe_horizons all, const bs::recipe& r, bs::threads run,
                                       bs::pack_options& options) {
    const bs::tangent_volume& e = r.encoding;
    const bool volume = e.kind == bs::texture_kind::volume;
    std::vector<glm::dvec2> own(std::size_t(e.slices.count));
    bs::fill_directions(own, e.slices);
    std::vector<recipe_horizons> levels;
    for (int level = 0; level < bs::default_mips(all.map.extent); ++level)
        levels.push_back(
            make_horizons({bs::mip_extent(all.map.extent.x, level), bs::mip_extent(all.map.extent.y, level)},
                          volume ? all.directions : own));
    if (volume) {
        for (std::size_t level = 1; level < levels.size(); ++level)
            require(bs::reduce(all.map, e.scale, levels[level].map, run));
        levels[0] = std::move(all);
        return levels;
    }
    require(bs::fit_slices(all.map, all.directions, e.slices, e.scale, options, levels[0].map, run));
    std::vector<bs::horizon_map> maps;
    for (std::size_t level = 1; level < levels.size(); ++level) maps.push_back(levels[level].map);
    require(bs::make_mips(levels[0].map, e.scale, maps, {}, run));
    options.fit = bs::slice_fit::point;
    // What is clamped was counted when the slices were fitted.
    options.report = nullptr;
    return levels;
}

}  // namespace

bs::recipe plan_for(const height_samples& samples, const height_source& source, const bs::scene& wanted) {
    bs::recipe r;
    require(with_height_map(samples, source, source.height_scale.value_or(1.0),
                            [&](const auto& map) { return bs::plan(map, wanted, r); }));
    return r;
}

bs::recipe recipe_for(const height_samples& samples, const height_source& source, const recipe_settings& settings) {
    if (settings.plan.empty()) return read_recipe(path_of(settings.recipe));
    const planned_scene scene = read_scene(path_of(settings.plan));
    return plan_for(samples, source, scene.view());
}

recipe_horizons bake_for(const height_samples& samples, const height_source& source, const bs::recipe& r, int threads) {
    std::vector<glm::dvec2> directions(std::size_t(r.directions));
    bs::fill_directions(r, directions);
    const glm::ivec2 extent = baked_extent(r, samples.extent);
    recipe_horizons h = make_horizons(extent, std::move(directions));
    const progress execute(bs::threads(threads), "baking");
    bs::bake_options options;
    options.steps = r.steps;
    options.radius = r.radius;
    require(with_height_map(samples, source, source.height_scale.value_or(1.0), [&](const auto& map) {
        if (r.reduced_heights == 1) return bs::bake_cascade(map, h.directions, h.map, options, execute);
        if (bs::status s = check(map); !s) return s;
        std::vector<float> averaged(bs::required_size(extent, 1));
        return bs::bake_cascade(bs::average_heights(map, r.reduced_heights, averaged.data()), h.directions, h.map,
                                options, execute);
    }));
    return h;
}

encoded pack_for(recipe_horizons horizons, const bs::recipe& r, glm::ivec2 extent, int threads) {
    const bs::tangent_volume& e = r.encoding;
    const bs::threads run(threads);
    encoded result;
    result.extent = extent;
    result.directions = int(horizons.directions.size());
    if (r.reduction > 1) {
        recipe_horizons small =
            make_horizons(bs::reduced_extent(horizons.map.extent, r.reduction), horizons.directions);
        require(bs::reduce(horizons.map, e.scale, small.map, run));
        horizons = std::move(small);
    }
    bs::pack_options options;
    options.fit = r.fit;
    options.report = &result.report;
    std::vector<recipe_horizons> levels;
    if (r.mips)
        levels = with_mips(std::move(horizons), r, run, options);
    else
        levels.push_back(std::move(horizons));
    std::vector<bs::horizon_map> maps;
    for (const recipe_horizons& level : levels) maps.push_back(level.map);
    result.textures.emplace_back(layout_of(e, maps[0].extent, int(maps.size())));
    require(bs::pack_tangent_volume(maps, levels[0].directions, e, options, result.textures[0].view(), run));
    result.how = e;
    return result;
}

encoded bake_recipe(const height_samples& samples, const height_source& source, const bs::recipe& r, int threads) {
    const auto start = clock::now();
    recipe_horizons horizons = bake_for(samples, source, r, threads);
    const double bake_seconds = seconds_since(start);
    const auto packing = clock::now();
    encoded result = pack_for(std::move(horizons), r, samples.extent, threads);
    result.bake_seconds = bake_seconds;
    result.pack_seconds = seconds_since(packing);
    return result;
}

std::string text_of(const bs::recipe& r) {
    std::string text;
    for (int i = 0; i < r.lines; ++i) {
        text += "  - ";
        text += r.why[std::size_t(i)].text;
        text += '\n';
    }
    const bs::plan_figures& p = r.predicted;
    if (!r.shadows) return text;
    return text + format(
                      "  predicted: %.2f +- %.2f %% wrong, %.3g bytes a texel, %.3g s to bake and %.3g s to pack "
                      "on one thread, %.0f cycles a wave, %d fetch%s\n",
                      100.0 * p.mismatch, 100.0 * p.interval, p.bytes, p.bake_seconds, p.pack_seconds, p.gpu_cost,
                      p.fetches, p.fetches == 1 ? "" : "es");
}

}  // namespace examples
