#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <limits>
#include <numbers>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

// Towards a light, elevation and azimuth in degrees.
glm::vec3 toward(double azimuth, double elevation) {
    const double a = azimuth * std::numbers::pi / 180.0, e = elevation * std::numbers::pi / 180.0;
    return glm::vec3(std::cos(a) * std::cos(e), std::sin(a) * std::cos(e), std::sin(e));
}

struct canvas {
    glm::ivec2 extent;
    std::vector<float> values;

    explicit canvas(glm::ivec2 e) : extent(e), values(3 * std::size_t(e.x) * std::size_t(e.y), -7.0f) {}
    operator rgb_image() { return {values, extent}; }
    [[nodiscard]] glm::vec3 at(int x, int y) const {
        const std::size_t i = 3 * (std::size_t(y) * std::size_t(extent.x) + std::size_t(x));
        return {values[i], values[i + 1], values[i + 2]};
    }
};

void check_equal(glm::vec3 found, glm::vec3 expected, double tolerance = 1e-6) {
    for (int c = 0; c < 3; ++c) CHECK(std::abs(double(found[c]) - double(expected[c])) <= tolerance);
}

// One pixel of a flat surface.
template <class Shadow = no_shadow>
glm::vec3 one(const shade_options& options, const Shadow& shadow = {}) {
    canvas c({1, 1});
    CHECK(bool(shade(options, shadow, flat_surface{{1, 1}}, c)));
    return c.at(0, 0);
}

struct constant {
    float factor = 1.0f;
    float operator()(glm::vec2, glm::vec3) const { return factor; }
};

struct brightness {
    static constexpr bool shades = true;
    float operator()(glm::vec2, glm::vec3) const { return 0.75f; }
};

// Normals of 8 x 4 texels that tilt every way, and colors.
struct maps {
    glm::ivec2 extent{8, 4};
    std::vector<float> normal = std::vector<float>(96);
    std::vector<std::byte> color = std::vector<std::byte>(128);

    maps() {
        for (int i = 0; i < 32; ++i) {
            const double a = i * 0.7, tilt = 0.02 * i;
            const std::size_t k = std::size_t(i);
            normal[k] = float(std::cos(a) * std::sin(tilt));
            normal[32 + k] = float(std::sin(a) * std::sin(tilt));
            normal[64 + k] = float(std::cos(tilt));
            for (int c = 0; c < 4; ++c) color[4 * k + std::size_t(c)] = std::byte((i * 37 + c * 91) & 255);
        }
    }
};

}  // namespace

TEST_CASE("Lambert's cosine, a light of any length, and ambient light") {
    for (const double elevation : {90.0, 60.0, 30.0, 5.0})
        for (const float length : {1.0f, 1e-30f, 1e30f}) {
            shade_options o;
            o.light.direction = length * toward(70, elevation);
            o.light.color = {1, 2, 0.5f};
            o.ambient = {0.1f, 0.2f, 0.3f};
            o.albedo = {0.5f, 1, 1};
            const float sine = float(std::sin(elevation * std::numbers::pi / 180.0));
            check_equal(one(o), {0.5f * (0.1f + sine), 0.2f + 2 * sine, 0.3f + 0.5f * sine});
        }
    shade_options o;
    o.light.direction = toward(10, -20);
    check_equal(one(o), glm::vec3(0));
    o.light.direction = glm::vec3(0);
    o.ambient = glm::vec3(0.25f);
    check_equal(one(o), glm::vec3(0.25f));
}

