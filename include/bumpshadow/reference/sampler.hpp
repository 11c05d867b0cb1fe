#pragma once

#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <bumpshadow/config.hpp>
#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/quantize.hpp>
#include <bumpshadow/texture.hpp>

#include <glm/common.hpp>

// Reads textures the way a GPU does (OpenGL 4.6, section 8.14; Direct3D 11.3, section 7.18). Textures have to pass
// check(); coordinates have to be finite; layers have to exist. Levels outside the chain are clamped into it.
// Channels that a format lacks read as 0, 0, 1 for green, blue, alpha.

namespace bumpshadow {

// What a coordinate outside [0, 1] reads, along one axis.
enum class address_mode : unsigned char { repeat, clamp, mirror };
// The nearest texel or level, or an interpolation of neighbors.
enum class filter_mode : unsigned char { point, linear };
// How exact the weights of linear filters are.
enum class filter_weights : unsigned char {
    exact,      // float
    eight_bit,  // the position in texels (and the level) is rounded to the nearest 1/256, halves up, before it is split
                // into texel and weight: what GPUs do, and the least that Direct3D asks for. Linear filters only.
};

// How a texture is sampled.
struct sampler {
    address_mode x = address_mode::repeat;           // along u
    address_mode y = address_mode::repeat;           // along v
    address_mode z = address_mode::repeat;           // along the slices of a volume
    filter_mode texels = filter_mode::linear;        // within a level
    filter_mode levels = filter_mode::point;         // linear: trilinear; point: the nearest level, halves up
    filter_weights weights = filter_weights::exact;  // of texels and levels
};

namespace sampler_detail {

[[nodiscard]] inline std::uint32_t little_endian(const std::byte* from, int bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < bytes; ++i) value |= std::to_integer<std::uint32_t>(from[i]) << (8 * i);
    return value;
}

// Where a coordinate falls on an axis: two texels and the weight of the second.
struct tap {
    int first = 0, second = 0;
    float weight = 0.0f;
};

[[nodiscard]] inline float rounded(float position, filter_weights weights) {
    return weights == filter_weights::eight_bit ? std::floor(position * 256.0f + 0.5f) / 256.0f : position;
}

// The coordinate moved into the first period, where few of its bits are spent on whole turns.
[[nodiscard]] inline float reduced(float coordinate, address_mode mode) {
    switch (mode) {
        case address_mode::repeat: return coordinate - std::floor(coordinate);
        case address_mode::mirror: return coordinate - 2.0f * std::floor(0.5f * coordinate);
        case address_mode::clamp: break;
    }
    return glm::clamp(coordinate, 0.0f, 1.0f);
}

[[nodiscard]] inline int addressed(int i, int n, address_mode mode) {
    constexpr edge_mode edges[] = {edge_mode::repeat, edge_mode::clamp, edge_mode::mirror};
    return static_cast<int>(resolve_edge(i, n, edges[static_cast<int>(mode)]));
}

[[nodiscard]] inline tap point_tap(float coordinate, int n, address_mode mode) {
    const int i = addressed(static_cast<int>(std::floor(reduced(coordinate, mode) * float(n))), n, mode);
    return {i, i, 0.0f};
}

[[nodiscard]] inline tap linear_tap(float coordinate, int n, address_mode mode, filter_weights weights) {
    const float position = rounded(reduced(coordinate, mode) * float(n) - 0.5f, weights);
    const float floor = std::floor(position);
    const int i = static_cast<int>(floor);
    return {addressed(i, n, mode), addressed(i + 1, n, mode), position - floor};
}

[[nodiscard]] inline tap tap_of(float coordinate, int n, address_mode mode, const sampler& how) {
    return how.texels == filter_mode::point ? point_tap(coordinate, n, mode)
                                            : linear_tap(coordinate, n, mode, how.weights);
}

// read(level) at one level, or at two and blended.
template <class Read>
[[nodiscard]] glm::vec4 across_levels(int mips, float level, const sampler& how, const Read& read) {
    const float last = static_cast<float>(mips - 1);
    if (how.levels == filter_mode::point)
        return read(static_cast<int>(std::floor(glm::clamp(level, 0.0f, last) + 0.5f)));
    const float position = rounded(glm::clamp(level, 0.0f, last), how.weights);
    const float floor = std::floor(position);
    const int finer = static_cast<int>(floor);
    if (position == floor) return read(finer);
    return glm::mix(read(finer), read(finer + 1), position - floor);
}

// A direction on the cube: face, and the two coordinates in it from -major to major, for float or int vectors.
template <class Vector, class Scalar>
struct cube_place {
    int face;
    Scalar s, t, major;
};

// OpenGL 4.6, table 8.19. Where components are equally long z goes before y before x.
template <class Vector, class Scalar = typename Vector::value_type>
[[nodiscard]] cube_place<Vector, Scalar> place_on_cube(Vector r) {
    const Scalar x = r.x < 0 ? -r.x : r.x, y = r.y < 0 ? -r.y : r.y, z = r.z < 0 ? -r.z : r.z;
    if (z >= x && z >= y)
        return r.z < 0 ? cube_place<Vector, Scalar>{5, -r.x, -r.y, z} : cube_place<Vector, Scalar>{4, r.x, -r.y, z};
    if (y >= x)
        return r.y < 0 ? cube_place<Vector, Scalar>{3, r.x, -r.z, y} : cube_place<Vector, Scalar>{2, r.x, r.z, y};
    return r.x < 0 ? cube_place<Vector, Scalar>{1, r.z, -r.y, x} : cube_place<Vector, Scalar>{0, -r.z, -r.y, x};
}

}  // namespace sampler_detail

