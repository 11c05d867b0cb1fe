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
    return section_of(
        {.name = section_name,
         .title = "Light interpolated over triangles: wrong answers against the light at the point, 16 slices",
         .steps = [](const report_context& context,
                     const report_map& map) { return sampled_patches(context, map) + triangle_pauses; },
         .seconds = 3.0,
         .quick_seconds = 0.3,
         .measure = measure});
}

}  // namespace examples
