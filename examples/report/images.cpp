// Pictures of the map under several lights against pictures with traced shadows.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/measure/time.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/choices.hpp"
#include "common/encoded_shadow.hpp"
#include "common/encoding.hpp"
#include "common/shading.hpp"
#include "report/image_setups.hpp"
#include "report/lit_window.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr int longest = 320, longest_quick = 192;  // sides of pictures
constexpr int longest_timed = 128;                 // of what is shaded to take the time
// The light that pictures are shown under: from above, as people expect it, and low.
constexpr double shown_azimuth = 260.0, shown_elevation = 20.0;

// Everything is compared with the same truth: normals of the height map, horizons traced in the light's own bearing,
// the edge that the sun makes, light = ambient + color * shadow * max(n . l, 0). What has shadows only gets the same
// normals and is off by its shadows. SSBump gives the shadowed cosine itself, in place of both. Embossing gives
// brightness and darkness around a flat surface in that light, in place of everything.
class gallery {
public:
    gallery(const report_context& context, const report_map& map)
        : context_(context),
          map_(map),
          shown_(map, context.quick ? longest_quick : longest),
          timed_(map, longest_timed) {
        source_ = map.source;
        source_.height_scale = map.scale;
        how_.x = how_.y = map.source.edge == bs::edge_mode::repeat   ? bs::address_mode::repeat
                          : map.source.edge == bs::edge_mode::mirror ? bs::address_mode::mirror
                                                                     : bs::address_mode::clamp;
    }

    void run() {
        for (const double azimuth : light_azimuths(context_.quick)) trace(azimuth);
        for (const image_setup& setup : image_setups(context_.quick)) {
            step(setup.name);
            std::optional<encoded> map;
            if (setup.settings.kind != encoding_kind::none)
                map = encode_heights(map_.heights, source_, {}, setup.settings, 0);
            if (!map)
                compare(setup, map, bs::no_shadow{});
            else
                with_encoded_shadow(*map,
                                    {.how = how_,
                                     .edge = {},
                                     .light_radius = bs::sun_radius,
                                     .published = setup.settings.published,
                                     .emboss_shift = {}},
                                    [&](const auto& shadow) { compare(setup, map, shadow); });
        }
    }

private:
    struct lit_truth {
        far_light light;
        image8 picture;
    };

    void step(const std::string& what) const {
        std::string text = map_.name;
        context_.step(text.append(": ").append(what));
    }

    // One bearing does for all elevations.
    void trace(double azimuth) {
        step("tracing");
        owned_texture slopes(layout_of(bs::traced{}, shown_.extent()));
        std::vector<float> values(bs::required_size(shown_.extent(), 1));
        const glm::dvec2 toward(std::cos(azimuth * std::numbers::pi / 180.0),
                                std::sin(azimuth * std::numbers::pi / 180.0));
        bs::bake_options options;
        options.region = shown_.window();
        const bs::horizon_map out{.values = values, .extent = shown_.extent(), .bearings = 1};
        const bs::status status = with_height_map(map_.heights, source_, map_.scale, [&](const auto& view) {
            return bs::bake_exact(view, std::span(&toward, 1), out, options, bs::threads());
        });
        if (!status) throw failure(status.message().c_str());
        std::copy_n(reinterpret_cast<const std::byte*>(values.data()), slopes.bytes.size(), slopes.bytes.data());
        const bs::encoded_shadow<bs::traced> shadow{{}, slopes.view(), {}, {.c = 0.5f}, bs::sun_radius};
        for (const double elevation : light_elevations(context_.quick)) {
            const far_light light{azimuth, elevation};
            const bs::shade_options options_of_light = sun_and_sky(shown_.surface(), light.direction());
            truths_.push_back({light, shade_picture(shown_.surface(), options_of_light, shadow, bs::threads())});
        }
    }

    [[nodiscard]] static bs::shade_options options_for(const lit_window& of, const far_light& light,
                                                       encoding_kind kind) {
        bs::shade_options options = sun_and_sky(of.surface(), light.direction());
        if (kind == encoding_kind::emboss) {
            options.light.color = options.ambient + options.light.color * light.direction().z;
            options.ambient = glm::vec3(0.0f);
        }
        return options;
    }

