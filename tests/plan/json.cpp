// Recipes and scenes as JSON, where the programs are built, which read and write it.

#if BUMPSHADOW_TESTS_READ_IMAGES

#include "common/plan_json.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <random>
#include <string>

#include <doctest/doctest.h>

#include "common/file.hpp"

using namespace bumpshadow;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Numbers whose digits are all needed.
class numbers {
public:
    explicit numbers(unsigned seed) : random_(seed) {}
    int whole(int least, int most) { return std::uniform_int_distribution<int>(least, most)(random_); }
    bool coin() { return whole(0, 1) == 1; }
    double real() { return std::ldexp(double(random_()) / 3.0, whole(-60, -20)); }
    float single() { return float(real()); }

private:
    std::mt19937_64 random_;
};

recipe any_recipe(unsigned seed) {
    numbers n(seed);
    recipe r;
    r.shadows = n.coin();
    r.obstacle = plan_obstacle(n.whole(0, int(plan_obstacle::textures)));
    r.steps = n.whole(1, 100);
    r.radius = n.coin() ? infinity : n.real();
    r.reduced_heights = n.whole(1, 8);
    r.reduction = n.whole(1, 8);
    r.encoding.slices.count = n.whole(1, 48);
    r.directions = r.encoding.slices.count + n.whole(0, 48);
    r.encoding.slices.phase = double(n.whole(-3000, 3000)) / 3000.0;
    r.encoding.slices.arc = n.coin() ? 1.0 : double(n.whole(100, 2500)) / 3000.0;
    r.encoding.slices.function = bearing_function(n.whole(0, 4));
    r.encoding.scale.stored = quantity(n.whole(0, 2));
    r.encoding.scale.max_slope = n.single();
    constexpr texel_format formats[] = {texel_format::r8, texel_format::r16, texel_format::r16f, texel_format::bc4};
    r.encoding.format = formats[n.whole(0, 3)];
    r.encoding.kind = n.coin() ? texture_kind::volume : texture_kind::array;
    r.fit = slice_fit(n.whole(0, 2));
    r.mips = r.encoding.kind == texture_kind::array && n.coin();
    r.edge = {n.coin() ? std::numeric_limits<float>::infinity() : n.single(), float(n.whole(0, 10)) / 10.0f};
    r.taps = n.whole(1, 16);
    r.above = n.coin();
    r.wants_normals = n.coin();
    r.wants_masks = n.coin();
    r.free_tiles = n.real();
    r.predicted = {n.real(),     n.coin() ? infinity : n.real(), n.real(), n.real(), n.real(), n.real(), n.real(),
                   n.whole(0, 2)};
    r.say("%s", "quotes \" and \\, a tab \t and %d");
    for (int i = n.whole(0, 3); i > 0; --i) r.say("line %d of %a", i, n.real());
    return r;
}

void check_same(const recipe& a, const recipe& b) {
    CHECK(a.shadows == b.shadows);
    CHECK(a.obstacle == b.obstacle);
    CHECK(a.steps == b.steps);
    CHECK(a.radius == b.radius);
    CHECK(a.reduced_heights == b.reduced_heights);
    CHECK(a.directions == b.directions);
    CHECK(a.reduction == b.reduction);
    CHECK(a.encoding.slices.count == b.encoding.slices.count);
    CHECK(a.encoding.slices.phase == b.encoding.slices.phase);
    CHECK(a.encoding.slices.arc == b.encoding.slices.arc);
    CHECK(a.encoding.slices.function == b.encoding.slices.function);
    CHECK(a.encoding.scale.stored == b.encoding.scale.stored);
    CHECK(a.encoding.scale.max_slope == b.encoding.scale.max_slope);
    CHECK(a.encoding.format == b.encoding.format);
    CHECK(a.encoding.kind == b.encoding.kind);
    CHECK(a.fit == b.fit);
    CHECK(a.mips == b.mips);
    CHECK(a.edge.k == b.edge.k);
    CHECK(a.edge.c == b.edge.c);
    CHECK(a.taps == b.taps);
    CHECK(a.above == b.above);
    CHECK(a.wants_normals == b.wants_normals);
    CHECK(a.wants_masks == b.wants_masks);
    CHECK(a.free_tiles == b.free_tiles);
    CHECK(a.predicted.mismatch == b.predicted.mismatch);
    CHECK(a.predicted.interval == b.predicted.interval);
    CHECK(a.predicted.degrees == b.predicted.degrees);
    CHECK(a.predicted.bytes == b.predicted.bytes);
    CHECK(a.predicted.bake_seconds == b.predicted.bake_seconds);
    CHECK(a.predicted.pack_seconds == b.predicted.pack_seconds);
    CHECK(a.predicted.gpu_cost == b.predicted.gpu_cost);
    CHECK(a.predicted.fetches == b.predicted.fetches);
    REQUIRE(a.lines == b.lines);
    for (int i = 0; i < a.lines; ++i) CHECK(std::string(a.why[std::size_t(i)].text) == b.why[std::size_t(i)].text);
}

scene read(const std::string& text) { return examples::scene_of(text, "scene").limits; }

}  // namespace

TEST_CASE("a recipe is the same after it was JSON") {
    check_same(recipe{}, examples::recipe_of(examples::json_of(recipe{}), "recipe"));
    for (unsigned seed = 0; seed < 500; ++seed) {
        CAPTURE(seed);
        const recipe r = any_recipe(seed);
        const std::string text = examples::json_of(r);
        const recipe back = examples::recipe_of(text, "recipe");
        check_same(r, back);
        CHECK(examples::json_of(back) == text);
    }
}

