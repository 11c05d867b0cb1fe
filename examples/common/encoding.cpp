#include "common/encoding.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>

#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/normal_map.hpp>

#include "common/progress.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point start) { return std::chrono::duration<double>(clock::now() - start).count(); }

// Horizons with their memory.
struct horizons {
    std::vector<float> values;
    bs::horizon_map map;
    std::vector<glm::dvec2> directions;

    horizons() = default;
    horizons(glm::ivec2 extent, std::size_t count) : values(bs::required_size(extent, int(count))), directions(count) {
        map = {.values = values, .extent = extent, .bearings = int(count)};
    }
    horizons(horizons&&) = default;
    horizons& operator=(horizons&&) = default;
};

// Evenly spaced directions for a fit: four to a slice and 32 to the turn, at least, those of both ends of an arc
// included.
std::vector<glm::dvec2> directions_for(bs::slice_set slices) {
    if (bs::is_arc(slices)) {
        slices.count = std::max(int(std::ceil(32.0 * slices.arc)), 4 * (slices.count - 1)) + 1;
        std::vector<glm::dvec2> directions(std::size_t(slices.count));
        bs::fill_directions(directions, slices);
        return directions;
    }
    std::vector<glm::dvec2> directions(std::size_t(std::max(32, 4 * slices.count)));
    bs::fill_directions(directions, 0.0);
    return directions;
}

// Slices of what the command line says: as far apart as 8 around the turn, where it does not say how many.
bs::slice_set slices_of(const encoding_settings& settings) {
    bs::slice_set slices;
    slices.function = settings.function;
    if (settings.arc) {
        const auto [first, last] = *settings.arc;
        const auto bearing = [&](double degrees) {
            return bs::to_bearing(settings.function, bs::exact_direction(degrees / 360.0));
        };
        if (!(last >= first && last - first < 360.0)) {
            char message[120];
            std::snprintf(message, sizeof message,
                          "--arc: %g %g is given, but LAST has to be from FIRST to less than 360 above it", first,
                          last);
            throw failure(message);
        }
        slices.phase = bearing(first);
        slices.arc = 0.0;
        if (last - first > 360.0 * bs::smallest_arc) {
            const double turns = bearing(last) - slices.phase;
            slices.arc = turns - std::floor(turns);
        }
        slices.count = int(std::ceil(slices.count * slices.arc - 1e-9)) + 1;
    }
    slices.count = settings.bearings.value_or(slices.count);
    return slices;
}

struct job {
    const height_samples& samples;
    const height_source& source;
    const horizon_settings& how;
    const encoding_settings& settings;
    bs::threads run;
    encoded& result;

    horizons bake(std::vector<glm::dvec2> directions) const {
        horizons h(samples.extent, directions.size());
        h.directions = std::move(directions);
        const auto start = clock::now();
        {
            const progress execute(run, "baking");
            bake_horizons(samples, source, how, h.directions, h.map, execute);
        }
        result.bake_seconds = seconds_since(start);
        result.directions = int(h.directions.size());
        return h;
    }

    horizons bake_evenly(std::size_t count) const {
        std::vector<glm::dvec2> directions(count);
        bs::fill_directions(directions, 0.0);
        return bake(std::move(directions));
    }

    bs::horizon_scale scale_for(const horizons& h, bs::quantity usual, bool open_end) const {
        bs::horizon_scale scale;
        scale.stored = settings.stored.value_or(usual);
        if (settings.max_slope)
            scale.max_slope = float(*settings.max_slope);
        else
            scale.max_slope = open_end ? std::numeric_limits<float>::infinity() : bs::suggest_max_slope(h.map);
        return scale;
    }

    // The map at the extent that is stored.
    horizons reduced(horizons h, const bs::horizon_scale& scale) const {
        if (settings.reduce == 1) return h;
        horizons small(bs::reduced_extent(h.map.extent, settings.reduce), h.directions.size());
        small.directions = h.directions;
        require(bs::reduce(h.map, scale, small.map, run));
        return small;
    }

