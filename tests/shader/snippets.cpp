#include <bumpshadow/shader/snippets.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "support/decoders.hpp"
#include "support/scan.hpp"

using namespace bumpshadow;
using namespace bumpshadow::shader_text;
using namespace scan;

namespace {

constexpr dialect dialects[] = {dialect::glsl, dialect::hlsl};

std::string composed(std::vector<std::string_view> names, dialect language) {
    std::string text;
    REQUIRE(compose(names, language, [&](std::string_view part) { text += part; }));
    return text;
}

std::string composed(const choice& chosen, dialect language) {
    std::string text;
    compose(chosen, language, [&](std::string_view part) { text += part; });
    return text;
}

std::vector<std::string> names_of(const std::vector<definition>& definitions) {
    std::vector<std::string> names(definitions.size());
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = definitions[i].name;
    return names;
}

bool has(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

// Which snippets each one uses, through others too, found by looking for their names.
std::vector<std::vector<bool>> needs_by_name(bool glsl) {
    const std::size_t count = std::size(snippets);
    std::vector<std::vector<bool>> needs(count, std::vector<bool>(count));
    for (std::size_t i = 0; i < count; ++i) {
        const std::vector<std::string> tokens = tokens_of(without_comments(glsl ? snippets[i].glsl : snippets[i].hlsl));
        for (std::size_t j = 0; j < count; ++j) needs[i][j] = has(tokens, snippets[j].name);
    }
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j)
                if (needs[i][k] && needs[k][j]) needs[i][j] = true;
    return needs;
}

// Every choice that there is.
template <class Visit>
void for_choices(const Visit& visit) {
    for (const decoders::use& u : decoders::all())
        for (int bearing = 0; bearing < 5; ++bearing)
            for (int stored = 0; stored < 3; ++stored)
                for (int shadow = 0; shadow < 5; ++shadow)
                    // Roots for Fourier, vertices for slices: no decoder has both.
                    for (const bool more : {false, true})
                        visit(u, choice{u.decode, bearing_function(bearing), quantity(stored), edge(shadow),
                                        more && decoders::is_fourier(u.decode), more});
}

}  // namespace

TEST_CASE("every snippet defines its own name, and that alone") {
    for (const snippet& s : snippets) {
        CAPTURE(s.name);
        CHECK(names_of(definitions_of(s.glsl)) == std::vector{std::string(s.name)});
        CHECK(names_of(definitions_of(s.hlsl)) == std::vector{std::string(s.name)});
        CHECK(s.name.starts_with("bumpshadow_"));
        CHECK(without_comments(s.comment).find_first_not_of('\n') == std::string::npos);
    }
}

TEST_CASE("what a snippet needs is what it names") {
    for (const bool glsl : {true, false}) {
        const std::vector<std::vector<bool>> needs = needs_by_name(glsl);
        for (std::size_t i = 0; i < needs.size(); ++i)
            for (std::size_t j = 0; j < needs.size(); ++j) {
                CAPTURE(snippets[i].name);
                CAPTURE(snippets[j].name);
                const bool bit = (snippets[i].needs[j / 64] >> (j % 64) & 1u) != 0;
                CHECK(bit == needs[i][j]);
                if (bit) CHECK(j <= i);
            }
    }
}

TEST_CASE("each dialect has its own names for types and functions") {
    const std::vector<std::string> of_glsl = {"vec2", "vec3", "vec4", "mix", "fract", "inversesqrt"};
    const std::vector<std::string> of_hlsl = {"float2", "float3", "float4", "lerp", "frac", "rsqrt"};
    for (const snippet& s : snippets) {
        const std::vector<std::string> glsl = tokens_of(without_comments(s.glsl)),
                                       hlsl = tokens_of(without_comments(s.hlsl));
        REQUIRE(glsl.size() == hlsl.size());
        for (std::size_t i = 0; i < glsl.size(); ++i) {
            const auto at = std::find(of_glsl.begin(), of_glsl.end(), glsl[i]);
            const std::string expected = at == of_glsl.end() ? glsl[i] : of_hlsl[std::size_t(at - of_glsl.begin())];
            CHECK_MESSAGE(hlsl[i] == expected, s.name);
        }
    }
}

