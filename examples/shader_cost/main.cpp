// shader_cost: what each snippet costs on AMD GPUs, from the RADV compiler, without one. `shader_cost --help` lists the
// options.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/report_text.hpp"
#include "shader_cost/cases.hpp"
#include "shader_cost/cost.hpp"
#include "shader_cost/glsl.hpp"
#include "shader_cost/report.hpp"

namespace {

using namespace examples;

struct arguments {
    std::string snippets = SHADER_COST_SNIPPETS;
    std::string glslang = SHADER_COST_GLSLANG;
    std::string icd, json, show;
    bool check = false;
};

const std::array<family, 3> families{{{"navi21", "RDNA2"}, {"vega10", "Vega"}, {"navi10", "RDNA1"}}};

cost net(cost all, const cost& empty) {
    all.instructions -= empty.instructions;
    all.inverse_throughput -= empty.inverse_throughput;
    all.latency -= empty.latency;
    return all;
}

void work(const arguments& arguments) {
    const shaders::source snippets = shaders::read_source(arguments.snippets);
    std::vector<shader_case> cases = yardsticks();
    for (shader_case& one : snippet_cases()) cases.push_back(std::move(one));
    for (planned_case& one : planned_cases()) cases.push_back(std::move(one.which));
    if (!arguments.show.empty()) {
        const auto at = std::find_if(cases.begin(), cases.end(), [&](const shader_case& one) {
            return one.group + ", " + one.name == arguments.show;
        });
        if (at == cases.end()) throw failure("--show: no shader is named " + arguments.show);
        std::fputs(compose(*at, snippets).c_str(), stdout);
        return flush_stdout();
    }
    const std::vector<std::string> missed = left_out(cases, snippets);
    if (arguments.check && !missed.empty()) throw failure("no row has the function " + missed.front());

    std::optional<output_file> json;
    if (!arguments.json.empty()) json.emplace(arguments.json);
    const std::string icd = arguments.icd.empty() ? find_icd() : arguments.icd;
    { const compiler first(families.front(), icd); }  // a driver that does not serve is known before any work
    const glsl_compiler glslang(arguments.glslang);
    const auto compile = [&](const shader_case& one) {
        return glslang.compile(one.group + ", " + one.name, compose(one, snippets));
    };
    std::map<std::string, std::vector<std::uint32_t>> empty;  // by type of result
    for (const char* result : {"float", "vec2", "vec3", "mat3"}) empty[result] = compile(empty_case(result));
    std::vector<measured_case> all;
    std::vector<std::vector<std::uint32_t>> codes;
    for (const shader_case& one : cases) {
        all.push_back({one, {}});
        codes.push_back(compile(one));
    }
    std::vector<cost> empty_costs;
    for (const family& target : families) {
        const compiler radv(target, icd);
        std::map<std::string, cost> nothing;
        for (const auto& [result, code] : empty) nothing[result] = radv.measure(code);
        empty_costs.push_back(nothing["float"]);
        for (std::size_t i = 0; i < all.size(); ++i)
            all[i].costs.push_back(net(radv.measure(codes[i]), nothing[all[i].which.result]));
    }

    std::printf(
        "%s\ncompute shader, waves of 64; instructions, cycles a wave (inverse throughput) and cycles of a wave alone "
        "(latency)\nare what the RADV compiler estimates, less those of the empty shader; registers are what a wave "
        "gets\n",
        build_text().c_str());
    for (std::size_t f = 0; f < families.size(); ++f)
        std::printf("\n%s (%s); the empty shader: %d instructions, inverse throughput %d, latency %d\n\n%s",
                    families[f].title.c_str(), families[f].name.c_str(), empty_costs[f].instructions,
                    empty_costs[f].inverse_throughput, empty_costs[f].latency, table_of(all, f).c_str());
    const std::vector<cost_bar> bars = bars_of(all, 0);
    std::printf("\n");
    for (const cost_bar& bar : bars) std::printf("%s\n", text_of(bar).c_str());
    for (const std::string& name : missed) std::printf("no row has the function %s\n", name.c_str());
    if (json) {
        json->write(json_of(families, empty_costs, all, bars, missed));
        json->commit();
    }
    flush_stdout();
    const auto unheld = std::count_if(bars.begin(), bars.end(), [](const cost_bar& bar) { return !bar.held(); });
    if (arguments.check && unheld > 0) throw failure(std::to_string(unheld) + " bars did not hold");
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Prints what every shader snippet costs on RDNA2, Vega and RDNA1, beside the listings of the papers. The RADV "
        "compiler says it; no such GPU is needed.",
        "shader_cost");
    arguments arguments;
    app.add_option("--snippets", arguments.snippets, "folder of shader.hpp and the snippets")
        ->capture_default_str()
        ->type_name("FOLDER");
    app.add_option("--glslang", arguments.glslang, "the program glslangValidator")
        ->capture_default_str()
        ->type_name("PROGRAM");
    app.add_option(
           "--icd", arguments.icd,
           "manifest of the RADV driver for the Vulkan loader (default: radeon_icd.*.json in the usual folders)")
        ->type_name("FILE");
    app.add_option("--show", arguments.show, "only print the source of one shader, named as in the table")
        ->type_name("NAME");
    app.add_option("--json", arguments.json, "write all figures to this file, too")->type_name("FILE");
    app.add_flag("--check", arguments.check,
                 "fail where a bar does not hold, or no row has a function of the snippets");
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "shader_cost: %s\n", error.what());
    return 1;
}
