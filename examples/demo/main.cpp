// demo: bakes a height map, its own stone wall or yours, and shows what the shadows do for it. `demo --help`.

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <list>
#include <mutex>
#include <numbers>
#include <string>
#include <system_error>
#include <type_traits>
#include <vector>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include "common/arguments.hpp"
#include "common/file.hpp"
#include "common/heights.hpp"
#include "common/image.hpp"
#include "common/picture.hpp"
#include "common/progress.hpp"
#include "common/shading.hpp"
#include "common/stone_wall.hpp"
#include "demo/page.hpp"

namespace {

using namespace examples;
namespace bs = bumpshadow;

constexpr int bearings = 16;
constexpr std::array<int, 3> still_elevations{15, 30, 50};
constexpr double side_by_side_elevation = 25.0, turning_elevation = 25.0;
constexpr double from_top_left = -135.0;  // azimuth, degrees
constexpr int longest_frame = 1024, longest_thumbnail = 256, longest_half = 599;

struct arguments {
    height_source heights;
    std::string folder = "build/demo";
    int threads = 0;
};

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <class... Values>
std::string format(const char* text, Values... values) {
    std::array<char, 400> buffer;
    std::snprintf(buffer.data(), buffer.size(), text, values...);
    return buffer.data();
}

// Runs body(0) ... body(count - 1) on threads; the first failure comes out once all have ended.
template <class Body>
void run_all(const bs::threads& run, std::size_t count, const Body& body) {
    std::mutex guard;
    std::exception_ptr first;
    run(count, [&](std::size_t i) {
        try {
            body(i);
        } catch (...) {
            const std::lock_guard lock(guard);
            if (!first) first = std::current_exception();
        }
    });
    if (first) std::rethrow_exception(first);
}

struct error_figures {
    std::size_t samples = 0;
    double mean = 0.0, percentile_99 = 0.0;  // degrees of elevation
};

// Compares the slopes of a few thousand texels, spread the same way on every run, with the exact horizons.
template <class Sample>
error_figures measure_error(const bs::height_map<Sample>& heights, const std::vector<glm::dvec2>& directions,
                            const bs::horizon_map& horizons, const progress& execute) {
    constexpr std::size_t texels = 2048;
    std::vector<Sample> storage(bs::height_bounds<Sample>::required_size(heights.extent));
    const bs::height_bounds<Sample> bounds(heights, storage);
    const auto elevation = [](double slope) { return std::atan(slope) * 180.0 / std::numbers::pi; };
    const std::uint64_t count = std::uint64_t(heights.extent.x) * std::uint64_t(heights.extent.y);

    std::vector<double> errors(texels * directions.size());
    execute(texels, [&](std::size_t i) {
        // Multiples of the golden ratio are spread evenly over the map and hit no regular pattern.
        const double turn = (double(i) + 0.5) * std::numbers::phi;
        const std::uint64_t index = std::min(std::uint64_t((turn - std::floor(turn)) * double(count)), count - 1);
        const glm::ivec2 texel(index % std::uint64_t(heights.extent.x), index / std::uint64_t(heights.extent.x));
        for (std::size_t d = 0; d < directions.size(); ++d) {
            const double infinity = std::numeric_limits<double>::infinity();
            const double exact = bs::exact_horizon(heights, texel, directions[d], infinity, {0.0, 0.0}, &bounds).slope;
            const double baked = double(horizons.row(int(d), texel.y)[texel.x]);
            errors[i * directions.size() + d] = std::abs(elevation(baked) - elevation(exact));
        }
    });
    error_figures figures{.samples = errors.size()};
    for (const double error : errors) figures.mean += error / double(errors.size());
    const auto rank = errors.begin() + std::ptrdiff_t(0.99 * double(errors.size() - 1));
    std::nth_element(errors.begin(), rank, errors.end());
    figures.percentile_99 = *rank;
    return figures;
}

template <class Sample>
image8 picture_of_heights(const bs::height_map<Sample>& heights) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    const auto each = [&](const auto& use) {
        for (int y = 0; y < heights.extent.y; ++y)
            for (int x = 0; x < heights.extent.x; ++x) {
                const Sample sample = bs::sample_at(heights, x, y);
                if (!bs::is_no_data(heights, sample)) use(x, y, double(sample) * bs::unit_height(heights));
            }
    };
    each([&](int, int, double height) { low = std::min(low, height), high = std::max(high, height); });
    image8 picture(heights.extent, 1);
    const double factor = high > low ? 255.0 / (high - low) : 0.0;
    each([&](int x, int y, double height) { *picture.at(x, y) = std::uint8_t(std::lround((height - low) * factor)); });
    return picture;
}