TEST_CASE("compose writes what is named and what that calls, once, in an order that compiles") {
    for (const dialect language : dialects) {
        for (std::size_t i = 0; i < std::size(snippets); ++i) {
            const std::vector<definition> all = definitions_of(composed({snippets[i].name}, language));
            CHECK(not_called(all, {std::string(snippets[i].name)}).empty());
            CHECK(all.back().name == snippets[i].name);
            std::vector<std::string> known;
            for (const definition& d : all) {
                CHECK_MESSAGE(!has(known, d.name), d.name, " twice");
                known.push_back(d.name);
                for (const std::string& token : d.tokens)
                    if (token.starts_with("bumpshadow_")) CHECK_MESSAGE(has(known, token), d.name, " uses ", token);
            }
        }
        const std::vector<definition> two =
            definitions_of(composed({"bumpshadow_slope", "bumpshadow_bearing_cubic", "bumpshadow_slope"}, language));
        CHECK(names_of(two) == std::vector<std::string>{"bumpshadow_square", "bumpshadow_steep", "bumpshadow_across",
                                                        "bumpshadow_unfold", "bumpshadow_bearing_cubic",
                                                        "bumpshadow_slope"});
        CHECK(composed(std::vector<std::string_view>{}, language).empty());
    }
    CHECK(composed({"bumpshadow_square"}, dialect::hlsl).find("float2 v") != std::string::npos);
    CHECK(composed({"bumpshadow_square"}, dialect::glsl).find("vec2 v") != std::string::npos);
}

TEST_CASE("an unknown name writes nothing") {
    for (const std::string_view wrong : {"bumpshadow_bearing", "slope", "", "bumpshadow_slope ", "bumpshadow_slop"}) {
        const std::string_view names[] = {"bumpshadow_square", wrong};
        std::size_t written = 0;
        CHECK_FALSE(compose(names, dialect::glsl, [&](std::string_view) { ++written; }));
        CHECK(written == 0);
    }
}

TEST_CASE("what is composed for a choice") {
    for (const dialect language : dialects)
        for_choices([&](const decoders::use& u, const choice& chosen) {
            const std::string text = composed(chosen, language);
            const std::vector<definition> all = definitions_of(text);
            INFO(u.name, " ", int(chosen.bearing), " ", int(chosen.stored), " ", int(chosen.shadow));
            const std::vector<std::string> roots = decoders::roots_of(u, chosen), names = names_of(all);
            for (const std::string& root : roots) CHECK_MESSAGE(has(names, root), root);
            const std::vector<std::string> unused = not_called(all, roots);
            CHECK_MESSAGE(unused.empty(), (unused.empty() ? "" : unused[0]));
            CHECK(has(names, "bumpshadow_bearing") == u.bearing);
            CHECK(has(names, "bumpshadow_shadow") == u.shadow);
            CHECK(has(names, "bumpshadow_vertex_bearing") == (u.bearing && chosen.vertex));
            CHECK(text.ends_with("\n"));
            for (const definition& d : all) {
                CHECK(d.what == kind::function);
                CHECK_MESSAGE(d.name.starts_with("bumpshadow_"), d.name);
            }
        });
}

namespace {

// Why Godot 3 would not take GLSL that was composed, as far as tokens show it; empty: nothing found. Its shading
// language has no preprocessor, structures, overloads and constant arrays, takes no suffix after an exponent, and one
// condition within another only in parentheses.
std::string godot_lacks(const std::string& text) {
    const std::string code = without_comments(text);
    if (code.find('#') != std::string::npos) return "#";
    std::vector<std::string> names;
    for (const definition& d : definitions_of(text)) {
        if (d.what != kind::function) return "global " + d.name;
        if (has(names, d.name)) return "overload " + d.name;
        names.push_back(d.name);
    }
    const std::vector<std::string> types = {"float", "vec2", "vec3", "vec4", "bool", "return"};
    const std::vector<std::string> functions = {"abs",         "atan", "clamp", "dot", "floor", "fract",
                                                "inversesqrt", "max",  "min",   "mix", "sqrt"};
    const std::vector<std::string> tokens = tokens_of(code);
    std::vector<int> conditions = {0};  // by depth of parentheses
    for (std::size_t i = 0; i < tokens.size(); ++i) {
        const std::string& t = tokens[i];
        const bool number = t[0] >= '0' && t[0] <= '9', word = in_word(t[0]) && !number;
        if (t == "[") return "an array";
        if (t == "(") conditions.push_back(0);
        if (t == ")") conditions.pop_back();
        if (t == ";" || t == ",") conditions.back() = 0;
        if (t == "?" && ++conditions.back() > 1) return "a condition in a condition";
        if (number && t.back() == 'f') return "a suffix: " + t;
        if (word && i + 1 < tokens.size() && tokens[i + 1] == "(" && !t.starts_with("bumpshadow_") && !has(types, t) &&
            !has(functions, t))
            return "a call of " + t;
        // What stands before a name is a type.
        if (word && i > 0 && in_word(tokens[i - 1][0]) && !has(types, tokens[i - 1])) return "a type: " + tokens[i - 1];
    }
    return {};
}

}  // namespace

