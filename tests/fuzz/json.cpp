// Fuzz target: scenes and recipes as JSON. Bytes become a text, or a good recipe or scene of which a piece is replaced.
// Either there is something that the library takes, and that is the same after it was JSON again, or there is one line
// of text that names the file.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>

#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/scene.hpp>

#include "common/file.hpp"
#include "common/plan_json.hpp"
#include "fuzz/input.hpp"

namespace {

using fuzz::require;

const std::string name = "file.json";

// Calls `use`; what it throws has to be a failure of one line that names the file.
template <class Use>
void attempt(const Use& use) {
    try {
        use();
    } catch (const examples::failure& failure) {
        const std::string text = failure.what();
        require(text.starts_with(name), "a failure names the file");
        require(text.find('\n') == std::string::npos, "a failure is one line");
        require(text.size() < name.size() + 400, "a failure is a short line");
    }
}

void read_scene(const std::string& text) {
    attempt([&] {
        const examples::planned_scene read = examples::scene_of(text, name);
        const bumpshadow::scene scene = read.view();
        require(bool(check(scene)), "a scene that is read can be planned for");
        require(scene.lights.empty() || scene.positions.empty(), "a scene has one kind of light");
    });
}

void read_recipe(const std::string& text) {
    attempt([&] {
        const bumpshadow::recipe r = examples::recipe_of(text, name);
        require(bool(check(r.encoding)) && bool(check(r.edge)), "a recipe that is read can be packed");
        require(r.directions >= r.encoding.slices.count, "there are directions for every slice");
        require(layout_of(r, {64, 48}).required_size() > 0, "a recipe has a texture");
        const std::string written = examples::json_of(r);
        require(examples::json_of(examples::recipe_of(written, name)) == written,
                "a recipe is the same after it was JSON");
    });
}

// A scene of each kind of light.
std::string good_scene(int kind) {
    constexpr const char* lights[] = {R"("lights":[{"azimuth":140,"elevation":35}])", R"("positions":[[1,-2.5,3]])",
                                      R"("arc":{"azimuth":[-90,270],"elevation":[10,60]})"};
    std::string text = "{";
    text += lights[kind];
    text += R"(,"light_radius":0.27,"mismatch":0.02,"degrees":2,"bytes":4,"bake_seconds":0.5,"gpu_cost":40,)"
            R"("volumes":false,"arrays":false,"bc4":false,"normals":false,"lightmaps":true,"texels_per_pixel":3})";
    return text;
}

// Up to 255 bytes from a place on give way to the rest of the input.
std::string with_a_piece_replaced(std::string good, fuzz::input& in) {
    const std::size_t at = std::size_t(in.bits<std::uint16_t>()) % good.size(), length = std::size_t(in.byte());
    return good.replace(at, length, reinterpret_cast<const char*>(in.rest().data()), in.rest().size());
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    static const std::string good_recipe = examples::json_of({});
    fuzz::input in(bytes, size);
    const int kind = in.below(6);
    const bool recipe = kind == 1 || kind == 5;
    std::string text(in.rest().begin(), in.rest().end());
    if (kind >= 2) text = with_a_piece_replaced(recipe ? good_recipe : good_scene(kind - 2), in);
    if (recipe)
        read_recipe(text);
    else
        read_scene(text);
    return 0;
}
