// What SSBump maps are for: light from three lightmaps, against light that is traced over exact horizons; and what
// small formats do to diffuse light and to reflections.

#include <bumpshadow/encode/ssbump.hpp>

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/horizon/exact.hpp>

#include "support/shapes.hpp"

#if BUMPSHADOW_TESTS_READ_IMAGES
#include "support/real_maps.hpp"

#include <bumpshadow/encode/stb_blocks.hpp>
#endif

using namespace bumpshadow;

namespace {

constexpr double pi = std::numbers::pi;
constexpr int bearings = 48, elevations = 20;

void require(const status& s) { REQUIRE_MESSAGE(bool(s), s.message().c_str()); }

// Radiance from evenly spread directions of equal solid angle, at the bearings of the horizons.
struct environment {
    template <class Radiance>
    explicit environment(const Radiance& radiance) {
        for (int i = 0; i < bearings; ++i)
            for (int k = 0; k < elevations; ++k) {
                const double sine = (k + 0.5) / elevations, cosine = std::sqrt(1.0 - sine * sine);
                const glm::dvec2 d = shapes::direction(double(i) / bearings);
                const glm::dvec3 w(d.x * cosine, d.y * cosine, sine);
                direction.push_back(w);
                light.push_back(radiance(w));
            }
    }
    // Of a plane with normal n; not clamped, light from behind counts as negative.
    [[nodiscard]] double irradiance(glm::dvec3 n, bool clamped) const {
        double sum = 0.0;
        for (std::size_t i = 0; i < light.size(); ++i) {
            const double cosine = glm::dot(n, direction[i]);
            sum += light[i] * (clamped ? std::max(0.0, cosine) : cosine);
        }
        return std::max(0.0, sum);
    }
    std::vector<glm::dvec3> direction;
    std::vector<double> light;
};

// A patch of a map with what is baked from it.
struct patch {
    template <class Sample>
    patch(const height_map<Sample>& map, rectangle region)
        : extent(region.extent),
          directions(shapes::directions(bearings)),
          slopes(required_size(extent, bearings)),
          normal(3 * std::size_t(extent.x) * std::size_t(extent.y)) {
        horizons = {.values = slopes, .extent = extent, .bearings = bearings};
        normals = {.values = normal, .extent = extent};
        bake_options options;
        options.region = region;
        require(bake_exact(map, directions, horizons, options));
        require(bake_normals(map, normals, region));
    }

    [[nodiscard]] std::vector<glm::vec3> masks(mask_occlusion occlusion) const {
        const ssbump encoding{.occlusion = occlusion};
        std::vector<std::byte> bytes(layout_of(encoding, extent).required_size());
        require(pack_ssbump(horizons, directions, normals, encoding, {bytes, layout_of(encoding, extent)}));
        std::vector<glm::vec3> result;
        for (int i = 0; i < extent.x * extent.y; ++i)
            result.push_back(ssbump_detail::read(encoding.format, bytes.data(), i));
        return result;
    }
    [[nodiscard]] std::vector<double> traced(const environment& e) const {
        std::vector<double> result;
        for (int y = 0; y < extent.y; ++y)
            for (int x = 0; x < extent.x; ++x) {
                const glm::dvec3 n(normals.at(x, y));
                double sum = 0.0;
                for (int i = 0; i < bearings; ++i)
                    for (int k = 0; k < elevations; ++k) {
                        const glm::dvec3 w = e.direction[std::size_t(i * elevations + k)];
                        if (w.z < double(horizons.row(i, y)[x]) * std::sqrt(1.0 - w.z * w.z)) continue;
                        sum += e.light[std::size_t(i * elevations + k)] * std::max(0.0, glm::dot(n, w));
                    }
                result.push_back(sum);
            }
        return result;
    }