// One texel. texel.z: slice of a volume, else 0. Layer: of an array, or face of a cube.
[[nodiscard]] inline glm::vec4 fetch(const const_texture& from, glm::ivec3 texel, int level = 0, int layer = 0) {
    using sampler_detail::little_endian;
    const texture_layout& l = from.layout;
    BUMPSHADOW_ASSERT(from.bytes.size() >= l.required_size());
    BUMPSHADOW_ASSERT(level >= 0 && level < l.mips && layer >= 0 && layer < l.layers);
    BUMPSHADOW_ASSERT(texel.x >= 0 && texel.x < l.level_extent(level).x && texel.y >= 0 &&
                      texel.y < l.level_extent(level).y && texel.z >= 0 && texel.z < l.level_depth(level));
    const format_traits f = traits_of(l.format);
    const std::byte* const at = from.slice(layer, level, texel.z) +
                                std::size_t(texel.y / f.block) * l.row_bytes(level) +
                                std::size_t(texel.x / f.block) * std::size_t(f.block_bytes);
    const auto unorm8 = [&](int i) { return from_unorm8(std::to_integer<std::uint8_t>(at[i])); };
    const auto unorm16 = [&](int i) { return from_unorm16(static_cast<std::uint16_t>(little_endian(at + 2 * i, 2))); };
    const auto half = [&](int i) { return from_half(static_cast<std::uint16_t>(little_endian(at + 2 * i, 2))); };
    const auto single = [&](int i) { return std::bit_cast<float>(little_endian(at + 4 * i, 4)); };
    const int in_block = texel.y % f.block * f.block + texel.x % f.block;
    switch (l.format) {
        case texel_format::r8: return {unorm8(0), 0.0f, 0.0f, 1.0f};
        case texel_format::rg8: return {unorm8(0), unorm8(1), 0.0f, 1.0f};
        case texel_format::rgba8: return {unorm8(0), unorm8(1), unorm8(2), unorm8(3)};
        case texel_format::r16: return {unorm16(0), 0.0f, 0.0f, 1.0f};
        case texel_format::rgba16: return {unorm16(0), unorm16(1), unorm16(2), unorm16(3)};
        case texel_format::r16f: return {half(0), 0.0f, 0.0f, 1.0f};
        case texel_format::rgba16f: return {half(0), half(1), half(2), half(3)};
        case texel_format::r32f: return {single(0), 0.0f, 0.0f, 1.0f};
        case texel_format::rgba32f: return {single(0), single(1), single(2), single(3)};
        case texel_format::rgb565: return from_rgb565(little_endian(at, 2));
        case texel_format::bc1: return decode_bc1(at, in_block);
        case texel_format::bc4: {
            float values[16];
            decode_bc4(at, values);
            return {values[in_block], 0.0f, 0.0f, 1.0f};
        }
    }
    return {0.0f, 0.0f, 0.0f, 1.0f};
}

namespace sampler_detail {

// As sample(), of texels that read(x, y, mip) gives.
template <class Read>
[[nodiscard]] glm::vec4 sample_flat(const const_texture& from, const sampler& how, glm::vec2 uv, float level,
                                    const Read& read) {
    BUMPSHADOW_ASSERT(from.layout.kind == texture_kind::flat || from.layout.kind == texture_kind::array);
    BUMPSHADOW_ASSERT(is_finite(uv.x) && is_finite(uv.y) && !is_nan(level));
    return across_levels(from.layout.mips, level, how, [&](int mip) {
        const glm::ivec2 extent = from.layout.level_extent(mip);
        const auto x = tap_of(uv.x, extent.x, how.x, how);
        const auto y = tap_of(uv.y, extent.y, how.y, how);
        const auto texel = [&](int i, int j) { return read(i, j, mip); };
        if (how.texels == filter_mode::point) return texel(x.first, y.first);
        return glm::mix(glm::mix(texel(x.first, y.first), texel(x.second, y.first), x.weight),
                        glm::mix(texel(x.first, y.second), texel(x.second, y.second), x.weight), y.weight);
    });
}

}  // namespace sampler_detail

