// plan: the cheapest set-up that a scene needs on a height map. `plan --help` lists the options.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/plan_json.hpp"
#include "common/recipe.hpp"
#include "common/report_text.hpp"
#include "plan/measured.hpp"
#include "plan/proof.hpp"

namespace {

using namespace examples;
namespace bs = bumpshadow;

struct arguments {
    std::string scene, json;
    std::vector<std::string> heights;
    height_source how;
    bool measure = false, proof = false, check = false;
};

std::string report_of(const planned_map& one, bool measured) {
    std::string text = text_of(one.how);
    const set_up_figures& f = one.figures;
    if (measured)
        text += format("  measured: %.2f +- %.2f %% wrong, %.3g bytes a texel, %.3g s to bake and %.3g s to pack\n",
                       100.0 * f.error.mismatch, 100.0 * f.error.interval, f.bytes, f.bake_seconds, f.pack_seconds);
    return text;
}

void plan_all(const arguments& arguments) {
    std::vector<std::string> inputs = arguments.heights;
    inputs.push_back(arguments.scene);
    refuse_inputs(path_of(arguments.json), inputs);
    const planned_scene scene = read_scene(path_of(arguments.scene));
    std::optional<output_file> file;
    if (!arguments.json.empty()) file.emplace(path_of(arguments.json));
    std::string json = "[", text;
    for (const std::string& path : arguments.heights) {
        height_source source = arguments.how;
        source.path = path;
        const height_samples samples = read_heights(source);
        const bs::scene wanted = scene.view();
        constexpr std::uint32_t seed = 20;
        std::optional<lit_pixels> pixels;
        if (arguments.measure) pixels.emplace(samples, source, wanted, seed);
        const planned_map one = plan_map(samples, source, wanted, pixels ? &*pixels : nullptr);
        text += path + format(": planned in %.2f s\n", one.plan_seconds) + report_of(one, arguments.measure);
        json += (json.size() > 1 ? ",\n" : "\n") + std::string("{\"map\":") + quoted(path) +
                ",\"plan\":" + json_of(one, arguments.measure) + "}";
    }
    if (file) {
        file->write(json + "]\n");
        file->commit();
    }
    std::fputs(text.c_str(), stdout);
    flush_stdout();
}

void prove(const arguments& arguments) {
    std::optional<output_file> file;
    if (!arguments.json.empty()) file.emplace(path_of(arguments.json));
    const proof all = run_proof();
    if (file) {
        file->write(json_of(all));
        file->commit();
    }
    std::printf("%s\n\n%s", build_text().c_str(), table_of(all).c_str());
    flush_stdout();
    const auto unheld = std::count_if(all.lines.begin(), all.lines.end(), [](const proof_line& l) { return !l.held; });
    if (arguments.check && unheld > 0) throw failure(std::to_string(unheld) + " bars did not hold");
}

void work(const arguments& arguments) {
    if (arguments.proof) {
        if (!arguments.scene.empty()) throw failure(arguments.scene + " is given, but --proof has its own scenes");
        return prove(arguments);
    }
    if (arguments.check) throw failure("--check goes with --proof");
    if (arguments.scene.empty()) throw failure("SCENE.json is missing");
    if (arguments.heights.empty()) throw failure("HEIGHTS is missing: " + arguments.scene + " is the scene");
    plan_all(arguments);
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Says what the shadows of a scene need on a height map: what to bake, what to store, which shader, why, and "
        "what that costs. bake --plan and shade --plan do it.",
        "plan");
    arguments arguments;
    app.add_option("SCENE", arguments.scene, "what the scene asks for (below)")->type_name("SCENE.json");
    app.add_option("HEIGHTS", arguments.heights, "height maps: PNG of 8 or 16 bits, JPEG, or --raw")->type_name("FILE");
    add_height_options(app, arguments.how, "default 1");
    app.add_flag("--measure", arguments.measure,
                 "bakes and packs each map and measures the error and the time, to compare with what is predicted");
    app.add_option("--json", arguments.json, "write the set-ups with all figures to this file, too")->type_name("FILE");
    app.add_flag("--proof", arguments.proof,
                 "plans a few scenes on the maps in the folder BUMPSHADOW_HEIGHT_MAPS, bakes them and prints a table");
    app.add_flag("--check", arguments.check, "with --proof: fail where a bar does not hold");
    app.footer(scene_help);
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "plan: %s\n", error.what());
    return 1;
}