    template <class Shadow>
    void compare(const image_setup& setup, const std::optional<encoded>& map, const Shadow& of_whole) {
        record r = record_of(setup, map);
        picture_errors errors;
        for (const lit_truth& truth : truths_) {
            step(setup.name);
            const image8 picture =
                shade_picture(shown_.surface(), options_for(shown_, truth.light, setup.settings.kind),
                              shown_.of_whole(of_whole), bs::threads());
            const std::vector<float>& difference = errors.add(truth.picture, picture);
            if (!setup.pictured || truth.light.azimuth != shown_azimuth || truth.light.elevation != shown_elevation)
                continue;
            context_.show({map_.name, setup.name, "truth", truth.picture});
            context_.show({map_.name, setup.name, "result", picture});
            context_.show({map_.name, setup.name, "difference (FLIP: black 0, pale yellow 1)",
                           picture_of_flip(difference, shown_.extent())});
        }
        errors.put(r);

        step(setup.name);
        const far_light light{shown_azimuth, shown_elevation};
        const bs::shade_options options = options_for(timed_, light, setup.settings.kind);
        std::vector<float> linear(3 * std::size_t(timed_.texels()));
        const auto shadow = timed_.of_whole(of_whole);
        const bs::time_figures time = bs::measure_time(context_.repeats, [&] {
            const bs::status status = bs::shade(options, shadow, bs::flat_surface{.extent = timed_.extent()},
                                                {.values = linear, .extent = timed_.extent()});
            if (!status) throw failure(status.message().c_str());
        });
        r[column::shade_ns] = time.median * 1e9 / timed_.texels();
        context_.add(r);
    }

    // Bytes and fetches are those of the shadow; all but SSBump and embossing need a normal map besides.
    record record_of(const image_setup& setup, const std::optional<encoded>& map) const {
        record r;
        r.section = "image";
        r.map = map_.name;
        r.family = setup.family;
        r.name = setup.name;
        r.snippet = setup.snippet;
        r[column::extent] = std::sqrt(double(shown_.whole().x) * double(shown_.whole().y));
        r[column::bytes] = r[column::fetches] = 0.0;
        if (!map) return r;
        r[column::bytes] = 0.0;
        for (const owned_texture& t : map->textures) r[column::bytes] += t.layout.bytes_per_texel(map->extent);
        r[column::reduction] = setup.settings.reduce;
        std::visit(
            [&]<class Encoding>(const Encoding& e) {
                r[column::fetches] = fetches(e);
                if constexpr (requires { e.slices; }) {
                    r[column::bearings] = e.slices.count;
                    r.function = word_of(bearing_function_names, e.slices.function);
                    r.fit = setup.settings.fit == bs::slice_fit::point ? "point" : "least squares";
                }
                if constexpr (requires { requires std::is_same_v<decltype(e.scale), bs::horizon_scale>; })
                    r.quantity = word_of(quantity_names, e.scale.stored);
                if constexpr (std::is_same_v<Encoding, bs::tangent_volume>)
                    r.format = e.format == bs::texel_format::bc4 ? "bc4" : "r8";
                if constexpr (std::is_same_v<Encoding, bs::fourier>) r[column::coefficients] = e.coefficients;
                if constexpr (std::is_same_v<Encoding, bs::sine_layers>) {
                    r[column::bearings] = 8;
                    // The cube of factors is the third.
                    if (setup.settings.published) r[column::fetches] += 1.0;
                }
            },
            map->how);
        return r;
    }

    const report_context& context_;
    const report_map& map_;
    height_source source_;
    bs::sampler how_;
    lit_window shown_, timed_;
    std::vector<lit_truth> truths_;
};

}  // namespace

report_section image_section() {
    return {
        .name = "image",
        .title = "Shaded images against traced shadows",
        .steps =
            [](const report_context& context) {
                const std::size_t bearings = light_azimuths(context.quick).size();
                const std::size_t lights = bearings * light_elevations(context.quick).size();
                const std::size_t map = bearings + (2 + lights) * image_setups(context.quick).size();
                return int(context.maps.size() * map);
            },
        .seconds =
            [](const report_context& context) { return double(context.maps.size()) * (context.quick ? 3.0 : 25.0); },
        .run =
            [](const report_context& context) {
                for (const report_map& map : context.maps) gallery(context, map).run();
            }};
}

}  // namespace examples
