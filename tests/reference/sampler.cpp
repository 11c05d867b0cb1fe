#include <bumpshadow/reference/sampler.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <vector>

#include <doctest/doctest.h>
#include <glm/ext/vector_double3.hpp>
#include <glm/geometric.hpp>

using namespace bumpshadow;

namespace {

using bytes = std::vector<std::byte>;

bytes of(std::initializer_list<int> values) {
    bytes result;
    for (const int v : values) result.push_back(static_cast<std::byte>(v));
    return result;
}

// A float texture of one channel, value(x, y, slice or layer) at level 0; further levels hold their number.
struct image {
    texture_layout layout;
    bytes storage;

    template <class Value>
    image(texture_layout wanted, Value&& value) : layout(wanted), storage(wanted.required_size()) {
        for (int layer = 0; layer < layout.layers; ++layer)
            for (int level = 0; level < layout.mips; ++level)
                for (int z = 0; z < layout.level_depth(level); ++z)
                    for (int y = 0; y < layout.level_extent(level).y; ++y)
                        for (int x = 0; x < layout.level_extent(level).x; ++x)
                            set(layer, level, {x, y, z}, level == 0 ? float(value(x, y, z + layer)) : float(level));
    }
    void set(int layer, int level, glm::ivec3 p, float value) {
        const auto pattern = std::bit_cast<std::uint32_t>(value);
        const std::size_t at =
            layout.offset(layer, level, p.z) + std::size_t(p.y) * layout.row_bytes(level) + std::size_t(p.x) * 4;
        for (std::size_t i = 0; i < 4; ++i) storage[at + i] = static_cast<std::byte>((pattern >> (8 * i)) & 255u);
    }
    operator const_texture() const { return {storage, layout}; }
};

texture_layout single(glm::ivec2 extent, int mips = 1) {
    return {.format = texel_format::r32f, .extent = extent, .mips = mips};
}

glm::vec4 only_texel(texel_format format, const bytes& block, glm::ivec2 texel = {0, 0}) {
    const int side = traits_of(format).block;
    const const_texture t{block, {.format = format, .extent = {side, side}}};
    CHECK(bool(check(t)));
    return fetch(t, {texel, 0});
}

void check_equal(glm::vec4 found, glm::vec4 expected, float tolerance = 0.0f) {
    for (int c = 0; c < 4; ++c) CHECK(std::abs(found[c] - expected[c]) <= tolerance);
}

}  // namespace

TEST_CASE("every format, from bytes worked by hand") {
    check_equal(only_texel(texel_format::r8, of({51})), {0.2f, 0, 0, 1}, 1e-7f);
    check_equal(only_texel(texel_format::rg8, of({0, 255})), {0, 1, 0, 1});
    check_equal(only_texel(texel_format::rgba8, of({255, 0, 51, 102})), {1, 0, 0.2f, 0.4f}, 1e-7f);
    check_equal(only_texel(texel_format::r16, of({0x34, 0x12})), {4660.0f / 65535.0f, 0, 0, 1});
    check_equal(only_texel(texel_format::rgba16, of({0xff, 0xff, 0, 0, 1, 0, 0, 0x80})),
                {1, 0, 1.0f / 65535.0f, 32768.0f / 65535.0f});
    check_equal(only_texel(texel_format::r16f, of({0x00, 0xbe})), {-1.5f, 0, 0, 1});
    check_equal(only_texel(texel_format::rgba16f, of({0x00, 0x3c, 0x00, 0x38, 0x00, 0xc0, 0x01, 0x00})),
                {1, 0.5f, -2, 1.0f / 16777216.0f});
    check_equal(only_texel(texel_format::r32f, of({0, 0, 0x20, 0xc1})), {-10, 0, 0, 1});
    check_equal(
        only_texel(texel_format::rgba32f, of({0, 0, 0x80, 0x3f, 0, 0, 0, 0x40, 0, 0, 0x40, 0x40, 0, 0, 0x80, 0x40})),
        {1, 2, 3, 4});
    // 0x8410: 10000 100000 10000
    check_equal(only_texel(texel_format::rgb565, of({0x10, 0x84})), {16 / 31.0f, 32 / 63.0f, 16 / 31.0f, 1});
    check_equal(only_texel(texel_format::rgb565, of({0x00, 0xf8})), {1, 0, 0, 1});
}