TEST_CASE("what is composed for a choice is what Godot 3 takes") {
    for_choices([&](const decoders::use& u, const choice& chosen) {
        const std::string lacks = godot_lacks(composed(chosen, dialect::glsl));
        CHECK_MESSAGE(lacks.empty(), u.name, ": ", lacks);
    });
    // What would be found.
    const auto body = [](const std::string& statements) {
        return godot_lacks("float bumpshadow_f(float v) { " + statements + " }\n");
    };
    CHECK(body("return v > 0.0 ? 1.0 : (v < -1.0 ? 2.0 : 3.0);").empty());
    CHECK(body("return v > 0.0 ? 1.0 : v < -1.0 ? 2.0 : 3.0;") == "a condition in a condition");
    CHECK(body("return v * 1e-30f;") == "a suffix: 30f");
    CHECK(body("float a[2]; return v;") == "an array");
    CHECK(body("return asfloat(v);") == "a call of asfloat");
    CHECK(body("mat3 m; return v;") == "a type: mat3");
    CHECK(godot_lacks("#define A\n") == "#");
    CHECK(godot_lacks("struct pair { float a, b; };\n") == "global pair");
    CHECK(godot_lacks("const float pi = 3.0;\n") == "global pi");
    CHECK(godot_lacks("float bumpshadow_f(float v) { return v; }\nfloat bumpshadow_f(vec2 v) { return v.x; }\n") ==
          "overload bumpshadow_f");
    CHECK(composed({"bumpshadow_factors"}, dialect::glsl).find("struct") != std::string::npos);
}

TEST_CASE("one slice, for a light that is fixed, has no bearing") {
    for (const dialect language : dialects) {
        const std::string text = composed(choice{.decode = decoder::flat, .vertex = true}, language);
        CHECK(without_comments(text).find("bearing") == std::string::npos);
        const std::vector<std::string> names = names_of(definitions_of(text));
        CHECK(has(names, "bumpshadow_level"));
        CHECK(has(names, "bumpshadow_shadow"));
    }
}

TEST_CASE("short names call what was chosen") {
    choice chosen;
    chosen.bearing = bearing_function::octant;
    chosen.stored = quantity::angle;
    const auto says = [&](const char* text) { return composed(chosen, dialect::glsl).find(text) != std::string::npos; };
    CHECK(says("float bumpshadow_bearing(vec2 v) { return bumpshadow_bearing_octant(v); }"));
    CHECK(says("float bumpshadow_level(vec3 light) { return bumpshadow_angle(light); }"));
    CHECK(says("{ return bumpshadow_shadow_soft(light, horizon, k, 1.0); }"));
    chosen.shadow = edge::soft_above;
    CHECK(says("{ return bumpshadow_shadow_soft_above(light, horizon, k, 1.0); }"));
    CHECK_FALSE(says("bumpshadow_shadow_soft("));
    chosen.shadow = edge::centered;
    CHECK(says("{ return bumpshadow_shadow_soft(light, horizon, k, 0.5); }"));
    chosen.shadow = edge::centered_above;
    CHECK(says("{ return bumpshadow_shadow_soft_above(light, horizon, k, 0.5); }"));
    chosen.shadow = edge::hard;
    CHECK(says("{ return bumpshadow_shadow_hard(light, horizon); }"));
    CHECK_FALSE(says("bumpshadow_shadow_soft_above("));
    CHECK_FALSE(says("bumpshadow_vertex_bearing"));
    chosen.vertex = true;
    CHECK(
        says("vec2 bumpshadow_vertex_bearing(vec3 light, float most) {\n"
             "    return vec2(bumpshadow_bearing(light.xy), clamp(bumpshadow_level(light), -most, most));\n}\n"));
    CHECK(composed(chosen, dialect::hlsl).find("float2 bumpshadow_vertex_bearing(float3 light") != std::string::npos);
    CHECK(composed(chosen, dialect::hlsl).find("float bumpshadow_bearing(float2 v)") != std::string::npos);
    CHECK(composed(chosen, dialect::hlsl).find("float bumpshadow_level(float3 light)") != std::string::npos);
}
