// Slices of one channel, over all axes.

#include <array>
#include <cstddef>

#include "common/choices.hpp"
#include "encodings/stored.hpp"
#include "report/slice_product.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

struct volume_format {
    bs::texel_format format;
    const char* name;
    double bytes;
};
constexpr std::array formats{volume_format{bs::texel_format::r8, "R8", 1.0},
                             volume_format{bs::texel_format::r16, "R16", 2.0},
                             volume_format{bs::texel_format::bc4, "BC4", 0.5}};
constexpr int block = 4;  // of BC4; the other formats are measured on the same texels

// The case of shader_cost, which has sines and angles with the cubic function alone.
std::string snippet_of(const slice_choice& c) {
    const std::string start = std::string("tangent volume, ") + word_of(bearing_function_names, c.function);
    if (c.scale.stored == bs::quantity::slope) return start + ", soft";
    if (c.function != bs::bearing_function::cubic) return {};
    return start + (c.scale.stored == bs::quantity::sine ? ", sines, soft" : ", angles, soft");
}

struct measured {
    slice_choice choice;
    std::array<score, formats.size()> scores = {};
};

void add(const measured& m, int side, sampled_map& to) {
    for (std::size_t i = 0; i < formats.size(); ++i) {
        record r;
        r.family = std::string("tangent volume, ") + formats[i].name;
        r.format = formats[i].name;
        r.snippet = snippet_of(m.choice);
        describe(r, m.choice, "slices");
        r[column::bytes] = m.choice.count * formats[i].bytes / (m.choice.reduction * m.choice.reduction);
        r[column::fetches] = 1.0;
        const int margin = margin_of(m.choice.reduction);
        if (is_default(m.choice))
            to.add_with_elevations(r, m.scores[i], side, margin);
        else
            to.add(r, m.scores[i], side, margin);
    }
}

}  // namespace

int volume_steps(const slice_axes& axes) {
    return int(axes.reductions.size() * axes.scales.size() * axes.functions.size());
}

void add_volumes(const report_context& context, const slice_axes& axes, sampled_map& map) {
    for (const int reduction : axes.reductions) {
        const int side = side_of(block, reduction);
        const sample_map& sample = map.cut(side);
        for (const bs::horizon_scale& scale : axes.scales) {
            slice_source source(sample, scale, reduction);
            for (const bs::bearing_function function : axes.functions) {
                if (picks_points(axes.fits)) source.prepare_points(function);
                std::vector<measured> all;
                for (const bs::slice_fit fit : axes.fits)
                    for (const int count : axes.counts) all.push_back({{fit, count, function, scale, reduction}});
                on_all_cores(all.size(), [&](std::size_t i) {
                    // The largest first, so that no core waits for one at the end.
                    measured& m = all[all.size() - 1 - i];
                    const planes slices = source.fit(m.choice);
                    for (std::size_t k = 0; k < formats.size(); ++k) {
                        planes stored = slices;
                        pass_through(stored, formats[k].format);
                        m.scores[k] = judge_slices(sample, enlarged(stored, sample.extent),
                                                   {m.choice.count, 0.0, function}, scale, margin_of(reduction));
                    }
                });
                for (const measured& m : all) add(m, side, map);
                context.step("volumes of " + sample.name);
            }
        }
    }
}

}  // namespace examples
