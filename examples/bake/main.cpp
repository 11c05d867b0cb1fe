// bake: a height map in, horizon slopes or packed textures out. `bake --help` lists the options.

#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "common/arguments.hpp"
#include "common/dds.hpp"
#include "common/encoding.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/image.hpp"
#include "common/method.hpp"
#include "common/picture.hpp"
#include "common/plan_json.hpp"
#include "common/progress.hpp"
#include "common/recipe.hpp"
#include "common/report_text.hpp"

namespace {

using namespace examples;
namespace bs = bumpshadow;

struct arguments {
    height_source heights;
    std::string output;
    horizon_settings horizons;
    encoding_settings encoding;
    bool encoding_given = false;
    recipe_settings recipe;
    std::optional<int> bearings;
    std::optional<double> phase;
    int threads = 0;
    bool json = false;
};

enum class output_kind { f32, png, dds, raw };

output_kind kind_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    if (extension == ".f32") return output_kind::f32;
    if (extension == ".png") return output_kind::png;
    if (extension == ".dds") return output_kind::dds;
    if (extension == ".raw") return output_kind::raw;
    throw failure("cannot write " + path.string() + ": the extension has to be .f32, .png, .dds or .raw");
}

void write_f32(output_file& file, std::vector<float>& slopes) {
    if constexpr (std::endian::native == std::endian::big)
        for (float& slope : slopes) {
            const auto b = std::bit_cast<std::uint32_t>(slope);
            slope = std::bit_cast<float>(b << 24 | (b & 0xff00u) << 8 | (b >> 8 & 0xff00u) | b >> 24);
        }
    file.write(std::as_bytes(std::span(slopes)));
}

void write_slopes(const arguments& arguments, output_kind kind) {
    const height_samples samples = read_heights(arguments.heights);
    const glm::ivec2 extent = samples.extent;
    const int bearings = arguments.bearings.value_or(16);
    if (kind == output_kind::png && !fits_png(std::int64_t(extent.x) * bearings, extent.y, 1))
        throw failure("cannot write " + arguments.output + ": too large for a PNG, write .f32 instead");
    output_file file(path_of(arguments.output));

    std::vector<glm::dvec2> directions(std::size_t(bearings), glm::dvec2(1.0, 0.0));
    bs::fill_directions(directions, arguments.phase.value_or(0.0));
    std::vector<float> slopes(bs::required_size(extent, bearings));
    const bs::horizon_map out{.values = slopes, .extent = extent, .bearings = bearings};

    const bs::threads run(arguments.threads);
    const auto start = std::chrono::steady_clock::now();
    {
        const progress execute(run, "baking");
        bake_horizons(samples, arguments.heights, arguments.horizons, directions, out, execute);
    }
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();

    const double nanoseconds = seconds * 1e9 / double(slopes.size());
    if (kind == output_kind::f32) {
        write_f32(file, slopes);
    } else {
        std::vector<image8> slices;
        slices.reserve(std::size_t(out.bearings));
        for (int i = 0; i < out.bearings; ++i) slices.push_back(picture_of_slice(out, i));
        write_png(file, sheet(slices, out.bearings));
    }
    file.commit();

    const std::string& method = name_of(arguments.horizons.how);
    if (arguments.json)
        std::printf(
            "{\"width\":%d,\"height\":%d,\"bearings\":%d,\"method\":\"%s\",\"threads\":%d,\"seconds\":%.6f,"
            "\"ns_per_sample\":%.4f,\"steps\":%d}\n",
            extent.x, extent.y, bearings, method.c_str(), run.concurrency(), seconds, nanoseconds,
            arguments.horizons.options.steps);
    else
        std::printf("%s: %d x %d texels, %d bearings by %s on %d thread%s in %.3f s, %.2f ns a sample\n",
                    arguments.output.c_str(), extent.x, extent.y, bearings, method.c_str(), run.concurrency(),
                    run.concurrency() == 1 ? "" : "s", seconds, nanoseconds);
}

// x.dds, x.1.dds, x.2.dds
std::filesystem::path numbered(std::filesystem::path path, std::size_t number) {
    if (number == 0) return path;
    const std::string extension = path.extension().string();
    path.replace_extension();
    path += "." + std::to_string(number) + extension;
    return path;
}

std::vector<std::string> inputs_of(const arguments& arguments) {
    return {arguments.heights.path, arguments.recipe.plan, arguments.recipe.recipe};
}

// first: opened before any work, so that a folder that cannot be written is known.
void write_textures(const arguments& arguments, output_kind kind, output_file& first, const encoded& map) {
    std::vector<std::unique_ptr<output_file>> others;
    for (std::size_t i = 0; i < map.textures.size(); ++i) {
        if (i > 0 && kind == output_kind::dds) {
            const std::filesystem::path path = numbered(path_of(arguments.output), i);
            refuse_inputs(path, inputs_of(arguments));
            others.push_back(std::make_unique<output_file>(path));
        }
        output_file& file = i == 0 || kind == output_kind::raw ? first : *others.back();
        if (kind == output_kind::dds)
            write_dds(file, map.textures[i].view());
        else
            file.write(map.textures[i].bytes);
    }
    first.close();
    for (const auto& file : others) file->close();
    first.commit();
    for (const auto& file : others) file->commit();
}

void say_clamped(const encoded& map) {
    if (map.report.clamped > 0)
        std::fprintf(
            stderr, "bake: %zu values lie beyond what stands for 1 and were stored as that%s\n", map.report.clamped,
            map.report.steepest > 0.0f ? (" (steepest slope: " + std::to_string(map.report.steepest) + ")").c_str()
                                       : "");
}

