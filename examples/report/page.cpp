#include <algorithm>
#include <string_view>
#include <utility>

#include "common/report_text.hpp"
#include "report/columns.hpp"
#include "report/tables.hpp"
#include "report/writers.hpp"

namespace examples {
namespace {

constexpr std::string_view head = R"(<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<title>bumpshadow: error against run time</title>
<style>
:root { --back: #fbfbfa; --text: #202122; --dim: #5f6163; --line: #dcdcd8; --even: #f2f2ef; --warn: #a33c00; }
@media (prefers-color-scheme: dark) {
:root { --back: #17181a; --text: #dedcd6; --dim: #a9a69e; --line: #37393d; --even: #1f2124; --warn: #ff9d5c; }
}
body { margin: 0 auto; padding: 1.5rem; max-width: 72rem; background: var(--back); color: var(--text); }
body { font: 1rem/1.5 sans-serif; }
h1, h2, h3 { font-weight: 600; }
h1 { margin: 0 0 .5rem; }
h2 { font-size: 1.25rem; margin: 2.5rem 0 .5rem; }
h3 { font-size: 1rem; margin: 1.5rem 0 .25rem; }
p, li, summary { color: var(--dim); }
ul { padding-left: 1.2rem; }
nav a { margin-right: 1rem; }
a { color: inherit; }
.partial { color: var(--warn); font-weight: 600; }
img { display: block; max-width: 100%; height: auto; border-radius: 3px; }
.plot { background: #fff; padding: .25rem; }
.three { display: grid; grid-template-columns: repeat(3, 1fr); gap: .5rem; margin: .5rem 0 1.5rem; }
.three img { width: 100%; }
figure { margin: 0; }
figcaption { color: var(--dim); font-size: .85rem; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; font-size: .85rem; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .6rem; text-align: right; white-space: nowrap; }
th { border-bottom: 1px solid var(--line); vertical-align: bottom; white-space: normal; font-weight: 600; }
th:first-child, td:first-child { text-align: left; }
tr:nth-child(even) td { background: var(--even); }
</style>
</head>
<body>
)";

std::string html_table(const std::vector<std::vector<std::string>>& rows) {
    std::string html = "<div class=\"wide\"><table>\n";
    for (const auto& row : rows) {
        const bool is_heading = &row == rows.data();
        html += "<tr>";
        for (const std::string& cell : row)
            html.append(is_heading ? "<th>" : "<td>").append(escaped(cell)).append(is_heading ? "</th>" : "</td>");
        html += "</tr>\n";
    }
    return html + "</table></div>\n";
}

std::string html_of(const table& t) {
    std::string html;
    if (!t.throughout.empty()) html += "<p>" + escaped(t.throughout) + "</p>\n";
    if (!t.rows.empty()) html += html_table(t.rows);
    if (t.skipped.empty()) return html;
    html += "<ul>\n";
    for (const std::string& skipped : t.skipped) html += "<li>skipped: " + escaped(skipped) + "</li>\n";
    return html + "</ul>\n";
}

std::string plots_html(const plot_outcome& outcome) {
    std::string html = "<h2 id=\"plots\">Plots</h2>\n";
    if (!outcome.are_drawn) html += "<p>" + escaped(outcome.about) + "</p>\n";
    for (const plot& p : outcome.plots) {
        html += "<h3>" + escaped(p.title) + "</h3>\n";
        if (outcome.are_drawn)
            html += "<img class=\"plot\" src=\"plots/" + p.name + ".svg\" alt=\"" + escaped(p.title) + "\">\n";
        if (p.front.empty()) continue;
        std::vector<std::vector<std::string>> rows{{"set-up", p.x.label, p.y.label}};
        for (const plot_point& m : p.front) rows.push_back({m.name, format("%.4g", m.x), format("%.3g", m.y)});
        html += "<details><summary>" + escaped(p.front_title) + "</summary>\n" + html_table(rows) + "</details>\n";
    }
    return html;
}

// What belongs to one set-up on one map, in one row.
std::string pictures_html(const findings& all) {
    if (all.pictures.empty()) return {};
    std::string html = "<h2 id=\"images\">Difference images</h2>\n";
    std::vector<std::pair<std::string, std::string>> shown;
    for (const saved_picture& first : all.pictures) {
        const std::pair key(first.map, first.name);
        if (std::find(shown.begin(), shown.end(), key) != shown.end()) continue;
        shown.push_back(key);
        html += "<h3>" + escaped(first.map) + ": " + escaped(first.name) + "</h3>\n<div class=\"three\">\n";
        for (const saved_picture& p : all.pictures) {
            if (p.map != first.map || p.name != first.name) continue;
            html += "<figure><img loading=\"lazy\" src=\"" + escaped(p.file) + "\" width=\"" +
                    std::to_string(p.extent.x) + "\" height=\"" + std::to_string(p.extent.y) + "\" alt=\"" +
                    escaped(p.kind) + "\"><figcaption>" + escaped(p.kind) + "</figcaption></figure>\n";
        }
        html += "</div>\n";
    }
    return html;
}

std::string sections_html(const findings& all) {
    std::string html;
    for (const section_facts& s : all.sections) {
        const std::vector<table> tables = tables_of(all, s.name);
        if (tables.empty()) continue;
        html += "<h2 id=\"" + escaped(s.name) + "\">" + escaped(s.title) + "</h2>\n";
        if (s.state != "complete") html += "<p class=\"partial\">" + escaped(s.state) + "</p>\n";
        for (const table& t : tables) {
            html += &t == tables.data() ? "<details open><summary>" : "<details><summary>";
            html += escaped(title_of(all, t.map)) + "</summary>\n" + html_of(t) + "</details>\n";
        }
    }
    return html;
}

}  // namespace

std::string page_of(const findings& all, const plot_outcome& outcome) {
    std::string html(head);
    html += "<h1>Error against run time</h1>\n<ul>\n";
    for (const std::string& line : conditions_of(all, outcome))
        html += (line.starts_with("PARTIAL") ? "<li class=\"partial\">" : "<li>") + escaped(line) + "</li>\n";
    html += "</ul>\n<nav><a href=\"#plots\">Plots</a>";
    if (!all.pictures.empty()) html += "<a href=\"#images\">Difference images</a>";
    for (const section_facts& s : all.sections)
        html += "<a href=\"#" + escaped(s.name) + "\">" + escaped(s.title) + "</a>";
    html += "<a href=\"report.csv\">report.csv</a><a href=\"report.json\">report.json</a></nav>\n";
    html += plots_html(outcome) + pictures_html(all) + sections_html(all);
    html += "<h2>Columns</h2>\n<ul>\n";
    for (std::size_t i = 0; i < column_count; ++i)
        html += "<li>" + escaped(heading_of(column(i))) + " (" + word_of(about(column(i)).kind) +
                "): " + escaped(about(column(i)).meaning) + "</li>\n";
    return html + "</ul>\n</body>\n</html>\n";
}

}  // namespace examples