    glm::ivec2 extent;
    std::vector<glm::dvec2> directions;
    std::vector<float> slopes, normal;
    horizon_map horizons;
    normal_map normals;
};

// Root mean square of the difference over the mean of the truth; with `exposed`, at the brightness that fits best.
double distance(const std::vector<double>& picture, const std::vector<double>& truth, bool exposed) {
    double pt = 0.0, pp = 0.0, mean = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < truth.size(); ++i) {
        pt += picture[i] * truth[i];
        pp += picture[i] * picture[i];
        mean += truth[i] / double(truth.size());
    }
    const double scale = exposed ? pt / pp : 1.0;
    for (std::size_t i = 0; i < truth.size(); ++i) sum += std::pow(scale * picture[i] - truth[i], 2.0);
    return std::sqrt(sum / double(truth.size())) / mean;
}

std::vector<environment> environments() {
    std::vector<environment> all;
    all.emplace_back([](glm::dvec3 w) { return 0.3 + 0.7 * w.z; });
    for (const double turns : {0.0, 0.3, 0.55, 0.9})
        for (const double elevation : {25.0, 50.0}) {
            const double e = elevation * pi / 180.0;
            const glm::dvec2 d = shapes::direction(turns);
            const glm::dvec3 sun(d.x * std::cos(e), d.y * std::cos(e), std::sin(e));
            all.emplace_back([sun](glm::dvec3 w) { return 0.3 + 20.0 * std::exp(60.0 * (glm::dot(w, sun) - 1.0)); });
        }
    return all;
}

// Returns the mean error with directional occlusion, as it is.
double compare(const std::string& name, const patch& p, bool clamped) {
    const auto none = p.masks(mask_occlusion::none), ambient = p.masks(mask_occlusion::ambient),
               directional = p.masks(mask_occlusion::directional);
    double sum[4][2] = {};
    for (const environment& e : environments()) {
        const auto truth = p.traced(e);
        glm::vec3 maps[3];
        for (std::size_t c = 0; c < 3; ++c) maps[c] = glm::vec3(float(e.irradiance(ssbump_basis[c], clamped)));
        const auto lit = [&](const std::vector<glm::vec3>& masks) {
            std::vector<double> picture;
            for (const glm::vec3 m : masks)
                picture.push_back(double(shader::bumpshadow_ssbump_lightmaps(m, maps[0], maps[1], maps[2]).x));
            return picture;
        };
        std::vector<double> plain;
        for (int i = 0; i < p.extent.x * p.extent.y; ++i)
            plain.push_back(double(shader::bumpshadow_normal_lightmaps(p.normals.at(i % p.extent.x, i / p.extent.x),
                                                                       maps[0], maps[1], maps[2])
                                       .x));
        for (const bool exposed : {false, true}) {
            const double errors[4] = {distance(plain, truth, exposed), distance(lit(none), truth, exposed),
                                      distance(lit(ambient), truth, exposed),
                                      distance(lit(directional), truth, exposed)};
            for (int k = 0; k < 4; ++k) sum[k][exposed] += errors[k];
            if (clamped && !exposed) CHECK(errors[3] < errors[1]);  // with every light, not just on average
        }
    }
    const double n = double(environments().size());
    for (const int exposed : {0, 1}) {
        const std::string how = exposed == 1 ? "at the best brightness" : "as it is";
        MESSAGE(name, clamped ? std::string(", ") : std::string(", dots not clamped, "), how,
                ": error over mean, normal map ", sum[0][exposed] / n, ", no occlusion ", sum[1][exposed] / n,
                ", ambient ", sum[2][exposed] / n, ", directional ", sum[3][exposed] / n);
        CHECK(sum[3][exposed] < 0.8 * sum[1][exposed]);
        CHECK(sum[3][exposed] < 0.8 * sum[0][exposed]);
    }
    return sum[3][0] / n;
}

double degrees_between(glm::dvec3 a, glm::dvec3 b) {
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(glm::normalize(a) - glm::normalize(b)))) * 180.0 / pi;
}