// A flat texture, or a layer of an array: (0, 0) is the corner of the image, texel centers stand at (i + 0.5) / extent.
[[nodiscard]] inline glm::vec4 sample(const const_texture& from, const sampler& how, glm::vec2 uv, float level = 0.0f,
                                      int layer = 0) {
    return sampler_detail::sample_flat(from, how, uv, level, [&](int x, int y, int mip) {
        return fetch(from, {x, y, 0}, mip, layer);
    });
}

// A volume: linear in three axes.
[[nodiscard]] inline glm::vec4 sample_volume(const const_texture& from, const sampler& how, glm::vec3 uvw,
                                             float level = 0.0f) {
    BUMPSHADOW_ASSERT(from.layout.kind == texture_kind::volume);
    BUMPSHADOW_ASSERT(is_finite(uvw.x) && is_finite(uvw.y) && is_finite(uvw.z) && !is_nan(level));
    return sampler_detail::across_levels(from.layout.mips, level, how, [&](int mip) {
        const glm::ivec2 extent = from.layout.level_extent(mip);
        const auto x = sampler_detail::tap_of(uvw.x, extent.x, how.x, how);
        const auto y = sampler_detail::tap_of(uvw.y, extent.y, how.y, how);
        const auto z = sampler_detail::tap_of(uvw.z, from.layout.level_depth(mip), how.z, how);
        const auto texel = [&](int i, int j, int k) { return fetch(from, {i, j, k}, mip); };
        if (how.texels == filter_mode::point) return texel(x.first, y.first, z.first);
        const auto slice = [&](int k) {
            return glm::mix(glm::mix(texel(x.first, y.first, k), texel(x.second, y.first, k), x.weight),
                            glm::mix(texel(x.first, y.second, k), texel(x.second, y.second, k), x.weight), y.weight);
        };
        return glm::mix(slice(z.first), slice(z.second), z.weight);
    });
}

// A cube, seamless: texels beyond an edge of a face are those of the face that it meets there. At a corner of the cube,
// where only three texels meet, the missing fourth is their average (OpenGL 4.6, section 8.14.2). `direction` has any
// length; the zero vector reads the middle of +z. The address modes do not matter.
[[nodiscard]] inline glm::vec4 sample_cube(const const_texture& from, const sampler& how, glm::vec3 direction,
                                           float level = 0.0f) {
    BUMPSHADOW_ASSERT(from.layout.kind == texture_kind::cube);
    BUMPSHADOW_ASSERT(is_finite(direction.x) && is_finite(direction.y) && is_finite(direction.z));
    BUMPSHADOW_ASSERT(!is_nan(level));
    const auto place = sampler_detail::place_on_cube(direction);
    const float major = place.major > 0.0f ? place.major : 1.0f;
    const glm::vec2 st(0.5f * (place.s / major + 1.0f), 0.5f * (place.t / major + 1.0f));
    return sampler_detail::across_levels(from.layout.mips, level, how, [&](int mip) {
        const int n = from.layout.level_extent(mip).x;
        if (how.texels == filter_mode::point) {
            const auto x = sampler_detail::point_tap(st.x, n, address_mode::clamp);
            const auto y = sampler_detail::point_tap(st.y, n, address_mode::clamp);
            return fetch(from, {x.first, y.first, 0}, mip, place.face);
        }
        // In half texels from the middle of a face, with faces n from the middle of the cube, all texel centers are
        // integers; a texel beyond an edge is one half texel behind this face and on the face it sticks out of.
        const auto texel = [&](int i, int j) {
            if (i >= 0 && i < n && j >= 0 && j < n) return fetch(from, {i, j, 0}, mip, place.face);
            const int s = glm::clamp(2 * i + 1 - n, -n, n), t = glm::clamp(2 * j + 1 - n, -n, n), back = n - 1;
            const glm::ivec3 faces[6] = {{back, -t, -s}, {-back, -t, s}, {s, back, t},
                                         {s, -back, -t}, {s, -t, back},  {-s, -t, -back}};
            const auto there = sampler_detail::place_on_cube(faces[place.face]);
            return fetch(from, {(there.s + n - 1) / 2, (there.t + n - 1) / 2, 0}, mip, there.face);
        };
        const glm::vec2 position(sampler_detail::rounded(st.x * float(n) - 0.5f, how.weights),
                                 sampler_detail::rounded(st.y * float(n) - 0.5f, how.weights));
        const glm::vec2 floor = glm::floor(position), weight = position - floor;
        const int x = static_cast<int>(floor.x), y = static_cast<int>(floor.y);
        glm::vec4 four[4], sum(0.0f);
        int missing = -1;
        for (int corner = 0; corner < 4; ++corner) {
            const int i = x + corner % 2, j = y + corner / 2;
            if ((i < 0 || i >= n) && (j < 0 || j >= n))
                missing = corner;
            else
                sum += four[corner] = texel(i, j);
        }
        if (missing >= 0) four[missing] = sum / 3.0f;
        return glm::mix(glm::mix(four[0], four[1], weight.x), glm::mix(four[2], four[3], weight.x), weight.y);
    });
}

}  // namespace bumpshadow
