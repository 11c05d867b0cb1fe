#include "shader/gl/encoded_maps.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <initializer_list>
#include <limits>
#include <string_view>
#include <utility>

#include <doctest/doctest.h>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "shader/gl/filter_bounds.hpp"

namespace encoded_maps {

namespace {

using namespace bumpshadow;
using glm::vec4;

constexpr glm::ivec2 extent(64, 48);
constexpr int mip_count = 4;
constexpr float infinite = std::numeric_limits<float>::infinity();

// Domes of many sizes, cut at their tops, with joints between them and a rough grain; tiles.
shapes::field<float> stones() {
    shapes::noise noise(3);
    std::vector<glm::dvec3> centers(26);  // and radius
    for (glm::dvec3& c : centers) {
        c.x = noise.uniform() * extent.x;
        c.y = noise.uniform() * extent.y;
        c.z = 5.0 + 7.0 * noise.uniform();
    }
    return shapes::sampled<float>(extent, [&](double x, double y) {
        double height = 0.0;
        for (const glm::dvec3& c : centers) {
            const double dx = std::remainder(x - c.x, extent.x), dy = std::remainder(y - c.y, extent.y);
            const double square = c.z * c.z - dx * dx - dy * dy;
            if (square > 0.0) height = std::max(height, std::min(std::sqrt(square), 0.7 * c.z));
        }
        return height + 0.4 * noise.uniform();
    });
}

std::string number(double value) {
    char text[32];
    std::snprintf(text, sizeof text, "%.9ef", value);
    return text;
}
std::string number(vec4 v) {
    return "vec4(" + number(double(v.x)) + ", " + number(double(v.y)) + ", " + number(double(v.z)) + ", " +
           number(double(v.w)) + ')';
}

std::string define(const char* name, int value) {
    return std::string("#define BUMPSHADOW_") + name + ' ' + std::to_string(value) + '\n';
}
std::string switches_of(const slice_set& slices, const horizon_scale& scale) {
    return define("BEARING", int(slices.function)) + define("QUANTITY", int(scale.stored));
}

// `text` with its $0, $1 ... replaced.
std::string filled(std::string_view text, std::initializer_list<std::string> parts) {
    std::string result;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '$')
            result += parts.begin()[text[++i] - '0'];
        else
            result += text[i];
    }
    return result;
}

// FUNCTION(textures, uv, light, rest) in GLSL and, with the sampler of the first texture, in HLSL.
void set_sampling(encoded& e, std::string_view function, std::initializer_list<std::string> rest = {}) {
    for (std::string& code : e.sampling) {
        code.append("horizon = ").append(function) += '(';
        for (const gl::bound_texture& t : e.textures) code.append(t.name) += ", ";
        if (&code == &e.sampling[1]) code.append(e.textures[0].name) += "_sampler, ";
        code += "uv, light";
        for (const std::string& argument : rest) code.append(", ") += argument;
        code += ");\n";
    }
}

sampler how_of(int mips, address_mode z = address_mode::repeat) {
    return {.z = z, .levels = mips > 1 ? filter_mode::linear : filter_mode::point};
}

const char* text_of(texel_format format) {
    constexpr const char* names[] = {"r8",      "rg8",  "rgba8",   "r16",    "rgba16", "r16f",
                                     "rgba16f", "r32f", "rgba32f", "rgb565", "bc1",    "bc4"};
    return names[int(format)];
}

}  // namespace

std::string maps::name() { return "map" + std::to_string(names_++); }

texture maps::make(const texture_layout& layout) { return {bytes_.emplace_back(layout.required_size()), layout}; }

maps::maps() : heights_(stones()), directions_(32) {
    fill_directions(directions_);
    const int bearings = int(directions_.size());
    for (int level = 0; level < mip_count; ++level) {
        const glm::ivec2 size(mip_extent(extent.x, level), mip_extent(extent.y, level));
        levels_.push_back({floats_.emplace_back(required_size(size, bearings)), size, bearings});
    }
    REQUIRE(bool(bake_cascade(heights_.view(), directions_, levels_[0])));
    for (int level = 1; level < mip_count; ++level) REQUIRE(bool(reduce(levels_[0], {}, levels_[std::size_t(level)])));
    normals_ = {floats_.emplace_back(3 * heights_.samples.size()), extent};
    REQUIRE(bool(bake_normals(heights_.view(), normals_)));
    add_all();
}

