#include "shade/render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <variant>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/emboss_shift.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/encoded_shadow.hpp"
#include "common/progress.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

// The size of a shift that shows the relief of this map, in texels.
double shift_of(const scene& scene, const encoded& map) {
    const emboss_shift_choice choice = emboss_shift_of(map);
    if (!scene.emboss_shift) return choice.usual;
    if (const bs::status s = bs::check_emboss_shift(float(*scene.emboss_shift), choice.range); !s)
        std::fprintf(stderr, "shade: warning: %s\n", s.message().c_str());
    return *scene.emboss_shift;
}

// Calls use(shadow) with a callable that shade() takes.
template <class Use>
void with_shadow(const scene& scene, const shown& what, glm::vec3 light, const Use& use) {
    shadow_style style{.how = scene.how,
                       .edge = scene.edge,
                       .light_radius = scene.light_radius,
                       .published = what.published,
                       .emboss_shift = {}};
    if (what.kind == encoding_kind::none) return use(bs::no_shadow{});
    if (what.kind == encoding_kind::traced) {
        owned_texture slopes(layout_of(bs::traced{}, scene.samples.extent));
        std::vector<float> values(bs::required_size(scene.samples.extent, 1));
        const glm::dvec2 toward =
            light.x != 0.0f || light.y != 0.0f ? glm::dvec2(light.x, light.y) : glm::dvec2(1.0, 0.0);
        horizon_settings exact = scene.horizons;
        exact.how = method::exact;
        {
            const progress execute(bs::threads(scene.threads), "tracing");
            bake_horizons(scene.samples, scene.source, exact, std::span(&toward, 1),
                          {.values = values, .extent = scene.samples.extent, .bearings = 1}, execute);
        }
        std::copy_n(reinterpret_cast<const std::byte*>(values.data()), slopes.bytes.size(), slopes.bytes.data());
        return use(bs::encoded_shadow<bs::traced>{{}, slopes.view(), scene.how, edge_of(style), radius_of(style)});
    }
    if (what.kind == encoding_kind::emboss) style.emboss_shift = shift_of(scene, *what.map);
    with_encoded_shadow(*what.map, style, use);
}

glm::vec3 texel_at(const image8& picture, glm::vec2 uv) {
    const int x = std::min(int(uv.x * float(picture.extent.x)), picture.extent.x - 1);
    const int y = std::min(int(uv.y * float(picture.extent.y)), picture.extent.y - 1);
    const std::uint8_t* const p = picture.at(x, y);
    return glm::vec3(p[0], p[picture.channels > 2 ? 1 : 0], p[picture.channels > 2 ? 2 : 0]) / 255.0f;
}

// SSBump in its own ways: three lightmaps, and a detail map multiplied in.
struct masked_light {
    const scene& all;
    const bs::ssbump& encoding;
    bs::const_texture masks;

    [[nodiscard]] glm::vec3 operator()(glm::vec2 uv, glm::vec3 light) const {
        glm::vec3 m = glm::vec3(sample(masks, all.how, uv)) / mask_scale(encoding);
        if (encoding.y == bs::normal_y::up) m = bs::shader::bumpshadow_ssbump_other_hand(m);
        if (all.detail) {
            const glm::vec3 d = texel_at(*all.detail, uv);
            m = bs::shader::bumpshadow_ssbump_detail(m, (d.x + d.y + d.z) / 3.0f);
        }
        if (!all.lightmaps.empty())
            return bs::shader::bumpshadow_ssbump_lightmaps(
                m, texel_at(all.lightmaps[0], uv), texel_at(all.lightmaps[1], uv), texel_at(all.lightmaps[2], uv));
        const float lit = light.z < 0.0f
                              ? 0.0f
                              : bs::shader::bumpshadow_ssbump_light(m, bs::shader::bumpshadow_ssbump_weights(light));
        return glm::vec3(lit);
    }
};