TEST_CASE("normals, y up and y down, and in the partial-derivative form") {
    // A slope that rises along +y by 1: the normal is (0, -1, 1) / sqrt(2), and faces light from -y.
    const float s = std::sqrt(0.5f);
    std::vector<float> normal = {0, -s, s};
    shade_options o;
    o.normals = {normal, {1, 1}};
    o.light.direction = toward(-90, 45);
    check_equal(one(o), glm::vec3(1));
    o.light.direction = toward(90, 45);
    check_equal(one(o), glm::vec3(0));
    // The same normal in bytes. Right-handed (y-up): green is above 128 where the normal points against the rows.
    const std::array<std::byte, 3> down = {std::byte{128}, std::byte{37}, std::byte{218}};
    const std::array<std::byte, 3> up = {std::byte{128}, std::byte{218}, std::byte{218}};
    // dz/dy = 1 of at most 2: 0.75.
    const std::array<std::byte, 3> derivatives = {std::byte{128}, std::byte{191}, std::byte{0}};
    o.light.direction = toward(-90, 45);
    const auto shaded = [&](std::span<const std::byte> bytes, const normal_encoding& encoding) {
        CHECK(bool(decode_normals(const_pixels{bytes, {1, 1}, 3}, encoding, o.normals)));
        return one(o);
    };
    check_equal(shaded(down, {.y = normal_y::down}), glm::vec3(1), 0.01);
    check_equal(shaded(up, {.y = normal_y::up}), glm::vec3(1), 0.01);
    check_equal(shaded(up, {.y = normal_y::down}), glm::vec3(0), 0.01);
    check_equal(shaded(derivatives, {.form = normal_form::derivatives, .max_slope = 2}), glm::vec3(1), 0.01);
    // A hole has no normal, and no light but the ambient.
    normal = {0, 0, 0};
    o.ambient = glm::vec3(0.5f);
    check_equal(one(o), glm::vec3(0.5f));
}

TEST_CASE("the diffuse map is sRGB or linear") {
    const std::array<std::byte, 4> bytes = {std::byte{188}, std::byte{255}, std::byte{0}, std::byte{17}};
    shade_options o;
    o.diffuse = {bytes, {1, 1}, 4};
    check_equal(one(o), {0.502886f, 1, 0}, 1e-5);  // ((188/255 + 0.055) / 1.055)^2.4
    o.diffuse_is_srgb = false;
    check_equal(one(o), {188 / 255.0f, 1, 0});
    o.diffuse = {bytes, {1, 1}, 3};
    o.albedo = {0.5f, 0.25f, 1};
    check_equal(one(o), {94 / 255.0f, 0.25f, 0});
}

TEST_CASE("Blinn-Phong") {
    shade_options o;
    o.albedo = glm::vec3(0);
    o.specular = {1, 0.5f, 0};
    o.light.direction = 5.0f * toward(0, 45);
    o.viewer_direction = 3.0f * toward(180, 45);  // the mirror direction: h is the normal
    check_equal(one(o), {1, 0.5f, 0});
    o.viewer_direction = {0, 0, 1};  // h is 22.5 degrees from it
    o.shininess = 16;
    const float glossy = float(std::pow(std::cos(std::numbers::pi / 8), 16.0));
    check_equal(one(o), {glossy, 0.5f * glossy, 0});
    o.viewer_position = glm::vec3(0, 0, 9);  // above the pixel at (0, 0, 0)
    check_equal(one(o), {glossy, 0.5f * glossy, 0});
    o.light.direction = toward(0, -1);
    check_equal(one(o), glm::vec3(0));
}

TEST_CASE("Blinn-Phong: no exponent makes a highlight brighter than its factor") {
    // Mirrored straight into the eye, where the cosine is 1 but for rounding.
    for (int i = 0; i < 64; ++i) {
        const glm::vec3 normal = toward(i * 11.0, 40.0 + 0.7 * i);
        std::array<float, 3> n{normal.x, normal.y, normal.z};
        shade_options o;
        o.normals = {n, {1, 1}};
        o.light.direction = o.viewer_direction = normal;
        o.albedo = glm::vec3(0.0f);
        o.specular = glm::vec3(1.0f);
        for (const float shininess : {32.0f, 1e6f, 1e9f, 3e38f}) {
            o.shininess = shininess;
            CHECK(one(o).x <= 1.0f);
        }
    }
}