    // Adds the mips of levels[0], where they are asked for, to be filled, and returns views of them.
    std::vector<bs::horizon_map> add_levels(std::vector<horizons>& levels) const {
        std::vector<bs::horizon_map> maps;
        const glm::ivec2 extent = levels[0].map.extent;
        for (int level = 1; settings.mips && level < bs::default_mips(extent); ++level) {
            levels.emplace_back(glm::ivec2(bs::mip_extent(extent.x, level), bs::mip_extent(extent.y, level)),
                                levels[0].directions.size());
            levels.back().directions = levels[0].directions;
            maps.push_back(levels.back().map);
        }
        return maps;
    }

    // The map and, where they are asked for, its mips, at `slices` bearings and no other.
    std::vector<horizons> with_mips(horizons h, const bs::slice_set& slices, const bs::horizon_scale& scale) const {
        std::vector<horizons> levels;
        if (!settings.mips) {
            levels.push_back(std::move(h));
            return levels;
        }
        horizons fitted(h.map.extent, std::size_t(slices.count));
        bs::fill_directions(fitted.directions, slices);
        bs::pack_options options;
        options.fit = settings.fit;
        options.report = &result.report;
        require(bs::fit_slices(h.map, h.directions, slices, scale, options, fitted.map, run));
        levels.push_back(std::move(fitted));
        const std::vector<bs::horizon_map> maps = add_levels(levels);
        require(bs::make_mips(levels[0].map, scale, maps, {}, run));
        return levels;
    }

    // pack(levels, directions, options, textures) with the timing and report of all encodings.
    template <class Pack>
    void pack(const std::vector<horizons>& levels, const std::vector<bs::texture_layout>& layouts, bs::slice_fit fit,
              const Pack& pack) const {
        std::vector<bs::horizon_map> maps;
        for (const horizons& h : levels) maps.push_back(h.map);
        std::vector<bs::texture> views;
        for (const bs::texture_layout& layout : layouts) result.textures.emplace_back(layout);
        for (owned_texture& t : result.textures) views.push_back(t.view());
        bs::pack_report report;
        bs::pack_options options;
        options.fit = fit;
        options.report = &report;
        const auto start = clock::now();
        require(pack(std::span<const bs::horizon_map>(maps), std::span<const glm::dvec2>(levels[0].directions), options,
                     std::span<const bs::texture>(views)));
        result.pack_seconds = seconds_since(start);
        // With mips the slopes were clamped when the slices were fitted.
        if (!settings.mips) result.report = report;
    }

    horizons bake_for(const bs::slice_set& slices) const {
        if (settings.fit != bs::slice_fit::point) return bake(directions_for(slices));
        std::vector<glm::dvec2> directions(std::size_t(slices.count));
        bs::fill_directions(directions, slices);
        return bake(std::move(directions));
    }

    // What is left to fit: with mips the slices are there already.
    bs::slice_fit fit_of() const { return settings.mips ? bs::slice_fit::point : settings.fit; }

    void tangent() const {
        bs::tangent_volume e;
        e.slices = slices_of(settings);
        e.format = settings.bits == stored_bits::eight     ? bs::texel_format::r8
                   : settings.bits == stored_bits::sixteen ? bs::texel_format::r16
                                                           : bs::texel_format::bc4;
        // Levels of a volume have fewer slices, and cannot keep the share of shadowed texels.
        if (settings.array || settings.mips) e.kind = bs::texture_kind::array;
        if (settings.arc && e.slices.count == 1) e.kind = bs::texture_kind::flat;
        require(check(e.slices));
        horizons h = bake_for(e.slices);
        e.scale = scale_for(h, bs::quantity::slope, false);
        require(check(e));
        const std::vector<horizons> levels = with_mips(reduced(std::move(h), e.scale), e.slices, e.scale);
        pack(levels, {layout_of(e, levels[0].map.extent, int(levels.size()))}, fit_of(),
             [&](auto maps, auto directions, const bs::pack_options& options, auto out) {
                 return bs::pack_tangent_volume(maps, directions, e, options, out[0], run);
             });
        result.how = e;
    }

