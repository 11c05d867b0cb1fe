// Normal maps in the formats that textures had and have (Forsyth's footnote 6: a palette in place of DXTn).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/reference/shade.hpp>

#include "common/encoding.hpp"
#include "common/shading.hpp"
#include "report/lit_window.hpp"
#include "report/normal_formats.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr int longest = 320, longest_quick = 192;  // sides of pictures
constexpr int formats = 5;

int lights_of(const report_context& context) {
    return int(light_azimuths(context.quick).size() * light_elevations(context.quick).size());
}

stored_normals stored_as(int format, const bs::normal_map& normals, bool quick) {
    switch (format) {
        case 0: return normals_as_rgb(normals);
        case 1: return normals_as_xy(normals);
        case 2: return normals_as_palette(normals, quick ? 2 : 8);
        case 3: return normals_as_bc1(normals);
        default: return normals_as_bc5(normals);
    }
}

// Angles between the stored normals and those of the height map, in degrees; holes are left out.
bs::error_figures angles_between(const bs::normal_map& truth, const bs::normal_map& stored) {
    std::vector<double> angles;
    for (int y = 0; y < truth.extent.y; ++y)
        for (int x = 0; x < truth.extent.x; ++x) {
            const glm::dvec3 a(truth.at(x, y)), b(stored.at(x, y));
            if (a.z == 0.0) continue;
            // The arc cosine of the product would lose small angles.
            angles.push_back(2.0 * std::asin(std::min(1.0, 0.5 * glm::length(a - b))) * 180.0 / std::numbers::pi);
        }
    return bs::figures_of(angles);
}

// The picture in the window with other normals than the height map's, without shadows.
image8 picture_with(const lit_window& shown, std::vector<float> normals, glm::vec3 light) {
    const surface lit{shown.extent(), std::move(normals), {}};
    return shade_picture(lit, sun_and_sky(lit, light), bs::no_shadow{}, bs::threads());
}

// The window's part of normals of the whole map; holes of the map stay holes.
std::vector<float> cut_out(const lit_window& shown, const std::vector<float>& planes) {
    const glm::ivec2 extent = shown.extent(), origin = shown.window().origin;
    const std::size_t whole = planes.size() / 3, count = std::size_t(extent.x) * std::size_t(extent.y);
    std::vector<float> part(3 * count);
    for (std::size_t c = 0; c < 3; ++c)
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const std::size_t to = std::size_t(y) * std::size_t(extent.x) + std::size_t(x);
                const bool hole = shown.surface().normals[2 * count + to] == 0.0f;
                part[c * count + to] =
                    hole ? 0.0f
                         : planes[c * whole + std::size_t(origin.y + y) * std::size_t(shown.whole().x) +
                                  std::size_t(origin.x + x)];
            }
    return part;
}

void run_on(const report_context& context, const report_map& map) {
    const auto step = [&](const std::string& what) {
        std::string text = map.name;
        context.step(text.append(": ").append(what));
    };
    step("normals");
    height_source source = map.source;
    source.height_scale = map.scale;
    std::vector<float> planes = normals_of(map.heights, source, 0);
    const bs::normal_map truth{.values = planes, .extent = map.heights.extent};
    const lit_window shown(map, context.quick ? longest_quick : longest);
    std::vector<far_light> lights;
    std::vector<image8> truths;
    for (const double azimuth : light_azimuths(context.quick))
        for (const double elevation : light_elevations(context.quick)) {
            lights.push_back({azimuth, elevation});
            truths.push_back(picture_with(shown, shown.surface().normals, lights.back().direction()));
        }

    for (int format = 0; format < formats; ++format) {
        step("normals");
        stored_normals stored = stored_as(format, truth, context.quick);
        const bs::error_figures angles = angles_between(truth, {.values = stored.planes, .extent = map.heights.extent});
        record r;
        r.section = "normals";
        r.map = map.name;
        r.family = "normals";
        r.name = stored.name;
        r.format = stored.format;
        const double texels = double(map.heights.extent.x) * double(map.heights.extent.y);
        r[column::extent] = std::sqrt(texels);
        if (stored.entries > 0) r[column::entries] = stored.entries;
        r[column::bytes] = stored.bytes / texels;
        r[column::fetches] = 1.0;
        r[column::normal_error] = angles.mean;
        r[column::error_99] = angles.percentile_99;
        r[column::error_largest] = angles.largest;
        picture_errors errors;
        const std::vector<float> part = cut_out(shown, stored.planes);
        for (std::size_t i = 0; i < lights.size(); ++i) {
            step(stored.name);
            errors.add(truths[i], picture_with(shown, part, lights[i].direction()));
        }
        errors.put(r);
        context.add(r);
    }
}

}  // namespace

report_section normals_section() {
    return {.name = "normals",
            .title = "Normal maps: palette, DXT1, BC5",
            .steps =
                [](const report_context& context) {
                    return int(context.maps.size()) * (1 + formats * (1 + lights_of(context)));
                },
            .seconds =
                [](const report_context& context) { return double(context.maps.size()) * (context.quick ? 0.6 : 4.0); },
            .run =
                [](const report_context& context) {
                    for (const report_map& map : context.maps) run_on(context, map);
                }};
}

}  // namespace examples
