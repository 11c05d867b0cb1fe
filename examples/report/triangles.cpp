// Points that are lit or shadowed wrongly where the light is interpolated over triangles of several sizes.

#include <string>

#include "common/report_text.hpp"
#include "encodings/triangle.hpp"
#include "report/sampled_map.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

constexpr const char* section_name = "triangle";

void measure(const report_context& context, const report_map& from) {
    const auto sample = sample_of(context, from);
    const auto step = [&] { context.step("triangles on " + from.name); };
    for (const triangle_figure& f : measure_triangles(*sample, context.quick ? 48 : 480, step)) {
        record r;
        r.section = section_name;
        r.map = from.name;
        r.family = f.form;
        r.name = f.form + ", light at " + f.place + format(", side %g", f.edge);
        r.format = "R8";
        r.function = "cubic";
        r.quantity = "slope";
        // No bearings and no snippet: beside encodings, which err against traced light, these would look better.
        r[column::triangle] = f.edge;
        r[column::mismatch] = f.percent;
        r[column::mismatch_interval] = f.interval;
        r[column::samples] = f.points;
        context.add(r);
    }
}

}  // namespace

report_section triangle_section() {
    report_section section{
        .name = section_name,
        .title = "Light interpolated over triangles: wrong answers against the light at the point, 16 slices",
        .steps = {},
        .seconds = {},
        .run = {}};
    section.steps = [](const report_context& context) {
        int steps = 0;
        for (const report_map& map : context.maps)
            if (const int patches = sampled_patches(context, map); patches > 0) steps += patches + triangle_pauses;
        return steps;
    };
    section.seconds = [](const report_context& context) {
        return (context.quick ? 0.3 : 3.0) * double(context.maps.size());
    };
    section.run = [](const report_context& context) {
        for (const report_map& map : context.maps) {
            if (sampled_patches(context, map) > 0)
                measure(context, map);
            else
                context.add(too_small(section_name, map));
        }
    };
    return section;
}

}  // namespace examples
