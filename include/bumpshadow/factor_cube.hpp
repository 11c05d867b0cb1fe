#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/status.hpp>
#include <bumpshadow/texture.hpp>

// A cube texture that turns the direction to a light into the factors of eight horizons, at 0, 45 ... 315 degrees:
// channel c holds the factor of direction c where it is positive and of the opposite one, c + 4, where it is negative.
// shader/factors.h decodes it, and computes the same without a cube.
//
// Source: Lengyel, Smooth Horizon Mapping (Game Engine Gems 3, 2016), section 5.3 and figure 5.5.

namespace bumpshadow {

// How a factor in [-1, 1] becomes a byte.
enum class factor_form : unsigned char {
    published,  // [0, 255]; 0 becomes 128, decoded as 1/255: every texel leaks 1/255 of each unused horizon of layer 0
    biased,     // 128 + 127 factor, so that 0 is 0 (within 2e-7); decoded at the same cost
};

// All that decoding needs. 16 texels a side are 6 KiB.
struct factor_cube {
    int size = 16;                           // texels a side, 1 to largest_factor_cube
    factor_form form = factor_form::biased;  // which decoding has to know
};

// Texels a side, at the most.
inline constexpr int largest_factor_cube = 1024;

// The cube of Lengyel's chapter: 16 texels a side, 0 stored as 128.
[[nodiscard]] constexpr factor_cube factor_cube_as_published() { return {16, factor_form::published}; }

// A cube of rgba8, linear and not sRGB.
[[nodiscard]] inline GLM_CONSTEXPR texture_layout layout_of(const factor_cube& cube) {
    return {.format = texel_format::rgba8, .kind = texture_kind::cube, .extent = glm::ivec2(cube.size), .layers = 6};
}

// Checks the size.
[[nodiscard]] constexpr status check(const factor_cube& cube) {
    if (cube.size <= 0) return {error::not_positive, "factor cube size", double(cube.size)};
    if (cube.size > largest_factor_cube)
        return {error::out_of_range, "factor cube size", double(cube.size), double(largest_factor_cube)};
    return {};
}

// A place on a cube texture. Faces 0 to 5 look along +x -x +y -y +z -z; s, t in [0, 1], t growing with the row number:
//   face  +x  -x  +y  -y  +z  -z
//   s     -z  +z  +x  +x  +x  -x    (the component that s grows with)
//   t     -y  -y  +z  -z  -y  -y
// as OpenGL (4.6, table 8.19), Direct3D and Vulkan have it.
struct cube_coordinate {
    int face;       // 0 to 5
    glm::dvec2 st;  // [0, 1], (0, 0) the corner of the face's first texel
};

// The direction to it, whose largest component is 1.
[[nodiscard]] inline glm::dvec3 from_cube(const cube_coordinate& place) {
    const double s = 2.0 * place.st.x - 1.0, t = 2.0 * place.st.y - 1.0;
    switch (place.face) {
        case 0: return {1.0, -t, -s};
        case 1: return {-1.0, -t, s};
        case 2: return {s, 1.0, t};
        case 3: return {s, -1.0, -t};
        case 4: return {s, -t, 1.0};
        default: return {-s, -t, -1.0};
    }
}

// Factors of the horizons at 0, 45 ... 315 degrees for a light in that direction, of any length: linear in the angle
// between the two nearest, the others 0. They add up to 1. Straight up and down count as +x.
[[nodiscard]] inline std::array<double, 8> eight_factors(glm::dvec3 direction) {
    const double position = 8.0 * exact_bearing(glm::dvec2(direction.x, direction.y));
    const double below = std::floor(position);
    std::array<double, 8> factors{};
    factors[std::size_t(below) % 8] = 1.0 - (position - below);
    factors[std::size_t(below + 1.0) % 8] = position - below;
    return factors;
}

// The byte of a factor in [-1, 1].
[[nodiscard]] constexpr std::uint8_t to_factor8(factor_form form, double factor) {
    if (form == factor_form::published) return to_unorm8(static_cast<float>(0.5 * factor + 0.5));
    return static_cast<std::uint8_t>(128.5 + 127.0 * factor);
}

// Writes the cube, each texel the factors at its center. A texel that looks straight up or down gets 0, as its
// surroundings cancel.
//   out: of layout_of(cube), 24 size^2 bytes
// Errors: size, a layout that differs, too few bytes.
// Accuracy of a factor at 16 a side, biased, sampled with seamless bilinear filtering: within 0.08 (0.007 in the mean)
// at elevations up to 30 degrees, worst at the axes, whose peaks the filter cuts; 0.16 (0.016) at 55 to 63 degrees;
// factors vanish at the pole, where opposite ones cancel. As published 1/255 more.
[[nodiscard]] inline status write_factor_cube(const factor_cube& cube, const texture& out) {
    if (status s = check(cube); !s) return s;
    if (status s = check(out); !s) return s;
    const texture_layout &given = out.layout, wanted = layout_of(cube);
    if (given.format != wanted.format)
        return {error::mismatch, "texture format", double(given.format), double(wanted.format)};
    if (given.kind != wanted.kind) return {error::mismatch, "texture kind", double(given.kind), double(wanted.kind)};
    if (given.extent.x != cube.size)
        return {error::mismatch, "texture extent.x", double(given.extent.x), double(cube.size)};
    if (given.mips != 1) return {error::mismatch, "texture mips", double(given.mips), 1.0};
    for (int face = 0; face < 6; ++face) {
        std::byte* texel = out.slice(face, 0);
        for (int row = 0; row < cube.size; ++row)
            for (int column = 0; column < cube.size; ++column, texel += 4) {
                const glm::dvec3 direction = from_cube({face, {(column + 0.5) / cube.size, (row + 0.5) / cube.size}});
                std::array<double, 8> factors{};
                if (direction.x != 0.0 || direction.y != 0.0) factors = eight_factors(direction);
                for (std::size_t c = 0; c < 4; ++c)
                    texel[c] = std::byte(to_factor8(cube.form, factors[c] - factors[c + 4]));
            }
    }
    return {};
}

}  // namespace bumpshadow