TEST_CASE("BC1 blocks") {
    // Red and blue, red the larger number: thirds between them. Rows of texels: 0 1 2 3, 3 2 1 0, all 2, all 3.
    const bytes opaque = of({0x00, 0xf8, 0x1f, 0x00, 0xe4, 0x1b, 0xaa, 0xff});
    const glm::vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1), near_red(2 / 3.0f, 0, 1 / 3.0f, 1);
    const glm::vec4 near_blue(1 / 3.0f, 0, 2 / 3.0f, 1);
    const glm::vec4 rows[4][4] = {{red, blue, near_red, near_blue},
                                  {near_blue, near_red, blue, red},
                                  {near_red, near_red, near_red, near_red},
                                  {near_blue, near_blue, near_blue, near_blue}};
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 4; ++x) check_equal(only_texel(texel_format::bc1, opaque, {x, y}), rows[y][x], 1e-7f);
    // The other way round: the middle, and black with alpha 1.
    const bytes three = of({0x1f, 0x00, 0x00, 0xf8, 0xe4, 0, 0, 0});
    check_equal(only_texel(texel_format::bc1, three, {0, 0}), blue);
    check_equal(only_texel(texel_format::bc1, three, {1, 0}), red);
    check_equal(only_texel(texel_format::bc1, three, {2, 0}), {0.5f, 0, 0.5f, 1});
    check_equal(only_texel(texel_format::bc1, three, {3, 0}), {0, 0, 0, 1});
    // Equal colors are not "larger": code 3 is black.
    check_equal(only_texel(texel_format::bc1, of({0, 0xf8, 0, 0xf8, 0xff, 0, 0, 0}), {0, 0}), {0, 0, 0, 1});
}

TEST_CASE("BC4 blocks") {
    // 255 and 10, eight values: code 2 is (6 * 255 + 10) / 7 of 255, code 7 (255 + 6 * 10) / 7.
    const bytes eight = of({255, 10, 0x88, 0xc6, 0xfa, 0, 0, 0});  // codes 0 1 2 3 4 5 6 7, then 0
    const float of255 = 1.0f / 255.0f;
    const float expected[8] = {255, 10, 1540.0f / 7, 1295.0f / 7, 1050.0f / 7, 805.0f / 7, 560.0f / 7, 315.0f / 7};
    for (int i = 0; i < 8; ++i)
        check_equal(only_texel(texel_format::bc4, eight, {i % 4, i / 4}), {expected[i] * of255, 0, 0, 1}, 1e-6f);
    check_equal(only_texel(texel_format::bc4, eight, {3, 3}), {1, 0, 0, 1});
    // 10 and 255, six values and 0 and 1.
    const bytes six = of({10, 255, 0x88, 0xc6, 0xfa, 0, 0, 0});
    const float others[8] = {10, 255, 59, 108, 157, 206, 0, 255};
    for (int i = 0; i < 8; ++i)
        check_equal(only_texel(texel_format::bc4, six, {i % 4, i / 4}), {others[i] * of255, 0, 0, 1}, 1e-6f);
}

TEST_CASE("block compressed textures whose extent is no multiple of four") {
    bytes blocks;
    for (const int value : {10, 20, 30, 40}) {
        const bytes block = of({value, 0, 0, 0, 0, 0, 0, 0});
        blocks.insert(blocks.end(), block.begin(), block.end());
    }
    const const_texture t{blocks, {.format = texel_format::bc4, .extent = {5, 6}}};
    CHECK(bool(check(t)));
    CHECK(fetch(t, {3, 3, 0}).x == doctest::Approx(10 / 255.0));
    CHECK(fetch(t, {4, 3, 0}).x == doctest::Approx(20 / 255.0));
    CHECK(fetch(t, {3, 4, 0}).x == doctest::Approx(30 / 255.0));
    CHECK(fetch(t, {4, 5, 0}).x == doctest::Approx(40 / 255.0));
    // Halfway between the last texel of the first row and the first one.
    CHECK(sample(t, {}, {0.0f, 0.5f / 6}).x == doctest::Approx(15 / 255.0));
}

