// encodings: what each encoding costs and how often it is wrong about what is lit. `encodings --help` lists the
// options.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <map>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/manifest.hpp"
#include "common/progress.hpp"
#include "common/report_text.hpp"
#include "common/stone_wall.hpp"
#include "encodings/compress.hpp"
#include "encodings/report.hpp"
#include "encodings/sample.hpp"
#include "encodings/setups.hpp"
#include "encodings/speed.hpp"
#include "encodings/ssbump.hpp"
#include "encodings/triangle.hpp"

namespace {

using namespace examples;

constexpr int patch_texels = patch_side * patch_side;

struct arguments {
    std::vector<std::string> paths;
    height_source heights;
    int texels = 2 * patch_texels;
    int seed = 1;
    int repeats = 5;
    std::string json;
    bool check = false;
};

named_map read(const height_source& source) {
    return {name_of(source), source, read_heights(source), source.height_scale.value_or(1.0)};
}

// The maps that the project states its figures for, if the folder that has them is known.
std::vector<named_map> usual_maps() {
    std::vector<named_map> maps;
    for (const char* name :
         {"acg_Bricks059", "acg_RoofingTiles013A", "dx_stones", "dx_rocks", "pk01_floor01", "ogre_Rock20"})
        for (const height_source& source : known_maps({name})) {
            maps.push_back(read(source));
            maps.back().name = name;
        }
    return maps;
}

named_map made_wall() {
    stone_wall wall = make_stone_wall();
    return {"stone wall", {}, {wall.extent, std::move(wall.heights)}, wall.height_scale};
}

// usual: set where the limits hold for the maps.
std::vector<named_map> maps_of(const arguments& arguments, bool& usual) {
    std::vector<named_map> maps;
    for (const std::string& path : arguments.paths) {
        height_source source = arguments.heights;
        source.path = path;
        maps.push_back(read(source));
    }
    usual = maps.empty();
    if (usual) maps = usual_maps();
    if (maps.empty()) {
        std::printf(
            "BUMPSHADOW_HEIGHT_MAPS does not name a folder of height maps: a stone wall, made by the program\n");
        maps.push_back(made_wall());
        usual = false;
    }
    if (!usual) std::printf("What the mismatch may be is said for six other maps: it is not checked\n");
    return maps;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

std::vector<double> percent(const std::vector<score>& scores) {
    std::vector<double> shares;
    for (const score& s : scores) shares.push_back(s.percent());
    return shares;
}

// The samples, cut to what a setup needs, with the mean mismatch of Lengyel's layout on the same texels.
class comparison {
public:
    explicit comparison(std::vector<sample_map> samples) { samples_[patch_side] = std::move(samples); }

    row look(const setup& s) {
        row line{.name = s.name, .bytes = s.bytes, .fetches = s.fetches, .mismatch = {}, .skipped = {}};
        if (s.needs == codec::astc && !programs_.astc) line.skipped = "astcenc is not in PATH";
        if (s.needs == codec::bc7 && !programs_.bc7) line.skipped = "bc7enc is not in PATH";
        if (!line.skipped.empty()) return line;
        line.mismatch = percent(s.measure(programs_, samples(s.side)));
        line.mean = mean(line.mismatch);
        line.ratio = line.mean / yardstick(s.side, s.margin);
        return line;
    }

private:
    const std::vector<sample_map>& samples(int side) {
        std::vector<sample_map>& cut = samples_[side];
        if (cut.empty())
            for (const sample_map& map : samples_[patch_side]) cut.push_back(crop(map, side));
        return cut;
    }
    double yardstick(int side, int margin) {
        const auto [at, is_new] = yardsticks_.try_emplace({side, margin}, 0.0);
        if (is_new) at->second = mean(percent(published_sine_layers(side, margin).measure(programs_, samples(side))));
        return at->second;
    }

    codecs programs_;
    std::map<int, std::vector<sample_map>> samples_;  // by side of a patch
    std::map<std::pair<int, int>, double> yardsticks_;
};

void work(const arguments& arguments) {
    std::optional<output_file> json;
    if (!arguments.json.empty()) json.emplace(arguments.json);
    std::printf("%s\n", build_text().c_str());
    bool usual = false;
    const std::vector<named_map> maps = maps_of(arguments, usual);
    std::vector<sample_map> samples;
    std::vector<std::string> names;
    for (const named_map& map : maps) {
        samples.push_back(take_sample(map, arguments.texels, std::uint32_t(arguments.seed)));
        names.push_back(map.name);
    }
    const int texels = int(samples.front().texels());
    std::printf(
        "Share of wrong answers, lit or in shadow: %d texels a map (patches of %d x %d, seed %d) x %d bearings x %zu "
        "elevations (5 to 60 degrees), exact horizons\n",
        texels, patch_side, patch_side, arguments.seed, light_bearings, light_elevations.size());

    comparison comparison(samples);
    std::vector<table> tables;
    std::vector<check> checks;
    int skipped = 0;
    for (const section& section : all_setups()) {
        tables.push_back({section.title, {}});
        for (const setup& s : section.setups) {
            if (stderr_is_terminal()) std::fprintf(stderr, "\r%s\033[K", s.name.c_str());
            const row& line = tables.back().rows.emplace_back(comparison.look(s));
            skipped += line.skipped.empty() ? 0 : 1;
            if (usual && s.most && line.skipped.empty())
                checks.push_back({s.name + format(": ratio <= %g", *s.most), line.ratio, line.ratio <= *s.most});
        }
        if (stderr_is_terminal()) std::fputs("\r\033[K", stderr);
        std::printf("\n%s", text_of(tables.back(), names).c_str());
        std::string reasons;
        for (const row& line : tables.back().rows)
            if (!line.skipped.empty() && reasons.find(line.skipped) == std::string::npos)
                reasons += "skipped: " + line.skipped + '\n';
        std::printf("%s", reasons.c_str());
        std::fflush(stdout);
    }
    const ssbump_figures ssbump = measure_ssbump(maps, samples);
    checks.insert(checks.end(), ssbump.checks.begin(), ssbump.checks.end());
    std::vector<grid> grids = ssbump.grids;
    const auto stones = std::find(names.begin(), names.end(), "dx_stones");
    grids.push_back(
        grid_of(measure_triangles(samples[stones == names.end() ? 0 : std::size_t(stones - names.begin())])));
    for (const grid& g : grids) std::printf("\n%s", text_of(g).c_str());
    const named_map& timed = maps.front();
    const speeds speed = measure_speed(timed.heights, timed.source, timed.scale, arguments.repeats);
    std::printf("\n%s, one thread, median of %d\n", timed.name.c_str(), arguments.repeats);
    for (const figure& f : speed.figures) std::printf("%s: %.4g\n", f.what.c_str(), f.value);
    std::printf("\n");
    checks.push_back(
        {"packing 8 fitted slices in R8, share of the bake <= 0.3", speed.pack_share, speed.pack_share <= 0.3});
    checks.push_back({"shading, million texels a second >= 100", speed.shade_rate, speed.shade_rate >= 100.0});
    for (const check& c : checks) std::printf("%s: %s: %.4g\n", c.held ? "held" : "NOT held", c.what.c_str(), c.value);
    if (skipped > 0) std::printf("%d setups skipped\n", skipped);

    if (json) {
        json->write(json_of(names, texels, tables, grids, speed, checks));
        json->commit();
    }
    flush_stdout();
    const auto unheld = std::count_if(checks.begin(), checks.end(), [](const check& c) { return !c.held; });
    if (arguments.check && unheld > 0) throw failure(std::to_string(unheld) + " checks did not hold");
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Prints what every encoding costs, in bytes a texel and fetches, and how often it is wrong about what is lit, "
        "on exact horizons, beside the layout of Lengyel; then how well SSBump maps light, and what interpolating the "
        "light over triangles costs.",
        "encodings");
    arguments arguments;
    app.add_option("HEIGHTS", arguments.paths,
                   "height maps: PNG of 8 or 16 bits, JPEG, or --raw (default: six maps of the folder that the "
                   "environment variable BUMPSHADOW_HEIGHT_MAPS names, or else a stone wall that the program makes)")
        ->type_name("FILE...");
    add_height_options(app, arguments.heights, "default 1");
    app.add_option("--texels", arguments.texels, "texels of each map, rounded up to patches of 60 x 60")
        ->check(whole_number(1, 1 << 20))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--seed", arguments.seed, "where the patches lie")
        ->check(whole_number(0, 1 << 30))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--repeats", arguments.repeats, "times that what is timed is run")
        ->check(whole_number(1, 1000))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--json", arguments.json, "write all figures to this file, too")->type_name("FILE");
    app.add_flag("--check", arguments.check, "fail where a check does not hold");
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "encodings: %s\n", error.what());
    return 1;
}