// Mean errors that a format adds: of diffuse light from twelve directions at 45 degrees, over that light's mean, and of
// the reflection of a ray that comes straight down, in degrees.
struct format_error {
    double diffuse = 0.0, reflection = 0.0;
};
format_error measured(const std::vector<glm::vec3>& exact, const std::vector<glm::vec3>& stored) {
    format_error e;
    double light = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        for (int k = 0; k < 12; ++k) {
            const glm::dvec2 d = shapes::direction(k / 12.0);
            const auto weights =
                shader::bumpshadow_ssbump_weights(glm::normalize(glm::vec3(float(d.x), float(d.y), 1.0f)));
            light += double(shader::bumpshadow_ssbump_light(exact[i], weights));
            e.diffuse += std::abs(double(shader::bumpshadow_ssbump_light(exact[i] - stored[i], weights)));
        }
        const auto reflection = [](glm::vec3 masks) {
            return glm::dvec3(
                shader::bumpshadow_reflection(glm::vec3(0.0f, 0.0f, 1.0f), shader::bumpshadow_ssbump_normal(masks)));
        };
        e.reflection += degrees_between(reflection(exact[i]), reflection(stored[i]));
    }
    e.diffuse /= light;
    e.reflection /= double(exact.size());
    return e;
}

// Masks are said to recover the mean unblocked direction B (bent normal). Their shares alone nearly do, that is, masks
// of a flat surface: with F the unblocked integral of max(0, b . w) of a basis vector b, and N_b that of max(0, -b . w)
// over the open directions, B . b = F share_b - N_b, where 0 <= N_b <= N, what an open sky gives. So the two are at
// most asin(sqrt(3) N / (F |shares|)) apart, 15.5 degrees under an open sky. The surface's own normal has nothing to do
// with B, but the masks have it as a factor: on a slope, whose own horizon tilts B by half of it, they count it twice
// (the case below), so that the recovered normal may be farther from B than the surface's is.
constexpr double lobe = pi / 2.0 * (1.0 + std::numbers::inv_sqrt3);    // F
constexpr double behind = pi / 2.0 * (1.0 - std::numbers::inv_sqrt3);  // N

struct bent_error {
    double recovered = 0.0, level = 0.0, surface = 0.0, up = 0.0;  // degrees to B, means
};

// level: recovered from masks of a flat surface with the same horizons
bent_error to_bent(const patch& p) {
    const std::size_t texels = std::size_t(p.extent.x) * std::size_t(p.extent.y);
    std::vector<float> values[4];
    normal_map maps[4];
    for (int k = 0; k < 4; ++k) {
        values[k].resize(3 * texels);
        maps[k] = {.values = values[k], .extent = p.extent};
    }
    const auto& [bent, recovered, flat, level] = maps;
    require(bend_normals(p.horizons, p.directions, bent));
    std::vector<std::byte> bytes(layout_of(ssbump{}, p.extent).required_size());
    const texture masks{bytes, layout_of(ssbump{}, p.extent)};
    require(pack_ssbump(p.horizons, p.directions, p.normals, {}, masks));
    require(recover_normals(masks, {}, recovered));
    for (int y = 0; y < p.extent.y; ++y)
        for (int x = 0; x < p.extent.x; ++x) flat.set(x, y, {0.0f, 0.0f, 1.0f});
    require(pack_ssbump(p.horizons, p.directions, flat, {}, masks));
    require(recover_normals(masks, {}, level));
    bent_error e;
    for (int y = 0; y < p.extent.y; ++y)
        for (int x = 0; x < p.extent.x; ++x) {
            const glm::dvec3 open(bent.at(x, y)), found(level.at(x, y));
            const double apart = degrees_between(found, open);
            e.recovered += degrees_between(recovered.at(x, y), open) / double(texels);
            e.level += apart / double(texels);
            e.surface += degrees_between(p.normals.at(x, y), open) / double(texels);
            e.up += degrees_between({0.0, 0.0, 1.0}, open) / double(texels);
            const glm::vec3 stored = ssbump_detail::read(texel_format::rgba8, bytes.data(), y * p.extent.x + x);
            // Rounding to 8 bits moves each share by up to sqrt(3) / 510.
            const double shares = std::numbers::sqrt3 * double(glm::length(stored)), rounding = 3.0 / 510.0;
            const double sine = (std::numbers::sqrt3 * behind / lobe + rounding) / std::max(shares - rounding, 1e-9);
            if (sine < 1.0) CHECK(apart <= std::asin(sine) * 180.0 / pi + 0.1);
        }
    return e;
}