TEST_CASE("point sampling and address modes") {
    const image t(single({4, 1}), [](int x, int, int) { return x; });
    const auto at = [&](float u, address_mode mode) {
        return sample(t, {.x = mode, .texels = filter_mode::point}, {u, 0.5f}).x;
    };
    const float inside[] = {0.0f, 0.24f, 0.25f, 0.6f, 0.99f};
    const float texels[] = {0, 0, 1, 2, 3};
    for (int i = 0; i < 5; ++i)
        for (const auto mode : {address_mode::repeat, address_mode::clamp, address_mode::mirror})
            CHECK(at(inside[i], mode) == texels[i]);
    CHECK(at(1.0f, address_mode::repeat) == 0);
    CHECK(at(1.0f, address_mode::clamp) == 3);
    CHECK(at(1.0f, address_mode::mirror) == 3);
    CHECK(at(-0.1f, address_mode::repeat) == 3);
    CHECK(at(-0.1f, address_mode::clamp) == 0);
    CHECK(at(-0.1f, address_mode::mirror) == 0);
    CHECK(at(1.3f, address_mode::mirror) == 2);
    CHECK(at(-0.3f, address_mode::mirror) == 1);
    CHECK(at(1e30f, address_mode::clamp) == 3);
    CHECK(at(-1e30f, address_mode::clamp) == 0);
    CHECK(at(1e30f, address_mode::repeat) == 0);
    // A fraction that rounds up to 1.
    CHECK(at(-1e-20f, address_mode::repeat) == 0);
}

TEST_CASE("linear filtering between texels and over the edges") {
    const image t(single({4, 2}), [](int x, int y, int) { return x + 10 * y; });
    const auto at = [&](glm::vec2 uv, address_mode mode) { return sample(t, {.x = mode, .y = mode}, uv).x; };
    for (const auto mode : {address_mode::repeat, address_mode::clamp, address_mode::mirror}) {
        CHECK(at({0.375f, 0.25f}, mode) == 1);       // a texel center
        CHECK(at({0.4375f, 0.25f}, mode) == 1.25f);  // a quarter of the way to the next
        CHECK(at({0.4375f, 0.5f}, mode) == 6.25f);
    }
    // u = 1/16: a quarter texel left of center 0.
    CHECK(at({0.0625f, 0.25f}, address_mode::repeat) == 0.75f);  // 3/4 of 0, 1/4 of 3
    CHECK(at({0.0625f, 0.25f}, address_mode::clamp) == 0);
    CHECK(at({0.0625f, 0.25f}, address_mode::mirror) == 0);
    CHECK(at({1.0625f, 0.25f}, address_mode::repeat) == 0.75f);
    CHECK(at({1.0625f, 0.25f}, address_mode::mirror) == 3);
    CHECK(at({1.1875f, 0.25f}, address_mode::mirror) == 2.75f);  // mirrors 0.8125, a quarter left of center 3
    CHECK(at({0.125f, 0.0f}, address_mode::repeat) == 5);
    CHECK(at({0.125f, 0.0f}, address_mode::clamp) == 0);
    // Each axis has its own mode.
    CHECK(sample(t, {.x = address_mode::clamp, .y = address_mode::repeat}, {0.0f, 0.0f}).x == 5);
}

TEST_CASE("eight-bit weights") {
    const image t(single({2, 1}), [](int x, int, int) { return x; });
    sampler how{.x = address_mode::clamp, .weights = filter_weights::eight_bit};
    // u = 0.25 + w / 2 reads w.
    const auto at = [&](double w) { return sample(t, how, {float(0.25 + w / 2), 0.5f}).x; };
    CHECK(at(0.5) == 0.5f);
    CHECK(at(1.0 / 256) == 1.0f / 256);
    CHECK(at(0.4 / 256) == 0.0f);
    CHECK(at(0.5 / 256) == 1.0f / 256);
    CHECK(at(100.3 / 256) == 100.0f / 256);
    CHECK(at(255.6 / 256) == 1.0f);  // rounds over to the next texel
    double worst = 0.0;
    for (int i = 0; i <= 1000; ++i) worst = std::max(worst, std::abs(double(at(i / 1000.0)) - i / 1000.0));
    CHECK(worst <= 0.5 / 256 + 1e-6);
    CHECK(worst > 0.4 / 256);
}

TEST_CASE("levels: nearest, and trilinear") {
    image t(single({8, 4}, 4), [](int, int, int) { return 0; });
    sampler how{};
    const auto at = [&](float level) { return sample(t, how, {0.3f, 0.7f}, level).x; };
    CHECK(at(-1.0f) == 0);
    CHECK(at(0.49f) == 0);
    CHECK(at(0.5f) == 1);
    CHECK(at(1.6f) == 2);
    CHECK(at(99.0f) == 3);
    how.levels = filter_mode::linear;
    CHECK(at(1.25f) == doctest::Approx(1.25));
    CHECK(at(2.75f) == doctest::Approx(2.75));
    CHECK(at(-1.0f) == 0);
    CHECK(at(3.0f) == 3);
    CHECK(at(7.0f) == 3);
    how.weights = filter_weights::eight_bit;
    CHECK(at(1.25f + 0.3f / 256) == 1.25f);
    // Level 3 of 8 x 4 is 1 x 1; extents halve and stop at 1.
    CHECK(fetch(t, {0, 0, 0}, 3).x == 3);
    t.set(0, 2, {1, 0, 0}, 50.0f);  // level 2: 2 x 1
    how.weights = filter_weights::exact;
    CHECK(sample(t, how, {0.75f, 0.2f}, 2.0f).x == 50);
    CHECK(sample(t, how, {0.5f, 0.2f}, 2.5f).x == doctest::Approx(0.5 * 26 + 0.5 * 3));
}

