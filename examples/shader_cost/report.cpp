#include "shader_cost/report.hpp"

#include <algorithm>

#include "common/file.hpp"
#include "common/report_text.hpp"

namespace examples {
namespace {

std::string full_name(const shader_case& one) { return one.group + ", " + one.name; }

std::string json_of(const cost& c) {
    return format("{\"instructions\":%d,\"inverse_throughput\":%d,\"latency\":%d,\"vgprs\":%d,\"sgprs\":%d}",
                  c.instructions, c.inverse_throughput, c.latency, c.vgprs, c.sgprs);
}

}  // namespace

// Mismatch of 16 slices, each function's slices in its own directions, to that of the true angle: octant 1.01, cubic
// 1.00, diamond 1.05 (1800 texels of six maps, 96 bearings, elevations of 5 to 60 degrees).
std::vector<cost_bar> bars_of(std::span<const measured_case> all, std::size_t navi21) {
    std::vector<cost_bar> bars{
        {"tangent volume, mismatch within 6 % of arc tangent's", "tangent volume, octant, soft", 34},
        {"tangent volume, mismatch within 2 % of arc tangent's", "tangent volume, cubic, soft", 40},
        {"eight channels without the cube", "eight channels, no cube, layers chosen, sines, soft", 41},
        {"Fourier, 5 coefficients", "Fourier, 5, soft", 45},
        {"slice layers, one fetch", "slice layers, overlapping, one fetch, octant, soft", 50},
        {"slice layers, two fetches", "slice layers, grouped, two fetches, octant, soft", 58},
        {"bearing and slope a vertex at a time, pixel", "bearing and slope a vertex, pixel: volume, soft", 22},
        {"bearing and slope a vertex at a time, vertex",
         "bearing and slope a vertex, vertex: bearing and slope, octant", 22},
    };
    for (cost_bar& bar : bars) {
        const auto at = std::find_if(all.begin(), all.end(),
                                     [&](const measured_case& one) { return full_name(one.which) == bar.name; });
        if (at == all.end()) throw failure("no case is named " + bar.name);
        bar.value = at->costs[navi21].inverse_throughput;
    }
    return bars;
}

std::string table_of(std::span<const measured_case> all, std::size_t family_index) {
    std::vector<std::vector<std::string>> rows{
        {"shader", "instructions", "inverse throughput", "latency", "VGPRs", "SGPRs"}};
    for (const measured_case& one : all) {
        const cost& c = one.costs[family_index];
        rows.push_back({full_name(one.which), format("%d", c.instructions), format("%d", c.inverse_throughput),
                        format("%d", c.latency), format("%d", c.vgprs), format("%d", c.sgprs)});
    }
    return lined_up(rows);
}

std::string json_of(std::span<const family> families, std::span<const cost> empty, std::span<const measured_case> all,
                    std::span<const cost_bar> bars) {
    std::string json = build_json() + ",\"empty\":{";
    for (std::size_t f = 0; f < families.size(); ++f)
        json.append(f == 0 ? "" : ",").append(quoted(families[f].name)).append(":").append(json_of(empty[f]));
    json += "},\"shaders\":[";
    for (const measured_case& one : all) {
        json += &one == all.data() ? "\n" : ",\n";
        json += "{\"group\":" + quoted(one.which.group) + ",\"name\":" + quoted(one.which.name);
        for (std::size_t f = 0; f < families.size(); ++f)
            json.append(",").append(quoted(families[f].name)).append(":").append(json_of(one.costs[f]));
        json += "}";
    }
    json += "],\"checks\":[";
    for (const cost_bar& bar : bars) {
        json += &bar == bars.data() ? "\n" : ",\n";
        json += "{\"check\":" + quoted(bar.what) + ",\"shader\":" + quoted(bar.name) +
                format(",\"value\":%d,\"limit\":%d,\"held\":%s}", bar.value, bar.limit, bar.held() ? "true" : "false");
    }
    return json + "]}\n";
}

}  // namespace examples