void compress(const std::string& name, const patch& p) {
    // 8 bits are the reference: their own error is far below the others'.
    const auto exact = p.masks(mask_occlusion::directional);
    const ssbump encoding{.format = texel_format::rgb565};
    std::vector<std::byte> bytes(layout_of(encoding, p.extent).required_size());
    require(pack_ssbump(p.horizons, p.directions, p.normals, encoding, {bytes, layout_of(encoding, p.extent)}));
    std::vector<glm::vec3> stored;
    for (int i = 0; i < p.extent.x * p.extent.y; ++i)
        stored.push_back(ssbump_detail::read(encoding.format, bytes.data(), i));
    const format_error coarse = measured(exact, stored);
    MESSAGE(name, ", RGB565: diffuse ", coarse.diffuse, ", reflection ", coarse.reflection, " degrees");
    // Steps of 1/31 and 1/63 leave a mean error of a quarter of a step in each channel, 0.008; masks are about 0.5.
    CHECK(coarse.diffuse < 0.02);
    // The normal is off by about 0.01 / 0.577 in either direction, the reflection by twice that.
    CHECK(coarse.reflection < 3.0);
#if BUMPSHADOW_TESTS_READ_IMAGES
    for (int by = 0; by < p.extent.y / 4; ++by)
        for (int bx = 0; bx < p.extent.x / 4; ++bx) {
            std::byte texels[64], block[8];
            for (int i = 0; i < 16; ++i) {
                const std::size_t at = std::size_t((4 * by + i / 4) * p.extent.x + 4 * bx + i % 4);
                for (int c = 0; c < 3; ++c) texels[4 * i + c] = std::byte(to_unorm8(exact[at][c]));
            }
            encode_bc1_stb(texels, block);
            for (int i = 0; i < 16; ++i) {
                const std::size_t at = std::size_t((4 * by + i / 4) * p.extent.x + 4 * bx + i % 4);
                stored[at] = glm::vec3(decode_bc1(block, i));
            }
        }
    const format_error blocks = measured(exact, stored);
    MESSAGE(name, ", DXT1: diffuse ", blocks.diffuse, ", reflection ", blocks.reflection, " degrees");
    // The post: "nasty blocky artifacts in specular/reflection", worse than RGB5 there.
    CHECK(blocks.reflection > coarse.reflection);
    CHECK(blocks.diffuse < 0.15);
#else
    MESSAGE("skipped: DXT1, built without the programs, which have stb");
#endif
}

}  // namespace

TEST_CASE("three lightmaps: directional occlusion is closer to traced light") {
    // Round stones in mortar.
    const auto stones = shapes::sampled<float>({48, 48}, [](double x, double y) {
        const double row = std::floor(y / 16.0), u = std::fmod(x + 12.0 * row, 24.0) - 12.0, v = y - 16.0 * row - 8.0;
        return 8.0 * std::sqrt(std::max(0.0, 1.0 - std::pow(u / 11.0, 4.0))) *
               std::sqrt(std::max(0.0, 1.0 - std::pow(v / 7.0, 4.0)));
    });
    const patch p(stones.view(), {{0, 0}, {48, 48}});
    const double usual = compare("stones", p, true), projected = compare("stones", p, false);
    CHECK(projected < 0.8 * usual);
    compress("stones", p);
}

