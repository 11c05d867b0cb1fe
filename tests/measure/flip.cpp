#include <bumpshadow/measure/flip.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory_resource>
#include <numbers>
#include <span>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

#include "support/shapes.hpp"

using namespace bumpshadow;

namespace {

// A picture in 8-bit sRGB, 3 channels.
struct picture {
    glm::ivec2 extent;
    std::vector<std::byte> bytes;

    explicit picture(glm::ivec2 size) : extent(size), bytes(std::size_t(3 * size.x * size.y)) {}
    picture(glm::ivec2 size, std::array<int, 3> color) : picture(size) {
        for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = std::byte(color[i % 3]);
    }
    [[nodiscard]] std::byte& at(int x, int y, int c) { return bytes[std::size_t(3 * (y * extent.x + x) + c)]; }
    [[nodiscard]] int level(int x, int y, int c) const {
        return std::to_integer<int>(bytes[std::size_t(3 * (y * extent.x + x) + c)]);
    }
    [[nodiscard]] const_pixels view() const { return {bytes, extent, 3}; }
};

// Patches of one color and patches of noise: flat places, edges and points.
picture mixed(glm::ivec2 extent, std::uint64_t seed) {
    picture result(extent);
    shapes::noise source(seed);
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x)
            for (int c = 0; c < 3; ++c) {
                const int patch = ((x / 6) * 37 + (y / 5) * 91 + c * 53 + int(seed) * 29) % 256;
                const bool noisy = (x / 7 + y / 9) % 2 == 0;
                result.at(x, y, c) = std::byte(noisy ? source.between(0, 255) : patch);
            }
    return result;
}

std::vector<float> compared(const const_pixels& a, const const_pixels& b, const flip_options& options = {}) {
    std::vector<float> difference(std::size_t(a.extent.x) * std::size_t(a.extent.y), -1.0f);
    const status s = flip(a, b, difference, options);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return difference;
}
std::vector<float> compared(const picture& a, const picture& b, const flip_options& options = {}) {
    return compared(a.view(), b.view(), options);
}

// The paper's equations in double precision, with filters over squares, summed up directly.
class direct {
public:
    using color = std::array<double, 3>;

    explicit direct(double pixels_per_degree) : density_(pixels_per_degree) {
        // Primaries of sRGB and the white of D65.
        const double white_x = 0.312727, white_y = 0.329023;
        const double primaries[3][2] = {{0.64, 0.33}, {0.30, 0.60}, {0.15, 0.06}};
        const color white{white_x / white_y, 1.0, (1.0 - white_x - white_y) / white_y};
        std::array<color, 3> columns{};
        for (std::size_t i = 0; i < 3; ++i) {
            const double x = primaries[i][0], y = primaries[i][1];
            columns[i] = {x / y, 1.0, (1.0 - x - y) / y};
        }
        const color amounts = solve(columns, white);
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t k = 0; k < 3; ++k) columns_[i][k] = columns[i][k] * amounts[i] / white[k];
        largest_ = std::pow(hyab(hunt_lab({0.0, 1.0, 0.0}), hunt_lab({0.0, 0.0, 1.0})), 0.7);

        radius_ = int(std::ceil(3.0 * std::sqrt(0.04 / (2.0 * pi * pi)) * density_));
        sensitivity_[0] = sensitivity({{1.0, 0.0047}});
        sensitivity_[1] = sensitivity({{1.0, 0.0053}});
        sensitivity_[2] = sensitivity({{34.1, 0.04}, {13.5, 0.025}});
        const double deviation = 0.5 * 0.082 * density_;
        feature_radius_ = int(std::ceil(3.0 * deviation));
        const auto bell = [=](double x, double y) {
            return std::exp(-(x * x + y * y) / (2.0 * deviation * deviation));
        };
        edge_ = signed_kernel([=](double x, double y) { return -x * bell(x, y); });
        point_ =
            signed_kernel([=](double x, double y) { return (x * x / (deviation * deviation) - 1.0) * bell(x, y); });
    }

    // At one pixel.
    [[nodiscard]] double operator()(const picture& a, const picture& b, int x, int y) const {
        const double part = std::pow(hyab(seen(a, x, y), seen(b, x, y)), 0.7);
        const double split = 0.4 * largest_;
        const double color_part =
            part < split ? 0.95 * part / split : 0.95 + 0.05 * (part - split) / (largest_ - split);
        const double edges = std::abs(strength(a, edge_, x, y) - strength(b, edge_, x, y));
        const double points = std::abs(strength(a, point_, x, y) - strength(b, point_, x, y));
        const double feature = std::sqrt((std::max)(edges, points) / std::sqrt(2.0));
        return std::pow(color_part, 1.0 - feature);
    }

