#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include "report/record.hpp"

namespace examples {

// Name and version of what report.json and report.csv hold. The version grows when a column or a key changes its
// meaning or goes; new ones do not change it.
inline constexpr const char* schema_name = "bumpshadow-report";
inline constexpr int schema_version = 1;

inline constexpr const char* mean_map = "mean";

// Conditions of a run.
struct run_facts {
    std::string machine, flags, date;  // date: ISO 8601, UTC
    int cores = 0;
    std::uint32_t seed = 1;
    int repeats = 5;
    bool quick = false;
    std::string partial;  // why not all was measured; empty: complete
    std::string gpu;      // where the cost on GPUs is from, or why it is missing
};

struct map_facts {
    std::string name, source;
    glm::ivec2 extent{0};
    double height_scale = 1.0;
    glm::dvec2 texel_size{1.0};
    std::string edge;
};

struct skipped_map {
    std::string source, reason;
};

struct section_facts {
    std::string name, title, state;  // "complete", "partial: ...", "not run"
};

// A difference image and what it belongs to; the file is relative to the report's folder.
struct saved_picture {
    std::string map, name, kind, file;
    glm::ivec2 extent{0};
};

// All that a run has found out.
struct findings {
    run_facts run;
    std::vector<map_facts> maps;
    std::vector<skipped_map> skipped;
    std::vector<section_facts> sections;
    std::vector<record> records;
    std::vector<saved_picture> pictures;
};

// Adds the means over the maps, as records of the map "mean": of every set-up that was measured on all of them, two at
// least. Largest errors become the largest of all, confidence intervals that of the mean.
void add_means(findings& all);

}  // namespace examples
