#include "common/encoding.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <type_traits>
#include <variant>

#include "common/choices.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

// printf into a string.
#ifdef __MINGW32__
[[gnu::format(gnu_printf, 1, 2)]]  // there "printf" stands for an older one, which is not what is called
#else
[[gnu::format(printf, 1, 2)]]
#endif
std::string
text(const char* format, ...) {
    char buffer[512];
    std::va_list arguments;
    va_start(arguments, format);
    std::vsnprintf(buffer, sizeof buffer, format, arguments);
    va_end(arguments);
    return buffer;
}

// JSON has no infinity: none stands for it.
std::string number(double value) { return std::isfinite(value) ? text("%.9g", value) : "null"; }

const char* name_of(bs::quantity stored) { return word_of(quantity_names, stored); }
const char* name_of(bs::bearing_function function) { return word_of(bearing_function_names, function); }

const char* name_of(bs::texel_format format) {
    constexpr const char* names[] = {"r8",      "rg8",  "rgba8",   "r16",    "rgba16", "r16f",
                                     "rgba16f", "r32f", "rgba32f", "rgb565", "bc1",    "bc4"};
    return names[int(format)];
}

std::string slices_of(const bs::slice_set& slices) {
    return text("; %d slices, %s bearing", slices.count, name_of(slices.function));
}
std::string bearings_of(const bs::tangent_volume& e) {
    if (e.kind == bs::texture_kind::flat) return "; one slice, no bearing";
    if (!bs::is_arc(e.slices)) return slices_of(e.slices) + text(", coordinate = bearing + %.9g", coordinate_offset(e));
    const bs::arc_coordinate c = arc_coordinate_of(e);
    return slices_of(e.slices) + text(", %s = %.9g * fract(bearing %+.9g) %+.9g, clamped",
                                      e.kind == bs::texture_kind::volume ? "coordinate" : "position among layers",
                                      double(c.scale), -double(c.start), double(c.offset));
}

std::string json_of(const bs::slice_set& slices) {
    const std::string arc = bs::is_arc(slices) ? text("\"arc\":%.9g,", slices.arc) : "";
    return text("\"bearings\":%d,\"phase\":%.9g,", slices.count, slices.phase) + arc +
           text("\"bearing_function\":\"%s\",", name_of(slices.function));
}
std::string json_of(const bs::horizon_scale& scale) {
    return text("\"stored\":\"%s\",\"max_slope\":%s,", name_of(scale.stored), number(double(scale.max_slope)).c_str());
}
std::string json_of(const bs::tangent_volume& e) {
    std::string common = "\"encoding\":\"tangent\"," + json_of(e.slices) + json_of(e.scale);
    if (e.kind == bs::texture_kind::flat) return common;
    if (!bs::is_arc(e.slices)) return common + text("\"coordinate_offset\":%.9g,", coordinate_offset(e));
    const bs::arc_coordinate c = arc_coordinate_of(e);
    return common + text("\"coordinate_start\":%.9g,\"coordinate_scale\":%.9g,\"coordinate_offset\":%.9g,",
                         double(c.start), double(c.scale), double(c.offset));
}
std::string json_of(const bs::slice_layers& e) {
    return "\"encoding\":\"layers\"," + json_of(e.slices) + json_of(e.scale) +
           text("\"overlapping\":%s,", e.grouping == bs::slice_grouping::overlapping ? "true" : "false");
}
std::string json_of(const bs::sine_layers& e) { return "\"encoding\":\"sine\",\"bearings\":8," + json_of(e.scale); }
std::string json_of(const bs::fourier& e) {
    std::string ranges;
    for (int i = 0; i < e.coefficients; ++i) {
        const bs::fourier_range r = stored_range(e, i);
        ranges += text("%s[%.9g,%.9g]", i == 0 ? "" : ",", double(r.low), double(r.high));
    }
    return "\"encoding\":\"fourier\"," + json_of(e.scale) +
           text("\"coefficients\":%d,\"square_root\":%s,\"stored_ranges\":[", e.coefficients,
                e.square_root ? "true" : "false") +
           ranges + "],";
}
std::string json_of(const bs::ssbump& e) {
    constexpr const char* occlusions[] = {"none", "ambient", "directional"};
    return text("\"encoding\":\"ssbump\",\"y\":\"%s\",\"occlusion\":\"%s\",\"mask_scale\":%.9g,",
                e.y == bs::normal_y::down ? "down" : "up", occlusions[int(e.occlusion)], double(mask_scale(e)));
}
std::string json_of(const bs::emboss& e) {
    return text("\"encoding\":\"emboss\",\"lowest\":%.9g,\"scale\":%.9g,", e.lowest, e.scale);
}

}  // namespace

std::string for_shaders(const encoded& map) {
    return std::visit(
        []<class Encoding>(const Encoding& e) {
            std::string words;
            if constexpr (std::is_same_v<Encoding, bs::tangent_volume>)
                words += bearings_of(e);
            else if constexpr (requires { e.slices; })
                words += slices_of(e.slices);
            if constexpr (requires { requires std::is_same_v<decltype(e.scale), bs::horizon_scale>; })
                words += text("; %s %.6g stands for 1", name_of(e.scale.stored),
                              double(bs::quantity_of_slope(e.scale.stored, e.scale.max_slope)));
            if constexpr (std::is_same_v<Encoding, bs::fourier>) words += "; --json has the ranges";
            return words;
        },
        map.how);
}

std::string json_of(const encoded& map) {
    constexpr const char* kinds[] = {"flat", "array", "cube", "volume"};
    std::string json = std::visit([](const auto& e) { return json_of(e); }, map.how) + "\"textures\":[";
    std::size_t bytes = 0;
    for (const owned_texture& t : map.textures) {
        const bs::texture_layout& l = t.layout;
        json += text(
            "%s{\"format\":\"%s\",\"kind\":\"%s\",\"width\":%d,\"height\":%d,\"depth\":%d,\"layers\":%d,"
            "\"mips\":%d,\"offset\":%zu,\"bytes\":%zu}",
            &t == map.textures.data() ? "" : ",", name_of(l.format), kinds[int(l.kind)], l.extent.x, l.extent.y,
            l.depth, l.layers, l.mips, bytes, t.bytes.size());
        bytes += t.bytes.size();
    }
    return json + text(
                      "],\"clamped\":%zu,\"steepest\":%.9g,\"directions\":%d,\"bake_seconds\":%.6f,"
                      "\"pack_seconds\":%.6f",
                      map.report.clamped, double(map.report.steepest), map.directions, map.bake_seconds,
                      map.pack_seconds);
}

}  // namespace examples
