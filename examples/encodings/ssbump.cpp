#include "encodings/ssbump.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/stb_blocks.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

constexpr double degree = std::numbers::pi / 180.0;
constexpr int mask_bearings = 32;  // that masks are made of; light is traced over all of light_bearings
constexpr int rings = 20;          // of directions that light comes from, of equal solid angle

double degrees_between(glm::vec3 a, glm::vec3 b) {
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(glm::dvec3(a) - glm::dvec3(b)))) / degree;
}

// Mean of what is added; not-a-number of nothing.
struct average {
    double sum = 0.0, count = 0.0;
    void add(double value) {
        sum += value;
        count += 1.0;
    }
    [[nodiscard]] double value() const { return count > 0.0 ? sum / count : std::numeric_limits<double>::quiet_NaN(); }
};

// Normals that own their memory.
struct normals {
    std::vector<float> values;
    bs::normal_map view;

    explicit normals(glm::ivec2 extent) : values(3 * std::size_t(extent.x) * std::size_t(extent.y)) {
        view = {.values = values, .extent = extent};
    }
    normals(const normals&) = delete;
    normals& operator=(const normals&) = delete;

    [[nodiscard]] glm::vec3 operator[](std::size_t texel) const {
        const std::size_t plane = values.size() / 3;
        return {values[texel], values[plane + texel], values[2 * plane + texel]};
    }
    [[nodiscard]] std::size_t texels() const { return values.size() / 3; }
};

void bake_whole(const named_map& map, const normals& out) {
    with_height_map(map.heights, map.source, map.scale,
                    [&](const auto& heights) { require(bs::bake_normals(heights, out.view)); });
}

// Those of a sample's texels.
void bake_patches(const named_map& map, const sample_map& sample, normals& out) {
    for (std::size_t i = 0; i < sample.origins.size(); ++i) {
        const bs::normal_map patch{.values = std::span(out.values).subspan(i * std::size_t(sample.side)),
                                   .extent = glm::ivec2(sample.side),
                                   .row_stride = std::size_t(sample.extent.x),
                                   .plane_stride = sample.texels()};
        with_height_map(map.heights, map.source, map.scale, [&](const auto& heights) {
            require(bs::bake_normals(heights, patch, {sample.origins[i], glm::ivec2(sample.side)}));
        });
    }
}

stored pack(const sample_map& sample, const normals& surface, const bs::ssbump& encoding) {
    stored texture(bs::layout_of(encoding, sample.extent));
    require(bs::pack_ssbump(sample.every(mask_bearings), sample.directions_of(mask_bearings), surface.view, encoding,
                            texture.view()));
    return texture;
}

std::vector<glm::vec3> masks_of(const stored& texture) {
    std::vector<glm::vec3> masks;
    for (const glm::vec4 texel : texel_centers(texture, 0, texture.layout.extent)) masks.emplace_back(texel);
    return masks;
}

// ---- Normals ----

constexpr double steep = 35.0;  // degrees
constexpr std::array normal_names{"without occlusion to the surface's, tilt below 35",
                                  "the same by an 8-bit normal map",
                                  "without occlusion to the surface's, tilt of 35 and more",
                                  "texels of such a tilt, %",
                                  "with occlusion to the mean unblocked direction",
                                  "the surface's to the mean unblocked direction",
                                  "with occlusion to the surface's",
                                  "with occlusion, as if the surface were flat, to the mean unblocked direction",
                                  "straight up to the mean unblocked direction"};

