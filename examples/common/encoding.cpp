#include "common/encoding.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <span>
#include <utility>

#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/normal_map.hpp>

#include "common/arguments.hpp"
#include "common/choices.hpp"
#include "common/progress.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

using clock = std::chrono::steady_clock;

double seconds_since(clock::time_point start) { return std::chrono::duration<double>(clock::now() - start).count(); }

void require(const bs::status& status) {
    if (!status) throw failure(status.message().c_str());
}

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

// Evenly spaced directions of all bearings, enough for a fit to `slices`.
std::size_t directions_for(int slices) { return std::size_t(std::max(32, 4 * slices)); }

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
        bs::fill_directions(fitted.directions, slices.phase, slices.function);
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
    void pack(const std::vector<horizons>& levels, std::vector<bs::texture_layout> layouts, bs::slice_fit fit,
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
        if (settings.fit != bs::slice_fit::point) return bake_evenly(directions_for(slices.count));
        std::vector<glm::dvec2> directions(std::size_t(slices.count));
        bs::fill_directions(directions, slices.phase, slices.function);
        return bake(std::move(directions));
    }

    // What is left to fit: with mips the slices are there already.
    bs::slice_fit fit_of() const { return settings.mips ? bs::slice_fit::point : settings.fit; }

    void tangent() const {
        bs::tangent_volume e;
        e.slices.count = settings.bearings.value_or(e.slices.count);
        e.slices.function = settings.function;
        e.format = settings.bits == stored_bits::eight     ? bs::texel_format::r8
                   : settings.bits == stored_bits::sixteen ? bs::texel_format::r16
                                                           : bs::texel_format::bc4;
        // Levels of a volume have fewer slices, and cannot keep the share of shadowed texels.
        if (settings.array || settings.mips) e.kind = bs::texture_kind::array;
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
        if (settings.bearings.value_or(8) != 8) throw failure("--bearings: sine layers have 8");
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

// printf into a string.
[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
    char buffer[512];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

// JSON has no infinity: none stands for it.
std::string number(double value) { return std::isfinite(value) ? text("%.9g", value) : "null"; }

const char* name_of(bs::quantity stored) { return word_of(quantity_names, stored); }
const char* name_of(bs::bearing_function function) { return word_of(bearing_function_names, function); }

const char* name_of(bs::texel_format format) {
    constexpr const char* names[] = {"r8",      "rg8",  "rgba8",   "r16",    "rgba16", "r16f",
                                     "rgba16f", "r32f", "rgba32f", "rgb565", "bc1",    "bc4"};
    return names[int(format)];
}

std::string json_of(const bs::slice_set& slices) {
    return text("\"bearings\":%d,\"phase\":%.9g,\"bearing_function\":\"%s\",", slices.count, slices.phase,
                name_of(slices.function));
}
std::string json_of(const bs::horizon_scale& scale) {
    return text("\"stored\":\"%s\",\"max_slope\":%s,", name_of(scale.stored), number(double(scale.max_slope)).c_str());
}
std::string json_of(const bs::tangent_volume& e) {
    return "\"encoding\":\"tangent\"," + json_of(e.slices) + json_of(e.scale) +
           text("\"coordinate_offset\":%.9g,", coordinate_offset(e));
}
std::string json_of(const bs::slice_layers& e) {
    return "\"encoding\":\"layers\"," + json_of(e.slices) + json_of(e.scale) +
           text("\"overlapping\":%s,", e.grouping == bs::slice_grouping::overlapping ? "true" : "false");
}
std::string json_of(const bs::sine_layers& e) { return "\"encoding\":\"sine\",\"bearings\":8," + json_of(e.scale); }
std::string json_of(const bs::fourier& e) {
    std::string ranges;
    for (int i = 0; i < e.coefficients; ++i) {
        const bs::fourier_range r = stored_range(e, i);
        ranges += text("%s[%.9g,%.9g]", i == 0 ? "" : ",", double(r.low), double(r.high));
    }
    return "\"encoding\":\"fourier\"," + json_of(e.scale) +
           text("\"coefficients\":%d,\"square_root\":%s,\"stored_ranges\":[", e.coefficients,
                e.square_root ? "true" : "false") +
           ranges + "],";
}
std::string json_of(const bs::ssbump& e) {
    constexpr const char* occlusions[] = {"none", "ambient", "directional"};
    return text("\"encoding\":\"ssbump\",\"y\":\"%s\",\"occlusion\":\"%s\",\"mask_scale\":%.9g,",
                e.y == bs::normal_y::down ? "down" : "up", occlusions[int(e.occlusion)], double(mask_scale(e)));
}
std::string json_of(const bs::emboss& e) {
    return text("\"encoding\":\"emboss\",\"lowest\":%.9g,\"scale\":%.9g,", e.lowest, e.scale);
}

}  // namespace

void add_encoding_options(CLI::App& app, encoding_settings& settings, bool extra) {
    std::vector<std::pair<std::string, encoding_kind>> kinds;
    for (int i = 0; i <= int(extra ? encoding_kind::none : encoding_kind::emboss); ++i)
        kinds.emplace_back(name_of(encoding_kind(i)), encoding_kind(i));
    add_choice(app, "--encoding", settings.kind, kinds, "what textures hold")->type_name("ENCODING");
    add_choice<stored_bits>(app, "--bits", settings.bits,
                            {{"8", stored_bits::eight}, {"16", stored_bits::sixteen}, {"bc4", stored_bits::bc4}},
                            "bits of what is stored")
        ->type_name("BITS");
    app.add_option("--reduce", settings.reduce, "extent of the texture: 1/R of the height map's")
        ->check(whole_number(1, 64))
        ->capture_default_str()
        ->type_name("R");
    add_choice<bs::slice_fit>(app, "--fit", settings.fit,
                              {{"point", bs::slice_fit::point},
                               {"least-squares", bs::slice_fit::least_squares},
                               {"least-angle", bs::slice_fit::least_angle}},
                              "slices: their own horizons, or fitted to four times as many (32 at least), for the "
                              "least squares of what is stored or the least error of the elevation")
        ->type_name("FIT");
    add_choice(app, "--bearing-function", settings.function, bearing_function_names, "how the shader measures bearings")
        ->type_name("FUNCTION");
    app.add_option_function<std::string>(
           "--stored",
           [&settings](const std::string& word) {
               for (const auto& [name, stored] : quantity_names)
                   if (name == word) settings.stored = stored;
           },
           "quantity that is stored: slope, sine, angle (default: the encoding's own)")
        ->check(CLI::IsMember({"slope", "sine", "angle"}))
        ->type_name("QUANTITY");
    app.add_option("--max-slope", settings.max_slope,
                   "slope that stands for 1; light above it is never shadowed (default: the steepest, at most 4)")
        ->check(positive_or_infinite_number())
        ->type_name("SLOPE");
    app.add_flag("--mips", settings.mips, "with mip levels; slices become layers of an array");
    app.add_flag("--array", settings.array, "tangent: slices as layers of an array in place of a volume");
    app.add_flag("--overlapping", settings.overlapping, "layers: one fetch, 4/3 of the bytes");
    app.add_flag("--factor-cube", settings.factor_cube, "sine: writes the cube of factors, too");
    app.add_flag("--published", settings.published, "sine, fourier: as published");
    app.add_option("--coefficients", settings.coefficients, "fourier: 3, 5, 7 or 9")
        ->check(CLI::IsMember({3, 5, 7, 9}))
        ->capture_default_str()
        ->type_name("N");
    app.add_flag("--square-root", settings.square_root, "fourier: stores signed square roots");
    add_choice<bs::normal_y>(app, "--ssbump-y", settings.y, {{"down", bs::normal_y::down}, {"up", bs::normal_y::up}},
                             "ssbump: hand of the basis")
        ->type_name("Y");
    add_choice<bs::mask_occlusion>(app, "--occlusion", settings.occlusion,
                                   {{"none", bs::mask_occlusion::none},
                                    {"ambient", bs::mask_occlusion::ambient},
                                    {"directional", bs::mask_occlusion::directional}},
                                   "ssbump: what darkens the masks")
        ->type_name("OCCLUSION");
}

std::string name_of(encoding_kind kind) {
    constexpr const char* names[] = {"tangent", "layers", "sine", "fourier", "ssbump", "emboss", "traced", "none"};
    return names[int(kind)];
}

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

std::string for_shaders(const encoded& map) {
    return std::visit(
        []<class Encoding>(const Encoding& e) {
            std::string words;
            if constexpr (requires { e.slices; })
                words += text("; %d slices, %s bearing", e.slices.count, name_of(e.slices.function));
            if constexpr (std::is_same_v<Encoding, bs::tangent_volume>)
                words += text(", coordinate = bearing + %.9g", coordinate_offset(e));
            if constexpr (requires { requires std::is_same_v<decltype(e.scale), bs::horizon_scale>; })
                words += text("; %s %.6g stands for 1", name_of(e.scale.stored),
                              double(bs::quantity_of_slope(e.scale.stored, e.scale.max_slope)));
            if constexpr (std::is_same_v<Encoding, bs::fourier>) words += "; --json has the ranges";
            return words;
        },
        map.how);
}

std::string json_of(const encoded& map) {
    constexpr const char* kinds[] = {"flat", "array", "cube", "volume"};
    std::string json = std::visit([](const auto& e) { return json_of(e); }, map.how) + "\"textures\":[";
    std::size_t bytes = 0;
    for (const owned_texture& t : map.textures) {
        const bs::texture_layout& l = t.layout;
        json += text(
            "%s{\"format\":\"%s\",\"kind\":\"%s\",\"width\":%d,\"height\":%d,\"depth\":%d,\"layers\":%d,"
            "\"mips\":%d,\"offset\":%zu,\"bytes\":%zu}",
            &t == map.textures.data() ? "" : ",", name_of(l.format), kinds[int(l.kind)], l.extent.x, l.extent.y,
            l.depth, l.layers, l.mips, bytes, t.bytes.size());
        bytes += t.bytes.size();
    }
    return json + text(
                      "],\"clamped\":%zu,\"steepest\":%.9g,\"directions\":%d,\"bake_seconds\":%.6f,"
                      "\"pack_seconds\":%.6f",
                      map.report.clamped, double(map.report.steepest), map.directions, map.bake_seconds,
                      map.pack_seconds);
}

}  // namespace examples
