#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <type_traits>
#include <variant>
#include <vector>

#include <bumpshadow/encode/emboss_shift.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/encoding.hpp"
#include "common/file.hpp"

namespace examples {

// How an encoded map is shown.
struct shadow_style {
    bumpshadow::sampler how;
    std::optional<bumpshadow::shadow_edge> edge = {};  // else that of the light's size
    double light_radius = 0.0;                         // angular, degrees; 0: a hard edge
    bool published = false;  // sine layers: factors from the published cube; Fourier: the edge of the post, if any
    std::optional<double> emboss_shift = {};  // texels; else the middle of what shows the relief
};

// The size of a shift that shows the relief of an embossed map, in texels.
struct emboss_shift_choice {
    double usual = 1.0;
    bumpshadow::emboss_shift_range range;
};
[[nodiscard]] inline emboss_shift_choice emboss_shift_of(const encoded& map) {
    emboss_shift_choice choice;
    require(bumpshadow::measure_emboss_shift(map.textures[0].view(), choice.range));
    choice.usual = std::max(1.0, 0.5 * double(choice.range.smallest + choice.range.largest));
    return choice;
}

[[nodiscard]] inline bumpshadow::shadow_edge edge_of(const shadow_style& style) {
    bumpshadow::shadow_edge edge = style.edge.value_or(bumpshadow::shadow_edge{});
    if (!style.edge && style.light_radius > 0.0) edge.c = 0.5f;
    return edge;
}
[[nodiscard]] inline double radius_of(const shadow_style& style) { return style.edge ? 0.0 : style.light_radius; }

// Calls use(shadow) with the shadow of an encoded map, as bumpshadow::shade() takes it. Throws failure.
template <class Use>
void with_encoded_shadow(const encoded& map, const shadow_style& style, const Use& use) {
    namespace bs = bumpshadow;
    const bs::sampler& how = style.how;
    const bs::shadow_edge edge = edge_of(style);
    const double radius = radius_of(style);
    const std::vector<owned_texture>& textures = map.textures;
    std::visit(
        [&]<class Encoding>(const Encoding& e) {
            if constexpr (std::is_same_v<Encoding, bs::fourier>) {
                bs::fourier_textures all{{}, decoding_of(e)};
                for (std::size_t i = 0; i < textures.size(); ++i) all.maps[i] = textures[i].view();
                using shadow = bs::encoded_shadow<Encoding, bs::fourier_textures>;
                // The post's edge belongs to its form.
                if (style.published && radius > 0.0)
                    use(shadow{e, all, how, {bs::fourier_posted_k, bs::fourier_posted_c}});
                else
                    use(shadow{e, all, how, edge, radius});
            } else if constexpr (std::is_same_v<Encoding, bs::sine_layers>) {
                if (!style.published)
                    return use(bs::encoded_shadow<Encoding>{e, textures[0].view(), how, edge, radius});
                const bs::factor_cube cube = bs::factor_cube_as_published();
                owned_texture factors(layout_of(cube));
                require(write_factor_cube(cube, factors.view()));
                const bs::with_factor_cube<bs::const_texture> with_cube{textures[0].view(), factors.view(), cube.form};
                use(bs::encoded_shadow<Encoding, bs::with_factor_cube<bs::const_texture>>{e, with_cube, how, edge,
                                                                                          radius});
            } else if constexpr (std::is_same_v<Encoding, bs::emboss>) {
                const double shift = style.emboss_shift ? *style.emboss_shift : emboss_shift_of(map).usual;
                use(bs::encoded_shadow<Encoding, bs::emboss_texture>{
                    e, {textures[0].view(), float(shift) / glm::vec2(map.extent)}, how});
            } else {
                use(bs::encoded_shadow<Encoding>{e, textures[0].view(), how, edge, radius});
            }
        },
        map.how);
}

}  // namespace examples
