#pragma once

#include <string>
#include <vector>

#include <bumpshadow/choices.hpp>
#include <bumpshadow/encode/quantity.hpp>
#include <bumpshadow/encode/slice_fit.hpp>

#include "encodings/planes.hpp"
#include "encodings/setups.hpp"
#include "report/sampled_map.hpp"
#include "report/section.hpp"

namespace examples {

// The axes that slices are measured over, each with each.
//
// Volumes take all of them. What layers leave out, and why:
//   The slices are the same, so that only what packing them adds is measured: with the cubic function alone, since the
//   volumes show what functions do. Overlapping layers of 12 and 24 slices (a multiple of 3) are not picked by points:
//   layers of four show what picking does.
//   Compression sees 30 x 30 stored texels of each patch at most: astcenc takes half of the section's time as it is.
struct slice_axes {
    std::vector<int> counts, overlapping;  // slices
    std::vector<int> reductions;           // extent of the map over that of the texture
    std::vector<bumpshadow::horizon_scale> scales;
    std::vector<bumpshadow::bearing_function> functions;
    std::vector<bumpshadow::slice_fit> fits;
    // Of layers.
    std::vector<int> layer_reductions;
    std::vector<bumpshadow::horizon_scale> layer_scales;
    std::vector<bumpshadow::slice_fit> layer_fits;
    std::vector<int> blocks;  // sides of those of ASTC
};

[[nodiscard]] slice_axes slice_axes_of(bool quick);

[[nodiscard]] bool picks_points(const std::vector<bumpshadow::slice_fit>& fits);

// The function of all layers.
inline constexpr auto layer_function = bumpshadow::bearing_function::cubic;

// Texels of a patch that are used at 1 / reduction of the extent, whole blocks of `block` stored texels, and those at
// its border that are not judged, since filtering would reach beyond the patch. So set-ups of different blocks and
// reductions see different parts of the patches: mismatch_ratio, whose two sides see the same, compares them best.
//   most: texels of a patch, or of what is compressed
[[nodiscard]] int side_of(int block, int reduction, int most = patch_side);
[[nodiscard]] int margin_of(int reduction);

// How often the functions below call step().
[[nodiscard]] int volume_steps(const slice_axes& axes);
[[nodiscard]] int layer_steps(const slice_axes& axes, const codecs& programs);

// Volumes in R8, R16 and BC4. Where points are picked, the sample has the slices of the functions.
void add_volumes(const report_context& context, const slice_axes& axes, sampled_map& map);

// Layers of four and overlapping ones, in RGBA8 and after ASTC and BC7. What has no encoder here is skipped.
void add_layers(const report_context& context, const slice_axes& axes, const codecs& programs, sampled_map& map);

// ---- What both are made of ----

// Slices of a fit.
struct slice_choice {
    bumpshadow::slice_fit fit;
    int count;
    bumpshadow::bearing_function function = layer_function;
    bumpshadow::horizon_scale scale = {};
    int reduction = 1;
};

// What most users would try first of a family: 8 slices (12 where a multiple of 3 is needed) of slopes, by least
// squares.
[[nodiscard]] bool is_default(const slice_choice& choice);

// Everything but family, format, snippet, bytes and fetches. kind: "slices", "slices in layers of four"; the format of
// the record has to be set
void describe(record& r, const slice_choice& choice, const std::string& kind);

// ", extent / 2"; empty for 1.
[[nodiscard]] std::string words_of_reduction(int reduction);

// The slopes that slices of one map, scale and reduction are fitted to, for many fits.
class slice_source {
public:
    slice_source(const sample_map& map, const bumpshadow::horizon_scale& scale, int reduction);

    // Before slices of that function are picked by points. The sample has to have them.
    void prepare_points(bumpshadow::bearing_function function);
    // choice: of that scale and reduction
    [[nodiscard]] planes fit(const slice_choice& choice) const;

private:
    [[nodiscard]] bumpshadow::horizon_map made_small(const bumpshadow::horizon_map& slopes, horizons& memory) const;

    const sample_map& map_;
    bumpshadow::horizon_scale scale_;
    int reduction_;
    horizons all_memory_, points_memory_;
    bumpshadow::horizon_map all_, points_;
};

}  // namespace examples