TEST_CASE("shadows take diffuse and specular light, not the ambient, and multiply the shadow that is there") {
    shade_options o;
    o.ambient = glm::vec3(0.1f);
    o.specular = glm::vec3(0.5f);  // light and viewer straight up: h is the normal
    check_equal(one(o), glm::vec3(1.6f));
    check_equal(one(o, constant{0.0f}), glm::vec3(0.1f));
    check_equal(one(o, constant{0.5f}), glm::vec3(0.85f));
    const std::array<float, 1> existing = {0.25f};
    o.existing_shadow = existing;
    check_equal(one(o, constant{0.5f}), glm::vec3(0.1f + 0.125f * 1.5f));
    // Brightness in place of the cosine.
    o.existing_shadow = {};
    o.specular = glm::vec3(0);
    o.light.direction = toward(0, 30);
    check_equal(one(o, brightness{}), glm::vec3(0.85f));
}

TEST_CASE("shadows fade with distance") {
    shade_options o;
    o.viewer_position = glm::vec3(0, 0, 10);
    const auto faded = [&](float start, float end) {
        o.fade_start = start;
        o.fade_end = end;
        return one(o, constant{0.2f}).x;
    };
    CHECK(faded(10, 20) == doctest::Approx(0.2));
    CHECK(faded(5, 15) == doctest::Approx(0.6));
    CHECK(faded(5, 25) == doctest::Approx(0.4));
    CHECK(faded(1, 9) == 1.0f);
    CHECK(faded(9, 9) == 1.0f);
    CHECK(faded(infinite, infinite) == doctest::Approx(0.2));
}

TEST_CASE("point and spot lights") {
    canvas c({3, 1});
    shade_options o;
    o.light.kind = light_kind::point;
    o.light.position = {0, 0, 2};
    const flat_surface surface{{3, 1}, {2.0f, 1.0f}};  // pixels at x = 0, 2, 4
    CHECK(bool(shade(o, no_shadow{}, surface, c)));
    // Falloff 1/d^2 times the cosine h/d.
    check_equal(c.at(0, 0), glm::vec3(0.25f));
    check_equal(c.at(1, 0), glm::vec3(float(2 / std::pow(8.0, 1.5))));
    check_equal(c.at(2, 0), glm::vec3(float(2 / std::pow(20.0, 1.5))));
    o.light.kind = light_kind::spot;
    o.light.axis = {0, 0, -3};
    o.light.inner_cosine = 0.9f;
    o.light.outer_cosine = 0.5f;
    CHECK(bool(shade(o, no_shadow{}, surface, c)));
    check_equal(c.at(0, 0), glm::vec3(0.25f));
    const double ramp = (std::sqrt(0.5) - 0.5) / 0.4;  // 45 degrees from the axis
    check_equal(c.at(1, 0), glm::vec3(float(ramp * ramp * 2 / std::pow(8.0, 1.5))));
    check_equal(c.at(2, 0), glm::vec3(0));  // cosine 0.447
    // In the surface itself: nothing is divided by 0.
    o.light.kind = light_kind::point;
    o.light.position = {2, 0, 0};
    CHECK(bool(shade(o, no_shadow{}, surface, c)));
    for (const float v : c.values) CHECK(std::isfinite(v));
}

