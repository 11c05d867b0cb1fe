// SSBump maps: light from three lightmaps and normals, against light that is traced over exact horizons.

#include <cmath>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "encodings/ssbump.hpp"
#include "report/sampled_map.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

constexpr const char* section_name = "ssbump";
constexpr int side = 28;  // texels of a patch, whole blocks of 4: light is traced from 1920 directions for each

struct part {
    const char* title;
    const char* family;
    std::span<const char* const> names;
    const std::vector<double>& values;
};

// One of the names is a share and no error.
bool is_share(const std::string& name) { return name.starts_with("texels of such a tilt"); }

// What is measured in degrees.
bool is_angle(const std::string& part, const std::string& name) {
    return part == "normals" || name.find("reflection") != std::string::npos;
}

void add(const report_context& context, const report_map& map, const part& p) {
    for (std::size_t i = 0; i < p.names.size(); ++i) {
        std::string name = p.names[i];
        if (is_share(name)) continue;
        record r;
        r.section = section_name;
        r.map = map.name;
        r.family = p.family;
        r[is_angle(p.title, name) ? column::normal_error : column::light_error] = p.values[i];
        if (std::isnan(p.values[i])) r.skipped = "no texel of this map is so steep";
        r.name = std::string(p.title) + ": " + name;
        context.add(r);
    }
}

void measure(const report_context& context, const report_map& from) {
    const sample_map sample = crop(*sample_of(context, from), side);
    const auto step = [&] { context.step("SSBump of " + from.name); };
    const ssbump_measured m = measure_ssbump(named(from), sample, step);
    step();
    add(context, from, {"normals", "SSBump, normals", ssbump_normal_names(), m.normals});
    add(context, from, {"light from three lightmaps", "SSBump, light", ssbump_light_names(), m.light});
    add(context, from, {"small formats", "SSBump, formats", ssbump_format_names(), m.formats});
}

}  // namespace

report_section ssbump_section() {
    return section_of({.name = section_name,
                       .title = "SSBump maps: light from three lightmaps and normals, against traced light",
                       .steps = [](const report_context& context,
                                   const report_map& map) { return sampled_patches(context, map) + 3; },
                       .seconds = 1.0,
                       .quick_seconds = 0.2,
                       .measure = measure});
}

}  // namespace examples
