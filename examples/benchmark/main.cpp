// benchmark: speed, error and memory of every method on the same height maps. `benchmark --help` lists the options.

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "benchmark/measure.hpp"
#include "benchmark/report.hpp"
#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/manifest.hpp"
#include "common/report_text.hpp"
#include "common/stone_wall.hpp"

namespace {

using namespace examples;

struct arguments {
    std::vector<std::string> paths;
    height_source heights;
    settings how;
    std::string json;
    bool check = false;
};

measurement measure_wall(const settings& how) {
    stone_wall wall = make_stone_wall();
    const height_samples samples{wall.extent, std::move(wall.heights)};
    return measure("stone wall", samples, {}, wall.height_scale, how);
}

void work(const arguments& arguments) {
    std::optional<output_file> json;
    if (!arguments.json.empty()) json.emplace(arguments.json);

    std::vector<height_source> maps;
    for (const std::string& path : arguments.paths) {
        maps.push_back(arguments.heights);
        maps.back().path = path;
    }
    if (maps.empty()) maps = known_maps({"acg_Bricks059", "acg_RoofingTiles013A", "ogre_Rock20"});
    std::printf("%s\n", build_text().c_str());
    std::printf(
        "%d bearings, one thread where nothing else is said; errors of the elevation in degrees\n"
        "neighborhood is a smoothed horizon of 16 texels' range, no estimate of the exact one\n",
        yardstick_bearings);
    if (maps.empty())
        std::printf(
            "BUMPSHADOW_HEIGHT_MAPS does not name a folder of height maps: a stone wall, made by the program\n");

    std::vector<measurement> all;
    std::vector<check> checks;
    for (std::size_t i = 0; i < std::max(maps.size(), std::size_t(1)); ++i) {
        all.push_back(maps.empty() ? measure_wall(arguments.how)
                                   : measure(name_of(maps[i]), read_heights(maps[i]), maps[i],
                                             maps[i].height_scale.value_or(1.0), arguments.how));
        const measurement& m = all.back();
        std::printf("\n%s\n%d x %d texels, errors over %zu samples, median of %d repeats\n", table_of(m).c_str(),
                    m.extent.x, m.extent.y, m.error_samples, arguments.how.repeats);
        for (const check& c : checks_of(m)) {
            std::printf("%s: %s: %.4g\n", c.held ? "held" : "NOT held", c.what.c_str(), c.value);
            checks.push_back(c);
        }
        std::fflush(stdout);
    }
    if (json) {
        json->write(json_of(all, checks));
        json->commit();
    }
    flush_stdout();
    const auto unheld = std::count_if(checks.begin(), checks.end(), [](const check& c) { return !c.held; });
    if (arguments.check && unheld > 0) throw failure(std::to_string(unheld) + " checks did not hold");
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Measures speed, error and scratch memory of every method, one thread, against the classic sweep in the same "
        "run.",
        "benchmark");
    arguments arguments;
    app.add_option("HEIGHTS", arguments.paths,
                   "height maps: PNG of 8 or 16 bits, JPEG, or --raw (default: three maps of the folder that the "
                   "environment variable BUMPSHADOW_HEIGHT_MAPS names, or else a stone wall that the program makes)")
        ->type_name("FILE...");
    add_height_options(app, arguments.heights, "default 1");
    app.add_option("--repeats", arguments.how.repeats, "times that everything is run")
        ->check(whole_number(1, 1000))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--sample", arguments.how.texels, "texels that errors are measured on")
        ->check(whole_number(1, 1 << 20))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--json", arguments.json, "write all figures to this file, too")->type_name("FILE");
    app.add_flag("--check", arguments.check, "fail where a check does not hold");
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "benchmark: %s\n", error.what());
    return 1;
}
