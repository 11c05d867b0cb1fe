#include "stability/encoders.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <span>
#include <type_traits>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_float2.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/texture.hpp>

namespace stability {
namespace {

namespace bs = bumpshadow;

constexpr int bearings = 16;
constexpr int texels = 100;

class checker {
public:
    explicit checker(const char* name) : name_(name) {}

    // Keeps the largest of the differences, of which none may be other than a number.
    void differs(double by) {
        worst_ = by <= worst_ ? worst_ : by;
        numbers_ = numbers_ && bs::is_finite(by);
    }
    void is_between(float value, float least, float most) { in_range_ = in_range_ && value >= least && value <= most; }

    // Ends what was looked at: a line of the table.
    void line(const char* what, double bound, const bs::status& s) {
        const bool held = bool(s) && numbers_ && in_range_ && worst_ <= bound;
        const char* const verdict = !s          ? s.message().c_str()
                                    : !numbers_ ? "not finite"
                                    : in_range_ ? held ? "held" : "too far"
                                                : "beyond [0, 1]";
        std::printf("| %s | %s | | | %.3g | %g | %s%s |\n", name_, what, worst_, bound,
                    held ? "" : "BROKEN: ", verdict);
        wrong_ += held ? 0 : 1;
        worst_ = 0.0;
        numbers_ = in_range_ = true;
    }
    [[nodiscard]] int wrong() const { return wrong_; }

private:
    const char* name_;
    double worst_ = 0.0;
    bool numbers_ = true, in_range_ = true;
    int wrong_ = 0;
};

double degrees_between(glm::dvec3 a, glm::dvec3 b) {
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))) * 180.0 / std::numbers::pi;
}

template <bs::height_sample Sample>
class trial {
public:
    trial(const char* name, const stiff_map& map, const bs::height_map<Sample>& heights)
        : check_(name), map_(map), heights_(heights) {
        for (int i = 0; i < texels; ++i) texels_.emplace_back(i * 61 % map.extent.x, (i * 37 + i / 7) % map.extent.y);
    }

    int run() {
        std::vector<float> values(bs::required_size(map_.extent, 3));
        const bs::normal_map normals{.values = values, .extent = map_.extent};
        look_at_normals(normals);
        bs::fill_directions(directions_);
        slopes_.resize(bs::required_size(map_.extent, bearings));
        horizons_ = {.values = slopes_, .extent = map_.extent, .bearings = bearings};
        if (const bs::status s = bs::bake_cascade(heights_, directions_, horizons_, map_.options); !s) {
            check_.line("horizons to pack", 0.0, s);
            return check_.wrong();
        }
        for (const bs::quantity stored : {bs::quantity::slope, bs::quantity::sine, bs::quantity::angle}) {
            const char* const names[] = {"tangent volume, 8 bits", "tangent volume of sines",
                                         "tangent volume of angles"};
            look_at_slices(names[int(stored)], bs::tangent_volume{.slices = slices(), .scale = scale(stored)},
                           1.0 / 510.0);
        }
        look_at_slices("tangent volume, 16 bits",
                       bs::tangent_volume{.slices = slices(), .scale = scale(), .format = bs::texel_format::r16},
                       1.0 / 131070.0);
        look_at_slices("slice layers", bs::slice_layers{.slices = slices(), .scale = scale()}, 1.0 / 510.0);
        look_at_sine_layers();
        look_at_fits();
        look_at_fourier();
        look_at_masks(normals);
        look_at_emboss();
        return check_.wrong();
    }

private:
    [[nodiscard]] bs::slice_set slices() const { return {.count = bearings, .function = bs::bearing_function::exact}; }
    // Not more than is steep in the unit of the case, so that something is left to look at.
    [[nodiscard]] bs::horizon_scale scale(bs::quantity stored = bs::quantity::slope) const {
        const double most = std::min(4.0 * map_.slope_unit, 1e30);
        return {stored, bs::suggest_max_slope(horizons_, float(most))};
    }
    [[nodiscard]] glm::vec2 uv(glm::ivec2 p) const { return (glm::vec2(p) + 0.5f) / glm::vec2(map_.extent); }

    void look_at_normals(const bs::normal_map& normals) {
        bs::status s = bs::bake_normals(heights_, normals);
        const double unit = bs::unit_height(heights_);
        for (const glm::ivec2 p : texels_) {
            const auto slope = [&](glm::ivec2 step, double spacing) {
                int span = 0;
                const auto at = [&](glm::ivec2 q) {
                    const auto x = bs::resolve_edge(q.x, map_.extent.x, heights_.edge);
                    const auto y = bs::resolve_edge(q.y, map_.extent.y, heights_.edge);
                    if (x < 0 || y < 0) return double(bs::sample_at(heights_, p.x, p.y));
                    ++span;
                    return double(bs::sample_at(heights_, x, y));
                };
                const double rise = at(p + step) - at(p - step);
                return rise / (span * spacing) * unit;
            };
            const double x = slope({1, 0}, heights_.texel_size.x), y = slope({0, 1}, heights_.texel_size.y);
            // Slopes whose squares overflow are all alike.
            const double length = std::hypot(x, y, 1.0);
            check_.differs(degrees_between({-x / length, -y / length, 1.0 / length}, normals.at(p.x, p.y)));
        }
        check_.line("normals, degrees", 1e-3, s);

        std::vector<std::byte> bytes(bs::required_size(map_.extent, 3));
        std::vector<float> values(bs::required_size(map_.extent, 3));
        const bs::normal_map decoded{.values = values, .extent = map_.extent};
        if (s) s = bs::encode_normals(normals, {}, {.bytes = bytes, .extent = map_.extent, .channels = 3});
        if (s) s = bs::decode_normals({.bytes = bytes, .extent = map_.extent, .channels = 3}, {}, decoded);
        for (const glm::ivec2 p : texels_) check_.differs(degrees_between(normals.at(p.x, p.y), decoded.at(p.x, p.y)));
        check_.line("normals of 8 bits, degrees", 0.39, s);
    }

