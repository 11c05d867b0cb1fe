#pragma once

#include <span>
#include <string>
#include <vector>

#include "report/findings.hpp"
#include "report/plots.hpp"

namespace examples {

// How the plots came out, as a sentence.
struct plot_outcome {
    std::span<const plot> plots;
    bool are_drawn = false;  // else there are only scripts and data
    std::string about;
};

// One line a record, the columns in the order of the schema; "inf" is no limit. Only a partial run has a line before
// the heading, which begins with "# partial".
[[nodiscard]] std::string csv_of(const findings& all);

// All of it as one JSON object: schema, run, maps, sections, columns, records, pareto.
[[nodiscard]] std::string json_of(const findings& all, const plot_outcome& outcome);

// report.md: tables by section.
[[nodiscard]] std::string markdown_of(const findings& all, const plot_outcome& outcome);

// index.html: plots, difference images and tables. Needs nothing but the files beside it.
[[nodiscard]] std::string page_of(const findings& all, const plot_outcome& outcome);

// What a reader has to know about the run, a sentence each; the first says so where the run was partial.
[[nodiscard]] std::vector<std::string> conditions_of(const findings& all, const plot_outcome& outcome);

}  // namespace examples