void maps::add_all() {
    using enum texel_format;
    constexpr bearing_function cubic = bearing_function::cubic;
    constexpr texture_kind volume = texture_kind::volume, array = texture_kind::array;
    for (const texture_kind kind : {volume, array}) {
        for (const texel_format format : {r8, r16, r16f}) add({{16, 0.0, cubic}, {}, format, kind}, 1);
        for (const texel_format format : {r8, r16f}) add({{16, 0.0, cubic}, {}, format, kind}, mip_count, ", mips");
        add({{11, kind == volume ? 0.03 : -1.7, cubic}, {}, r16f, kind}, 1, ", 11 slices, phase");
        for (const texel_format format : {r8, r16f}) add({{5, 0.03, cubic, 0.4}, {}, format, kind}, 1, ", arc");
    }
    add({{16, 0.0, cubic}, {}, bc4, array}, 1);
    add({{5, -1.67, cubic, 0.4}, {}, r8, array}, mip_count, ", arc, mips");
    add({{1, 0.03, cubic, 0.4}, {}, r8, texture_kind::flat}, 1);
    for (const texture_kind kind : {volume, array}) add_slopes(kind);
    constexpr const char* functions[] = {", exact", ", quintic", ", cubic", ", octant", ", diamond"};
    for (int i = 0; i < 5; ++i) add({{16, 0.0, bearing_function(i)}, {}, r16f}, 1, functions[i]);
    add({{16, 0.0, cubic}, {quantity::sine, infinite}, r16f}, 1, ", sine");
    add({{16, 0.0, cubic}, {quantity::angle, 3.0f}, r16f}, 1, ", angle");

    for (const auto grouping : {slice_grouping::four, slice_grouping::overlapping}) {
        add({{12, 0.0, cubic}, {}, grouping}, 1);
        add({{12, 0.03, cubic}, {}, grouping}, mip_count);
    }
    for (const sine_way way : {sine_way::array, sine_way::half, sine_way::two, sine_way::published, sine_way::biased})
        add({sine_layers{}.scale, way == sine_way::two}, way);
    add({horizon_scale{}, false}, sine_way::half);
    for (const int coefficients : {3, 5, 7, 9})
        for (const int bits : {8, 16})
            for (const bool root : {false, true}) {
                fourier f;
                f.coefficients = coefficients;
                f.bits = bits;
                f.square_root = root;
                f.scale = {quantity::sine, infinite};
                if (!root) REQUIRE(bool(tighten_ranges(levels_[0], directions_, f, {})));
                add(f);
            }
    for (const normal_y y : {normal_y::down, normal_y::up}) {
        for (const bool detail : {false, true}) add({rgba8, y, mask_occlusion::directional, detail});
        add({rgb565, y, mask_occlusion::directional, false});
    }
    add_emboss();
}

void maps::add(const tangent_volume& v, int mips, const char* remark) {
    const texture t = make(layout_of(v, extent, mips));
    REQUIRE(bool(pack_tangent_volume(levels(mips), directions_, v, {}, t)));
    add(v, t, mips, remark);
}

// The first bearing is the first layer, as in a texture: [bearing][y][x].
void maps::add_slopes(texture_kind kind) {
    const slice_set slices{int(directions_.size()), 0.0, bearing_function::exact};
    const tangent_volume v{slices, {quantity::slope, 1.0f}, texel_format::r32f, kind};
    const std::span<const float> slopes = levels_[0].values;
    const texture t = make(layout_of(v, extent, 1));
    REQUIRE(t.bytes.size() == slopes.size_bytes());
    std::copy_n(std::as_bytes(slopes).begin(), slopes.size_bytes(), t.bytes.begin());
    add(v, t, 1, ", slopes as baked");
    all_.back().bound = exact * *std::max_element(slopes.begin(), slopes.end());
}