    void layers() const {
        bs::slice_layers e;
        if (settings.overlapping) e.grouping = bs::slice_grouping::overlapping;
        e.slices.count = settings.bearings.value_or(settings.overlapping ? 12 : e.slices.count);
        e.slices.function = settings.function;
        require(check(e));
        horizons h = bake_for(e.slices);
        e.scale = scale_for(h, bs::quantity::slope, false);
        const std::vector<horizons> levels = with_mips(reduced(std::move(h), e.scale), e.slices, e.scale);
        pack(levels, {layout_of(e, levels[0].map.extent, int(levels.size()))}, fit_of(),
             [&](auto maps, auto directions, const bs::pack_options& options, auto out) {
                 return bs::pack_slice_layers(maps, directions, e, options, out[0], run);
             });
        result.how = e;
    }

    void sine() const {
        bs::sine_layers e;
        if (settings.bearings.value_or(8) != 8)
            throw failure("--bearings " + std::to_string(*settings.bearings) + " is given, but sine layers have 8");
        const bs::slice_set slices{8, 0.0, bs::bearing_function::exact};
        horizons h = settings.published ? bake_evenly(bs::sine_layers_directions) : bake_for(slices);
        e.scale = scale_for(h, bs::quantity::sine, settings.stored.value_or(bs::quantity::sine) != bs::quantity::slope);
        require(check(e.scale));
        if (settings.published && settings.mips) throw failure("--published has no --mips");
        const std::vector<horizons> levels = with_mips(reduced(std::move(h), e.scale), slices, e.scale);
        pack(levels, {layout_of(e, levels[0].map.extent, int(levels.size()))}, fit_of(),
             [&](auto maps, auto directions, const bs::pack_options& options, auto out) {
                 return settings.published ? bs::pack_sine_layers_averaged(maps, directions, e, options, out, run)
                                           : bs::pack_sine_layers(maps, directions, e, options, out, run);
             });
        if (settings.factor_cube) {
            bs::factor_cube cube;
            if (settings.published) cube = bs::factor_cube_as_published();
            result.textures.emplace_back(layout_of(cube));
            require(write_factor_cube(cube, result.textures.back().view()));
        }
        result.how = e;
    }

    void fourier() const {
        bs::fourier e = settings.published ? bs::fourier_as_posted() : bs::fourier{};
        e.coefficients = settings.coefficients;
        horizons h = bake_evenly(32);
        if (!settings.published) {
            e.scale = scale_for(h, bs::quantity::slope, false);
            e.square_root = settings.square_root;
        }
        e.bits = settings.bits == stored_bits::eight ? 8 : 16;
        std::vector<horizons> levels;
        levels.push_back(reduced(std::move(h), e.scale));
        std::vector<bs::horizon_map> maps = add_levels(levels);
        if (!maps.empty()) require(bs::make_fourier_mips(levels[0].map, levels[0].directions, e, maps, {}, run));
        maps.insert(maps.begin(), levels[0].map);
        if (!settings.published) require(bs::tighten_ranges(maps, levels[0].directions, e, {}, run));
        std::vector<bs::texture_layout> layouts;
        for (int i = 0; i < bs::texture_count(e); ++i)
            layouts.push_back(layout_of(e, levels[0].map.extent, int(levels.size()), i));
        pack(levels, layouts, settings.fit, [&](auto each, auto directions, const bs::pack_options& options, auto out) {
            return bs::pack_fourier(each, directions, e, options, out, run);
        });
        result.how = e;
    }

    void ssbump() const {
        bs::ssbump e;
        e.y = settings.y;
        e.occlusion = settings.occlusion;
        std::vector<horizons> levels;
        levels.push_back(bake_evenly(std::size_t(settings.bearings.value_or(32))));
        std::vector<float> planes = normals_of(samples, source, run.concurrency());
        const bs::normal_map normals{.values = planes, .extent = samples.extent};
        const int mips = settings.mips ? bs::full_mips(samples.extent) : 1;
        pack(levels, {layout_of(e, samples.extent, mips)}, settings.fit,
             [&](auto maps, auto directions, const bs::pack_options&, auto out) {
                 return bs::pack_ssbump(maps[0], directions, normals, e, out[0], run);
             });
        result.how = e;
    }