TEST_CASE("on a slope the masks count its tilt twice, and the mean unblocked direction half of it") {
    for (const double tilt : {10.0, 20.0, 30.0})
        for (const double turns : {0.0, 0.1, 0.37}) {
            const glm::dvec2 uphill = shapes::direction(turns);
            const double slope = std::tan(tilt * pi / 180.0);
            patch p(shapes::sampled<float>({4, 4}, shapes::plane(0.0)).view(), {{0, 0}, {4, 4}});
            const glm::dvec3 normal = glm::normalize(glm::dvec3(-slope * uphill, 1.0));
            for (int y = 0; y < 4; ++y)
                for (int x = 0; x < 4; ++x) {
                    p.normals.set(x, y, glm::vec3(normal));
                    for (int i = 0; i < bearings; ++i)
                        p.horizons.row(i, y)[x] =
                            float(slope * std::max(0.0, glm::dot(uphill, p.directions[std::size_t(i)])));
                }
            const bent_error e = to_bent(p);
            // Open is the wedge between the slope and the horizontal, and B stands in its middle.
            CHECK(e.up == doctest::Approx(tilt / 2.0).epsilon(0.01));
            CHECK(e.surface == doctest::Approx(tilt / 2.0).epsilon(0.01));
            CHECK(e.recovered > e.surface);
            CHECK(e.level < e.up);
        }
}

#if BUMPSHADOW_TESTS_READ_IMAGES

TEST_CASE("three lightmaps and small formats on real height maps") {
    for_real_maps({"dx_stones_256", "pk01_floor01_512", "acg_Bricks059_1024"},
                  [](const std::string& name, const auto& map) {
                      const patch p(map, {{96, 64}, {48, 48}});
                      const double usual = compare(name, p, true), projected = compare(name, p, false);
                      CHECK(projected < 0.8 * usual);
                      compress(name, p);
                  });
}

TEST_CASE("recovered normals and mean unblocked directions of real height maps") {
    const float limit = float(std::cos(35.0 * pi / 180.0));
    for_real_maps({}, [&](const std::string& name, const auto& map) {
        const std::size_t texels = std::size_t(map.extent.x) * std::size_t(map.extent.y);
        std::vector<float> values(3 * texels), back(3 * texels);
        const normal_map n{.values = values, .extent = map.extent}, r{.values = back, .extent = map.extent};
        require(bake_normals(map, n, {}, threads()));
        const ssbump encoding{.occlusion = mask_occlusion::none};
        std::vector<std::byte> bytes(4 * texels);
        const texture t{bytes, layout_of(encoding, map.extent)};
        require(pack_ssbump(n, encoding, t, threads()));
        require(recover_normals(t, encoding, r, 0, threads()));
        double sum[2] = {};
        std::size_t count[2] = {};
        for (int y = 0; y < map.extent.y; ++y)
            for (int x = 0; x < map.extent.x; ++x) {
                const bool steep = n.at(x, y).z < limit;
                sum[steep] += degrees_between(n.at(x, y), r.at(x, y));
                ++count[steep];
            }
        MESSAGE(name, ": recovered within ", sum[0] / double(count[0]), " degrees; ",
                100.0 * double(count[1]) / double(texels), " % tilt by more than 35 degrees, there ",
                count[1] == 0 ? 0.0 : sum[1] / double(count[1]));
        CHECK(sum[0] / double(count[0]) < 0.2);

        const bent_error e = to_bent(patch(map, {map.extent / 2 - glm::ivec2(16), glm::ivec2(32)}));
        MESSAGE(name, ": to the mean unblocked direction, recovered ", e.recovered, ", the surface's ", e.surface,
                "; recovered from masks of a flat surface ", e.level, ", straight up ", e.up);
        // A blocked direction w tilts B by w.xy / pi, and what is recovered by at least 0.24 of that: to first
        // order what is left is up to 0.76 of it.
        CHECK(e.level < 0.76 * e.up);
    });
}

#else

TEST_CASE("three lightmaps and small formats on real height maps") {
    MESSAGE("skipped: built without the programs, which read images");
}

#endif