std::vector<double> measure_normals(const named_map& map, const sample_map& sample, const normals& patches) {
    const glm::ivec2 extent = map.heights.extent;
    normals surface(extent), recovered(extent), plain(extent);
    bake_whole(map, surface);
    const bs::ssbump open{.occlusion = bs::mask_occlusion::none};
    stored masks(bs::layout_of(open, extent));
    require(bs::pack_ssbump(surface.view, open, masks.view()));
    require(bs::recover_normals(masks.view(), open, recovered.view));
    std::vector<std::byte> bytes(4 * surface.texels());
    require(bs::encode_normals(surface.view, {}, {bytes, extent}));
    require(bs::decode_normals({bytes, extent}, {}, plain.view));
    average gentle, beyond, by_normal_map;
    for (std::size_t i = 0; i < surface.texels(); ++i) {
        const bool is_gentle = double(surface[i].z) > std::cos(steep * degree);
        (is_gentle ? gentle : beyond).add(degrees_between(recovered[i], surface[i]));
        if (is_gentle) by_normal_map.add(degrees_between(plain[i], surface[i]));
    }

    normals bent(sample.extent), seen(sample.extent), level(sample.extent), level_seen(sample.extent);
    require(bs::bend_normals(sample.every(light_bearings), sample.directions, bent.view));
    require(bs::recover_normals(pack(sample, patches, {}).view(), {}, seen.view));
    std::fill(level.values.begin() + std::ptrdiff_t(2 * level.texels()), level.values.end(), 1.0f);
    require(bs::recover_normals(pack(sample, level, {}).view(), {}, level_seen.view));
    average to_bent, apart, to_surface, level_to_bent, level_apart;
    for (std::size_t i = 0; i < bent.texels(); ++i) {
        to_bent.add(degrees_between(seen[i], bent[i]));
        apart.add(degrees_between(patches[i], bent[i]));
        to_surface.add(degrees_between(seen[i], patches[i]));
        level_to_bent.add(degrees_between(level_seen[i], bent[i]));
        level_apart.add(degrees_between(level[i], bent[i]));
    }
    return {
        gentle.value(),     by_normal_map.value(), beyond.value(),     100.0 * beyond.count / double(surface.texels()),
        to_bent.value(),    apart.value(),         to_surface.value(), level_to_bent.value(),
        level_apart.value()};
}

// ---- Light ----

// Directions that light comes from, [bearing][ring], and how much for each of several surroundings.
struct lights {
    std::vector<glm::dvec3> directions;
    std::vector<std::vector<double>> radiance;  // [surroundings][direction]

    lights() {
        for (int b = 0; b < light_bearings; ++b)
            for (int k = 0; k < rings; ++k) {
                const double up = (k + 0.5) / rings, across = std::sqrt(1.0 - up * up);
                const glm::dvec2 d = bs::exact_direction(double(b) / light_bearings);
                directions.emplace_back(d.x * across, d.y * across, up);
            }
        add([](glm::dvec3 w) { return 0.3 + 0.7 * w.z; });
        for (const double turns : {0.0, 0.3, 0.55, 0.9})
            for (const double elevation : {25.0, 50.0}) {
                const glm::dvec2 d = bs::exact_direction(turns) * std::cos(elevation * degree);
                const glm::dvec3 sun(d.x, d.y, std::sin(elevation * degree));
                add([sun](glm::dvec3 w) { return 0.3 + 20.0 * std::exp(60.0 * (glm::dot(w, sun) - 1.0)); });
            }
    }
    template <class Radiance>
    void add(const Radiance& of) {
        std::vector<double>& values = radiance.emplace_back();
        for (const glm::dvec3 w : directions) values.push_back(of(w));
    }
    // Of a plane that faces n; with the dot not clamped, light from behind counts as negative.
    [[nodiscard]] double irradiance(std::size_t surroundings, glm::dvec3 n, bool clamped) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < directions.size(); ++i) {
            const double cosine = glm::dot(n, directions[i]);
            sum += radiance[surroundings][i] * (clamped ? std::max(0.0, cosine) : cosine);
        }
        return std::max(0.0, sum);
    }
};

// Diffuse light of every texel over its exact horizons, [surroundings][texel].
std::vector<std::vector<double>> trace(const sample_map& sample, const normals& surface, const lights& from) {
    std::vector<std::vector<double>> light(from.radiance.size(), std::vector<double>(sample.texels()));
    for (std::size_t i = 0; i < sample.texels(); ++i) {
        const glm::dvec3 n(surface[i]);
        for (std::size_t d = 0; d < from.directions.size(); ++d) {
            const glm::dvec3 w = from.directions[d];
            const double horizon = double(sample.slopes[d / rings * sample.texels() + i]);
            const double cosine = glm::dot(n, w);
            if (cosine <= 0.0 || w.z < horizon * std::sqrt(1.0 - w.z * w.z)) continue;
            for (std::size_t s = 0; s < light.size(); ++s) light[s][i] += from.radiance[s][d] * cosine;
        }
    }
    return light;
}