// The picture of light that is given at each pixel, without a sky.
template <class Light>
image8 paint(const scene& scene, const Light& light) {
    const glm::ivec2 extent = scene.samples.extent;
    image8 picture(extent, 3);
    bs::threads(scene.threads)(std::size_t(extent.y), [&](std::size_t y) {
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec2 uv{(float(x) + 0.5f) / float(extent.x), (float(y) + 0.5f) / float(extent.y)};
            const glm::vec3 lit = light(uv);
            for (int c = 0; c < 3; ++c) {
                const float albedo = scene.surface.diffuse.samples.empty()
                                         ? 0.5f
                                         : bs::srgb_to_linear(float(scene.surface.diffuse.at(x, int(y))[c]) / 255.0f);
                picture.at(x, int(y))[c] = bs::to_unorm8(bs::linear_to_srgb(albedo * lit[c]));
            }
        }
    });
    return picture;
}

}  // namespace

shown prepare(const scene& scene, const encoding_settings& settings) {
    shown what{settings.kind, settings.published, {}};
    if (settings.kind != encoding_kind::traced && settings.kind != encoding_kind::none)
        what.map = encode_heights(scene.samples, scene.source, scene.horizons, settings, scene.threads);
    return what;
}

image8 draw(const scene& scene, const shown& what, glm::vec3 light, bool factor) {
    const glm::ivec2 extent = scene.samples.extent;
    const bs::threads run(scene.threads);
    if (what.kind == encoding_kind::ssbump && (!scene.lightmaps.empty() || scene.detail)) {
        const masked_light masked{scene, std::get<bs::ssbump>(what.map->how), what.map->textures[0].view()};
        return paint(scene, [&](glm::vec2 uv) { return masked(uv, light); });
    }
    image8 picture(extent, factor ? 1 : 3);
    with_shadow(scene, what, light, [&]<class Shadow>(const Shadow& shadow) {
        if (factor) {
            const float scale = what.kind == encoding_kind::emboss ? 0.5f : 1.0f;
            run(std::size_t(extent.y), [&](std::size_t y) {
                for (int x = 0; x < extent.x; ++x) {
                    const glm::vec2 uv{(float(x) + 0.5f) / float(extent.x), (float(y) + 0.5f) / float(extent.y)};
                    const float value = light.z < 0.0f ? 0.0f : scale * shadow(uv, light);
                    picture.at(x, int(y))[0] = bs::to_unorm8(value);
                }
            });
            return;
        }
        bs::shade_options options = sun_and_sky(scene.surface, light);
        // Embossing turns the base texture, as it is, brighter and darker.
        if (what.kind == encoding_kind::emboss)
            options.light.color = glm::vec3(1.0f), options.ambient = glm::vec3(0.0f);
        picture = shade_picture(scene.surface, options, shadow, run);
    });
    return picture;
}

std::vector<image8> draw_emboss_figures(const scene& scene, const encoded& map, glm::vec3 light) {
    const glm::ivec2 extent = scene.samples.extent;
    const bs::edge_mode edge = scene.source.edge;
    const auto plane = [&](std::size_t texture) {
        image8 picture(extent, 3);
        for (std::size_t i = 0; i < picture.samples.size(); ++i)
            picture.samples[i] = std::to_integer<std::uint8_t>(map.textures[texture].bytes[i / 3]);
        return picture;
    };
    image8 base(extent, 3);
    if (scene.surface.diffuse.samples.empty())
        std::fill(base.samples.begin(), base.samples.end(), std::uint8_t(170));
    else
        for (std::size_t i = 0; i < base.samples.size(); ++i)
            base.samples[i] =
                scene.surface.diffuse.samples[i / 3 * std::size_t(scene.surface.diffuse.channels) + i % 3];
    const float amount = float(shift_of(scene, map));
    const glm::vec2 shift = bs::shader::bumpshadow_emboss_shift(light, glm::vec2(amount));
    const auto far = [shift](glm::vec2) { return shift; };
    const auto bytes_of = [&](image8& picture) {
        return bs::pixels{.bytes = std::as_writable_bytes(std::span(picture.samples)), .extent = extent, .channels = 3};
    };
    image8 relief(extent, 3), embossed(extent, 3);
    require(bs::draw_relief(map.textures[0].view(), edge, far, bytes_of(relief)));
    require(bs::draw_emboss(map.textures[0].view(), edge, bytes_of(base), far, bytes_of(embossed),
                            bs::emboss_passes::three));
    std::vector<image8> figures;
    figures.push_back(plane(0));
    figures.push_back(plane(1));
    figures.push_back(std::move(relief));
    figures.push_back(std::move(base));
    figures.push_back(std::move(embossed));
    return figures;
}

}  // namespace examples
