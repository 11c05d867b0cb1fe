#include <bumpshadow/plan/shader.hpp>

#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "support/scan.hpp"

using namespace bumpshadow;
using shader_text::decoder, shader_text::dialect, shader_text::edge;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

recipe usual() {
    recipe r;
    r.encoding.slices.function = bearing_function::cubic;
    r.edge = {infinity, 1.0f};
    return r;
}

// Functions that are composed, in their order, but for what the bearing function, the level and the factor call.
std::vector<std::string> composed(const recipe& r, dialect language = dialect::glsl) {
    std::string text;
    shader_text::compose(shader_choice(r), language, [&](std::string_view part) { text += part; });
    std::vector<std::string> names;
    for (const scan::definition& d : scan::definitions_of(text)) names.push_back(d.name);
    return names;
}

using names = std::vector<std::string>;

}  // namespace

TEST_CASE("the decoder is that of the texture and of the arc") {
    recipe r = usual();
    CHECK(shader_choice(r).decode == decoder::volume);
    r.encoding.kind = texture_kind::array;
    CHECK(shader_choice(r).decode == decoder::slices);
    r.encoding.slices.arc = 0.5;
    CHECK(shader_choice(r).decode == decoder::arc_slices);
    r.encoding.kind = texture_kind::volume;
    CHECK(shader_choice(r).decode == decoder::arc);
    r.encoding.slices = {1, 0.3, bearing_function::cubic, 0.0};
    r.encoding.kind = texture_kind::flat;
    CHECK(shader_choice(r).decode == decoder::flat);
}

TEST_CASE("the bearing function and the quantity are those of the encoding") {
    for (const bearing_function f : {bearing_function::exact, bearing_function::quintic, bearing_function::cubic,
                                     bearing_function::octant, bearing_function::diamond})
        for (const quantity q : {quantity::slope, quantity::sine, quantity::angle}) {
            recipe r = usual();
            r.encoding.slices.function = f;
            r.encoding.scale.stored = q;
            CHECK(shader_choice(r).bearing == f);
            CHECK(shader_choice(r).stored == q);
        }
}

TEST_CASE("the edge is hard, inside the shadow or centered, with or without light from below") {
    recipe r = usual();
    const auto found = [&r](float k, float c, bool above) {
        r.edge = {k, c};
        r.above = above;
        return shader_choice(r).shadow;
    };
    for (const bool above : {false, true})
        for (const float c : {0.0f, 0.5f, 1.0f}) CHECK(found(infinity, c, above) == edge::hard);
    CHECK(found(8.0f, 1.0f, false) == edge::soft);
    CHECK(found(8.0f, 1.0f, true) == edge::soft_above);
    CHECK(found(8.0f, 0.5f, false) == edge::centered);
    CHECK(found(8.0f, 0.5f, true) == edge::centered_above);
    CHECK(found(8.0f, 0.3f, true) == edge::centered_above);
}

TEST_CASE("what is composed for a recipe is what it needs and nothing else") {
    // A light whose bearing is fixed: no bearing function, no coordinate.
    recipe r = usual();
    r.encoding.kind = texture_kind::flat;
    r.encoding.slices.count = 1;
    r.encoding.slices.arc = 0.0;
    CHECK(composed(r) == names{"bumpshadow_square", "bumpshadow_slope", "bumpshadow_shadow_hard", "bumpshadow_level",
                               "bumpshadow_shadow"});
    // The whole turn, octants and a soft edge.
    r = usual();
    r.encoding.slices.function = bearing_function::octant;
    r.edge = {8.0f, 1.0f};
    const auto has = [](const names& all, std::string_view name) {
        for (const std::string& one : all)
            if (one == name) return true;
        return false;
    };
    for (const dialect language : {dialect::glsl, dialect::hlsl}) {
        const names all = composed(r, language);
        for (const char* name :
             {"bumpshadow_volume_coordinate", "bumpshadow_bearing_octant", "bumpshadow_slope",
              "bumpshadow_shadow_soft_above", "bumpshadow_bearing", "bumpshadow_level", "bumpshadow_shadow"})
            CHECK_MESSAGE(has(all, name), name);
        for (const char* name : {"bumpshadow_bearing_cubic", "bumpshadow_arc_coordinate", "bumpshadow_tangent_layers",
                                 "bumpshadow_tangent_horizon", "bumpshadow_shadow_hard", "bumpshadow_shadow_soft",
                                 "bumpshadow_sine", "bumpshadow_angle", "bumpshadow_vertex_bearing"})
            CHECK_MESSAGE(!has(all, name), name);
    }
    CHECK(!has(composed(r), "bumpshadow_pixel_place"));
    r.taps = 4;
    CHECK(has(composed(r), "bumpshadow_pixel_place"));
    CHECK(shader_choice(r).places);
    // Whatever the recipe, nothing is there that the caller's functions do not reach.
    struct road {
        texture_kind kind;
        double arc;
        names entries;
    };
    const std::vector<road> roads = {
        {texture_kind::volume, 1.0, {"bumpshadow_volume_coordinate"}},
        {texture_kind::volume, 0.5, {"bumpshadow_arc_coordinate"}},
        {texture_kind::array, 1.0, {"bumpshadow_tangent_layers", "bumpshadow_tangent_horizon"}},
        {texture_kind::array, 0.5, {"bumpshadow_arc_layers", "bumpshadow_tangent_horizon"}},
        {texture_kind::flat, 0.0, {}}};
    for (const road& way : roads)
        for (const quantity stored : {quantity::slope, quantity::sine, quantity::angle})
            for (const shadow_edge& shape :
                 {shadow_edge{infinity, 1.0f}, shadow_edge{8.0f, 1.0f}, shadow_edge{8.0f, 0.5f}})
                for (const bool above : {false, true}) {
                    r = usual();
                    r.encoding.kind = way.kind;
                    r.encoding.slices.arc = way.arc;
                    r.encoding.slices.count = way.kind == texture_kind::flat ? 1 : 5;
                    r.encoding.scale.stored = stored;
                    r.edge = shape;
                    r.above = above;
                    std::string text;
                    shader_text::compose(shader_choice(r), dialect::glsl, [&](std::string_view part) { text += part; });
                    const std::vector<scan::definition> all = scan::definitions_of(text);
                    names roots = way.entries;
                    if (way.kind != texture_kind::flat) roots.emplace_back("bumpshadow_bearing");
                    roots.emplace_back("bumpshadow_level");
                    roots.emplace_back("bumpshadow_shadow");
                    for (const std::string& root : roots) CHECK_MESSAGE(has(composed(r), root), root);
                    CHECK(scan::not_called(all, roots).empty());
                }
}
