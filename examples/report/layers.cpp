// Slices in the channels of layers, plain and after block compression.

#include <algorithm>
#include <cstddef>
#include <optional>

#include <bumpshadow/quantize.hpp>

#include "common/file.hpp"
#include "common/report_text.hpp"
#include "encodings/compress.hpp"
#include "encodings/stored.hpp"
#include "report/slice_product.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr int compressed_side = 30;  // stored texels of a patch

// How layers are stored.
struct layer_format {
    std::string name;
    std::optional<codec> compressed = {};
    int block = 1;
    double bytes = 4.0;  // a texel of a layer
};

std::vector<layer_format> formats_of(const slice_axes& axes) {
    std::vector<layer_format> all{{"RGBA8"}};
    for (const int block : axes.blocks)
        all.push_back({format("ASTC %dx%d", block, block), codec::astc, block, 16.0 / (block * block)});
    all.push_back({"BC7", codec::bc7, 4, 1.0});
    return all;
}

std::optional<std::string> program_of(const layer_format& format, const codecs& programs) {
    return format.compressed == codec::astc ? programs.astc : programs.bc7;
}

bool is_missing(const layer_format& format, const codecs& programs) {
    return format.compressed && !program_of(format, programs);
}

struct measured {
    slice_choice choice;
    bs::slice_grouping grouping = bs::slice_grouping::four;
    planes channels = {};
    score found = {};
};

bs::slice_layers encoding_of(const measured& m) {
    return {{m.choice.count, 0.0, m.choice.function}, m.choice.scale, m.grouping};
}

std::vector<measured> setups_of(const slice_axes& axes, bs::slice_fit fit, const bs::horizon_scale& scale,
                                int reduction) {
    std::vector<measured> all;
    for (const int count : axes.counts)
        all.push_back({{fit, count, layer_function, scale, reduction}, bs::slice_grouping::four});
    if (fit != bs::slice_fit::point)
        for (const int count : axes.overlapping)
            all.push_back({{fit, count, layer_function, scale, reduction}, bs::slice_grouping::overlapping});
    return all;
}

// Slices into the channels of their layers, in 8 bits.
planes channels_of(const planes& slices, bs::slice_grouping grouping) {
    planes channels{slices.extent, {}};
    const std::size_t step = std::size_t(bs::slices_per_layer(grouping)), count = slices.values.size();
    for (std::size_t first = 0; first < count; first += step)
        for (std::size_t c = 0; c < 4; ++c) channels.values.push_back(slices.values[(first + c) % count]);
    pass_through(channels, bs::texel_format::r8);
    return channels;
}

// The layers of all setups, one below the other.
image8 stacked(const std::vector<measured>& all) {
    const glm::ivec2 extent = all.front().channels.extent;
    std::size_t layers = 0;
    for (const measured& m : all) layers += m.channels.values.size() / 4;
    image8 picture({extent.x, extent.y * int(layers)}, 4);
    auto to = picture.samples.begin();
    for (const measured& m : all)
        for (std::size_t first = 0; first < m.channels.values.size(); first += 4)
            for (std::size_t i = 0; i < m.channels.values[first].size(); ++i)
                for (std::size_t c = 0; c < 4; ++c) *to++ = bs::to_unorm8(m.channels.values[first + c][i]);
    return picture;
}

void unstack(const image8& picture, std::vector<measured>& all) {
    auto from = picture.samples.begin();
    for (measured& m : all)
        for (std::size_t first = 0; first < m.channels.values.size(); first += 4)
            for (std::size_t i = 0; i < m.channels.values[first].size(); ++i)
                for (std::size_t c = 0; c < 4; ++c) m.channels.values[first + c][i] = bs::from_unorm8(*from++);
}

record record_of(const measured& m, const layer_format& format) {
    const bool four = m.grouping == bs::slice_grouping::four;
    record r;
    r.family = (four ? "layers of four, " : "overlapping layers, ") + format.name;
    r.format = format.name;
    if (m.choice.scale.stored == bs::quantity::slope)  // the only ones that shader_cost has
        r.snippet = std::string("slice layers, ") + (four ? "grouped, two fetches" : "overlapping, one fetch") +
                    ", cubic, soft";
    describe(r, m.choice, four ? "slices in layers of four" : "slices in overlapping layers");
    const int layers = bs::layout_of(encoding_of(m), {1, 1}).layers;
    r[column::bytes] = layers * format.bytes / (m.choice.reduction * m.choice.reduction);
    r[column::fetches] = bs::fetches(encoding_of(m));
    return r;
}

// Goes through the encoder and back. Its failure is a reason to skip, not to end the report.
std::string compress(const layer_format& format, const codecs& programs, std::vector<measured>& all) {
    const std::string block = examples::format("%dx%d", format.block, format.block);
    try {
        unstack(recompress(*format.compressed, *program_of(format, programs), block, stacked(all)), all);
    } catch (const failure& error) {
        return error.what();
    }
    return {};
}

void measure(const report_context& context, const slice_axes& axes, const layer_format& format, const codecs& programs,
             bs::slice_fit fit, const bs::horizon_scale& scale, int reduction, sampled_map& map) {
    const int most = format.compressed ? std::min(compressed_side * reduction, patch_side) : patch_side;
    const int side = side_of(format.block, reduction, most), margin = margin_of(reduction);
    const sample_map& sample = map.cut(side);
    slice_source source(sample, scale, reduction);
    if (fit == bs::slice_fit::point) source.prepare_points(layer_function);
    std::vector<measured> all = setups_of(axes, fit, scale, reduction);
    on_all_cores(all.size(),
                 [&](std::size_t i) { all[i].channels = channels_of(source.fit(all[i].choice), all[i].grouping); });
    const std::string problem = format.compressed ? compress(format, programs, all) : std::string();
    if (problem.empty())
        on_all_cores(all.size(), [&](std::size_t i) {
            const planes channels = enlarged(all[i].channels, sample.extent);
            all[i].found = judge_layers(sample, channels, encoding_of(all[i]), margin);
        });
    context.step(format.name + " of " + sample.name);
    for (const measured& m : all) {
        const record r = record_of(m, format);
        if (!problem.empty())
            map.add_skipped(r, problem);
        else if (is_default(m.choice))
            map.add_with_elevations(r, m.found, side, margin);
        else
            map.add(r, m.found, side, margin);
    }
}

}  // namespace

int layer_steps(const slice_axes& axes, const codecs& programs) {
    int formats = 0;
    for (const layer_format& format : formats_of(axes)) formats += is_missing(format, programs) ? 0 : 1;
    return formats * int(axes.layer_reductions.size() * axes.layer_scales.size() * axes.layer_fits.size());
}

void add_layers(const report_context& context, const slice_axes& axes, const codecs& programs, sampled_map& map) {
    for (const layer_format& format : formats_of(axes)) {
        if (is_missing(format, programs)) {
            record r;
            r.name = "layers, " + format.name;
            map.add_skipped(r, format.compressed == codec::astc ? "astcenc is not in PATH" : "bc7enc is not in PATH");
            continue;
        }
        for (const int reduction : axes.layer_reductions)
            for (const bs::horizon_scale& scale : axes.layer_scales)
                for (const bs::slice_fit fit : axes.layer_fits)
                    measure(context, axes, format, programs, fit, scale, reduction, map);
    }
}

}  // namespace examples
