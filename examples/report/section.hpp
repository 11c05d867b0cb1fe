#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "common/heights.hpp"
#include "common/image.hpp"
#include "report/record.hpp"

namespace examples {

struct sample_map;

// A height map of the report.
struct report_map {
    std::string name;
    height_source source;
    height_samples heights;
    double scale = 1.0;
};

// A picture for index.html, written as PNG.
struct report_picture {
    std::string map, name;  // of the set-up
    std::string kind;       // "truth", "result", "difference"
    image8 pixels;
};

// What a section gets, and where its findings go. Sections call step() between measurements, each of which should take
// a second at most: it throws interrupted after Ctrl-C.
struct report_context {
    const std::vector<report_map>& maps;
    std::uint32_t seed = 1;
    int repeats = 5;     // of what is timed
    bool quick = false;  // a coarse choice: all of it within 20 seconds on two cores for one map of 512 x 512
    std::map<std::string, std::shared_ptr<const sample_map>>& samples;  // of the maps, by name, once they are baked
    std::function<void(record)> add;
    std::function<void(report_picture)> show;
    std::function<void(const std::string& what)> step;
};

// Part of a report. `steps` of all sections together are the progress bar's whole.
struct report_section {
    std::string name;                                      // as in record::section
    std::string title;                                     // for a reader
    std::function<int(const report_context&)> steps;       // how often run will call step()
    std::function<double(const report_context&)> seconds;  // a rough estimate of its share of the time
    std::function<void(const report_context&)> run;
};

struct interrupted {};

}  // namespace examples