// Root mean square of the difference over the mean of the truth, in percent; with `exposed`, at the brightness that
// fits best.
double distance(const std::vector<double>& picture, const std::vector<double>& truth, bool exposed) {
    const double all = std::inner_product(picture.begin(), picture.end(), truth.begin(), 0.0);
    const double own = std::inner_product(picture.begin(), picture.end(), picture.begin(), 0.0);
    const double scale = exposed ? all / own : 1.0;
    average square, mean;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        square.add((scale * picture[i] - truth[i]) * (scale * picture[i] - truth[i]));
        mean.add(truth[i]);
    }
    return 100.0 * std::sqrt(square.value()) / mean.value();
}

constexpr std::array light_names{"normal map",
                                 "no occlusion",
                                 "ambient occlusion",
                                 "directional occlusion",
                                 "normal map, at the best brightness",
                                 "no occlusion, at the best brightness",
                                 "ambient occlusion, at the best brightness",
                                 "directional occlusion, at the best brightness",
                                 "no occlusion, dots not clamped",
                                 "ambient occlusion, dots not clamped",
                                 "directional occlusion, dots not clamped"};

// worst: largest ratio of the errors with directional occlusion and without, of all surroundings.
std::vector<double> measure_light(const sample_map& sample, const normals& surface, double& worst) {
    const lights from;
    const auto truth = trace(sample, surface, from);
    using enum bs::mask_occlusion;
    std::vector<std::vector<glm::vec3>> masks;
    for (const bs::mask_occlusion occlusion : {none, ambient, directional})
        masks.push_back(masks_of(pack(sample, surface, {.occlusion = occlusion})));
    const auto picture = [&](const auto& light_of) {
        std::vector<double> light(sample.texels());
        for (std::size_t i = 0; i < light.size(); ++i) light[i] = double(light_of(i).x);
        return light;
    };
    std::array<average, light_names.size()> errors;
    worst = 0.0;
    for (std::size_t s = 0; s < truth.size(); ++s)
        for (const bool clamped : {true, false}) {
            std::array<glm::vec3, 3> maps;
            for (std::size_t c = 0; c < 3; ++c)
                maps[c] = glm::vec3(float(from.irradiance(s, bs::ssbump_basis[c], clamped)));
            std::array<std::vector<double>, 4> pictures;
            pictures[0] = picture([&](std::size_t i) {
                return shader::bumpshadow_normal_lightmaps(surface[i], maps[0], maps[1], maps[2]);
            });
            for (std::size_t k = 0; k < 3; ++k)
                pictures[k + 1] = picture([&](std::size_t i) {
                    return shader::bumpshadow_ssbump_lightmaps(masks[k][i], maps[0], maps[1], maps[2]);
                });
            for (std::size_t k = 0; k < 4; ++k) {
                const double error = distance(pictures[k], truth[s], false);
                if (clamped) {
                    errors[k].add(error);
                    errors[k + 4].add(distance(pictures[k], truth[s], true));
                } else if (k > 0) {
                    errors[k + 7].add(error);
                }
            }
            if (clamped)
                worst =
                    std::max(worst, distance(pictures[3], truth[s], false) / distance(pictures[1], truth[s], false));
        }
    std::vector<double> values;
    for (const average& e : errors) values.push_back(e.value());
    return values;
}

// ---- Formats ----

constexpr std::array format_names{"RGB565: diffuse light, %", "RGB565: reflection, degrees", "DXT1: diffuse light, %",
                                  "DXT1: reflection, degrees"};

// Mean error of diffuse light from twelve directions at 45 degrees over that light's mean, and of the reflection of a
// ray that comes straight down.
std::array<double, 2> added_error(const std::vector<glm::vec3>& exact, const std::vector<glm::vec3>& stored) {
    average light, off, reflection;
    const auto reflected = [](glm::vec3 masks) {
        return shader::bumpshadow_reflection({0.0f, 0.0f, 1.0f}, shader::bumpshadow_ssbump_normal(masks));
    };
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (int k = 0; k < 12; ++k) {
            const glm::dvec2 d = bs::exact_direction(k / 12.0);
            const glm::vec3 weights = shader::bumpshadow_ssbump_weights(glm::vec3(d.x, d.y, 1.0) * std::sqrt(0.5f));
            const double truth = double(shader::bumpshadow_ssbump_light(exact[i], weights));
            light.add(truth);
            off.add(std::abs(double(shader::bumpshadow_ssbump_light(stored[i], weights)) - truth));
        }
        reflection.add(degrees_between(reflected(exact[i]), reflected(stored[i])));
    }
    return {100.0 * off.value() / light.value(), reflection.value()};
}

