#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <utility>

#include <bumpshadow/encode/mean_level.hpp>
#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/ssbump_lobes.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/shader/shader.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// Self-shadowed bump maps: three masks a texel, for radiosity normal mapping and lights projected on its basis.
// For each vector b of the basis (shader/ssbump.h), with n the normal of the surface, a mask is
//     max(0, b . n) * visible share of the clamped-cosine lobe around b
// the share being the integral of max(0, b . w) over the directions w of the upper hemisphere above the horizons, over
// the same integral without horizons; closed-form in elevation, a sum over bearings.
// Source: Green 2007, Efficient Self-Shadowed Radiosity Normal Mapping; Ols 2010, Self-Shadowed Bump maps.

namespace bumpshadow {

// What darkens the masks besides the normal.
enum class mask_occlusion : unsigned char {
    none,         // masks are the normal in the basis, nothing else
    ambient,      // all three times the visible share of the lobe around +z: ambient occlusion
    directional,  // each times that of its own lobe
};

// All that decoding needs.
struct ssbump {
    // rgba8 (the fourth channel is 1) or rgb565. For bc1 pack as rgba8 and compress each level of that with
    // encode/stb_blocks.hpp into a texture of layout_of({.format = texel_format::bc1}, extent, mips).
    // Added error, diffuse light over its mean and reflected rays, six maps: rgb565 1.2 % and 1.3 degrees, bc1 3 to 8 %
    // and 3 to 12 degrees: too much for reflections.
    texel_format format = texel_format::rgba8;
    normal_y y = normal_y::down;  // down: left-handed, as the Source engine and its tools have it; up: right-handed
    mask_occlusion occlusion = mask_occlusion::directional;  // whether and how the horizons darken the masks
    bool detail = false;  // scaled so that a flat, unshadowed texel is 0.5 in place of 1 / sqrt(3): a detail texture
};

// One flat texture of the extent of the normals, linear and not sRGB.
[[nodiscard]] constexpr texture_layout layout_of(const ssbump& encoding, glm::ivec2 extent, int mips = 1) {
    return {.format = encoding.format, .extent = extent, .mips = mips};
}
// Texture fetches of one light, and of all of them.
[[nodiscard]] constexpr int fetches(const ssbump&) { return 1; }
// What stands for a mask of 1 in the texture. Half of sqrt(3), rounded up so that flat becomes 128 in 8 bits.
[[nodiscard]] constexpr float mask_scale(const ssbump& encoding) { return encoding.detail ? 0.86602545f : 1.0f; }

// The basis of the masks, red, green, blue, in tangent space with the y of the map. Orthonormal; each vector is
// 54.74 degrees from +z.
inline GLM_CONSTEXPR const std::array<glm::dvec3, 3> ssbump_basis = {
    glm::dvec3(0.81649658092772603, 0.0, 0.57735026918962576),
    glm::dvec3(-0.40824829046386302, 0.70710678118654752, 0.57735026918962576),
    glm::dvec3(-0.40824829046386302, -0.70710678118654752, 0.57735026918962576)};

namespace ssbump_detail {

inline constexpr int chunk = 64;  // texels of a row whose sums stay in registers and the first cache

[[nodiscard]] inline glm::vec3 read(texel_format format, const std::byte* row, int x) {
    if (format == texel_format::rgba8) {
        const auto channel = [&](int c) { return from_unorm8(std::to_integer<std::uint8_t>(row[4 * x + c])); };
        return {channel(0), channel(1), channel(2)};
    }
    const int bits = std::to_integer<int>(row[2 * x]) | std::to_integer<int>(row[2 * x + 1]) << 8;
    return {float(bits >> 11) / 31.0f, float((bits >> 5) & 63) / 63.0f, float(bits & 31) / 31.0f};
}

inline void write(texel_format format, std::byte* row, int x, glm::vec3 masks) {
    if (format == texel_format::rgba8) {
        for (glm::length_t c = 0; c < 3; ++c) row[4 * x + int(c)] = std::byte(to_unorm8(masks[c]));
        row[4 * x + 3] = std::byte(255);
        return;
    }
    const int bits = to_unorm<31>(masks.x) << 11 | to_unorm<63>(masks.y) << 5 | to_unorm<31>(masks.z);
    row[2 * x] = std::byte(bits & 255);
    row[2 * x + 1] = std::byte(bits >> 8);
}

// Masks of a normal, before occlusion. A hole counts as flat, so that it does not darken what is filtered with it.
[[nodiscard]] inline glm::vec3 project(glm::vec3 normal, normal_y y) {
    if (normal.z == 0.0f && normal.x == 0.0f && normal.y == 0.0f) normal.z = 1.0f;
    const glm::vec3 masks = shader::bumpshadow_ssbump_weights(normal);
    return y == normal_y::down ? masks : shader::bumpshadow_ssbump_other_hand(masks);
}

// One level from the one above it.
template <executor Executor>
void halve(const texture& t, int level, Executor&& execute) {
    const texel_format format = t.layout.format;
    const glm::ivec2 from = t.layout.level_extent(level - 1), to = t.layout.level_extent(level);
    const std::size_t step = t.layout.row_bytes(level - 1);
    normal_detail::for_rows(to.y, execute, [&](int y) {
        std::byte* const row = t.slice(0, level) + std::size_t(y) * t.layout.row_bytes(level);
        mean_detail::mean_row<glm::vec3>(
            from, to, y, [&](int x, int j) { return read(format, t.slice(0, level - 1) + std::size_t(j) * step, x); },
            [&](int x, glm::vec3 masks) { write(format, row, x, masks); });
    });
}

[[nodiscard]] inline status check_format(const ssbump& encoding, const texture_layout& layout) {
    if (encoding.format != texel_format::rgba8 && encoding.format != texel_format::rgb565)
        return {error::not_supported, "format", double(encoding.format)};
    if (layout.format != encoding.format)
        return {error::mismatch, "texture format", double(layout.format), double(encoding.format)};
    if (layout.kind != texture_kind::flat)
        return {error::mismatch, "texture kind", double(layout.kind), double(texture_kind::flat)};
    return {};
}

[[nodiscard]] inline status check_extent(glm::ivec2 extent, glm::ivec2 expected, const char* x, const char* y) {
    if (extent.x != expected.x) return {error::mismatch, x, double(extent.x), double(expected.x)};
    if (extent.y != expected.y) return {error::mismatch, y, double(extent.y), double(expected.y)};
    return {};
}

// Sums over bearings for each chunk of a row: visit(x0, count, i, slopes, A, B) for every bearing i.
template <class Visit>
void for_bearings(const horizon_map& horizons, int y, int x0, int count, const Visit& visit) {
    float slopes[chunk], across[chunk], up[chunk];
    for (int i = 0; i < horizons.bearings; ++i) {
        const float* const row = horizons.row(i, y) + x0;
        for (int x = 0; x < count; ++x) {
            slopes[x] = lobe_detail::clamped(row[x]);
            const lobe_detail::open_integrals integrals = lobe_detail::above(slopes[x]);
            across[x] = integrals.across;
            up[x] = integrals.up;
        }
        visit(i, slopes, across, up);
    }
}

}  // namespace ssbump_detail

// Masks from horizons and normals, and the mip chain that out.layout asks for (each level the mean of the one above).
//   horizons: slopes at `directions` (any bearings, in any order; 16 or more are worth having), of the extent of
//     normals; those below 0 count as 0, no_horizon as unoccluded. Not read, and may be empty, without occlusion
//   normals: those of the surface; a hole, all 0, becomes a flat unshadowed texel
//   out: of the layout that layout_of gives
//   first_row: row of level 0 that the first row of horizons and normals is: they may be a band of its rows, so that
//     memory is O(width * directions * rows of the band). Mips are made with the band that ends at the last row, which
//     has to come last
// Errors: extents that differ, rows that the texture does not have, a format that is not rgba8 or rgb565, fewer than 3
// or more than 256 directions or equal ones. Uses about 25 KiB of stack and no other memory. Accuracy before rounding
// to the format: the sum over elevations is within 1e-6; a share is off by up to 0.02, 0.004 and 0.0006 with 8, 16 and
// 32 even bearings over a smooth horizon of five features. About 60 ns a texel on one core with 32 bearings and
// 512-bit vectors. Against light traced over exact horizons: see bumpshadow_ssbump_lightmaps.
template <executor Executor = serial>
[[nodiscard]] status pack_ssbump(const horizon_map& horizons, std::span<const glm::dvec2> directions,
                                 const normal_map& normals, const ssbump& encoding, const texture& out,
                                 Executor&& execute = {}, int first_row = 0) {
    if (status s = ssbump_detail::check_format(encoding, out.layout); !s) return s;
    if (status s = check(out); !s) return s;
    const glm::ivec2 whole = out.layout.extent, extent{whole.x, (std::min)(normals.extent.y, whole.y)};
    if (status s = check(normals, extent); !s) return s;
    if (first_row < 0 || first_row > whole.y - extent.y)
        return {error::out_of_range, "first_row", double(first_row), double(whole.y - extent.y)};
    lobe_bearings bearings;
    bearings.count = 0;
    if (encoding.occlusion != mask_occlusion::none) {
        if (status s = check_horizons(horizons, directions); !s) return s;
        if (status s =
                ssbump_detail::check_extent(horizons.extent, extent, "horizon map extent.x", "horizon map extent.y");
            !s)
            return s;
        if (status s = place(directions, bearings); !s) return s;
    }
    const bool directional = encoding.occlusion == mask_occlusion::directional;
    // The basis in tangent space here, whose y is down.
    const double flip = double(sign_of(encoding.y));
    const auto lobe = [&](int c) {
        const glm::dvec3 b = ssbump_basis[std::size_t(c)];
        return cosine_lobe(bearings, directional ? glm::dvec3(b.x, flip * b.y, b.z) : glm::dvec3(0.0, 0.0, 1.0));
    };
    const std::array<cosine_lobe, 3> lobes = {lobe(0), lobe(1), lobe(2)};
    const int channels = bearings.count == 0 ? 0 : directional ? 3 : 1;

    const float scale = mask_scale(encoding);
    normal_detail::for_rows(extent.y, execute, [&](int y) {
        constexpr int chunk = ssbump_detail::chunk;
        std::byte* const row = out.slice(0, 0) + std::size_t(first_row + y) * out.layout.row_bytes(0);
        for (int x0 = 0; x0 < extent.x; x0 += chunk) {
            const int count = (std::min)(chunk, extent.x - x0);
            float shares[3][chunk] = {};
            if (channels > 0)
                ssbump_detail::for_bearings(horizons, y, x0, count,
                                            [&](int i, const float* slopes, const float* across, const float* up) {
                                                for (int c = 0; c < channels; ++c)
                                                    lobes[std::size_t(c)].add(i, slopes, across, up, count, shares[c]);
                                            });
            for (int x = 0; x < count; ++x) {
                const glm::vec3 open = channels == 0   ? glm::vec3(1.0f)
                                       : channels == 1 ? glm::vec3(shares[0][x])
                                                       : glm::vec3(shares[0][x], shares[1][x], shares[2][x]);
                const glm::vec3 masks = ssbump_detail::project(normals.at(x0 + x, y), encoding.y);
                ssbump_detail::write(encoding.format, row, x0 + x, scale * masks * open);
            }
        }
    });
    if (first_row + extent.y < whole.y) return {};
    for (int level = 1; level < out.layout.mips; ++level) ssbump_detail::halve(out, level, execute);
    return {};
}

// Masks without occlusion: a normal map as an SSBump map. encoding.occlusion has to be none.
template <executor Executor = serial>
[[nodiscard]] status pack_ssbump(const normal_map& normals, const ssbump& encoding, const texture& out,
                                 Executor&& execute = {}, int first_row = 0) {
    if (encoding.occlusion != mask_occlusion::none)
        return {error::not_supported, "occlusion (without horizons)", double(encoding.occlusion)};
    return pack_ssbump(horizon_map{}, {}, normals, encoding, out, std::forward<Executor>(execute), first_row);
}

// An SSBump map as a normal map: the recovered normals of a level. Without occlusion these are the normals of the
// surface up to a tilt of 35.26 degrees, in 8 bits 0.07 degrees off in the mean (six maps; a normal map 0.21, as it
// spends half of its range on what points away). With it they are bent towards where the texel is open, but are no bent
// normals (bend_normals): 17 degrees off them, and the surface's 21, since the masks have the surface's normal as a
// factor as well; those of a flat surface with the same horizons are 4 degrees off, where straight up is 12. Black
// gives straight up. out.extent: that of the level. Errors: as above, and a level that the texture does not have.
template <executor Executor = serial>
[[nodiscard]] status recover_normals(const const_texture& from, const ssbump& encoding, const normal_map& out,
                                     int level = 0, Executor&& execute = {}) {
    if (status s = ssbump_detail::check_format(encoding, from.layout); !s) return s;
    if (status s = check(from); !s) return s;
    if (level < 0 || level >= from.layout.mips)
        return {error::out_of_range, "level", double(level), double(from.layout.mips - 1)};
    const glm::ivec2 extent = from.layout.level_extent(level);
    if (status s = check(out, extent); !s) return s;
    normal_detail::for_rows(extent.y, execute, [&](int y) {
        const std::byte* const row = from.slice(0, level) + std::size_t(y) * from.layout.row_bytes(level);
        for (int x = 0; x < extent.x; ++x) {
            const glm::vec3 masks = ssbump_detail::read(encoding.format, row, x);
            out.set(x, y,
                    shader::bumpshadow_ssbump_normal(
                        encoding.y == normal_y::down ? masks : shader::bumpshadow_ssbump_other_hand(masks)));
        }
    });
    return {};
}

// Mean unblocked direction (bent normal) of every texel: the integral of w over the directions above the horizons,
// normalized; straight up where nothing is open. Independent of the surface's normal.
template <executor Executor = serial>
[[nodiscard]] status bend_normals(const horizon_map& horizons, std::span<const glm::dvec2> directions,
                                  const normal_map& out, Executor&& execute = {}) {
    if (status s = check_horizons(horizons, directions); !s) return s;
    if (status s = check(out, horizons.extent); !s) return s;
    lobe_bearings bearings;
    if (status s = place(directions, bearings); !s) return s;
    normal_detail::for_rows(out.extent.y, execute, [&](int y) {
        constexpr int chunk = ssbump_detail::chunk;
        for (int x0 = 0; x0 < out.extent.x; x0 += chunk) {
            const int count = (std::min)(chunk, out.extent.x - x0);
            float sum[3][chunk] = {};
            ssbump_detail::for_bearings(horizons, y, x0, count,
                                        [&](int i, const float*, const float* across, const float* up) {
                                            const std::size_t bearing = std::size_t(i);
                                            const float share = float(bearings.share[bearing]);
                                            const float dx = share * float(bearings.direction[bearing].x);
                                            const float dy = share * float(bearings.direction[bearing].y);
                                            for (int x = 0; x < count; ++x) {
                                                sum[0][x] += dx * across[x];
                                                sum[1][x] += dy * across[x];
                                                sum[2][x] += share * up[x];
                                            }
                                        });
            for (int x = 0; x < count; ++x) {
                const float square = sum[0][x] * sum[0][x] + sum[1][x] * sum[1][x] + sum[2][x] * sum[2][x];
                const float inverse = square > 1e-12f ? 1.0f / std::sqrt(square) : 0.0f;
                out.set(x0 + x, y,
                        inverse > 0.0f ? glm::vec3(sum[0][x], sum[1][x], sum[2][x]) * inverse
                                       : glm::vec3(0.0f, 0.0f, 1.0f));
            }
        }
    });
    return {};
}

}  // namespace bumpshadow
