#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "report/findings.hpp"
#include "report/section.hpp"

namespace examples {

// Runs the sections one by one and collects what they find; pictures are written to `folder`/pictures at once. After
// Ctrl-C, and where a section fails, what was found so far stays, and all.run.partial says why it is not everything.
void run_sections(std::span<const report_section> sections, const std::vector<report_map>& maps,
                  const std::filesystem::path& folder, findings& all);

}  // namespace examples