TEST_CASE("a scene says what its keys say") {
    const scene usual = read("{}");
    CHECK(usual.arc.lowest == 5.0);
    CHECK(usual.arc.last_bearing - usual.arc.first_bearing == 1.0);
    CHECK(usual.mismatch == scene{}.mismatch);

    const examples::planned_scene lights =
        examples::scene_of(R"({"lights": [{"azimuth": 90, "elevation": 30}, {"azimuth": 7, "elevation": 90}]})", "s");
    REQUIRE(lights.view().lights.size() == 2);
    // Towards +y, half as high as long; and straight up.
    CHECK(std::abs(lights.lights[0].x) < 1e-15);
    CHECK(lights.lights[0].y == doctest::Approx(std::sqrt(0.75)));
    CHECK(lights.lights[0].z == doctest::Approx(0.5));
    CHECK(lights.lights[1] == glm::dvec3(0.0, 0.0, 1.0));
    const examples::planned_scene torch = examples::scene_of(R"({"positions": [[1, -2.5, 3]]})", "s");
    REQUIRE(torch.view().positions.size() == 1);
    CHECK(torch.positions[0] == glm::dvec3(1.0, -2.5, 3.0));

    const scene s =
        read(R"({"arc": {"azimuth": [-90, 270], "elevation": [10, 60]}, "light_radius": 0.27, "mismatch": 0.02,)"
             R"( "degrees": 2, "bytes": 4, "bake_seconds": 0.5, "gpu_cost": 40, "volumes": false, "arrays": false,)"
             R"( "bc4": false, "normals": false, "lightmaps": true, "texels_per_pixel": 3})");
    CHECK(s.arc.first_bearing == -0.25);
    CHECK(s.arc.last_bearing == 0.75);
    CHECK(s.arc.lowest == 10.0);
    CHECK(s.arc.highest == 60.0);
    CHECK(s.light_radius == 0.27);
    CHECK(s.mismatch == 0.02);
    CHECK(s.degrees == 2.0);
    CHECK(s.bytes == 4.0);
    CHECK(s.bake_seconds == 0.5);
    CHECK(s.gpu_cost == 40.0);
    CHECK_FALSE(s.volumes);
    CHECK_FALSE(s.arrays);
    CHECK_FALSE(s.bc4);
    CHECK_FALSE(s.has_normals);
    CHECK(s.has_lightmaps);
    CHECK(s.texels_per_pixel == 3.0);
    // A turn from anywhere is not more than one.
    for (int first = -720; first <= 720; ++first) {
        const std::string from = std::to_string(first + 0.3), to = std::to_string(first + 360.3);
        std::string text = R"({"arc": {"azimuth": [)";
        text += from;
        text += ", ";
        text += to;
        text += "]}}";
        const light_arc arc = read(text).arc;
        CHECK(arc.last_bearing - arc.first_bearing == doctest::Approx(1.0));
    }
}

TEST_CASE("what is no scene or recipe is refused with its key") {
    const auto why = [](const std::string& text, bool recipe) -> std::string {
        try {
            static_cast<void>(recipe ? examples::recipe_of(text, "file").lines
                                     : examples::scene_of(text, "file").limits.bc4);
        } catch (const examples::failure& failure) {
            return failure.what();
        }
        return {};
    };
    CHECK(why(R"({"arc": {"elevation": [5, 91]}})", false) ==
          "file: arc.elevation is [5,91], but has to be from 0 to 90 degrees");
    CHECK(why(R"({"Lights": 1})", false) == "file has an unknown key \"Lights\": 1");
    CHECK(why(R"({"mismatch": 2})", false) == "file: mismatch is 2, but has to be at least 0.0 and at most 1.0");
    // One line, whatever the key is.
    CHECK(why(R"({"a\nb": 1})", false) == R"(file has an unknown key "a\nb": 1)");
    CHECK(why(R"({"a\nb": 1, "a\nb": 1})", false) == R"(file: "a\nb" is there twice)");
    CHECK(why("{}", true) == "file has no \"shadows\"");
    // Every key of a recipe has to be there, and to be of its type.
    const std::string good = examples::json_of(any_recipe(1));
    CHECK(why(good, true).empty());
    for (std::size_t end = good.find("\":"); end != std::string::npos; end = good.find("\":", end + 1)) {
        std::string other = good;
        other.insert(end, "_");
        CAPTURE(other);
        CHECK_FALSE(why(other, true).empty());
        other = good;
        other.insert(end + 2, "[[0]],\"extra\":");
        CAPTURE(other);
        CHECK_FALSE(why(other, true).empty());
    }
    // Nothing but a message comes of broken text.
    for (std::size_t length = 0; length < good.size(); length += 7)
        CHECK(why(good.substr(0, length), true).starts_with("file is no JSON: "));
    CHECK(why(std::string(100000, '['), true).starts_with("file"));
    const std::string nested = "{\"degrees\":" + std::string(1000000, '[') + std::string(1000000, ']') + "}";
    CHECK(why(nested, false) == "file: lists and objects in each other, more than 64 deep");
    CHECK(why("{\"degrees\": \"" + std::string(1000000, 'a') + "}", false).size() < 400);
    CHECK(why("{\"why\": \"\xff\"}", true).starts_with("file is no JSON: "));
}

#else

#include <doctest/doctest.h>

TEST_CASE("JSON is skipped: it belongs to the programs, which are not built") {}

#endif