TEST_CASE("the light that a shadow is asked about is in tangent space, uv at texel centers") {
    struct asked {
        std::vector<glm::vec2>* uv;
        std::vector<glm::vec3>* light;
        float operator()(glm::vec2 u, glm::vec3 l) const {
            uv->push_back(u);
            light->push_back(l);
            return 1.0f;
        }
    };
    std::vector<glm::vec2> uv;
    std::vector<glm::vec3> light;
    canvas c({2, 2});
    shade_options o;
    o.light.direction = {0, 0, -9};
    CHECK(bool(shade(o, asked{&uv, &light}, flat_surface{{2, 2}}, c)));
    REQUIRE(uv.size() == 4);
    CHECK(uv[0] == glm::vec2(0.25f, 0.25f));
    CHECK(uv[3] == glm::vec2(0.75f, 0.75f));
    CHECK(light[2] == glm::vec3(0, 0, -1));
    // A wall that faces world -x: light from there is straight up for it.
    uv.clear(), light.clear();
    o.light.direction = {-2, 0, 0};
    const auto wall = [](glm::ivec2) {
        return surface_point{{0.5f, 0.5f}, {0, 0, 0}, {0, 1, 0}, {0, 0, -1}, {-1, 0, 0}};
    };
    CHECK(bool(shade(o, asked{&uv, &light}, wall, c)));
    CHECK(light[0] == glm::vec3(0, 0, 1));
    check_equal(c.at(1, 1), glm::vec3(1));
}

TEST_CASE("a curved surface: a cylinder under far light") {
    canvas c({64, 1});
    shade_options o;
    o.light.direction = toward(0, 60);
    const auto cylinder = [](glm::ivec2 p) {
        const float a = float(p.x) / 63.0f * 3.0f - 1.5f;
        return surface_point{{0, 0},
                             {std::sin(a), 0, std::cos(a)},
                             {std::cos(a), 0, -std::sin(a)},
                             {0, 1, 0},
                             {std::sin(a), 0, std::cos(a)}};
    };
    CHECK(bool(shade(o, no_shadow{}, cylinder, c)));
    for (int x = 0; x < 64; ++x) {
        const double a = double(x) / 63 * 3 - 1.5;
        const double cosine =
            std::sin(a) * std::cos(std::numbers::pi / 3) + std::cos(a) * std::sin(std::numbers::pi / 3);
        check_equal(c.at(x, 0), glm::vec3(float(std::fmax(cosine, 0.0))));
    }
}

TEST_CASE("a flat surface and the same one as a callable give the same picture") {
    const maps m;
    std::vector<float> normal = m.normal;
    shade_options o;
    o.normals = {normal, m.extent};
    o.diffuse = {m.color, m.extent, 4};
    o.specular = glm::vec3(0.3f);
    o.ambient = glm::vec3(0.05f);
    const flat_surface flat{m.extent, {1.0f, 1.0f}};
    const auto callable = [&](glm::ivec2 p) { return flat(p); };
    const auto ripple = [](glm::vec2 uv, glm::vec3 l) { return 0.5f + 0.4f * std::sin(9 * uv.x + 4 * uv.y + l.x); };
    for (const auto kind : {light_kind::directional, light_kind::point, light_kind::spot}) {
        o.light.kind = kind;
        o.light.direction = toward(33, 40);
        o.light.position = {3, 1, 5};
        o.light.outer_cosine = -0.5f;
        canvas a(m.extent), b(m.extent);
        CHECK(bool(shade(o, ripple, flat, a)));
        CHECK(bool(shade(o, ripple, callable, b)));
        for (std::size_t i = 0; i < a.values.size(); ++i) CHECK(std::abs(a.values[i] - b.values[i]) < 2e-6f);
    }
}

