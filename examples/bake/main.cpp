// bake: a height map in, horizon slopes out. `bake --help` lists the options.

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/image.hpp"
#include "common/picture.hpp"
#include "common/progress.hpp"

namespace {

using namespace examples;
namespace bs = bumpshadow;

enum class method { exact, cascade, sweep, sweep_classic, neighborhood };

const std::vector<std::pair<std::string, method>> method_names{{"cascade", method::cascade},
                                                               {"exact", method::exact},
                                                               {"sweep", method::sweep},
                                                               {"sweep-classic", method::sweep_classic},
                                                               {"neighborhood", method::neighborhood}};

const std::string& name_of(method how) {
    return std::find_if(method_names.begin(), method_names.end(),
                        [&](const auto& entry) { return entry.second == how; })
        ->first;
}

struct arguments {
    height_source heights;
    std::string output;
    method how = method::cascade;
    bs::bake_options options;
    int bearings = 16;
    double phase = 0.0;
    int threads = 0;
    bool json = false;
};

enum class output_kind { f32, png };

output_kind kind_of(const std::filesystem::path& path) {
    std::string extension = path.extension().string();
    for (char& c : extension)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    if (extension == ".f32") return output_kind::f32;
    if (extension == ".png") return output_kind::png;
    throw failure("cannot write " + path.string() + ": the extension has to be .f32 or .png");
}

template <class Sample>
bs::status bake(method how, const bs::height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                const bs::horizon_map& out, const bs::bake_options& options, const progress& execute) {
    switch (how) {
        case method::exact: return bs::bake_exact(heights, directions, out, options, execute);
        case method::sweep: return bs::bake_sweep(heights, directions, out, options, execute);
        case method::sweep_classic: return bs::bake_sweep_classic(heights, directions, out, options, execute);
        case method::neighborhood: return bs::bake_neighborhood(heights, directions, out, options, execute);
        case method::cascade: break;
    }
    return bs::bake_cascade(heights, directions, out, options, execute);
}

void write_f32(output_file& file, std::vector<float>& slopes) {
    if constexpr (std::endian::native == std::endian::big)
        for (float& slope : slopes) {
            const auto b = std::bit_cast<std::uint32_t>(slope);
            slope = std::bit_cast<float>(b << 24 | (b & 0xff00u) << 8 | (b >> 8 & 0xff00u) | b >> 24);
        }
    file.write(std::as_bytes(std::span(slopes)));
}

void work(const arguments& arguments) {
    const output_kind kind = kind_of(arguments.output);
    std::error_code ignored;
    if (std::filesystem::equivalent(arguments.heights.path, arguments.output, ignored))
        throw failure("cannot write " + arguments.output + ": it is the height map itself");

    const height_samples samples = read_heights(arguments.heights);
    const glm::ivec2 extent = samples.extent;
    if (kind == output_kind::png && !fits_png(std::int64_t(extent.x) * arguments.bearings, extent.y, 1))
        throw failure("cannot write " + arguments.output + ": too large for a PNG, write .f32 instead");
    output_file file(arguments.output);

    std::vector<glm::dvec2> directions(std::size_t(arguments.bearings));
    bs::fill_directions(directions, arguments.phase);
    std::vector<float> slopes(bs::required_size(extent, arguments.bearings));
    const bs::horizon_map out{.values = slopes, .extent = extent, .bearings = arguments.bearings};

    const bs::threads run(arguments.threads);
    const auto start = std::chrono::steady_clock::now();
    const bs::status status =
        with_height_map(samples, arguments.heights, arguments.heights.height_scale.value_or(1.0), [&](const auto& map) {
            const progress execute(run, "baking");
            return bake(arguments.how, map, directions, out, arguments.options, execute);
        });
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!status) throw failure(status.message().c_str());

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

    if (arguments.json)
        std::printf(
            "{\"width\":%d,\"height\":%d,\"bearings\":%d,\"method\":\"%s\",\"threads\":%d,\"seconds\":%.6f,"
            "\"ns_per_sample\":%.4f,\"steps\":%d}\n",
            extent.x, extent.y, arguments.bearings, name_of(arguments.how).c_str(), run.concurrency(), seconds,
            nanoseconds, arguments.options.steps);
    else
        std::printf("%s: %d x %d texels, %d bearings by %s on %d thread%s in %.3f s, %.2f ns a sample\n",
                    arguments.output.c_str(), extent.x, extent.y, arguments.bearings, name_of(arguments.how).c_str(),
                    run.concurrency(), run.concurrency() == 1 ? "" : "s", seconds, nanoseconds);
    flush_stdout();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Bakes the horizon slopes of a height map: how steep light has to come in, from each of N bearings, to reach a "
        "texel.",
        "bake");
    arguments arguments;

    app.add_option("HEIGHTS", arguments.heights.path, "height map: PNG of 8 or 16 bits, JPEG, or --raw")
        ->required()
        ->type_name("FILE");
    app.add_option("-o,--output", arguments.output,
                   "where to write. FILE.f32: slopes as bare little-endian float32, [bearing][y][x], bearing i at "
                   "phase + i/N of a turn from +x (right) towards +y (down in the picture). FILE.png: the slices side "
                   "by side, elevation of the horizon from 0 degrees (black) to 90 (white)")
        ->required()
        ->type_name("FILE");
    add_height_options(app, arguments.heights, "default 1");
    add_choice(app, "--method", arguments.how, method_names, "how horizons are found")->type_name("METHOD");
    app.add_option("--steps", arguments.options.steps, "cascade: texels of a level that it looks at; more is finer")
        ->check(whole_number(1, 1 << 20))
        ->capture_default_str()
        ->type_name("K");
    app.add_option("--radius", arguments.options.radius,
                   "occluders farther than this are left out, in the unit of --texel-size (default: none are)")
        ->check(positive_or_infinite_number())
        ->type_name("R");
    app.add_option_function<std::pair<double, double>>(
           "--curvature",
           [&](const auto& curvature) {
               arguments.options.curvature = {curvature.first, curvature.second};
           },
           "curvature of the base surface along x and y, 1/unit (default 0 0)")
        ->check(finite_number())
        ->type_name("KX KY");
    app.add_option("--bearings", arguments.bearings, "number of slices")
        ->check(whole_number(1, 65536))
        ->capture_default_str()
        ->type_name("N");
    app.add_option("--phase", arguments.phase, "bearing of the first slice, in turns")
        ->check(finite_number())
        ->capture_default_str()
        ->type_name("TURNS");
    app.add_option("--threads", arguments.threads, "threads to bake on (default: one a core)")
        ->check(whole_number(1, 4096))
        ->type_name("N");
    app.add_flag("--json", arguments.json, "print one line of JSON instead of a sentence");

    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "bake: %s\n", error.what());
    return 1;
}