private:
    using kernel = std::vector<double>;  // [y][x] over a square
    static constexpr double pi = std::numbers::pi;

    static double determinant(const std::array<color, 3>& m) {
        return m[0][0] * (m[1][1] * m[2][2] - m[2][1] * m[1][2]) - m[1][0] * (m[0][1] * m[2][2] - m[2][1] * m[0][2]) +
               m[2][0] * (m[0][1] * m[1][2] - m[1][1] * m[0][2]);
    }
    static color solve(const std::array<color, 3>& columns, color right) {
        color result{};
        for (std::size_t i = 0; i < 3; ++i) {
            auto replaced = columns;
            replaced[i] = right;
            result[i] = determinant(replaced) / determinant(columns);
        }
        return result;
    }

    struct gaussian {
        double a, b;
    };
    [[nodiscard]] kernel sensitivity(const std::vector<gaussian>& sum) const {
        kernel result;
        double total = 0.0;
        for (int y = -radius_; y <= radius_; ++y)
            for (int x = -radius_; x <= radius_; ++x) {
                double value = 0.0;
                for (const gaussian& g : sum)
                    value +=
                        g.a * std::sqrt(pi / g.b) * std::exp(-pi * pi * (x * x + y * y) / (density_ * density_ * g.b));
                result.push_back(value);
                total += value;
            }
        for (double& value : result) value /= total;
        return result;
    }
    [[nodiscard]] kernel signed_kernel(const std::function<double(double, double)>& value) const {
        kernel result;
        double above = 0.0, below = 0.0;
        for (int y = -feature_radius_; y <= feature_radius_; ++y)
            for (int x = -feature_radius_; x <= feature_radius_; ++x) {
                result.push_back(value(x, y));
                (result.back() < 0.0 ? below : above) += std::abs(result.back());
            }
        for (double& v : result) v /= v < 0.0 ? below : above;
        return result;
    }

    // XYZ over that of white.
    [[nodiscard]] color xyz(color rgb) const {
        color result{};
        for (std::size_t k = 0; k < 3; ++k)
            for (std::size_t i = 0; i < 3; ++i) result[k] += columns_[i][k] * rgb[i];
        return result;
    }
    [[nodiscard]] color xyz(const picture& of, int x, int y) const {
        color rgb{};
        const int column = (std::clamp)(x, 0, of.extent.x - 1), row = (std::clamp)(y, 0, of.extent.y - 1);
        for (int c = 0; c < 3; ++c) {
            const double v = double(of.level(column, row, c)) / 255.0;
            rgb[std::size_t(c)] = v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
        }
        return xyz(rgb);
    }
    [[nodiscard]] color hunt_lab(color rgb) const {
        color f = xyz(rgb);
        for (double& v : f) {
            const double delta = 6.0 / 29.0;
            v = v > delta * delta * delta ? std::cbrt(v) : v / (3.0 * delta * delta) + 4.0 / 29.0;
        }
        const double lightness = 116.0 * f[1] - 16.0;
        return {lightness, 0.01 * lightness * 500.0 * (f[0] - f[1]), 0.01 * lightness * 200.0 * (f[1] - f[2])};
    }
    static double hyab(color a, color b) { return std::abs(a[0] - b[0]) + std::hypot(a[1] - b[1], a[2] - b[2]); }

    // Color as the eye sees it at a pixel.
    [[nodiscard]] color seen(const picture& of, int x, int y) const {
        color opponent{};
        std::size_t i = 0;
        for (int dy = -radius_; dy <= radius_; ++dy)
            for (int dx = -radius_; dx <= radius_; ++dx, ++i) {
                const color v = xyz(of, x + dx, y + dy);
                opponent[0] += sensitivity_[0][i] * (116.0 * v[1] - 16.0);
                opponent[1] += sensitivity_[1][i] * 500.0 * (v[0] - v[1]);
                opponent[2] += sensitivity_[2][i] * 200.0 * (v[1] - v[2]);
            }
        const double white = (opponent[0] + 16.0) / 116.0;
        color rgb = solve(columns_, {white + opponent[1] / 500.0, white, white - opponent[2] / 200.0});
        for (double& v : rgb) v = (std::clamp)(v, 0.0, 1.0);
        return hunt_lab(rgb);
    }
    [[nodiscard]] double strength(const picture& of, const kernel& along_x, int x, int y) const {
        double sums[2] = {};
        const int side = 2 * feature_radius_ + 1;
        for (int dy = 0; dy < side; ++dy)
            for (int dx = 0; dx < side; ++dx) {
                const double v = xyz(of, x + dx - feature_radius_, y + dy - feature_radius_)[1];
                sums[0] += along_x[std::size_t(dy * side + dx)] * v;
                sums[1] += along_x[std::size_t(dx * side + dy)] * v;
            }
        return std::hypot(sums[0], sums[1]);
    }

    double density_, largest_ = 1.0;
    int radius_ = 0, feature_radius_ = 0;
    std::array<color, 3> columns_{};
    std::array<kernel, 3> sensitivity_;
    kernel edge_, point_;
};

}  // namespace