    // What a horizon is where it is stored, over what stands for 1.
    [[nodiscard]] static double stored(const bs::horizon_scale& scale, float slope) {
        const float most = scale.max_slope, clamped = std::clamp(slope, 0.0f, most);
        if (scale.stored == bs::quantity::slope) return double(clamped) / double(most);
        const double angle = std::atan(double(clamped)), all = std::atan(double(most));
        return scale.stored == bs::quantity::angle ? angle / all : std::sin(angle) / std::sin(all);
    }
    [[nodiscard]] static glm::vec3 light(glm::dvec2 direction, double elevation) {
        return {float(direction.x), float(direction.y), float(elevation)};
    }

    // Factors of a few lights.
    template <class Encoding, class Textures>
    void look_at_factors(const Encoding& encoding, const Textures& textures) {
        for (const glm::ivec2 p : texels_)
            for (const double elevation : {0.0, 1e-7, 0.5, 1e7})
                check_.is_between(
                    bs::shadow_factor(encoding, textures, {}, uv(p), light(directions_[3], elevation), {8.0f, 0.5f}),
                    0.0f, 1.0f);
    }

    // `every`: an encoding stores each such direction.
    template <class Encoding, class Textures>
    void look_at_decoded(const Encoding& encoding, const Textures& textures, int every) {
        for (int i = 0; i < bearings; i += every)
            for (const glm::ivec2 p : texels_) {
                const double wanted = stored(encoding.scale, horizons_.row(i, p.y)[p.x]);
                const glm::vec3 along = light(directions_[std::size_t(i)], 0.5);
                check_.differs(std::abs(double(bs::horizon(encoding, textures, {}, uv(p), along)) - wanted));
            }
        look_at_factors(encoding, textures);
    }

    // Between texels as rounding of coordinates has it: texels of the range apart differ by up to 4e-5 of it.
    static constexpr double of_sampling = 4e-5;

    template <class Encoding>
    void look_at_slices(const char* name, const Encoding& encoding, double bound) {
        const bs::texture_layout layout = layout_of(encoding, map_.extent);
        std::vector<std::byte> bytes(layout.required_size());
        const bs::texture out{bytes, layout};
        const bs::pack_options options{.fit = bs::slice_fit::point};
        bs::status s;
        if constexpr (std::is_same_v<Encoding, bs::tangent_volume>)
            s = bs::pack_tangent_volume(horizons_, directions_, encoding, options, out);
        else
            s = bs::pack_slice_layers(horizons_, directions_, encoding, options, out);
        if (s) look_at_decoded(encoding, bs::const_texture{bytes, layout}, 1);
        check_.line(name, bound + of_sampling, s);
    }

    void look_at_sine_layers() {
        const bs::sine_layers encoding;
        const bs::texture_layout layout = layout_of(encoding, map_.extent);
        std::vector<std::byte> bytes(layout.required_size());
        const bs::texture out{bytes, layout};
        const bs::status s =
            bs::pack_sine_layers(horizons_, directions_, encoding, {.fit = bs::slice_fit::point}, std::span(&out, 1));
        if (s) look_at_decoded(encoding, bs::const_texture{bytes, layout}, 2);
        check_.line("sine layers", 1.0 / 510.0 + of_sampling, s);
    }

    // Eight slices from sixteen directions, every other one of which lies in the middle between two: the normal
    // equations of least squares are x[i-1] / 4 + 3 x[i] / 2 + x[i+1] / 4 = d[2i] + (d[2i-1] + d[2i+1]) / 2.
    [[nodiscard]] std::vector<double> fitted(const bs::horizon_scale& scale, glm::ivec2 p) const {
        constexpr std::size_t count = bearings / 2;
        std::vector<double> data, right, x(count);
        for (int i = 0; i < bearings; ++i) data.push_back(stored(scale, horizons_.row(i, p.y)[p.x]));
        for (std::size_t i = 0; i < count; ++i)
            right.push_back(data[2 * i] + 0.5 * (data[2 * i + 1] + data[(2 * i + bearings - 1) % bearings]));
        // Each time a third of the error is left.
        for (int times = 0; times < 30; ++times) {
            const std::vector<double> before = x;
            for (std::size_t i = 0; i < count; ++i)
                x[i] = (right[i] - 0.25 * (before[(i + 1) % count] + before[(i + count - 1) % count])) / 1.5;
        }
        for (double& value : x) value = std::clamp(value, 0.0, 1.0);
        return x;
    }