void maps::add(const tangent_volume& v, const texture& t, int mips, const char* remark) {
    const bool volume = v.kind == texture_kind::volume, flat = v.kind == texture_kind::flat, arc = is_arc(v.slices);
    const sampler how = how_of(mips, arc ? address_mode::clamp : address_mode::repeat);
    const arc_coordinate c = arc_coordinate_of(v);
    const double other = volume ? coordinate_offset(v) : v.slices.phase;
    std::string map = name(), slices = number(v.slices.count), constants = number(arc ? double(c.start) : other);
    if (arc) constants += ", " + number(double(c.scale)) + ", " + number(double(c.offset));
    encoded e{};
    constexpr const char* kinds[] = {"one slice, ", "slices, array, ", "cube, ", "tangent volume, "};
    e.name = kinds[int(v.kind)] + std::string(text_of(v.format)) + remark;
    e.switches = switches_of(v.slices, v.scale);
    e.textures = {{map, t, how}};
    e.scale = v.scale;
    e.bound = bound_of(v);
    e.mips = mips;
    e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(v, const_texture(t), how, uv, light, level); };
    if (flat) e.code = filled("horizon = sample_$0(uv, level).x;\n", {map});
    if (volume) {
        e.code = filled(
            "float w = bumpshadow_$2_coordinate(bumpshadow_bearing(vec2(light.x, light.y)), $0);\n"
            "horizon = sample_$1(vec3(uv.x, uv.y, w), level).x;\n",
            {constants, map, arc ? "arc" : "volume"});
        set_sampling(e, arc ? "bumpshadow_sample_arc" : "bumpshadow_sample_volume", {constants});
    } else if (!flat) {
        e.code = filled(
            "vec3 p = bumpshadow_$3_layers(bumpshadow_bearing(vec2(light.x, light.y)), $0, $1);\n"
            "horizon = bumpshadow_tangent_horizon(sample_$2(vec3(uv.x, uv.y, p.x), level).x,\n"
            "                                     sample_$2(vec3(uv.x, uv.y, p.y), level).x, p.z);\n",
            {constants, slices, map, arc ? "arc" : "tangent"});
        set_sampling(e, arc ? "bumpshadow_sample_arc_slices" : "bumpshadow_sample_slices", {constants, slices});
    }
    all_.push_back(std::move(e));
}

void maps::add(const slice_layers& s, int mips) {
    const texture t = make(layout_of(s, extent, mips));
    REQUIRE(bool(pack_slice_layers(levels(mips), directions_, s, {}, t)));
    const sampler how = how_of(mips);
    const std::string map = name(), phase = number(s.slices.phase), slices = number(s.slices.count);
    const bool four = s.grouping == slice_grouping::four;
    encoded e{};
    e.name = std::string("slice layers, ") + (four ? "four" : "overlapping") + (mips > 1 ? ", mips, phase" : "");
    e.switches = switches_of(s.slices, s.scale);
    e.textures = {{map, t, how}};
    e.scale = s.scale;
    e.bound = filter_2d;
    e.mips = mips;
    e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(s, const_texture(t), how, uv, light, level); };
    const char* const code =
        four ? "vec3 p = bumpshadow_grouped_layers(position, $1 * 0.25f);\n"
               "horizon = bumpshadow_grouped_horizon(sample_$2(vec3(uv.x, uv.y, p.x), level),\n"
               "                                     sample_$2(vec3(uv.x, uv.y, p.y), level).x, p.z);\n"
             : "vec2 p = bumpshadow_overlapping_layer(position);\n"
               "horizon = bumpshadow_overlapping_horizon(sample_$2(vec3(uv.x, uv.y, p.x), level), p.y);\n";
    e.code = filled(std::string("float bearing = bumpshadow_bearing(vec2(light.x, light.y));\n"
                                "float position = bumpshadow_slice_position(bearing, $0, $1);\n") +
                        code,
                    {phase, slices, map});
    set_sampling(e, four ? "bumpshadow_sample_grouped" : "bumpshadow_sample_overlapping", {phase, slices});
    all_.push_back(std::move(e));
}