void print_line(const arguments& arguments, const encoded& map, const char* name) {
    std::size_t bytes = 0;
    for (const owned_texture& t : map.textures) bytes += t.bytes.size();
    std::printf("%s: %d x %d texels as %s, %zu texture%s of %.3g bytes a texel, baked in %.3f s, packed in %.3f s%s\n",
                arguments.output.c_str(), map.extent.x, map.extent.y, name, map.textures.size(),
                map.textures.size() == 1 ? "" : "s", double(bytes) / (double(map.extent.x) * map.extent.y),
                map.bake_seconds, map.pack_seconds, for_shaders(map).c_str());
}

void bake_encoding(const arguments& arguments, output_kind kind) {
    if (arguments.phase)
        throw failure("--phase " + format("%g", *arguments.phase) + " is given, but slices of a texture start at 0");
    encoding_settings settings = arguments.encoding;
    settings.bearings = arguments.bearings;
    const height_samples samples = read_heights(arguments.heights);
    output_file file(path_of(arguments.output));
    const encoded map = encode_heights(samples, arguments.heights, arguments.horizons, settings, arguments.threads);
    write_textures(arguments, kind, file, map);
    if (arguments.json || kind == output_kind::raw)
        std::printf("{\"width\":%d,\"height\":%d,\"method\":\"%s\",\"steps\":%d,%s}\n", map.extent.x, map.extent.y,
                    name_of(arguments.horizons.how).c_str(), arguments.horizons.options.steps, json_of(map).c_str());
    else
        print_line(arguments, map, name_of(settings.kind).c_str());
    say_clamped(map);
}

void bake_planned(const arguments& arguments, output_kind kind) {
    const height_samples samples = read_heights(arguments.heights);
    output_file file(path_of(arguments.output));
    std::optional<output_file> saved;
    if (!arguments.recipe.save.empty()) saved.emplace(path_of(arguments.recipe.save));
    const bs::recipe recipe = recipe_for(samples, arguments.heights, arguments.recipe);
    std::optional<encoded> map;
    if (recipe.shadows) map = bake_recipe(samples, arguments.heights, recipe, arguments.threads);
    if (saved) {
        saved->write(json_of(recipe) + "\n");
        saved->close();
    }
    if (map) write_textures(arguments, kind, file, *map);
    if (saved) saved->commit();

    if (arguments.json || kind == output_kind::raw) {
        const std::string constants = map ? json_of(*map) + "," : "";
        std::printf("{\"width\":%d,\"height\":%d,%s\"recipe\":%s}\n", samples.extent.x, samples.extent.y,
                    constants.c_str(), json_of(recipe).c_str());
    } else if (map) {
        print_line(arguments, *map, "planned");
        std::fputs(text_of(recipe).c_str(), stdout);
    } else {
        std::printf("%s is not written: no shadows are needed\n%s", arguments.output.c_str(), text_of(recipe).c_str());
    }
}

void work(const arguments& arguments) {
    const output_kind kind = kind_of(path_of(arguments.output));
    refuse_inputs(path_of(arguments.output), inputs_of(arguments));
    const bool textures = kind == output_kind::dds || kind == output_kind::raw, planned = arguments.recipe.given();
    if ((arguments.encoding_given || planned) && !textures)
        throw failure("cannot write " + arguments.output + " with " +
                      (arguments.encoding_given        ? "--encoding"
                       : arguments.recipe.plan.empty() ? "--recipe"
                                                       : "--plan") +
                      ": the extension has to be .dds or .raw");
    if (planned)
        bake_planned(arguments, kind);
    else if (textures)
        bake_encoding(arguments, kind);
    else
        write_slopes(arguments, kind);
    flush_stdout();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Bakes the horizon slopes of a height map: how steep light has to come in, from each of N bearings, to reach a "
        "texel. Packs them into textures, too.",
        "bake");
    arguments arguments;

    app.add_option("HEIGHTS", arguments.heights.path, "height map: PNG of 8 or 16 bits, JPEG, or --raw")
        ->required()
        ->type_name("FILE");
    app.add_option("-o,--output", arguments.output,
                   "where to write. FILE.f32: slopes as bare little-endian float32, [bearing][y][x], bearing i at "
                   "phase + i/N of a turn from +x (right) towards +y (down in the picture). FILE.png: the slices side "
                   "by side, elevation of the horizon from 0 degrees (black) to 90 (white). FILE.dds: the textures of "
                   "--encoding, a second one as FILE.1.dds. FILE.raw: their bytes one after the other, and a line of "
                   "JSON on standard output with all that decoding needs")
        ->required()
        ->type_name("FILE");
    add_height_options(app, arguments.heights, "default 1");
    add_horizon_options(app, arguments.horizons);
    app.add_option("--bearings", arguments.bearings, "number of slices (default 16; of textures: the encoding's own)")
        ->check(whole_number(1, 65536))
        ->type_name("N");
    app.add_option("--phase", arguments.phase, "bearing of the first slice, in turns (default 0)")
        ->check(finite_number())
        ->type_name("TURNS");
    app.add_option("--threads", arguments.threads, "threads to bake on (default: one a core)")
        ->check(whole_number(1, 4096))
        ->type_name("N");
    app.add_flag("--json", arguments.json, "print one line of JSON instead of a sentence");
    add_encoding_options(app, arguments.encoding, false);
    add_recipe_options(app, arguments.recipe);

    return run_program(app, argc, argv, [&] {
        check_recipe_options(app, arguments.recipe, arguments.heights.path, arguments.output, {"--json"});
        arguments.encoding_given = app.get_option("--encoding")->count() > 0;
        work(arguments);
    });
} catch (const std::exception& error) {
    std::fprintf(stderr, "bake: %s\n", error.what());
    return 1;
}