// The map twice in a row, without shadows and with them; where it tiles the two halves are one surface.
image8 halves(const image8& plain, const image8& shadowed) {
    const std::array<image8, 2> both{shrink(plain, longest_half), shrink(shadowed, longest_half)};
    image8 picture = sheet(both, 2);
    const int middle = both[0].extent.x;
    if (middle >= 64)
        for (int y = 0; y < picture.extent.y; ++y) std::fill_n(picture.at(middle - 1, y), 2 * picture.channels, 255);
    return picture;
}

// A file for each picture. All are opened before the work starts and get their names after the last byte is written,
// so that a failure leaves nothing.
class pictures {
public:
    explicit pictures(std::filesystem::path folder) : folder_(std::move(folder)) {}

    output_file& add(const std::string& name) { return files_.emplace_back(folder_ / name); }
    void commit() {
        for (output_file& file : files_) file.close();
        for (output_file& file : files_) file.commit();
    }
    [[nodiscard]] std::size_t count() const { return files_.size(); }

private:
    std::filesystem::path folder_;
    std::list<output_file> files_;
};

template <class Sample>
void show(const arguments& arguments, const bs::height_map<Sample>& heights, image8 diffuse, const std::string& name) {
    const bs::threads run(arguments.threads);
    const std::filesystem::path folder = path_of(arguments.folder);
    output_folder created(folder);
    pictures files(folder);
    page_facts facts;

    facts.side_by_side = "surface.jpg";
    facts.contact_sheet = "turning.png";
    facts.heights = "heights.png";
    facts.slices = "horizons.png";
    output_file& side_by_side = files.add(facts.side_by_side);
    std::vector<output_file*> stills, frames;
    for (const int elevation : still_elevations) {
        facts.stills.push_back(format("elevation-%d.png", elevation));
        facts.still_captions.push_back(format(
            "Light from the upper left, %d degrees above the surface. Left: plain normal mapping. Right: with shadows.",
            elevation));
        stills.push_back(&files.add(facts.stills.back()));
    }
    for (int i = 0; i < bearings; ++i) {
        facts.frames.push_back(format("turning-%02d.png", i));
        frames.push_back(&files.add(facts.frames.back()));
    }
    output_file& contact_sheet = files.add(facts.contact_sheet);
    output_file& height_picture = files.add(facts.heights);
    output_file& slice_picture = files.add(facts.slices);
    output_file& page = files.add("index.html");

    const glm::ivec2 extent = heights.extent;
    facts.map = format("%s: %d x %d texels, heights times %.6g, texels %.6g x %.6g apart", name.c_str(), extent.x,
                       extent.y, heights.height_scale, heights.texel_size.x, heights.texel_size.y);
    facts.magnified = std::max(extent.x, extent.y) < 256;
    std::printf("%s\n", facts.map.c_str());

    bs::tangent_volume encoding;
    encoding.slices.count = bearings;
    std::vector<glm::dvec2> directions(bearings);
    bs::fill_directions(directions, 0.0, encoding.slices.function);
    std::vector<float> slopes(bs::required_size(extent, bearings));
    const bs::horizon_map horizons{.values = slopes, .extent = extent, .bearings = bearings};
    auto start = std::chrono::steady_clock::now();
    if (const bs::status s = bs::bake_cascade(heights, directions, horizons, {}, progress(run, "baking")); !s)
        throw failure(s.message().c_str());
    const double bake_seconds = seconds_since(start);
    facts.bake = format("Baked %d bearings by the cascade on %d thread%s in %.1f ms: %.2f ns a sample.", bearings,
                        run.concurrency(), run.concurrency() == 1 ? "" : "s", bake_seconds * 1e3,
                        bake_seconds * 1e9 / double(slopes.size()));
    std::printf("%s\n", facts.bake.c_str());

    const error_figures figures = measure_error(heights, directions, horizons, progress(run, "measuring"));
    facts.error =
        format("Error against the exact horizons (%zu samples): mean %.3f degrees, 99th percentile %.3f degrees.",
               figures.samples, figures.mean, figures.percentile_99);
    std::printf("%s\n", facts.error.c_str());

    start = std::chrono::steady_clock::now();
    // Packed and sampled as a GPU would.
    encoding.scale.max_slope = bs::suggest_max_slope(horizons);
    const bs::texture_layout layout = layout_of(encoding, extent);
    std::vector<std::byte> bytes(layout.required_size());
    surface surface{extent, std::vector<float>(3 * bs::required_size(extent, 1)), std::move(diffuse)};
    bs::status packed =
        bs::pack_tangent_volume(horizons, directions, encoding, {.fit = bs::slice_fit::point}, {bytes, layout}, run);
    if (packed) packed = bs::bake_normals(heights, {.values = surface.normals, .extent = extent}, {}, run);
    if (!packed) throw failure(packed.message().c_str());
    // In the light of a sun that is larger than ours, so that its penumbra can be seen.
    const auto draw = [&](double azimuth, double elevation, bool shadows) {
        const glm::vec3 light = light_direction(azimuth, elevation);
        const bs::shade_options options = sun_and_sky(surface, light);
        if (!shadows) return shade_picture(surface, options, bs::no_shadow{}, bs::serial{});
        const bs::encoded_shadow<bs::tangent_volume> shadow{
            encoding, bs::const_texture{bytes, layout}, {}, {.c = 0.5f}, 1.0};
        return shade_picture(surface, options, shadow, bs::serial{});
    };
    std::vector<image8> thumbnails(bearings), slices(bearings);
    run_all(run, stills.size() + frames.size() + 2, [&](std::size_t i) {
        if (i < stills.size()) {
            const double elevation = still_elevations[i];
            const std::array<image8, 2> both{draw(from_top_left, elevation, false),
                                             draw(from_top_left, elevation, true)};
            write_png(*stills[i], sheet(both, 2, std::min(extent.x / 16, 8)));
            return;
        }
        i -= stills.size();
        if (i < frames.size()) {
            const image8 frame = draw(360.0 * double(i) / bearings, turning_elevation, true);
            write_png(*frames[i], shrink(frame, longest_frame));
            thumbnails[i] = shrink(frame, longest_thumbnail);
            slices[i] = shrink(picture_of_slice(horizons, int(i)), longest_thumbnail);
            return;
        }
        if (i == frames.size()) {
            write_jpg(side_by_side,
                      halves(draw(from_top_left, side_by_side_elevation, false),
                             draw(from_top_left, side_by_side_elevation, true)),
                      88);
        } else {
            write_png(height_picture, picture_of_heights(heights));
        }
    });
    write_png(contact_sheet, sheet(thumbnails, 4, 4));
    write_png(slice_picture, sheet(slices, 4, 4));
    page.write(make_page(facts));
    files.commit();
    created.keep();
    std::error_code ignored;
    std::printf("Wrote %zu files in %.1f s. Open %s\n", files.count(), seconds_since(start),
                std::filesystem::absolute(folder / "index.html", ignored).lexically_normal().string().c_str());
}