void maps::add(const sine_layers& s, sine_way way) {
    std::vector<texture> out;
    encoded e{};
    for (int i = 0; i < texture_count(s); ++i) {
        out.push_back(make(layout_of(s, extent)));
        e.textures.push_back({name(), out.back(), {}});
    }
    REQUIRE(bool(pack_sine_layers(levels_[0], directions_, s, {}, out)));
    e.name = s.scale.stored == quantity::sine ? "sine layers, " : "sine layers, slopes, ";
    e.switches = switches_of({}, s.scale);
    e.scale = s.scale;
    e.bound = filter_2d;
    const std::string map = e.textures[0].name;
    const const_texture first = out[0];
    e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(s, first, {}, uv, light, level); };
    if (way == sine_way::array) {
        e.name += "array";
        e.code = filled(
            "horizon = bumpshadow_sine_layers(sample_$0(vec3(uv.x, uv.y, 0.0f), level),\n"
            "    sample_$0(vec3(uv.x, uv.y, 1.0f), level), vec2(light.x, light.y));\n",
            {map});
    } else if (way == sine_way::half) {
        e.name += "array, half";
        e.code = filled(
            "float first = bumpshadow_sine_first_layer(vec2(light.x, light.y));\n"
            "horizon = bumpshadow_sine_half(sample_$0(vec3(uv.x, uv.y, first), level),\n"
            "    sample_$0(vec3(uv.x, uv.y, 1.0f - first), level).x, vec2(light.x, light.y));\n",
            {map});
        set_sampling(e, "bumpshadow_sample_sine_layers");
    } else if (way == sine_way::two) {
        e.name += "two textures";
        e.code = filled(
            "horizon = bumpshadow_sine_layers(sample_$0(uv, level), sample_$1(uv, level),\n"
            "    vec2(light.x, light.y));\n",
            {map, e.textures[1].name});
        const two_textures two{out[0], out[1]};
        e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(s, two, {}, uv, light, level); };
        set_sampling(e, "bumpshadow_sample_two_maps");
    } else {
        const factor_cube c{16, way == sine_way::published ? factor_form::published : factor_form::biased};
        const std::string form = way == sine_way::published ? "published" : "biased";
        const texture cube = make(layout_of(c));
        REQUIRE(bool(write_factor_cube(c, cube)));
        e.textures.push_back({name(), cube, {}});
        e.name += form + " cube";
        e.code = filled(
            "horizon = bumpshadow_sine_layers_factors(sample_$0(vec3(uv.x, uv.y, 0.0f), level),\n"
            "    sample_$0(vec3(uv.x, uv.y, 1.0f), level),\n"
            "    bumpshadow_factors_$1_cube(sample_$2(light, 0.0f)));\n",
            {map, form, e.textures[1].name});
        if (way == sine_way::biased) set_sampling(e, "bumpshadow_sample_with_cube");
        // Horizons are at most 1. Each texel of the layers is off by filter_2d times its factor. Factors add up to 1,
        // by half a step of a byte in each of the four channels, which 2.008 times become factors, more: 4 / 255; the
        // published form leaks 1 / 255 from each of the three channels of layer 0 that are at rest, or from all four.
        // And the four channels are off by filter_cube themselves.
        e.bound = filter_2d * (1.0f + 8.1f / 255.0f) + 4.0f * 2.008f * filter_cube;
        const with_factor_cube<const_texture> with{first, cube, c.form};
        e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(s, with, {}, uv, light, level); };
    }
    all_.push_back(std::move(e));
}

void maps::add(const fourier& f) {
    fourier_textures from{{}, decoding_of(f)};
    const fourier_decoding& d = from.decoding;
    std::vector<texture> out;
    encoded e{};
    for (int i = 0; i < texture_count(f); ++i) {
        out.push_back(make(layout_of(f, extent, 1, i)));
        from.maps[std::size_t(i)] = out.back();
        e.textures.push_back({name(), out.back(), {}});
    }
    REQUIRE(bool(pack_fourier(levels_[0], directions_, f, {}, out)));
    const std::string root = f.square_root ? "root_" : "", scale = number(double(d.constant_scale)),
                      offset = number(double(d.constant_offset));
    e.name = "Fourier " + std::to_string(f.coefficients) + ", " + std::to_string(f.bits) + " bits" +
             (f.square_root ? ", roots" : "");
    e.switches = switches_of({}, f.scale);
    e.scale = f.scale;
    e.bound = bound_of(f);
    e.expected = [=](vec2 uv, vec3 light, float level) { return horizon(f, from, {}, uv, light, level); };
    const auto texel = [&](std::size_t i) {
        return filled("bumpshadow_fourier_$0texel(sample_$1(uv, level), $2, $3)",
                      {root, e.textures[i].name, number(d.scale[i]), number(d.offset[i])});
    };
    const auto constant = [&](std::size_t i) {
        return filled(f.square_root ? "bumpshadow_fourier_root_constant(sample_$0(uv, level).x, $1, $2)"
                                    : "sample_$0(uv, level).x * $1 + $2",
                      {e.textures[i].name, scale, offset});
    };
    e.code = "vec2 direction = bumpshadow_fourier_direction(vec2(light.x, light.y));\nvec4 one = " + texel(0) + ";\n";
    if (f.coefficients > 5) e.code += "vec4 more = " + texel(1) + ";\n";
    switch (f.coefficients) {
        case 3: e.code += "horizon = bumpshadow_fourier_3(vec3(one.x, one.y, one.z), direction);\n"; break;
        case 5: e.code += "horizon = bumpshadow_fourier_5(one, " + constant(1) + ", direction);\n"; break;
        case 7: e.code += "horizon = bumpshadow_fourier_7(one, vec3(more.x, more.y, more.z), direction);\n"; break;
        default: e.code += "horizon = bumpshadow_fourier_9(one, more, " + constant(2) + ", direction);\n";
    }
    if (f.coefficients == 5 && !f.square_root)
        set_sampling(e, "bumpshadow_sample_fourier_5",
                     {number(d.scale[0]), number(d.offset[0]), "vec2(" + scale + ", " + offset + ')'});
    all_.push_back(std::move(e));
}

