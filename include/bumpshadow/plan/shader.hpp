#pragma once

#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/shader/snippets.hpp>
#include <bumpshadow/texture.hpp>

// The shader of a recipe.

namespace bumpshadow {

// What compose() of shader/snippets.hpp puts together for a recipe with shadows; one without them needs no code.
// The short name bumpshadow_shadow has c = 1 or 0.5, whichever is nearer to edge.c of the recipe; plan() gives 0.5, or
// a hard edge. The constants of the decoder are coordinate_offset() or arc_coordinate_of() of the recipe's encoding. Of
// a recipe with taps average bumpshadow_shadow over the horizons at uv + x dFdx(uv) + y dFdy(uv), x and y those of
// bumpshadow_pixel_place(i, taps), i from 0 to taps * taps - 1.
[[nodiscard]] inline shader_text::choice shader_choice(const recipe& r) {
    using shader_text::decoder, shader_text::edge;
    shader_text::choice chosen;
    const bool arc = is_arc(r.encoding.slices);
    switch (r.encoding.kind) {
        case texture_kind::flat: chosen.decode = decoder::flat; break;
        case texture_kind::array: chosen.decode = arc ? decoder::arc_slices : decoder::slices; break;
        default: chosen.decode = arc ? decoder::arc : decoder::volume;
    }
    chosen.bearing = r.encoding.slices.function;
    chosen.stored = r.encoding.scale.stored;
    if (is_infinite(r.edge.k))
        chosen.shadow = edge::hard;
    else if (r.edge.c > 0.75f)
        chosen.shadow = r.above ? edge::soft_above : edge::soft;
    else
        chosen.shadow = r.above ? edge::centered_above : edge::centered;
    chosen.places = r.taps > 1;
    return chosen;
}

}  // namespace bumpshadow
