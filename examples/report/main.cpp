// report: error against run time of methods and encodings on given height maps, in tables and plots. `report --help`
// lists the options.

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/progress.hpp"
#include "common/report_text.hpp"
#include "common/tool.hpp"
#include "report/bar.hpp"
#include "report/findings.hpp"
#include "report/gnuplot.hpp"
#include "report/gpu.hpp"
#include "report/growth.hpp"
#include "report/machine.hpp"
#include "report/maps.hpp"
#include "report/plots.hpp"
#include "report/run.hpp"
#include "report/sections.hpp"
#include "report/writers.hpp"

namespace {

using namespace examples;

// Exit codes beside those of run_program.
constexpr int some_maps_skipped = 3, was_interrupted = 130;

struct arguments {
    std::vector<std::string> paths, only;
    height_source heights;
    std::string folder;
    bool quick = false;
    int seed = 1, repeats = 5;
};

std::vector<report_section> all_sections() {
    return {bake_section(),     growth_section(), encoding_section(), codebook_section(),
            triangle_section(), ssbump_section(), image_section(),    normals_section()};
}

std::string name_list(const std::vector<report_section>& sections) {
    std::string names;
    for (const report_section& section : sections) names.append(names.empty() ? "" : ", ").append(section.name);
    return names;
}

void save(const std::filesystem::path& path, const std::string& text) {
    output_file file(path);
    file.write(text);
    file.commit();
}

plot_outcome save_plots(const std::filesystem::path& folder, const std::vector<plot>& plots) {
    plot_outcome outcome{plots, false, "No plots: nothing that was measured belongs in one."};
    const std::optional<std::string> gnuplot = find_tool("gnuplot");
    int drawn = 0;
    for (const plot& p : plots) {
        save(folder / (p.name + ".gp"), script_of(p));
        save(folder / (p.name + ".dat"), data_of(p));
        std::error_code ignored;
        if (!gnuplot)
            std::filesystem::remove(folder / (p.name + ".svg"), ignored);  // of an earlier run
        else if (draw(*gnuplot, folder, p))
            ++drawn;
    }
    if (plots.empty()) return outcome;
    outcome.are_drawn = drawn == int(plots.size());
    if (outcome.are_drawn)
        outcome.about = "Plots drawn by gnuplot; scripts and data are in plots/.";
    else if (gnuplot)
        outcome.about = "Not all plots are drawn: gnuplot failed. Scripts and data are in plots/.";
    else
        outcome.about = "Plots are not drawn: gnuplot is not in PATH. Scripts and data are in plots/.";
    return outcome;
}

// Fills in the column and returns where the costs are from, or why there are none.
std::string add_gpu_costs(std::vector<record>& records, bool quick, const char* program,
                          const std::filesystem::path& folder) {
    if (std::none_of(records.begin(), records.end(), [](const record& r) { return !r.snippet.empty(); }))
        return "not measured: nothing that was measured has a shader";
    if (quick) return "not measured: --quick leaves it out";
    if (is_interrupted()) return "not measured: interrupted before";
    if (stderr_is_terminal()) std::fputs("shader_cost", stderr);
    const gpu_costs costs = measure_gpu_costs(program, folder / "shader_cost.json");
    if (stderr_is_terminal()) std::fputs("\r\033[K", stderr);
    for (record& r : records)
        if (const auto at = costs.cycles.find(r.snippet); at != costs.cycles.end()) r[column::gpu] = at->second;
    return costs.about;
}

// Returns the exit code.
int work(const arguments& arguments, const char* program) {
    const std::filesystem::path folder = arguments.folder;
    output_folder created(folder), created_plots(folder / "plots"), created_pictures(folder / "pictures");
    output_file csv(folder / "report.csv"), json(folder / "report.json"), markdown(folder / "report.md"),
        page(folder / "index.html");
    { const output_file probe(folder / "plots" / "bake.gp"), other(folder / "pictures" / "1.png"); }

    map_choice choice = choose_maps(arguments.paths, arguments.heights, arguments.quick);
    catch_interrupt();
    findings all;
    all.run = {.machine = processor_name(),
               .flags = REPORT_FLAGS,
               .date = date_text(),
               .cores = int(std::thread::hardware_concurrency()),
               .seed = std::uint32_t(arguments.seed),
               .repeats = arguments.repeats,
               .quick = arguments.quick,
               .partial = {},
               .gpu = {}};
    for (const report_map& map : choice.maps) all.maps.push_back(facts_of(map));
    all.skipped = std::move(choice.skipped);
    std::printf("%s\n", build_text().c_str());
    for (const map_facts& map : all.maps)
        std::printf("%s: %d x %d texels, height scale %.6g\n", map.name.c_str(), map.extent.x, map.extent.y,
                    map.height_scale);
    flush_stdout();

    std::vector<report_section> sections = all_sections();
    if (!arguments.only.empty())
        std::erase_if(sections, [&](const report_section& section) {
            return std::find(arguments.only.begin(), arguments.only.end(), section.name) == arguments.only.end();
        });
    run_sections(sections, choice.maps, folder, all);

    add_means(all);
    all.run.gpu = add_gpu_costs(all.records, arguments.quick, program, folder);
    if (is_interrupted()) all.run.partial = "interrupted";
    const std::vector<plot> plots = plots_of(all);
    const plot_outcome outcome = save_plots(folder / "plots", plots);
    csv.write(csv_of(all));
    json.write(json_of(all, outcome));
    markdown.write(markdown_of(all, outcome));
    page.write(page_of(all, outcome));
    for (output_file* file : {&csv, &json, &markdown, &page}) file->close();
    for (output_file* file : {&csv, &json, &markdown, &page}) file->commit();
    created.keep();

    std::error_code ignored;
    const std::string address = std::filesystem::absolute(folder / "index.html", ignored).lexically_normal().string();
    for (const growth_check& c : checks_of_growth(all.records)) std::printf("%s\n", text_of(c).c_str());
    std::printf("%zu records. %s\n%s%s\n", all.records.size(), outcome.about.c_str(),
                all.run.partial.empty() ? "Open " : ("PARTIAL, " + all.run.partial + ". Open ").c_str(),
                address.c_str());
    flush_stdout();
    if (is_interrupted()) return was_interrupted;
    if (!all.run.partial.empty()) throw failure("the report is partial: " + all.run.partial);
    return all.skipped.empty() ? 0 : some_maps_skipped;
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Measures methods and encodings on height maps: what each costs and what each gets wrong. Writes tables, plots "
        "and index.html, a page with all of them.",
        "report");
    arguments arguments;
    app.add_option("HEIGHTS", arguments.paths,
                   "height maps, PNG of 8 or 16 bits, JPEG, or --raw, and folders of them: one with a MANIFEST.tsv, or "
                   "else all its PNG files (default: a stone wall that the program makes and, without --quick, four "
                   "maps of the folder that the environment variable BUMPSHADOW_HEIGHT_MAPS names)")
        ->type_name("FILE|FOLDER...");
    app.add_option("-o,--output", arguments.folder, "folder to write to; created where it is missing")
        ->required()
        ->type_name("DIR");
    app.add_flag("--quick", arguments.quick, "a coarse choice of set-ups, within 20 seconds");
    app.add_option("--seed", arguments.seed, "of what is drawn by chance")
        ->check(whole_number(0, 1 << 30))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--repeats", arguments.repeats, "times that what is timed is run")
        ->check(whole_number(1, 1000))
        ->capture_default_str()
        ->type_name("N");
    const std::vector<report_section> sections = all_sections();
    const std::string names = name_list(sections);
    app.add_option("--only", arguments.only, "only these sections: " + names)
        ->check(CLI::Validator(
            [&](std::string& text) {
                for (const report_section& section : sections)
                    if (section.name == text) return std::string();
                return text + " is none of " + names;
            },
            ""))
        ->type_name("SECTION...");
    add_height_options(app, arguments.heights,
                       "default: what MANIFEST.tsv says, else a 16th of the map's shorter side; raw: 1");
    app.footer(
        "Exit code: 0; 1 where nothing could be measured or written, or a section failed; 2 for a wrong command line; "
        "3 where height maps that cannot be used were skipped and all else is done; 130 after Ctrl-C, which ends the "
        "measuring and writes what there is, marked as partial (a second one ends at once).");
    int code = 0;
    const int failed = run_program(app, argc, argv, [&] { code = work(arguments, argv[0]); });
    return failed != 0 ? failed : code;
} catch (const std::exception& error) {
    std::fprintf(stderr, "report: %s\n", error.what());
    return 1;
}