// The snippets leave it to the shader that a light below the surface is dark, and the reference clamps.
void maps::add(const ssbump& s) {
    const texture t = make(layout_of(s, extent));
    REQUIRE(bool(pack_ssbump(levels_[0], directions_, normals_, s, t)));
    const bool up = s.y == normal_y::up;
    encoded e{};
    e.name = std::string("SSBump, ") + text_of(s.format) + (up ? ", y up" : ", y down") + (s.detail ? ", detail" : "");
    e.switches = switches_of({}, {});
    e.textures = {{name(), t, {}}};
    const char* const clamped = "horizon = light.z >= 0.0f ? clamp(horizon, 0.0f, 1.0f) : 0.0f;\n";
    e.code = filled(std::string("vec4 texel = sample_$0(uv, level);\n"
                                "vec3 masks = vec3(texel.x, texel.y, texel.z);\n") +
                        (up ? "masks = bumpshadow_ssbump_other_hand(masks);\n" : "") +
                        "horizon = $1 * bumpshadow_ssbump_light(masks, bumpshadow_ssbump_weights(light));\n" + clamped,
                    {e.textures[0].name, number(1.0 / double(mask_scale(s)))});
    if (!up && !s.detail) {
        set_sampling(e, "bumpshadow_sample_ssbump");
        for (std::string& code : e.sampling) code += clamped;
    }
    // The weights of a unit vector add up to sqrt(3) at most.
    e.bound = (s.format == texel_format::rgb565 ? filter_565 : filter_2d) * 1.7321f / mask_scale(s);
    e.brightness = true;
    e.expected = [=](vec2 uv, vec3 light, float level) {
        return shadow_factor(s, const_texture(t), {}, uv, light, {}, level);
    };
    all_.push_back(std::move(e));
}

void maps::add_emboss() {
    emboss packing;
    REQUIRE(bool(scaled_emboss(heights_.view(), packing)));
    const texture t = make(layout_of(packing, extent));
    REQUIRE(bool(pack_emboss(heights_.view(), packing, t)));
    const emboss_texture from{t, {1.0f / float(extent.x), 1.0f / float(extent.y)}};
    encoded e{};
    e.name = "emboss";
    e.switches = switches_of({}, {});
    e.textures = {{name(), t, {}}};
    e.code = filled(
        "vec2 shifted = uv + bumpshadow_emboss_shift(light, vec2($1, $2));\n"
        "float inverse = bumpshadow_emboss_inverse(sample_$0(shifted, level).x);\n"
        "horizon = 2.0f * bumpshadow_emboss_relief(sample_$0(uv, level).x, inverse);\n"
        "horizon = light.z >= 0.0f ? horizon : 0.0f;\n",
        {e.textures[0].name, number(double(from.amount.x)), number(double(from.amount.y))});
    e.bound = 2.0f * 2.0f * filter_2d;  // twice the sum of two texels
    e.brightness = true;
    e.expected = [=](vec2 uv, vec3 light, float level) {
        return shadow_factor(packing, from, {}, uv, light, {}, level);
    };
    all_.push_back(std::move(e));
}

}  // namespace encoded_maps