TEST_CASE("long rows, strides, several lights and executors") {
    const glm::ivec2 extent(700, 37);
    std::vector<float> normal(3 * std::size_t(extent.x) * std::size_t(extent.y));
    for (std::size_t i = 0; i < normal.size(); ++i) normal[i] = 0.57f + 0.01f * float(i % 7);
    shade_options o;
    o.normals = {normal, extent};
    o.light.direction = toward(33, 40);
    const auto ripple = [](glm::vec2 uv, glm::vec3) { return 0.5f + 0.4f * std::sin(90 * uv.x + 40 * uv.y); };
    canvas a(extent), b(extent);
    CHECK(bool(shade(o, ripple, flat_surface{extent}, a)));
    CHECK(bool(shade(o, ripple, flat_surface{extent}, b, threads(3))));
    CHECK(a.values == b.values);
    o.add = true;
    CHECK(bool(shade(o, ripple, flat_surface{extent}, b)));
    for (std::size_t i = 0; i < a.values.size(); ++i) REQUIRE(b.values[i] == 2 * a.values[i]);
    // What lies between rows stays as it is.
    o.add = false;
    const std::size_t stride = 3 * std::size_t(extent.x) + 5;
    std::vector<float> wide(stride * std::size_t(extent.y), -1.0f);
    CHECK(bool(shade(o, ripple, flat_surface{extent}, rgb_image{wide, extent, stride})));
    for (int y = 0; y < extent.y; ++y) {
        for (std::size_t x = 0; x < 3 * std::size_t(extent.x); ++x)
            REQUIRE(wide[std::size_t(y) * stride + x] == a.values[std::size_t(y) * 3 * std::size_t(extent.x) + x]);
        for (std::size_t x = 3 * std::size_t(extent.x); x < stride; ++x)
            REQUIRE(wide[std::size_t(y) * stride + x] == -1.0f);
    }
}

TEST_CASE("linear light to bytes") {
    std::vector<float> light = {0.0f, 1.0f, 0.5f, 2.0f, -1.0f, 0.002f, not_a_number, infinite, 0.2126f};
    std::vector<std::byte> bytes(12, std::byte{9});
    CHECK(bool(to_srgb8({light, {3, 1}}, pixels{bytes, {3, 1}, 4})));
    // 0.5 is 187.5 in sRGB, 0.002 in the linear part is 6.59; 0.2126 is 127.2.
    const int expected[12] = {0, 255, 188, 255, 255, 0, 7, 255, 0, 255, 127, 255};
    for (std::size_t i = 0; i < 12; ++i)
        if (i != 8) CHECK(std::to_integer<int>(bytes[i]) == expected[i]);
    CHECK(bool(to_srgb8({light, {3, 1}}, pixels{bytes, {3, 1}, 3}, 0.5f)));
    CHECK(std::to_integer<int>(bytes[1]) == 188);
    for (int i = 0; i < 256; ++i) {
        const float v = float(i) / 255.0f;
        CHECK(linear_to_srgb(srgb_to_linear(v)) == doctest::Approx(double(v)).epsilon(1e-5));
    }
}

