#include <set>

#include "common/report_text.hpp"
#include "report/columns.hpp"
#include "report/growth.hpp"
#include "report/tables.hpp"
#include "report/writers.hpp"

namespace examples {
namespace {

// Names of the columns of a kind that have a value, for "these are ...".
std::string names_of(const findings& all, column_kind kind) {
    std::string names;
    for (std::size_t i = 0; i < column_count; ++i) {
        if (about(column(i)).kind != kind) continue;
        bool is_used = false;
        for (const record& r : all.records) is_used = is_used || r.has(column(i));
        if (is_used) names.append(names.empty() ? "" : ", ").append(heading_of(column(i)));
    }
    return names;
}

std::string front_text(const plot& p) {
    std::vector<std::vector<std::string>> rows{{p.front_title, p.x.label, p.y.label}};
    for (const plot_point& m : p.front) rows.push_back({m.name, format("%.4g", m.x), format("%.3g", m.y)});
    return lined_up(rows);
}

}  // namespace

std::vector<std::string> conditions_of(const findings& all, const plot_outcome& outcome) {
    const run_facts& run = all.run;
    std::vector<std::string> lines;
    if (!run.partial.empty()) lines.push_back("PARTIAL: " + run.partial + ". What is not here was not measured.");
    lines.push_back(run.date + ", " + run.machine + format(", %d cores; ", run.cores) + build_text() + "; flags " +
                    run.flags + '.');
    lines.push_back(format("Seed %u, times are medians of up to %d repeats, of growth the least%s.", run.seed,
                           run.repeats, run.quick ? ", a coarse choice of set-ups (--quick)" : ""));
    const std::string times = names_of(all, column_kind::time), ratios = names_of(all, column_kind::ratio);
    if (!times.empty())
        lines.push_back("Absolute times of this machine, not comparable with those of another: " + times + ".");
    if (!ratios.empty()) lines.push_back("Ratios within this run: " + ratios + ".");
    lines.push_back("Cost on a GPU: " + run.gpu + ".");
    for (const map_facts& m : all.maps)
        lines.push_back("Map " + m.name +
                        format(": %d x %d texels, height scale %.6g, texel size %.6g x %.6g, edge ", m.extent.x,
                               m.extent.y, m.height_scale, m.texel_size.x, m.texel_size.y) +
                        m.edge + "; " + m.source + '.');
    for (const skipped_map& m : all.skipped) lines.push_back("Skipped: " + m.reason + '.');
    for (const section_facts& s : all.sections)
        if (s.state != "complete") lines.push_back("Section " + s.name + ": " + s.state + '.');
    for (const growth_check& c : checks_of_growth(all.records)) lines.push_back(text_of(c) + '.');
    lines.push_back(outcome.about);
    return lines;
}

std::string markdown_of(const findings& all, const plot_outcome& outcome) {
    std::string text = "# Error against run time\n\n";
    for (const std::string& line : conditions_of(all, outcome)) text += "- " + line + '\n';
    for (const plot& p : outcome.plots) {
        text += "\n## " + p.title + "\n\n";
        if (outcome.are_drawn) text += "![" + p.title + "](plots/" + p.name + ".svg)\n\n";
        if (!p.subtitle.empty()) text += p.subtitle + ".\n\n";
        if (!p.front.empty()) text += front_text(p);
    }
    for (const section_facts& s : all.sections) {
        const std::vector<table> tables = tables_of(all, s.name);
        if (tables.empty()) continue;
        text += "\n## " + s.title + '\n';
        const bool has_mean = tables.front().map == mean_map;
        if (has_mean) text += "\nThe single maps are in report.csv.\n";
        for (const table& t : tables) {
            text += "\n### " + title_of(all, t.map) + "\n\n";
            if (!t.throughout.empty()) text += t.throughout + "\n\n";
            if (!t.rows.empty()) text += lined_up(t.rows);
            if (!t.skipped.empty()) text += '\n';
            for (const std::string& skipped : t.skipped) text += "- skipped: " + skipped + '\n';
            if (has_mean) break;
        }
    }
    text += "\n## Columns\n\n";
    for (std::size_t i = 0; i < column_count; ++i)
        text += "- " + heading_of(column(i)) + " (" + word_of(about(column(i)).kind) +
                "): " + about(column(i)).meaning + '\n';
    return text;
}

}  // namespace examples