TEST_CASE("volumes are linear in three axes and repeat on each") {
    const image t({.format = texel_format::r32f, .kind = texture_kind::volume, .extent = {4, 2}, .depth = 3},
                  [](int x, int y, int z) { return x + 10 * y + 100 * z; });
    CHECK(bool(check(const_texture(t))));
    CHECK(sample_volume(t, {}, {0.375f, 0.25f, 0.5f}).x == doctest::Approx(101));
    CHECK(sample_volume(t, {}, {0.5f, 0.5f, 1.0f / 3}).x == doctest::Approx(1.5 + 5 + 50));
    // Between the last slice and the first, at both ends of the coordinate, and whole turns away.
    for (const float w : {0.0f, 1.0f, -1.0f, 5.0f}) CHECK(sample_volume(t, {}, {0.125f, 0.25f, w}).x == 100);
    CHECK(sample_volume(t, {}, {0.125f, 0.25f, 0.5f / 3 - 0.25f / 3}).x == doctest::Approx(50));  // 1/4 of 200
    CHECK(sample_volume(t, {.z = address_mode::clamp}, {0.125f, 0.25f, 0.0f}).x == 0);
    CHECK(sample_volume(t, {.z = address_mode::mirror}, {0.125f, 0.25f, 1.0f}).x == 200);
    CHECK(sample_volume(t, {.texels = filter_mode::point}, {0.3f, 0.9f, 0.9f}).x == 211);
    // Trilinear in depth, too: level 1 has one slice.
    image mips({.format = texel_format::r32f, .kind = texture_kind::volume, .extent = {2, 2}, .depth = 2, .mips = 2},
               [](int, int, int z) { return 10 * z; });
    CHECK(sample_volume(mips, {.levels = filter_mode::linear}, {0.5f, 0.5f, 0.5f}, 0.5f).x == doctest::Approx(3));
}

TEST_CASE("array layers are not blended") {
    const image t({.format = texel_format::r32f, .kind = texture_kind::array, .extent = {2, 1}, .layers = 3, .mips = 2},
                  [](int x, int, int layer) { return x + 10 * layer; });
    CHECK(bool(check(const_texture(t))));
    for (int layer = 0; layer < 3; ++layer)
        CHECK(sample(t, {}, {0.5f, 0.5f}, 0.0f, layer).x == float(10 * layer) + 0.5f);
}

namespace {

// A cube whose texels hold number 1 + x + n y + n n face.
image numbered_cube(int n) {
    return {{.format = texel_format::r32f, .kind = texture_kind::cube, .extent = {n, n}, .layers = 6},
            [=](int x, int y, int face) { return 1 + x + n * y + n * n * face; }};
}

// Direction of a point of a face from its coordinates in [-1, 1], from the table of OpenGL 4.6 turned around.
glm::dvec3 direction_of(int face, double s, double t) {
    switch (face) {
        case 0: return {1, -t, -s};
        case 1: return {-1, -t, s};
        case 2: return {s, 1, t};
        case 3: return {s, -1, -t};
        case 4: return {s, -t, 1};
        default: return {-s, -t, -1};
    }
}

// The four texels around a direction that lies in no corner: the ones whose centers, seen from the middle of the cube
// folded flat around the face's edge, are nearest. Found by search over all texels of all faces.
double brute_force(int n, glm::dvec3 direction) {
    // The face is the one whose outward normal is closest; its tangents are derivatives of direction_of.
    int face = 0;
    double best = -2.0;
    for (int f = 0; f < 6; ++f) {
        const double toward = glm::dot(direction_of(f, 0, 0), direction);
        if (toward > best) best = toward, face = f;
    }
    const glm::dvec3 normal = direction_of(face, 0, 0);
    const glm::dvec3 along_s = direction_of(face, 1, 0) - normal, along_t = direction_of(face, 0, 1) - normal;
    const glm::dvec3 on_face = direction / best;
    const double s = glm::dot(on_face, along_s), t = glm::dot(on_face, along_t);
    double value = 0.0, weights = 0.0;
    for (int f = 0; f < 6; ++f)
        for (int y = 0; y < n; ++y)
            for (int x = 0; x < n; ++x) {
                const glm::dvec3 p = direction_of(f, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1);
                double a = glm::dot(p, along_s), b = glm::dot(p, along_t);
                const double behind = 1.0 - glm::dot(p, normal);
                if (behind > 1.0) continue;
                // Unfold the neighbor around the common edge: how far it lies behind is how far it lies outside.
                if (std::abs(a) == 1.0)
                    a += std::copysign(behind, a);
                else if (std::abs(b) == 1.0)
                    b += std::copysign(behind, b);
                const double wa = 1.0 - std::abs(a - s) * n / 2, wb = 1.0 - std::abs(b - t) * n / 2;
                if (wa <= 0.0 || wb <= 0.0) continue;
                value += wa * wb * (1.0 + x + n * y + n * n * f);
                weights += wa * wb;
            }
    CHECK(weights == doctest::Approx(1.0).epsilon(1e-9));
    return value;
}

}  // namespace

