#include <bumpshadow/reference/reflection.hpp>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;
using glm::vec3;

namespace {

// A cube of 2 x 2 texels a face, each face in a gray of its own: 10, 20 ... 60.
struct gray_cube {
    texture_layout layout{.format = texel_format::r8, .kind = texture_kind::cube, .extent = {2, 2}, .layers = 6};
    std::array<std::byte, 24> bytes{};

    gray_cube() {
        for (std::size_t i = 0; i < 24; ++i) bytes[i] = std::byte(10 * (i / 4 + 1));
    }
    [[nodiscard]] const_texture view() const { return {bytes, layout}; }
};

// An SSBump map of one texel whose normal is tilted by `degrees` towards a bearing.
float face_seen(double degrees, double bearing, normal_y y, vec3 eye, const surface_point& point) {
    const double tilt = degrees * std::numbers::pi / 180.0, turn = bearing * 2.0 * std::numbers::pi;
    std::array<float, 3> values{float(std::sin(tilt) * std::cos(turn)), float(std::sin(tilt) * std::sin(turn)),
                                float(std::cos(tilt))};
    const normal_map normals{.values = values, .extent = {1, 1}};
    const ssbump encoding{.y = y, .occlusion = mask_occlusion::none};
    std::array<std::byte, 4> bytes{};
    const texture_layout layout = layout_of(encoding, {1, 1});
    REQUIRE(bool(pack_ssbump(normals, encoding, texture{bytes, layout})));
    const gray_cube cube;
    return reflected(encoding, const_texture{bytes, layout}, {.texels = filter_mode::point}, point, eye, cube.view())
               .x *
           255.0f;
}

}  // namespace

TEST_CASE("reflection: seen from above, a tilt of 30 degrees mirrors what lies 60 degrees down") {
    const surface_point flat;
    const vec3 above(0.0f, 0.0f, 3.0f);
    for (const normal_y y : {normal_y::down, normal_y::up}) {
        CHECK(face_seen(0.0, 0.0, y, above, flat) == doctest::Approx(50.0));    // +z
        CHECK(face_seen(30.0, 0.0, y, above, flat) == doctest::Approx(10.0));   // +x
        CHECK(face_seen(30.0, 0.5, y, above, flat) == doctest::Approx(20.0));   // -x
        CHECK(face_seen(30.0, 0.25, y, above, flat) == doctest::Approx(30.0));  // +y
        CHECK(face_seen(30.0, 0.75, y, above, flat) == doctest::Approx(40.0));  // -y
    }
    // From the side a flat mirror shows the other side.
    CHECK(face_seen(0.0, 0.0, normal_y::down, {2.0f, 0.0f, 1.0f}, flat) == doctest::Approx(20.0));
}

TEST_CASE("reflection: on a wall that looks along x") {
    surface_point wall;
    wall.tangent = {0.0f, 1.0f, 0.0f};
    wall.bitangent = {0.0f, 0.0f, 1.0f};
    wall.normal = {1.0f, 0.0f, 0.0f};
    const vec3 in_front(1.0f, 0.0f, 0.0f);
    CHECK(face_seen(0.0, 0.0, normal_y::down, in_front, wall) == doctest::Approx(10.0));    // +x
    CHECK(face_seen(30.0, 0.0, normal_y::down, in_front, wall) == doctest::Approx(30.0));   // tangent: +y
    CHECK(face_seen(30.0, 0.25, normal_y::down, in_front, wall) == doctest::Approx(50.0));  // bitangent: +z
}