void work(const arguments& arguments) {
    if (arguments.heights.path.empty()) {
        stone_wall wall = make_stone_wall();
        bs::height_map<std::uint16_t> map = bs::tight_height_map(wall.heights.data(), wall.extent);
        map.height_scale = arguments.heights.height_scale.value_or(wall.height_scale);
        map.texel_size = arguments.heights.texel_size;
        map.edge = arguments.heights.edge;
        show(arguments, map, std::move(wall.diffuse), "A stone wall, made by the program");
    } else {
        const height_samples samples = read_heights(arguments.heights);
        const glm::dvec2 texel = arguments.heights.texel_size;
        // Textures rarely say how deep they are; a 16th of their size suits most.
        const double usual = std::min(samples.extent.x * texel.x, samples.extent.y * texel.y) / 16.0;
        const double scale = arguments.heights.height_scale.value_or(samples.is_normalized() ? usual : 1.0);
        const std::string name = path_of(arguments.heights.path).filename().string();
        with_height_map(samples, arguments.heights, scale, [&](const auto& map) { show(arguments, map, {}, name); });
    }
    flush_stdout();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Shows a height map with plain normal mapping and with shadows from a baked horizon map: pictures, a light "
        "that turns, and index.html, a page with all of them.",
        "demo");
    arguments arguments;
    app.add_option("HEIGHTS", arguments.heights.path,
                   "height map: PNG of 8 or 16 bits, JPEG, or --raw (default: a stone wall that the program makes)")
        ->type_name("FILE");
    app.add_option("-o,--output", arguments.folder, "folder to write to; created where it is missing")
        ->capture_default_str()
        ->type_name("DIR");
    add_height_options(app, arguments.heights, "default: a 16th of the map's shorter side; raw: 1");
    app.add_option("--threads", arguments.threads, "threads to work on (default: one a core)")
        ->check(whole_number(1, 4096))
        ->type_name("N");
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "demo: %s\n", error.what());
    return 1;
}
