// shade: a height map in, the surface in the light of one encoding out. `shade --help` lists the options.

#include <cstdio>
#include <exception>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <bumpshadow/normal_map.hpp>

#include "common/arguments.hpp"
#include "common/encoding.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/image.hpp"
#include "common/plan_json.hpp"
#include "common/recipe.hpp"
#include "common/shading.hpp"
#include "common/stone_wall.hpp"
#include "shade/render.hpp"
#include "shade/sheets.hpp"

namespace {

using namespace examples;
namespace bs = bumpshadow;

struct arguments {
    height_source heights;
    std::string output, normal, diffuse, detail;
    std::vector<std::string> lightmaps;
    horizon_settings horizons;
    encoding_settings encoding;
    recipe_settings recipe;
    std::optional<int> bearings;
    bs::normal_y normal_y = bs::normal_y::up;
    std::pair<double, double> light{-135.0, 30.0};
    double light_radius = 1.0;
    std::optional<double> k, c, shift;
    bool factor = false, hard = false, gpu_weights = false;
    std::optional<std::string> sheet;
    int threads = 0;
};

image8 read_picture(const std::string& path) {
    std::variant<image8, image16> read = read_image(path_of(path));
    if (image8* picture = std::get_if<image8>(&read)) return std::move(*picture);
    const image16& wide = std::get<image16>(read);
    image8 picture(wide.extent, wide.channels);
    for (std::size_t i = 0; i < picture.samples.size(); ++i)
        picture.samples[i] = std::uint8_t((wide.samples[i] + 128) / 257);
    return picture;
}

void require_extent(const image8& picture, const std::string& path, glm::ivec2 extent) {
    if (picture.extent == extent) return;
    throw failure(path + " has " + std::to_string(picture.extent.x) + " x " + std::to_string(picture.extent.y) +
                  " pixels, but the height map has " + std::to_string(extent.x) + " x " + std::to_string(extent.y));
}

std::vector<float> read_normals(const arguments& arguments, glm::ivec2 extent) {
    const image8 picture = read_picture(arguments.normal);
    require_extent(picture, arguments.normal, extent);
    if (picture.channels < 3) throw failure(arguments.normal + " has no three channels");
    std::vector<float> planes(3 * bs::required_size(extent, 1));
    const bs::status s = bs::decode_normals({std::as_bytes(std::span(picture.samples)), extent, picture.channels},
                                            {.y = arguments.normal_y}, {.values = planes, .extent = extent});
    if (!s) throw failure(arguments.normal + ": " + s.message().c_str());
    return planes;
}

scene make_scene(const arguments& arguments) {
    scene s;
    s.samples = read_heights(arguments.heights);
    s.source = arguments.heights;
    s.horizons = arguments.horizons;
    s.threads = arguments.threads;
    s.light_radius = arguments.hard ? 0.0 : arguments.light_radius;
    s.how.x = s.how.y = address_of(arguments.heights.edge);
    if (arguments.gpu_weights) s.how.weights = bs::filter_weights::eight_bit;
    if (arguments.k && !arguments.hard) s.edge = bs::shadow_edge{float(*arguments.k), float(arguments.c.value_or(1.0))};
    s.emboss_shift = arguments.shift;
    const glm::ivec2 extent = s.samples.extent;
    s.surface.extent = extent;
    s.surface.normals =
        arguments.normal.empty() ? normals_of(s.samples, s.source, s.threads) : read_normals(arguments, extent);
    if (!arguments.diffuse.empty()) {
        s.surface.diffuse = read_picture(arguments.diffuse);
        require_extent(s.surface.diffuse, arguments.diffuse, extent);
        if (s.surface.diffuse.channels < 3) {
            image8 color(extent, 3);
            for (std::size_t i = 0; i < color.samples.size(); ++i)
                color.samples[i] = s.surface.diffuse.samples[i / 3 * std::size_t(s.surface.diffuse.channels)];
            s.surface.diffuse = std::move(color);
        }
    }
    if (!arguments.detail.empty()) s.detail = read_picture(arguments.detail);
    for (const std::string& path : arguments.lightmaps) s.lightmaps.push_back(read_picture(path));
    return s;
}

void work(const arguments& arguments) {
    const std::filesystem::path path = path_of(arguments.output);
    if (path.extension() != ".png" && path.extension() != ".PNG")
        throw failure("cannot write " + arguments.output + ": the extension has to be .png");
    std::vector<std::string> inputs = arguments.lightmaps;
    inputs.insert(inputs.end(), {arguments.heights.path, arguments.normal, arguments.diffuse, arguments.detail,
                                 arguments.recipe.plan, arguments.recipe.recipe});
    refuse_inputs(path, inputs);
    encoding_settings settings = arguments.encoding;
    settings.bearings = arguments.bearings;
    if ((!arguments.lightmaps.empty() || !arguments.detail.empty()) && settings.kind != encoding_kind::ssbump)
        throw failure("--lightmap and --detail are for --encoding ssbump");
    if (arguments.factor && (!arguments.lightmaps.empty() || !arguments.detail.empty()))
        throw failure("--factor is of one light: not with --lightmap or --detail");
    if (arguments.c && !arguments.k) throw failure("--c goes with --k");
    if (arguments.k && arguments.hard) throw failure("--k and --hard exclude each other");

    output_file file(path);
    std::optional<output_file> saved;
    if (!arguments.recipe.save.empty()) saved.emplace(path_of(arguments.recipe.save));
    scene s = make_scene(arguments);
    const auto [azimuth, elevation] = arguments.light;
    image8 picture;
    std::string title = arguments.sheet ? *arguments.sheet : name_of(settings.kind), why;
    if (arguments.recipe.given()) {
        const bs::recipe recipe = recipe_for(s.samples, s.source, arguments.recipe);
        title = recipe.shadows ? "planned" : "no shadows";
        why = text_of(recipe);
        if (recipe.taps > 1) why += "drawn with one place a pixel, since a pixel is a texel here\n";
        s.edge = recipe.edge;
        shown what;
        if (recipe.shadows) what = {encoding_kind::tangent, false, bake_recipe(s.samples, s.source, recipe, s.threads)};
        picture = draw(s, what, light_direction(azimuth, elevation), arguments.factor);
        if (saved) saved->write(json_of(recipe) + "\n");
    } else if (arguments.sheet) {
        sheet_kind kind{};
        for (const auto& [word, value] : sheet_names())
            if (word == *arguments.sheet) kind = value;
        picture = draw_sheet(kind, s, settings, azimuth, elevation, arguments.factor);
    } else {
        picture = draw(s, prepare(s, settings), light_direction(azimuth, elevation), arguments.factor);
    }
    if (!fits_png(picture.extent.x, picture.extent.y, picture.channels))
        throw failure("cannot write " + arguments.output + ": too large for a PNG");
    write_png(file, picture);
    if (saved) saved->close();
    file.commit();
    if (saved) saved->commit();
    std::printf("%s: %d x %d pixels, %s, light from %g degrees, %g high\n%s", arguments.output.c_str(),
                picture.extent.x, picture.extent.y, title.c_str(), azimuth, elevation, why.c_str());
    flush_stdout();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Shades a height map with the shadows that an encoding of its horizons gives, as a GPU would: one pixel a "
        "texel.",
        "shade");
    arguments arguments;
    app.add_option("HEIGHTS", arguments.heights.path, "height map: PNG of 8 or 16 bits, JPEG, or --raw")
        ->required()
        ->type_name("FILE");
    app.add_option("-o,--output", arguments.output, "picture to write")->required()->type_name("FILE.png");
    app.add_option("--light", arguments.light,
                   "where the light comes from, in degrees: azimuth 0 along +x (right), 90 along +y (down in the "
                   "picture), and elevation above the surface (default -135 30: the upper left)")
        ->check(finite_number())
        ->type_name("AZIMUTH ELEVATION");
    app.add_flag("--factor", arguments.factor, "the shadow factor alone, 8-bit gray; emboss: brightness, 128 is flat");
    app.add_option("--light-radius", arguments.light_radius,
                   "half the light's apparent size in degrees, from which the soft edge follows")
        ->check(CLI::Range(0.0, 45.0))
        ->capture_default_str()
        ->type_name("DEGREES");
    app.add_option("--k", arguments.k, "steepness of the soft edge in what is stored, in place of --light-radius")
        ->check(positive_or_infinite_number())
        ->type_name("K");
    app.add_option("--c", arguments.c, "with --k: factor of a light on the horizon, 1 (default) or 0.5")
        ->check(CLI::Range(0.0, 1.0))
        ->type_name("C");
    app.add_flag("--hard", arguments.hard, "no soft edge");
    app.add_option("--normal", arguments.normal, "normal map (default: from the heights)")->type_name("FILE");
    add_choice<bs::normal_y>(app, "--normal-y", arguments.normal_y,
                             {{"up", bs::normal_y::up}, {"down", bs::normal_y::down}},
                             "which way green of --normal points")
        ->type_name("Y");
    app.add_option("--diffuse", arguments.diffuse, "diffuse map, sRGB")->type_name("FILE");
    app.add_option("--detail", arguments.detail, "ssbump: detail map multiplied into the masks")->type_name("FILE");
    app.add_option("--lightmap", arguments.lightmaps, "ssbump: three lightmaps, linear, one for each mask")
        ->expected(3)
        ->type_name("FILE FILE FILE");
    app.add_option("--shift", arguments.shift,
                   "emboss: shift of a light at the horizon, texels (default: from the map)")
        ->check(positive_number())
        ->type_name("TEXELS");
    std::string sheets;
    for (const auto& [name, kind] : sheet_names()) sheets += (sheets.empty() ? "" : ", ") + name;
    app.add_option("--sheet", arguments.sheet, "figures of the papers side by side: " + sheets)
        ->check([](const std::string& word) {
            for (const auto& [name, kind] : sheet_names())
                if (name == word) return std::string();
            return word + " is no sheet";
        })
        ->type_name("NAME");
    app.add_flag("--gpu-weights", arguments.gpu_weights, "filter with weights of 8 bits, as GPUs do");
    app.add_option("--bearings", arguments.bearings, "number of slices (default: the encoding's own)")
        ->check(whole_number(1, 4096))
        ->type_name("N");
    app.add_option("--threads", arguments.threads, "threads (default: one a core)")
        ->check(whole_number(1, 4096))
        ->type_name("N");
    add_height_options(app, arguments.heights, "default 1");
    add_horizon_options(app, arguments.horizons);
    add_encoding_options(app, arguments.encoding, true);
    add_recipe_options(app, arguments.recipe);
    return run_program(app, argc, argv, [&] {
        check_recipe_options(app, arguments.recipe, arguments.heights.path, arguments.output,
                             {"--light", "--factor", "--normal", "--normal-y", "--diffuse", "--gpu-weights"});
        work(arguments);
    });
} catch (const std::exception& error) {
    std::fprintf(stderr, "shade: %s\n", error.what());
    return 1;
}
