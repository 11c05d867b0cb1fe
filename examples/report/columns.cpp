#include "report/columns.hpp"

#include <array>
#include <cmath>
#include <cstddef>

#include "common/report_text.hpp"

namespace examples {
namespace {

using enum column_kind;

constexpr std::array<column_info, column_count> columns{{
    {"extent", "extent", "texels", setup, "side of a square map, or the geometric mean of its sides"},
    {"bearings", "bearings", "", setup, "bearings that are baked or stored"},
    {"steps", "steps", "", setup, "texels of a level that the cascade looks at"},
    {"radius", "radius", "texels", setup, "occluders farther than this are left out; inf: none are"},
    {"threads", "threads", "", setup, "threads that worked"},
    {"coefficients", "coefficients", "", setup, "coefficients of a Fourier series"},
    {"cube_side", "factor cube", "texels", setup, "side of a factor cube"},
    {"reduction", "reduction", "", setup, "extent of the map over the extent of the texture"},
    {"entries", "entries", "", setup, "entries of a codebook or palette"},
    {"triangle", "triangle over light", "", setup, "side of a triangle over the height of the light above it"},
    {"elevation", "elevation of the light", "degrees", setup,
     "elevation of the light; without: over all lights of the section"},
    {"bake_ns", "bake time", "ns a sample", column_kind::time, "median time to bake one texel in one bearing"},
    {"bake_ratio", "times as fast", "", ratio, "how many times as fast as the classic sweep, in the same run"},
    {"shade_ns", "shading time", "ns a texel", column_kind::time,
     "median time to shade a texel for one light, one thread"},
    {"bytes", "size", "bytes a texel", count,
     "size of the textures over the texels of the map; in the section bake, of the scratch memory"},
    {"fetches", "fetches", "", count, "texture fetches a pixel"},
    {"gpu", "GPU", "cycles a wave", count,
     "inverse throughput on RDNA2 as the RADV compiler estimates it, wave of 64, less the empty shader"},
    {"samples", "samples", "", setup, "samples that the errors are taken over"},
    {"error_mean", "mean error", "degrees", error, "mean absolute error of the horizon's elevation"},
    {"error_99", "99th percentile", "degrees", error, "99th percentile of that error"},
    {"error_largest", "largest", "degrees", error, "largest error found"},
    {"error_bias", "bias", "degrees", error, "mean signed error; positive: horizons too high"},
    {"error_interval", "+- of the mean", "degrees", error,
     "half width of the 95 % confidence interval of the mean error"},
    {"mismatch", "mismatch", "%", error, "share of texels and lights that are lit or shadowed wrongly"},
    {"mismatch_interval", "+-", "%", error, "half width of the 95 % confidence interval of the mismatch"},
    {"mismatch_ratio", "to Lengyel's", "", error, "mismatch over that of Lengyel's published layout, in the same run"},
    {"rmse", "RMSE", "levels", error, "root mean square error of the shaded image, in 8-bit sRGB levels"},
    {"psnr", "PSNR", "dB", error, "peak signal-to-noise ratio of the shaded image; larger is better"},
    {"flip", "FLIP", "", error, "mean of the perceptual difference FLIP, 0 to 1"},
    {"exponent", "exponent", "", ratio, "exponent that the time grows with"},
    {"light_error", "light error", "%", error,
     "root mean square error of diffuse light over the mean of the truth; of small formats the mean error"},
    {"normal_error", "normal error", "degrees", error, "mean angle between normals, or reflections, and the true ones"},
}};

static_assert(columns.back().name != nullptr, "every column has a line");

constexpr std::array<text_column, 10> texts{{
    {"section", &record::section, "part of the report"},
    {"map", &record::map, "height map; mean: over all maps of the run; empty: none"},
    {"family", &record::family, "what a plot draws as one series"},
    {"name", &record::name, "set-up; unique within section and map"},
    {"format", &record::format, "of the texture"},
    {"fit", &record::fit, "how stored slices are found from baked ones"},
    {"function", &record::function, "bearing function"},
    {"quantity", &record::quantity, "what is stored: slope, sine or angle"},
    {"snippet", &record::snippet, "the case of shader_cost that reads the textures"},
    {"skipped", &record::skipped, "why nothing was measured"},
}};

std::string number(double value, const char* pattern) {
    if (std::isnan(value)) return {};
    if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
    return format(pattern, value == 0.0 ? 0.0 : value);
}

}  // namespace

const column_info& about(column c) { return columns[std::size_t(c)]; }

const char* word_of(column_kind kind) {
    switch (kind) {
        case setup: return "set-up";
        case count: return "count";
        case column_kind::time: return "absolute time";
        case ratio: return "ratio";
        case error: break;
    }
    return "error";
}

std::span<const text_column> text_columns() { return texts; }

std::string text_of(const record& r, column c) {
    const column_kind kind = about(c).kind;
    return number(r[c], kind == setup || kind == count ? "%.6g" : "%.3g");
}

std::string number_of(const record& r, column c) { return number(r[c], "%.6g"); }

std::string heading_of(column c) {
    std::string text = about(c).heading;
    if (*about(c).unit != '\0') text.append(", ").append(about(c).unit);
    return text;
}

}  // namespace examples
