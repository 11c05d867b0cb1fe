// The compute kernel that bakes horizons, run from its paste files, against the cascade.

#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "support/bake_kernel.hpp"
#include "support/gl.hpp"
#include "support/hlsl.hpp"
#include "support/shader_run.hpp"
#include "support/shapes.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

using bake_kernel::trial;
using bumpshadow::edge_mode;

namespace {

constexpr shader_run::backend backends[] = {shader_run::glsl_450, shader_run::es_310, shader_run::hlsl_450};

std::string paste_file(const char* name) { return tool::read(std::string(BUMPSHADOW_SHADER_FOLDER "/") + name); }

// The whole shader, from a paste file's text.
std::string shader_of(const shader_run::backend& with, const std::string& text) {
    if (with.source == shader_run::language::glsl) return std::string(with.header) + text;
    const hlsl::translation translated = hlsl::to_glsl(text, "comp");
    REQUIRE_MESSAGE(translated.error.empty(), translated.error);
    return translated.glsl;
}
std::string shader_of(const shader_run::backend& with) {
    const bool glsl = with.source == shader_run::language::glsl;
    return shader_of(with, paste_file(glsl ? "bumpshadow_bake.glsl" : "bumpshadow_bake.hlsl"));
}

std::vector<float> run(const trial& t, const shader_run::backend& with, const std::string& shader) {
    bake_kernel::owned_plan how;
    bake_kernel::plan(t, how);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    std::vector<float> heights = t.field.samples, scratch(how.plan.scratch_floats, nan),
                       slopes(how.plan.slope_count, nan);
    const gl::bound_buffer buffers[] = {{std::as_writable_bytes(std::span(heights))},
                                        {std::as_writable_bytes(std::span(how.tables))},
                                        {std::as_writable_bytes(std::span(scratch))},
                                        {std::as_writable_bytes(std::span(slopes))}};
    std::vector<gl::dispatch> dispatches;
    for (const bumpshadow::bake_dispatch& d : how.dispatches)
        dispatches.push_back({std::as_bytes(std::span(d.constants)), d.groups});
    const std::string error = gl::run_dispatches(shader_run::context_of(with), shader, dispatches, 4, buffers);
    REQUIRE_MESSAGE(error.empty(), error);
    return slopes;
}

bool runs(const shader_run::backend& with) {
    const std::string why = shader_run::missing(with);
    if (!why.empty()) skip::because(why);
    return why.empty();
}

}  // namespace

TEST_CASE("the compute kernel's slopes are those of the cascade") {
    using shapes::directions;
    const trial trials[] = {
        {"64 x 64, repeat, stones", bake_kernel::stones({64, 64}, 1), edge_mode::repeat, directions(16)},
        {"64 x 64, repeat, towers", bake_kernel::towers({64, 64}, 2), edge_mode::repeat, directions(8, 0.01)},
        {"64 x 64, repeat, towers, 48 steps", bake_kernel::towers({64, 64}, 2), edge_mode::repeat, directions(8), 48},
        {"100 x 67, clamp, stones", bake_kernel::stones({100, 67}, 3), edge_mode::clamp, directions(8)},
        {"100 x 67, clamp, towers, 48 steps", bake_kernel::towers({100, 67}, 4), edge_mode::clamp, directions(8), 48},
        {"100 x 67, mirror, towers", bake_kernel::towers({100, 67}, 5), edge_mode::mirror, directions(8, 0.01)},
        {"100 x 67, open, towers", bake_kernel::towers({100, 67}, 6), edge_mode::open, directions(8)},
        {"100 x 67, open, stones, 48 steps", bake_kernel::stones({100, 67}, 7), edge_mode::open, directions(8), 48},
        {"45 x 71, repeat, towers", bake_kernel::towers({45, 71}, 8), edge_mode::repeat, directions(16, 0.01)},
        {"45 x 71, repeat, stones, 48 steps", bake_kernel::stones({45, 71}, 9), edge_mode::repeat, directions(8), 48},
        {"33 x 17, mirror, towers, 48 steps", bake_kernel::towers({33, 17}, 10), edge_mode::mirror, directions(8), 48},
        {"96 x 72, repeat, bricks", bake_kernel::bricks({96, 72}, 12), edge_mode::repeat, directions(16)},
        {"100 x 67, clamp, bricks, 48 steps", bake_kernel::bricks({100, 67}, 13), edge_mode::clamp, directions(8), 48},
        {"7 x 3, repeat, stones", bake_kernel::stones({7, 3}, 11), edge_mode::repeat, directions(8)},
    };
    for (const shader_run::backend& with : backends) {
        if (!runs(with)) continue;
        const std::string shader = shader_of(with);
        for (const trial& t : trials) {
            CAPTURE(with.name);
            print(check(t, run(t, with, shader)), std::string(with.name) + ", " + t.name);
        }
    }
}

TEST_CASE("the compute kernel with sizes, radii, holes and rows that lie apart") {
    constexpr const char* names[] = {"repeat", "clamp", "mirror", "open"};
    for (const shader_run::backend& with : backends) {
        if (!runs(with)) continue;
        const std::string shader = shader_of(with);
        for (int edge = 0; edge < 4; ++edge) {
            bake_kernel::agreement all;
            for (const trial& t : bake_kernel::unusual(edge_mode(edge))) {
                CAPTURE(with.name);
                CAPTURE(names[edge]);
                all.include(check(t, run(t, with, shader)));
            }
            print(all, std::string(with.name) + ", unusual maps, " + names[edge]);
        }
    }
}

// A comparison that could not fail would be worth nothing.
TEST_CASE("a changed kernel is noticed") {
    const trial t("towers", bake_kernel::towers({64, 64}, 2), edge_mode::repeat, shapes::directions(8, 0.01));
    const std::vector<float> expected = bake_kernel::run_cascade(t);
    constexpr const char* changes[][2] = {
        {"more.x + i", "more.x + max(i - 1, 0)"},     // distances of cells
        {"right * above", "(1.0f - right) * above"},  // weights of parents
        {"x * (1.0f + x * (1.0f + x))", "0.0f"},      // pairs brought forward
        {"looks.x + i]", "looks.x + max(i, 1)]"},     // looks of texels
    };
    const shader_run::backend& with = shader_run::glsl_450;
    if (!runs(with)) return;
    for (const auto& change : changes) {
        std::string text = paste_file("bumpshadow_bake.glsl");
        const std::string from = change[0];
        const std::size_t at = text.find(from);
        REQUIRE_MESSAGE(at != std::string::npos, from);
        text.replace(at, from.size(), change[1]);
        CHECK_MESSAGE(bake_kernel::compare(run(t, with, shader_of(with, text)), expected).apart > 0.001, from);
    }
}
