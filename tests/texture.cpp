#include <bumpshadow/texture.hpp>

#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

TEST_CASE("texture: sizes worked by hand") {
    // Forsyth, section 5: 256 x 256 x 16 and 128 x 128 x 8 of 8 bits are 1024 and 128 kbytes.
    CHECK(texture_layout{texel_format::r8, texture_kind::volume, {256, 256}, 16}.required_size() == 1024u * 1024u);
    CHECK(texture_layout{texel_format::r8, texture_kind::volume, {128, 128}, 8}.required_size() == 128u * 1024u);
    // The same in BC4: half.
    CHECK(texture_layout{texel_format::bc4, texture_kind::volume, {256, 256}, 16}.required_size() == 512u * 1024u);
    // Lengyel's factor cube: six kilobytes.
    CHECK(texture_layout{texel_format::rgba8, texture_kind::cube, {16, 16}, 1, 6}.required_size() == 6u * 1024u);
    // 5 x 3 in blocks: 2 x 1 of them, and again 1 at 2 x 1 texels, 1 at 1 x 1.
    const texture_layout odd{texel_format::bc4, texture_kind::array, {5, 3}, 1, 2, 3};
    CHECK(odd.row_bytes(0) == 16);
    CHECK(odd.layer_bytes() == 16 + 8 + 8);
    CHECK(odd.required_size() == 64);
    CHECK(odd.offset(1, 2) == 32 + 24);
    // A volume of 4 x 2 x 4 and its levels 2 x 1 x 2, 1 x 1 x 1.
    const texture_layout volume{texel_format::r16, texture_kind::volume, {4, 2}, 4, 1, 3};
    CHECK(volume.offset(0, 1) == 64);
    CHECK(volume.offset(0, 1, 1) == 68);
    CHECK(volume.offset(0, 2) == 72);
    CHECK(volume.required_size() == 74);
    CHECK(volume.bytes_per_texel({4, 2}) == doctest::Approx(8.0));
    CHECK(full_mips({1, 1}) == 1);
    CHECK(full_mips({1024, 669}) == 11);
    CHECK(full_mips({5, 3}) == 3);
}

TEST_CASE("texture: bad layouts are refused by name") {
    std::vector<std::byte> bytes(64);
    const auto why = [&](const texture_layout& layout) { return check(texture{bytes, layout}); };
    CHECK(bool(why({texel_format::r8, texture_kind::flat, {8, 8}})));
    CHECK(why({texel_format::r8, texture_kind::flat, {9, 8}}).code() == error::too_small);
    CHECK(why({texel_format::r8, texture_kind::flat, {0, 8}}).argument() == std::string_view("texture extent.x"));
    CHECK(why({texel_format::r8, texture_kind::flat, {8, -1}}).argument() == std::string_view("texture extent.y"));
    CHECK(why({texel_format::r8, texture_kind::flat, {4, 4}, 2}).argument() == std::string_view("texture depth"));
    CHECK(why({texel_format::r8, texture_kind::volume, {4, 4}, 2, 2}).argument() == std::string_view("texture layers"));
    CHECK(why({texel_format::r8, texture_kind::cube, {1, 1}, 1, 5}).code() == error::mismatch);
    CHECK(why({texel_format::r8, texture_kind::cube, {2, 1}, 1, 6}).code() == error::mismatch);
    CHECK(why({texel_format::r8, texture_kind::flat, {4, 4}, 1, 1, 4}).argument() == std::string_view("texture mips"));
    CHECK(why({texel_format::r8, texture_kind::flat, {4, 4}, 1, 1, 0}).code() == error::not_positive);
}
