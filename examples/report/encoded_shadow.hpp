#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <variant>

#include <bumpshadow/encode/emboss_shift.hpp>
#include <bumpshadow/factor_cube.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/encoding.hpp"
#include "common/file.hpp"

namespace examples {

// Calls use(shadow) with the shadow of an encoded map under a light of an angular radius, as bumpshadow::shade() takes
// it. published: sine layers get their factors from the published cube, a Fourier series the edge of the post.
// Embossing shifts by the middle of what shows the relief. Throws failure.
template <class Use>
void with_encoded_shadow(const encoded& map, bool published, const bumpshadow::sampler& how, double radius,
                         const Use& use) {
    namespace bs = bumpshadow;
    const auto require = [](const bs::status& status) {
        if (!status) throw failure(status.message().c_str());
    };
    const bs::shadow_edge edge{.c = 0.5f};
    const std::vector<owned_texture>& textures = map.textures;
    std::visit(
        [&]<class Encoding>(const Encoding& e) {
            if constexpr (std::is_same_v<Encoding, bs::fourier>) {
                bs::fourier_textures all{{}, decoding_of(e)};
                for (std::size_t i = 0; i < textures.size(); ++i) all.maps[i] = textures[i].view();
                using shadow = bs::encoded_shadow<Encoding, bs::fourier_textures>;
                if (published)
                    use(shadow{e, all, how, {bs::fourier_posted_k, bs::fourier_posted_c}});
                else
                    use(shadow{e, all, how, edge, radius});
            } else if constexpr (std::is_same_v<Encoding, bs::sine_layers>) {
                if (!published) return use(bs::encoded_shadow<Encoding>{e, textures[0].view(), how, edge, radius});
                const bs::factor_cube cube = bs::factor_cube_as_published();
                owned_texture factors(layout_of(cube));
                require(write_factor_cube(cube, factors.view()));
                const bs::with_factor_cube<bs::const_texture> with_cube{textures[0].view(), factors.view(), cube.form};
                use(bs::encoded_shadow<Encoding, bs::with_factor_cube<bs::const_texture>>{e, with_cube, how, edge,
                                                                                          radius});
            } else if constexpr (std::is_same_v<Encoding, bs::emboss>) {
                bs::emboss_shift_range range;
                require(bs::measure_emboss_shift(textures[0].view(), range));
                const float shift = std::max(1.0f, 0.5f * (range.smallest + range.largest));
                use(bs::encoded_shadow<Encoding, bs::emboss_texture>{
                    e, {textures[0].view(), shift / glm::vec2(map.extent)}, how});
            } else {
                use(bs::encoded_shadow<Encoding>{e, textures[0].view(), how, edge, radius});
            }
        },
        map.how);
}

}  // namespace examples