    void emboss() const {
        bs::emboss e;
        const int mips = settings.mips ? bs::full_mips(samples.extent) : 1;
        for (int i = 0; i < 2; ++i) result.textures.emplace_back(layout_of(e, samples.extent, mips));
        const auto start = clock::now();
        require(with_height_map(samples, source, source.height_scale.value_or(1.0), [&](const auto& map) {
            if (bs::status s = bs::scaled_emboss(map, e); !s) return s;
            return bs::pack_emboss(map, e, result.textures[0].view(), result.textures[1].view(), &result.report.clamped,
                                   run);
        }));
        result.pack_seconds = seconds_since(start);
        result.how = e;
    }
};

void refuse_what_does_not_fit(const encoding_settings& s) {
    using kind = encoding_kind;
    const auto only = [&](bool given, const char* option, std::initializer_list<kind> kinds) {
        if (!given || std::find(kinds.begin(), kinds.end(), s.kind) != kinds.end()) return;
        std::string words;
        for (const kind k : kinds) words += (words.empty() ? "" : ", ") + name_of(k);
        throw failure(std::string(option) + " is not for --encoding " + name_of(s.kind) + ", but for " + words);
    };
    only(s.bits == stored_bits::bc4, "--bits bc4", {kind::tangent});
    only(s.bits == stored_bits::sixteen, "--bits 16", {kind::tangent, kind::fourier});
    only(s.array, "--array", {kind::tangent});
    only(s.arc.has_value(), "--arc", {kind::tangent});
    only(s.overlapping, "--overlapping", {kind::layers});
    only(s.published, "--published", {kind::sine, kind::fourier});
    only(s.factor_cube, "--factor-cube", {kind::sine});
    only(s.square_root, "--square-root", {kind::fourier});
    only(s.bearings.has_value(), "--bearings", {kind::tangent, kind::layers, kind::sine, kind::ssbump});
    only(s.stored.has_value(), "--stored", {kind::tangent, kind::layers, kind::sine, kind::fourier});
    only(s.max_slope.has_value(), "--max-slope", {kind::tangent, kind::layers, kind::sine, kind::fourier});
    only(s.reduce != 1, "--reduce", {kind::tangent, kind::layers, kind::sine, kind::fourier});
    if (s.published && s.kind == kind::fourier && (s.stored || s.max_slope || s.square_root))
        throw failure("--published has its own --stored, --max-slope and --square-root");
}

}  // namespace

std::vector<float> normals_of(const height_samples& samples, const height_source& source, int threads) {
    std::vector<float> planes(3 * bs::required_size(samples.extent, 1));
    const bs::normal_map normals{.values = planes, .extent = samples.extent};
    require(with_height_map(samples, source, source.height_scale.value_or(1.0),
                            [&](const auto& map) { return bs::bake_normals(map, normals, {}, bs::threads(threads)); }));
    return planes;
}

encoded encode_heights(const height_samples& samples, const height_source& source, const horizon_settings& horizons,
                       const encoding_settings& settings, int threads) {
    encoded result;
    result.extent = samples.extent;
    refuse_what_does_not_fit(settings);
    const job work{samples, source, horizons, settings, bs::threads(threads), result};
    switch (settings.kind) {
        case encoding_kind::tangent: work.tangent(); break;
        case encoding_kind::layers: work.layers(); break;
        case encoding_kind::sine: work.sine(); break;
        case encoding_kind::fourier: work.fourier(); break;
        case encoding_kind::ssbump: work.ssbump(); break;
        case encoding_kind::emboss: work.emboss(); break;
        case encoding_kind::traced:
        case encoding_kind::none: throw failure("--encoding: " + name_of(settings.kind) + " has no texture");
    }
    return result;
}

}  // namespace examples
