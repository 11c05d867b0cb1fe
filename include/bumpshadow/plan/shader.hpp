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
// The short name bumpshadow_shadow has c = 1 or 0.5, whichever is nearer to edge.c of the recipe. Of an edge with
// another c, as pixels of many texels have, call bumpshadow_shadow_soft_above (without `above`:
// bumpshadow_shadow_soft), which comes along, with edge.k and edge.c. The constants of the decoder are
// coordinate_offset() or arc_coordinate_of() of the recipe's encoding.
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
    return chosen;
}

}  // namespace bumpshadow