    void look_at_fits() {
        bs::tangent_volume encoding{.slices = slices(), .scale = scale()};
        encoding.slices.count = bearings / 2;
        const bs::texture_layout layout = layout_of(encoding, map_.extent);
        std::vector<std::byte> bytes(layout.required_size());
        const auto pack = [&](bs::slice_fit fit) {
            return bs::pack_tangent_volume(horizons_, directions_, encoding, {.fit = fit}, {bytes, layout});
        };
        bs::status s = pack(bs::slice_fit::least_squares);
        for (const glm::ivec2 p : texels_) {
            const std::vector<double> wanted = fitted(encoding.scale, p);
            for (int i = 0; s && i < bearings / 2; ++i)
                check_.differs(std::abs(double(bs::fetch({bytes, layout}, {p, i}).x) - wanted[std::size_t(i)]));
        }
        if (s) look_at_factors(encoding, bs::const_texture{bytes, layout});
        check_.line("tangent volume, fitted", 1.0 / 510.0 + 1e-5, s);
        s = pack(bs::slice_fit::least_angle);
        if (s) look_at_factors(encoding, bs::const_texture{bytes, layout});
        check_.line("tangent volume, fitted by angle", 0.0, s);

        const bs::slice_layers overlapping{
            .slices = {.count = 12}, .scale = scale(), .grouping = bs::slice_grouping::overlapping};
        const bs::texture_layout layers = layout_of(overlapping, map_.extent);
        std::vector<std::byte> grouped(layers.required_size());
        s = bs::pack_slice_layers(horizons_, directions_, overlapping, {}, {grouped, layers});
        if (s) look_at_factors(overlapping, bs::const_texture{grouped, layers});
        check_.line("slice layers that overlap, fitted", 0.0, s);
    }

    // A series does not go through its samples, so here it is enough that there is one.
    void look_at_fourier() {
        const bs::fourier encoding{.coefficients = 9, .scale = scale(bs::quantity::sine)};
        std::vector<std::vector<std::byte>> bytes;
        std::vector<bs::texture> out;
        bs::fourier_textures from{.maps = {}, .decoding = bs::decoding_of(encoding)};
        for (int i = 0; i < bs::texture_count(encoding); ++i) {
            const bs::texture_layout layout = layout_of(encoding, map_.extent, 1, i);
            bytes.emplace_back(layout.required_size());
            from.maps[std::size_t(i)] = {bytes.back(), layout};
        }
        for (std::size_t i = 0; i < bytes.size(); ++i) out.push_back({bytes[i], from.maps[i].layout});
        const bs::status s = bs::pack_fourier(horizons_, directions_, encoding, {}, out);
        if (s) look_at_factors(encoding, from);
        check_.line("Fourier, 9", 0.0, s);
    }

    void look_at_masks(const bs::normal_map& normals) {
        const bs::ssbump encoding{.occlusion = bs::mask_occlusion::directional};
        const bs::texture_layout layout = layout_of(encoding, map_.extent);
        std::vector<std::byte> bytes(layout.required_size());
        const bs::status s = bs::pack_ssbump(horizons_, directions_, normals, encoding, {bytes, layout});
        if (s) look_at_factors(encoding, bs::const_texture{bytes, layout});
        check_.line("SSBump", 0.0, s);
    }

    // Heights to bytes, of the range that they have.
    void look_at_emboss() {
        bs::emboss encoding;
        bs::status s = bs::scaled_emboss(heights_, encoding);
        const bs::texture_layout layout = layout_of(encoding, map_.extent);
        std::vector<std::byte> bytes(layout.required_size());
        if (s) s = bs::pack_emboss(heights_, encoding, {bytes, layout});
        for (const glm::ivec2 p : texels_) {
            const double height = double(bs::sample_at(heights_, p.x, p.y)) * bs::unit_height(heights_);
            const double wanted = (height - encoding.lowest) * encoding.scale;
            check_.differs(std::abs(double(bs::fetch({bytes, layout}, {p, 0}).x) - wanted));
        }
        check_.line("emboss", 1.0 / 255.0, s);
    }

    checker check_;
    const stiff_map& map_;
    bs::height_map<Sample> heights_;
    std::vector<glm::ivec2> texels_;
    std::vector<glm::dvec2> directions_ = std::vector<glm::dvec2>(bearings);
    std::vector<float> slopes_;
    bs::horizon_map horizons_;
};

template <bs::height_sample Sample>
int check(const char* name, const stiff_map& map, const std::vector<Sample>& samples) {
    return trial<Sample>(name, map, view(map, samples)).run();
}

}  // namespace

int check_encoders(const stiff_case& one) {
    const stiff_map map = one.make();
    if (map.as_double) return check(one.name.c_str(), map, map.heights);
    return check(one.name.c_str(), map, std::vector<float>(map.heights.begin(), map.heights.end()));
}

}  // namespace stability
