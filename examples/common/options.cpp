// The options of horizons, encodings and recipes: in one file, since CLI11 takes seconds to compile.

#include <filesystem>
#include <initializer_list>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

#include "common/arguments.hpp"
#include "common/choices.hpp"
#include "common/encoding.hpp"
#include "common/file.hpp"
#include "common/method.hpp"
#include "common/plan_json.hpp"
#include "common/recipe.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

bool same_file(const std::string& a, const std::string& b) {
    std::error_code ignored;
    return path_of(a).lexically_normal() == path_of(b).lexically_normal() ||
           std::filesystem::equivalent(path_of(a), path_of(b), ignored);
}

}  // namespace

void add_horizon_options(CLI::App& app, horizon_settings& settings) {
    add_choice(app, "--method", settings.how, method_names, "how horizons are found")->type_name("METHOD");
    app.add_option("--steps", settings.options.steps, "cascade: texels of a level that it looks at; more is finer")
        ->check(whole_number(1, 1 << 20))
        ->capture_default_str()
        ->type_name("K");
    app.add_option("--radius", settings.options.radius,
                   "occluders farther than this are left out, in the unit of --texel-size (default: none are)")
        ->check(positive_or_infinite_number())
        ->type_name("R");
    app.add_option_function<std::pair<double, double>>(
           "--curvature",
           [&settings](const auto& curvature) {
               settings.options.curvature = {curvature.first, curvature.second};
           },
           "curvature of the base surface along x and y, 1/unit (default 0 0)")
        ->check(finite_number())
        ->type_name("KX KY");
}

void add_encoding_options(CLI::App& app, encoding_settings& settings, bool extra) {
    std::vector<std::pair<std::string, encoding_kind>> kinds;
    for (int i = 0; i <= int(extra ? encoding_kind::none : encoding_kind::emboss); ++i)
        kinds.emplace_back(name_of(encoding_kind(i)), encoding_kind(i));
    add_choice(app, "--encoding", settings.kind, kinds, "what textures hold")->type_name("ENCODING");
    add_choice<stored_bits>(app, "--bits", settings.bits,
                            {{"8", stored_bits::eight}, {"16", stored_bits::sixteen}, {"bc4", stored_bits::bc4}},
                            "bits of what is stored")
        ->type_name("BITS");
    app.add_option("--reduce", settings.reduce, "extent of the texture: 1/R of the height map's")
        ->check(whole_number(1, 64))
        ->capture_default_str()
        ->type_name("R");
    add_choice<bs::slice_fit>(app, "--fit", settings.fit,
                              {{"point", bs::slice_fit::point},
                               {"least-squares", bs::slice_fit::least_squares},
                               {"least-angle", bs::slice_fit::least_angle}},
                              "slices: their own horizons, or fitted to four times as many (32 at least), for the "
                              "least squares of what is stored or the least error of the elevation")
        ->type_name("FIT");
    add_choice(app, "--bearing-function", settings.function, bearing_function_names, "how the shader measures bearings")
        ->type_name("FUNCTION");
    app.add_option_function<std::string>(
           "--stored",
           [&settings](const std::string& word) {
               for (const auto& [name, stored] : quantity_names)
                   if (name == word) settings.stored = stored;
           },
           "quantity that is stored: slope, sine, angle (default: the encoding's own)")
        ->check(CLI::IsMember({"slope", "sine", "angle"}))
        ->type_name("QUANTITY");
    app.add_option("--max-slope", settings.max_slope,
                   "slope that stands for 1; light above it is never shadowed (default: the steepest, at most 4)")
        ->check(positive_or_infinite_number())
        ->type_name("SLOPE");
    app.add_flag("--mips", settings.mips, "with mip levels; slices become layers of an array");
    app.add_option_function<std::pair<double, double>>(
           "--arc", [&settings](const auto& ends) { settings.arc = ends; },
           "tangent: for light from these bearings alone, in degrees: slices from the first to the last one, as far "
           "apart as 8 around the turn, or --bearings of them; one flat texture where both are the same")
        ->check(finite_number())
        ->type_name("FIRST LAST");
    app.add_flag("--array", settings.array, "tangent: slices as layers of an array in place of a volume");
    app.add_flag("--overlapping", settings.overlapping, "layers: one fetch, 4/3 of the bytes");
    app.add_flag("--factor-cube", settings.factor_cube, "sine: writes the cube of factors, too");
    app.add_flag("--published", settings.published, "sine, fourier: as published");
    app.add_option("--coefficients", settings.coefficients, "fourier: 3, 5, 7 or 9")
        ->check(CLI::IsMember({3, 5, 7, 9}))
        ->capture_default_str()
        ->type_name("N");
    app.add_flag("--square-root", settings.square_root, "fourier: stores signed square roots");
    add_choice<bs::normal_y>(app, "--ssbump-y", settings.y, {{"down", bs::normal_y::down}, {"up", bs::normal_y::up}},
                             "ssbump: hand of the basis")
        ->type_name("Y");
    add_choice<bs::mask_occlusion>(app, "--occlusion", settings.occlusion,
                                   {{"none", bs::mask_occlusion::none},
                                    {"ambient", bs::mask_occlusion::ambient},
                                    {"directional", bs::mask_occlusion::directional}},
                                   "ssbump: what darkens the masks")
        ->type_name("OCCLUSION");
}

std::string name_of(encoding_kind kind) {
    constexpr const char* names[] = {"tangent", "layers", "sine", "fourier", "ssbump", "emboss", "traced", "none"};
    return names[int(kind)];
}

void add_recipe_options(CLI::App& app, recipe_settings& settings) {
    app.footer(scene_help);
    CLI::Option* const plan =
        app.add_option("--plan", settings.plan,
                       "plans the cheapest set-up that this scene needs (below) and uses it: decides all that says how "
                       "horizons are baked and stored")
            ->type_name("SCENE.json");
    app.add_option("--recipe", settings.recipe, "uses a set-up that was planned before")
        ->type_name("FILE.json")
        ->excludes(plan);
    app.add_option("--save-recipe", settings.save, "with --plan or --recipe: writes the set-up for --recipe")
        ->type_name("FILE.json");
}

void check_recipe_options(const CLI::App& app, const recipe_settings& settings, const std::string& heights,
                          const std::string& output, std::initializer_list<const char*> kept) {
    if (!settings.given()) {
        if (!settings.save.empty())
            throw failure("--save-recipe " + settings.save + " is given, but neither --plan nor --recipe");
        return;
    }
    const bool plan = !settings.plan.empty();
    std::set<std::string> fine{"HEIGHTS", "--output",  "--height-scale", "--texel-size", "--edge",   "--channel",
                               "--raw",   "--no-data", "--threads",      "--plan",       "--recipe", "--save-recipe"};
    fine.insert(kept.begin(), kept.end());
    for (const CLI::Option* option : app.get_options()) {
        if (option->count() == 0 || fine.contains(option->get_name())) continue;
        std::string given = option->get_name();
        if (option->get_expected_max() > 0)
            for (const std::string& word : option->results()) given += " " + word;
        throw failure(given + " does not go with " + (plan ? "--plan" : "--recipe") +
                      ", which decides how horizons are baked and stored");
    }
    if (settings.save.empty()) return;
    refuse_inputs(path_of(settings.save), {heights, settings.plan, settings.recipe});
    if (same_file(output, settings.save))
        throw failure("cannot write " + settings.save + ": it is what --output names");
}

}  // namespace examples