TEST_CASE("the same picture twice has no difference") {
    const picture a = mixed({40, 30}, 1);
    for (const float d : compared(a, a)) CHECK(d == 0.0f);
    CHECK(mean_difference(compared(a, a)) == 0.0);
}

// L* a* b* under D65, as they are in many tables: black 0 0 0, white 100 0 0, green 87.73 -86.18 83.18,
// blue 32.30 79.19 -107.86. Times L / 100, green is at -75.61 72.98 and blue at 25.58 -34.84: 55.43 + 147.86 = 203.29
// apart. Black and white are 100 apart, (100 / 203.29)^0.7 = 0.6086 of that, and 0.95 + 0.05 (0.6086 - 0.4) / 0.6 =
// 0.9674.
TEST_CASE("pictures of one color: the distance of the colors alone") {
    const glm::ivec2 extent{9, 7};
    for (const float d : compared(picture(extent, {0, 0, 0}), picture(extent, {255, 255, 255})))
        CHECK(double(d) == doctest::Approx(0.9674).epsilon(1e-4));
    for (const float d : compared(picture(extent, {0, 255, 0}), picture(extent, {0, 0, 255})))
        CHECK(double(d) == doctest::Approx(1.0).epsilon(1e-5));
    // Grays: (difference of L* / 203.29)^0.7 * 0.95 / 0.4. sRGB 119 is linear 0.1845, L* 50.03; 99 is 0.1248, 41.97.
    for (const float d : compared(picture(extent, {119, 119, 119}), picture(extent, {99, 99, 99})))
        CHECK(double(d) == doctest::Approx(std::pow(8.06 / 203.29, 0.7) * 0.95 / 0.4).epsilon(2e-3));
}

TEST_CASE("against filters over squares in double precision") {
    for (const float density : {67.02f, 25.0f, 3.0f}) {
        CAPTURE(density);
        const direct reference{double(density)};
        // More than two bands of rows, and rows that no vector divides.
        const picture a = mixed({21, 131}, 2), b = mixed({21, 131}, 3);
        const auto found = compared(a, b, {.pixels_per_degree = density});
        double worst = 0.0;
        for (int y = 0; y < 131; y += y < 60 || y > 67 ? 7 : 1)
            for (int x = 0; x < 21; x += 5)
                worst = (std::max)(worst, std::abs(double(found[std::size_t(y * 21 + x)]) - reference(a, b, x, y)));
        CHECK(worst < 3e-4);
    }
    const direct reference(67.02);
    const picture a = mixed({1, 1}, 2), b = mixed({1, 1}, 3);
    CHECK(double(compared(a, b)[0]) == doctest::Approx(reference(a, b, 0, 0)).epsilon(1e-4));
}

TEST_CASE("small differences are as exact") {
    const picture a = mixed({30, 20}, 5);
    picture b = a;
    for (int x = 0; x < 30; ++x) b.at(x, 9, 1) = std::byte(a.level(x, 9, 1) / 2 + 60);
    const direct reference(67.02);
    const auto found = compared(a, b);
    for (int y = 2; y < 20; y += 3)
        for (int x = 0; x < 30; x += 6)
            CHECK(double(found[std::size_t(y * 30 + x)]) == doctest::Approx(reference(a, b, x, y)).epsilon(2e-3));
}

TEST_CASE("symmetric") {
    const picture a = mixed({33, 70}, 6), b = mixed({33, 70}, 7);
    CHECK(compared(a, b) == compared(b, a));
}

TEST_CASE("more contrast is more different") {
    const glm::ivec2 extent{48, 48};
    const picture gray(extent, {128, 128, 128});
    for (const int side : {1, 4, 24}) {
        CAPTURE(side);
        double before = 0.0;
        for (const int contrast : {2, 8, 20, 45, 80, 120}) {
            picture board(extent);
            for (int y = 0; y < extent.y; ++y)
                for (int x = 0; x < extent.x; ++x)
                    for (int c = 0; c < 3; ++c)
                        board.at(x, y, c) = std::byte((x / side + y / side) % 2 == 0 ? 128 - contrast : 128 + contrast);
            const double mean = mean_difference(compared(gray, board));
            CHECK(mean > before);
            before = mean;
        }
    }
}