std::vector<double> measure_formats(const sample_map& sample, const normals& surface) {
    // 8 bits are the truth here: their own error is far below the others'.
    const stored bytes = pack(sample, surface, {});
    const std::vector<glm::vec3> exact = masks_of(bytes);
    const auto coarse = added_error(exact, masks_of(pack(sample, surface, {.format = bs::texel_format::rgb565})));
    stored blocks(bs::layout_of(bs::ssbump{.format = bs::texel_format::bc1}, sample.extent));
    const std::size_t row = bytes.layout.row_bytes(0);
    for (int y = 0; y < sample.extent.y; y += 4)
        for (int x = 0; x < sample.extent.x; x += 4) {
            std::array<std::byte, 64> texels;
            for (std::size_t j = 0; j < 4; ++j)
                std::copy_n(bytes.bytes.data() + (std::size_t(y) + j) * row + std::size_t(4 * x), 16,
                            texels.data() + 16 * j);
            bs::encode_bc1_stb(texels.data(), blocks.bytes.data() + std::size_t(y / 4) * blocks.layout.row_bytes(0) +
                                                  std::size_t(x / 4) * 8);
        }
    const auto compressed = added_error(exact, masks_of(blocks));
    return {coarse[0], coarse[1], compressed[0], compressed[1]};
}

// ---- All of it ----

grid lined(const std::string& title, std::span<const char* const> names, std::span<const ssbump_measured> maps,
           std::span<const sample_map> samples, std::vector<double> ssbump_measured::*part) {
    grid g{title, {"mean"}, {}};
    for (const sample_map& sample : samples) g.columns.push_back(sample.name);
    for (std::size_t i = 0; i < names.size(); ++i) {
        average mean;
        std::vector<double> values;
        for (const ssbump_measured& m : maps) {
            values.push_back((m.*part)[i]);
            if (!std::isnan(values.back())) mean.add(values.back());
        }
        values.insert(values.begin(), mean.value());
        g.lines.push_back({names[i], values});
    }
    return g;
}

}  // namespace

std::span<const char* const> ssbump_normal_names() { return normal_names; }
std::span<const char* const> ssbump_light_names() { return light_names; }
std::span<const char* const> ssbump_format_names() { return format_names; }

ssbump_measured measure_ssbump(const named_map& map, const sample_map& sample, const std::function<void()>& between) {
    normals patches(sample.extent);
    bake_patches(map, sample, patches);
    ssbump_measured m;
    m.normals = measure_normals(map, sample, patches);
    if (between) between();
    m.light = measure_light(sample, patches, m.worst_light);
    if (between) between();
    m.formats = measure_formats(sample, patches);
    return m;
}

ssbump_figures measure_ssbump(std::span<const named_map> maps, std::span<const sample_map> samples) {
    const std::vector<ssbump_measured> all = each_map(samples, [&](const sample_map& sample) {
        return measure_ssbump(maps[std::size_t(&sample - samples.data())], sample);
    });
    ssbump_figures figures;
    figures.grids = {
        lined("SSBump: recovered normals, degrees", normal_names, all, samples, &ssbump_measured::normals),
        lined("SSBump: error of light from three lightmaps, %", light_names, all, samples, &ssbump_measured::light),
        lined("SSBump: what small formats add", format_names, all, samples, &ssbump_measured::formats)};
    double off = 0.0, precision = 0.0, light = 0.0;
    for (const ssbump_measured& m : all) {
        if (!std::isnan(m.normals[0])) off = std::max(off, m.normals[0]);
        if (m.normals[1] > 0.0) precision = std::max(precision, m.normals[0] / m.normals[1]);
        light = std::max(light, m.worst_light);
    }
    figures.checks = {
        {"SSBump: normals recovered without occlusion, tilt below 35, degrees <= 1, every map", off, off <= 1.0},
        {"SSBump: the same over the error of an 8-bit normal map < 1, every map", precision, precision < 1.0},
        {"SSBump: error of lightmaps with directional occlusion over without < 1, every map and light", light,
         light < 1.0}};
    return figures;
}

}  // namespace examples