TEST_CASE("cube faces stand where GL and D3D put them") {
    const image t = numbered_cube(4);
    CHECK(bool(check(const_texture(t))));
    const sampler point{.texels = filter_mode::point};
    for (int face = 0; face < 6; ++face)
        for (int y = 0; y < 4; ++y)
            for (int x = 0; x < 4; ++x) {
                const glm::dvec3 d = direction_of(face, (2 * x + 1) / 4.0 - 1, (2 * y + 1) / 4.0 - 1);
                const float expected = float(1 + x + 4 * y + 16 * face);
                for (const double length : {1.0, 1e-30, 1e30}) {
                    CHECK(sample_cube(t, point, glm::vec3(length * d)).x == expected);
                    CHECK(sample_cube(t, {}, glm::vec3(length * d)).x ==
                          doctest::Approx(double(expected)).epsilon(1e-5));
                }
            }
    CHECK(std::isfinite(sample_cube(t, {}, glm::vec3(0.0f)).x));
}

TEST_CASE("a seamless cube equals brute force everywhere but at its corners") {
    for (const int n : {1, 2, 4, 7}) {
        CAPTURE(n);
        const image t = numbered_cube(n);
        for (int face = 0; face < 6; ++face)
            for (int j = 0; j < 23; ++j)
                for (int i = 0; i < 23; ++i) {
                    const double s = (2 * i + 1) / 23.0 - 1, u = (2 * j + 1) / 23.0 - 1;
                    if (std::abs(s) > 1 - 1.0 / n && std::abs(u) > 1 - 1.0 / n) continue;
                    const glm::dvec3 d = direction_of(face, s, u);
                    CHECK(std::abs(double(sample_cube(t, {}, glm::vec3(d)).x) - brute_force(n, d)) < 1e-3);
                }
    }
}

TEST_CASE("a seamless cube is continuous, and its corners are the average of three") {
    const int n = 4;
    const image t = numbered_cube(n);
    for (int corner = 0; corner < 8; ++corner) {
        const glm::vec3 d(corner & 1 ? 1 : -1, corner & 2 ? 1 : -1, corner & 4 ? 1 : -1);
        // The three texels at this corner are those nearest to it.
        float sum = 0.0f;
        int count = 0;
        for (int face = 0; face < 6; ++face)
            for (const int y : {0, n - 1})
                for (const int x : {0, n - 1})
                    if (glm::dot(glm::normalize(direction_of(face, (2 * x + 1.0) / n - 1, (2 * y + 1.0) / n - 1)),
                                 glm::normalize(glm::dvec3(d))) > 0.95) {
                        sum += float(1 + x + n * y + n * n * face);
                        ++count;
                    }
        CHECK(count == 3);
        CHECK(sample_cube(t, {}, d).x == doctest::Approx(double(sum / 3)));
        // From all three faces, a little inside each.
        for (int axis = 0; axis < 3; ++axis) {
            glm::vec3 inside = d;
            inside[axis] *= 1.0001f;
            CHECK(sample_cube(t, {}, inside).x == doctest::Approx(double(sum / 3)).epsilon(1e-3));
        }
    }
    // Across an edge.
    for (int i = 0; i < 40; ++i) {
        const float z = float(i) / 20 - 0.975f;
        const float one = sample_cube(t, {}, {1.0f, 0.99999f, z}).x, other = sample_cube(t, {}, {0.99999f, 1.0f, z}).x;
        CHECK(std::abs(one - other) < 0.01f);
    }
}
