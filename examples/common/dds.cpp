#include "common/dds.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>

namespace examples {

namespace {

using bumpshadow::texel_format;
using bumpshadow::texture_kind;

constexpr std::uint32_t four_characters(const char (&text)[5]) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) value |= std::uint32_t(static_cast<unsigned char>(text[i])) << (8 * i);
    return value;
}

// Microsoft, "DDS_PIXELFORMAT structure".
struct pixel_format {
    std::uint32_t flags;
    std::uint32_t four_cc = 0;
    std::uint32_t bits = 0;
    std::uint32_t masks[4] = {};
};

constexpr std::uint32_t is_four_cc = 0x4, is_rgb = 0x40, has_alpha = 0x1, is_luminance = 0x20000;

constexpr pixel_format legacy_format(texel_format format) {
    switch (format) {
        case texel_format::r8: return {is_luminance, 0, 8, {0xff, 0, 0, 0}};
        case texel_format::r16: return {is_luminance, 0, 16, {0xffff, 0, 0, 0}};
        case texel_format::rg8: return {is_luminance | has_alpha, 0, 16, {0xff, 0, 0, 0xff00}};  // A8L8
        case texel_format::rgba8: return {is_rgb | has_alpha, 0, 32, {0xff, 0xff00, 0xff0000, 0xff000000u}};
        case texel_format::rgb565: return {is_rgb, 0, 16, {0xf800, 0x7e0, 0x1f, 0}};
        case texel_format::bc1: return {is_four_cc, four_characters("DXT1")};
        case texel_format::bc4: return {is_four_cc, four_characters("BC4U")};
        // Numbers of D3DFORMAT.
        case texel_format::rgba16: return {is_four_cc, 36};
        case texel_format::r16f: return {is_four_cc, 111};
        case texel_format::rgba16f: return {is_four_cc, 113};
        case texel_format::r32f: return {is_four_cc, 114};
        case texel_format::rgba32f: return {is_four_cc, 116};
    }
    return {};
}

// DXGI_FORMAT.
constexpr std::uint32_t dxgi_format(texel_format format) {
    switch (format) {
        case texel_format::r8: return 61;
        case texel_format::rg8: return 49;
        case texel_format::rgba8: return 28;
        case texel_format::r16: return 56;
        case texel_format::rgba16: return 11;
        case texel_format::r16f: return 54;
        case texel_format::rgba16f: return 10;
        case texel_format::r32f: return 41;
        case texel_format::rgba32f: return 2;
        case texel_format::rgb565: return 85;
        case texel_format::bc1: return 71;
        case texel_format::bc4: return 80;
    }
    return 0;
}

}  // namespace

void write_dds(output_file& file, const bumpshadow::const_texture& picture) {
    if (const bumpshadow::status status = check(picture); !status)
        throw failure("cannot write " + file.target().string() + ": " + status.message().c_str());
    const bumpshadow::texture_layout& layout = picture.layout;
    const bool array = layout.kind == texture_kind::array, volume = layout.kind == texture_kind::volume,
               cube = layout.kind == texture_kind::cube, mips = layout.mips > 1;
    const bool blocks = bumpshadow::traits_of(layout.format).block > 1;
    const pixel_format format =
        array ? pixel_format{is_four_cc, four_characters("DX10")} : legacy_format(layout.format);

    std::array<std::uint32_t, 1 + 31 + 5> words{};
    std::size_t next = 0;
    const auto put = [&](std::uint32_t word) { words[next++] = word; };
    put(four_characters("DDS "));
    put(124);
    // Capabilities, height, width and pixel format are always there.
    put(0x1007u | (blocks ? 0x80000u : 0x8u) | (mips ? 0x20000u : 0u) | (volume ? 0x800000u : 0u));
    put(std::uint32_t(layout.extent.y));
    put(std::uint32_t(layout.extent.x));
    put(std::uint32_t(blocks ? layout.slice_bytes(0) : layout.row_bytes(0)));
    put(volume ? std::uint32_t(layout.depth) : 0u);
    put(mips ? std::uint32_t(layout.mips) : 0u);
    next += 11;
    put(32);
    put(format.flags);
    put(format.four_cc);
    put(format.bits);
    for (const std::uint32_t mask : format.masks) put(mask);
    put(0x1000u | (mips ? 0x400008u : 0u) | (cube || volume || array ? 0x8u : 0u));
    put(cube ? 0xfe00u : volume ? 0x200000u : 0u);
    next += 3;
    if (array) {
        put(dxgi_format(layout.format));
        put(3);  // a 2D texture
        put(0);
        put(std::uint32_t(layout.layers));
        put(0);
    }
    static_assert(std::endian::native == std::endian::little, "DDS files and texture bytes are little-endian");
    file.write(std::as_bytes(std::span(words).first(next)));
    file.write(picture.bytes.first(layout.required_size()));
}

}  // namespace examples
