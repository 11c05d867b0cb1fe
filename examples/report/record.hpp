#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace examples {

// Numbers of a record. Each has a name, a unit and a meaning in columns.cpp, which is what the schema is made of.
enum class column {
    // What was measured.
    extent,    // side of a square map, or the geometric mean of its sides
    bearings,  // baked, or stored
    steps,     // of the cascade
    radius,    // texels; infinite: without limit
    threads,
    coefficients,  // of a Fourier series
    cube_side,     // of a factor cube
    reduction,     // extent of the map over that of the texture
    entries,       // of a codebook or palette
    triangle,      // side of a triangle over the height of the light
    elevation,     // of the light, in degrees
    // What it costs.
    bake_ns,     // a sample: one texel in one bearing
    bake_ratio,  // times as fast as the classic sweep in the same run
    shade_ns,    // a texel, one light, one thread
    bytes,       // a texel
    fetches,
    gpu,  // inverse throughput on RDNA2, net of the empty shader
    // What it gets wrong.
    samples,
    error_mean,  // of the elevation, in degrees
    error_99,
    error_largest,
    error_bias,
    error_interval,  // half width of the 95 % confidence interval of the mean
    mismatch,        // share of lit or shadowed wrongly, in percent
    mismatch_interval,
    mismatch_ratio,  // to Lengyel's layout
    rmse,            // of the shaded image, in 8-bit sRGB levels
    psnr,            // dB
    flip,            // mean of FLIP, 0 to 1
    exponent,        // of the growth of the time
    light_error,     // of diffuse light: root mean square over the mean of the truth, in percent
    normal_error,    // of normals or reflections, mean, in degrees
    count_
};

inline constexpr std::size_t column_count = std::size_t(column::count_);

// One set-up on one map.
struct record {
    std::string section;                          // "bake", "encoding", "image", ...
    std::string map;                              // "mean": over all maps
    std::string family;                           // what a plot draws as one series, for example "tangent volume, R8"
    std::string name;                             // of the set-up, unique within section and map
    std::string format, fit, function, quantity;  // where it has them: "r8", "least squares", "cubic", "slope"
    std::string snippet;                          // the case of shader_cost that reads it, "group, name"
    std::string skipped;                          // why nothing was measured
    std::array<double, column_count> values = nothing();

    [[nodiscard]] double operator[](column c) const { return values[std::size_t(c)]; }
    [[nodiscard]] double& operator[](column c) { return values[std::size_t(c)]; }
    [[nodiscard]] bool has(column c) const { return values[std::size_t(c)] == values[std::size_t(c)]; }

private:
    static constexpr std::array<double, column_count> nothing() {
        std::array<double, column_count> all{};
        for (double& value : all) value = std::numeric_limits<double>::quiet_NaN();
        return all;
    }
};

}  // namespace examples