TEST_CASE("bad input is refused and nothing is written") {
    canvas c({4, 2});
    const auto result = [&](const shade_options& o) { return shade(o, no_shadow{}, flat_surface{{4, 2}}, c); };
    const shade_options good;
    shade_options o = good;
    o.light.direction = {0, not_a_number, 1};
    CHECK(result(o).code() == error::not_finite);
    CHECK(is_nan(result(o).value()));
    o = good;
    o.light.direction = {1, 0, infinite};
    CHECK(result(o).code() == error::not_finite);
    CHECK(result(o).value() == double(infinite));
    o = good;
    o.light.color.y = infinite;
    CHECK(result(o).code() == error::not_finite);
    o = good;
    o.light.kind = light_kind::spot;
    o.light.axis = glm::vec3(0);
    CHECK(result(o).code() == error::not_positive);
    o.light.axis = {0, 0, -1};
    o.light.inner_cosine = 0.5f;
    o.light.outer_cosine = 0.5f;
    CHECK(result(o).code() == error::out_of_range);
    o = good;
    o.light.kind = light_kind::point;
    o.light.position.z = not_a_number;
    CHECK(result(o).code() == error::not_finite);
    o.light.position.z = 1.0f;
    for (const glm::vec2 size : {glm::vec2(not_a_number, 1.0f), glm::vec2(1.0f, infinite)}) {
        const status s = shade(o, no_shadow{}, flat_surface{{4, 2}, size}, c);
        CHECK(s.argument() == std::string_view("surface texel_size"));
    }
    o = good;
    o.ambient.z = not_a_number;
    CHECK(result(o).code() == error::not_finite);
    o = good;
    o.shininess = -1.0f;
    CHECK(result(o).code() == error::out_of_range);
    o = good;
    o.fade_start = 3.0f;
    CHECK(result(o).code() == error::missing);
    o.viewer_position = glm::vec3(0);
    o.fade_end = 2.0f;
    CHECK(result(o).code() == error::out_of_range);
    o = good;
    std::vector<float> few(23);
    o.normals = {few, {4, 2}};
    CHECK(result(o).code() == error::too_small);
    o.normals = {few, {3, 2}};
    CHECK(result(o).code() == error::mismatch);
    o = good;
    const std::vector<std::byte> color(32);
    o.diffuse = {color, {4, 2}, 2};
    CHECK(result(o).code() == error::too_small);
    o.diffuse = {color, {2, 4}, 4};
    CHECK(result(o).code() == error::mismatch);
    o = good;
    o.existing_shadow = few;
    CHECK(result(o).code() == error::mismatch);
    CHECK(shade(good, no_shadow{}, flat_surface{{4, 3}}, c).code() == error::mismatch);
    CHECK(shade(good, no_shadow{}, flat_surface{{4, 2}}, rgb_image{few, {4, 2}}).code() == error::too_small);
    CHECK(shade(good, no_shadow{}, flat_surface{{0, 2}}, rgb_image{few, {0, 2}}).code() == error::not_positive);
    for (const float v : c.values) CHECK(v == -7.0f);
    CHECK(bool(result(good)));
    std::vector<std::byte> bytes(24);
    CHECK(to_srgb8(c, pixels{bytes, {4, 2}, 3}, not_a_number).code() == error::not_finite);
    CHECK(to_srgb8(c, pixels{bytes, {4, 2}, 4}).code() == error::too_small);
    CHECK(to_srgb8(c, pixels{bytes, {2, 4}, 3}).code() == error::mismatch);
}

TEST_CASE("shade: a shadow without its texture is refused") {
    std::vector<float> values(3 * 4 * 4, 7.0f);
    const rgb_image out{.values = values, .extent = {4, 4}};
    const flat_surface flat{{4, 4}};
    encoded_shadow<tangent_volume> shadow;
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("texture kind"));
    const texture_layout layout = layout_of(tangent_volume{}, {4, 4});
    std::vector<std::byte> bytes(layout.required_size());
    shadow.textures = const_texture{std::span<const std::byte>(bytes).first(bytes.size() - 1), layout};
    CHECK(shade({}, shadow, flat, out).code() == error::too_small);
    shadow.textures = const_texture{bytes, layout};
    shadow.edge.k = -1.0f;
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("edge.k"));
    shadow.edge.k = 8.0f;
    shadow.radius = 90.0;
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("radius"));
    CHECK(std::count(values.begin(), values.end(), 7.0f) == 48);
    shadow.radius = 1.0;
    shadow.level = not_a_number;
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("level"));
    shadow.level = infinite;
    shadow.encoding.slices.phase = double(infinite);
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("phase"));
    shadow.encoding.slices.phase = 0.0;
    shadow.encoding.scale.max_slope = -1.0f;
    CHECK(shade({}, shadow, flat, out).argument() == std::string_view("max_slope"));
    CHECK(std::count(values.begin(), values.end(), 7.0f) == 48);
    shadow.encoding.scale.max_slope = 4.0f;
    CHECK(bool(shade({}, shadow, flat, out)));
    encoded_shadow<sine_layers> sines{.encoding = {.scale = {quantity::sine, not_a_number}}};
    CHECK(shade({}, sines, flat, out).argument() == std::string_view("max_slope"));
    const encoded_shadow<fourier, fourier_textures> series;
    CHECK(shade({}, series, flat, out).code() == error::mismatch);
}