TEST_CASE("linear floats, four channels and strides say the same") {
    const glm::ivec2 extent{23, 19};
    const picture a = mixed(extent, 8), b = mixed(extent, 9);
    const auto wanted = compared(a, b);

    std::vector<float> linear[2];
    std::vector<std::byte> wide[2];
    const std::size_t float_stride = 3 * 23 + 5, byte_stride = 4 * 23 + 3;
    for (int i = 0; i < 2; ++i) {
        const picture& from = i == 0 ? a : b;
        linear[i].assign(float_stride * 19, std::numeric_limits<float>::quiet_NaN());
        wide[i].assign(byte_stride * 19, std::byte(17 + 100 * i));
        for (int y = 0; y < 19; ++y)
            for (int x = 0; x < 23; ++x)
                for (int c = 0; c < 3; ++c) {
                    const int level = from.level(x, y, c);
                    // Beyond white and black is cut off.
                    linear[i][std::size_t(y) * float_stride + std::size_t(3 * x + c)] =
                        level == 255 ? 7.0f
                        : level == 0 ? -1.0f
                                     : srgb_to_linear(float(level) / 255.0f);
                    wide[i][std::size_t(y) * byte_stride + std::size_t(4 * x + c)] = std::byte(level);
                }
    }
    CHECK(compared({wide[0], extent, 4, byte_stride}, {wide[1], extent, 4, byte_stride}) == wanted);
    std::vector<float> found(wanted.size());
    const status s =
        flip(rgb_image{linear[0], extent, float_stride}, rgb_image{linear[1], extent, float_stride}, found);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    CHECK(found == wanted);
}

TEST_CASE("the executor and the memory do not matter") {
    const picture a = mixed({50, 300}, 10), b = mixed({50, 300}, 11);
    const auto wanted = compared(a, b);
    std::vector<float> found(wanted.size());
    flip_options options;
    std::vector<std::byte> scratch(flip_scratch_size({50, 300}, options, 3));
    options.scratch = scratch;
    options.memory = std::pmr::null_memory_resource();
    CHECK(flip(a.view(), b.view(), found, options, threads(3)));
    CHECK(found == wanted);
    CHECK(compared(a, b, options) == wanted);
}

TEST_CASE("bad input is named, and nothing is written") {
    const picture a = mixed({8, 6}, 12), wider = mixed({9, 6}, 12), taller = mixed({8, 7}, 12);
    std::vector<float> difference(48, -1.0f);
    const auto refused = [&](const status& s, error code, const char* argument) {
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        for (const float d : difference) CHECK(d == -1.0f);
    };
    refused(flip(a.view(), wider.view(), difference), error::mismatch, "picture extent.x");
    refused(flip(a.view(), taller.view(), difference), error::mismatch, "picture extent.y");
    refused(flip(const_pixels{}, const_pixels{}, difference), error::not_positive, "picture extent.x");
    refused(flip(const_pixels{a.bytes, {8, 6}, 2}, a.view(), difference), error::too_small, "picture channels");
    refused(flip(a.view(), a.view(), std::span(difference).first(47)), error::too_small, "difference size");
    for (const float density : {0.0f, -3.0f, 0.99f, 501.0f, std::numeric_limits<float>::quiet_NaN()})
        refused(flip(a.view(), a.view(), difference, {.pixels_per_degree = density}), error::out_of_range,
                "pixels_per_degree");
    CHECK(flip_scratch_size({8, 6}, {.pixels_per_degree = 1e30f}) > 0);
    CHECK(flip_scratch_size({8, 6}, {.pixels_per_degree = std::numeric_limits<float>::quiet_NaN()}) > 0);
    std::vector<std::byte> scratch(flip_scratch_size({8, 6}) - 1);
    refused(flip(a.view(), a.view(), difference, {.scratch = scratch}), error::too_small, "options.scratch");
#if defined(__cpp_exceptions)
    refused(flip(a.view(), a.view(), difference, {.memory = std::pmr::null_memory_resource()}), error::out_of_memory,
            "flip");
#endif
    std::vector<float> light(8 * 6 * 3), dark(8 * 6 * 3);
    dark[3 * (8 * 4 + 5) + 1] = std::numeric_limits<float>::infinity();
    const status s = flip(rgb_image{light, {8, 6}}, rgb_image{dark, {8, 6}}, difference);
    refused(s, error::not_finite, "image");
    CHECK(s.texel() == glm::ivec2(5, 4));
    refused(flip(rgb_image{light, {8, 6}}, rgb_image{light, {6, 8}}, difference), error::mismatch, "image extent.x");
    refused(flip(rgb_image{light, {8, 6}}, rgb_image{light, {8, 5}}, difference), error::mismatch, "image extent.y");
    CHECK(std::isnan(mean_difference({})));
}

TEST_CASE("largest and smallest number of pixels a degree") {
    const picture a(glm::ivec2(5, 4), {10, 20, 30}), b(glm::ivec2(5, 4), {200, 100, 0});
    const direct reference(67.02);
    const double wanted = reference(a, b, 2, 2);
    for (const float density : {1.0f, 500.0f})
        for (const float d : compared(a, b, {.pixels_per_degree = density}))
            CHECK(double(d) == doctest::Approx(wanted).epsilon(1e-4));
}
