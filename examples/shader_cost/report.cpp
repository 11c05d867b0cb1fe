#include "shader_cost/report.hpp"

#include <algorithm>
#include <cmath>

#include "common/file.hpp"
#include "common/report_text.hpp"

namespace examples {
namespace {

// Cycles by which plan()'s table may be off, either way.
constexpr int planned_margin = 1;

std::string full_name(const shader_case& one) { return one.group + ", " + one.name; }

std::string json_of(const cost& c) {
    return format("{\"instructions\":%d,\"inverse_throughput\":%d,\"latency\":%d,\"vgprs\":%d,\"sgprs\":%d}",
                  c.instructions, c.inverse_throughput, c.latency, c.vgprs, c.sgprs);
}

}  // namespace

// That the mismatch of the octant function is within 6 %, and that of the cubic one within 2 %, of what the arc tangent
// gives is what tests/encode/bearings.cpp checks.
std::vector<cost_bar> bars_of(std::span<const measured_case> all, std::size_t navi21) {
    const std::string vertex = "bearing and slope a vertex, ";
    std::vector<cost_bar> bars{
        {"tangent volume, mismatch within 6 % of arc tangent's", "tangent volume, octant, soft", 34},
        {"tangent volume, mismatch within 2 % of arc tangent's", "tangent volume, cubic, soft", 40},
        {"eight channels without the cube", "eight channels, no cube, layers chosen, sines, soft", 41},
        {"Fourier, 5 coefficients", "Fourier, 5, soft", 45},
        {"the same of signed roots", "Fourier, 5, roots, soft", {}},
        {"slice layers, one fetch", "slice layers, overlapping, one fetch, octant, soft", 50},
        {"slice layers, two fetches", "slice layers, grouped, two fetches, octant, soft", 58},
        {"bearing and slope a vertex at a time, pixel", vertex + "pixel: volume, soft", 22},
        {"Forsyth's pixel, which has no soft edge", "yardstick, Forsyth, pixel: sub and cnd", {}},
        {"bearing and slope a vertex at a time, vertex", vertex + "vertex: bearing and slope, octant", 22},
        {"Forsyth's vertex", "yardstick, Forsyth, vertex: bearing as published, slope", {}},
        {"a vertex with the light's way into tangent space",
         vertex + "vertex: light into tangent space, bearing and slope, octant",
         {}},
    };
    // What plan() chooses by is a table, which is to be what the compiler says.
    for (const planned_case& one : planned_cases()) {
        const int cycles = int(std::lround(one.planned));
        bars.push_back(
            {"what plan() takes it for", full_name(one.which), cycles + planned_margin, cycles - planned_margin});
    }
    for (cost_bar& bar : bars) {
        const auto at = std::find_if(all.begin(), all.end(),
                                     [&](const measured_case& one) { return full_name(one.which) == bar.name; });
        if (at == all.end()) throw failure("no case is named " + bar.name);
        bar.value = at->costs[navi21].inverse_throughput;
        bar.instructions = at->costs[navi21].instructions;
    }
    return bars;
}

std::string text_of(const cost_bar& bar) {
    const std::string cost = format(": %d in %d instructions", bar.value, bar.instructions);
    if (!bar.limit) return "no bar: " + bar.what + cost + " (" + bar.name + ")";
    const std::string bounds =
        (bar.least > 0 ? format(", %d to %d (", bar.least, *bar.limit) : format(", at most %d (", *bar.limit));
    return (bar.held() ? "held: " : "NOT held: ") + bar.what + cost + bounds + bar.name + ")";
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
                    std::span<const cost_bar> bars, std::span<const std::string> left_out) {
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
                format(",\"value\":%d,\"instructions\":%d", bar.value, bar.instructions);
        if (bar.least > 0) json += format(",\"least\":%d", bar.least);
        if (bar.limit) json += format(",\"limit\":%d,\"held\":%s", *bar.limit, bar.held() ? "true" : "false");
        json += "}";
    }
    json += "],\"left_out\":[";
    for (const std::string& name : left_out) json.append(&name == left_out.data() ? "" : ",").append(quoted(name));
    return json + "]}\n";
}

}  // namespace examples
