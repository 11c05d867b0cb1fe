#include <bumpshadow/measure/image.hpp>

#include <cmath>
#include <cstddef>
#include <limits>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

const_pixels view(const std::vector<std::byte>& bytes, glm::ivec2 extent, int channels, std::size_t stride = 0) {
    return {bytes, extent, channels, stride};
}

image_figures figures(const const_pixels& truth, const const_pixels& result) {
    image_figures f;
    const status s = image_error(truth, result, f);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    return f;
}

}  // namespace

TEST_CASE("8 bits: psnr by hand") {
    const glm::ivec2 extent{10, 10};
    std::vector<std::byte> a(100, std::byte(40)), b = a;
    CHECK(figures(view(a, extent, 1), view(b, extent, 1)).rmse == 0.0);
    CHECK(std::isinf(figures(view(a, extent, 1), view(b, extent, 1)).psnr));
    // All ten levels off: 20 log10(25.5).
    b.assign(100, std::byte(30));
    CHECK(figures(view(a, extent, 1), view(b, extent, 1)).rmse == doctest::Approx(10.0));
    CHECK(figures(view(a, extent, 1), view(b, extent, 1)).psnr == doctest::Approx(28.1308).epsilon(1e-5));
    // One of a hundred pixels the whole range off: a hundredth of 255^2, so 20 dB.
    a.assign(100, std::byte(0));
    b = a;
    b[57] = std::byte(255);
    const image_figures f = figures(view(a, extent, 1), view(b, extent, 1));
    CHECK(f.rmse == doctest::Approx(25.5));
    CHECK(f.psnr == doctest::Approx(20.0));
    CHECK(f.largest == 255.0);
}

TEST_CASE("colors count, the fourth channel and the second of two do not") {
    // 2 x 1 pixels with strides; differences 3, 4, 0 and 0, 0, 5: 50 / 6.
    const std::vector<std::byte> rgb{std::byte(10), std::byte(20), std::byte(30),
                                     std::byte(40), std::byte(50), std::byte(60)};
    std::vector<std::byte> rgba{std::byte(13), std::byte(16), std::byte(30), std::byte(255),
                                std::byte(40), std::byte(50), std::byte(65), std::byte(7)};
    CHECK(figures(view(rgb, {2, 1}, 3), view(rgba, {2, 1}, 4)).rmse == doctest::Approx(std::sqrt(50.0 / 6.0)));
    CHECK(figures(view(rgba, {2, 1}, 4), view(rgb, {2, 1}, 3)).largest == 5.0);
    // Gray with and without alpha, the rows of one 3 bytes apart: 10 against 13, 40 against 30 and so on.
    const std::vector<std::byte> gray_alpha{std::byte(13), std::byte(99), std::byte(99), std::byte(40), std::byte(1)};
    const std::vector<std::byte> gray{std::byte(10), std::byte(44)};
    CHECK(figures(view(gray, {1, 2}, 1), view(gray_alpha, {1, 2}, 2, 3)).rmse ==
          doctest::Approx(std::sqrt((9.0 + 16.0) / 2.0)));
}

TEST_CASE("floats: psnr by hand") {
    std::vector<float> a(12, 0.5f), b(12, 0.6f);
    image_figures f;
    REQUIRE(image_error(rgb_image{a, {2, 2}}, rgb_image{b, {2, 2}}, f));
    CHECK(f.rmse == doctest::Approx(0.1).epsilon(1e-6));
    CHECK(f.psnr == doctest::Approx(20.0).epsilon(1e-6));
    REQUIRE(image_error(rgb_image{a, {2, 2}}, rgb_image{b, {2, 2}}, f, 10.0));
    CHECK(f.psnr == doctest::Approx(40.0).epsilon(1e-6));
    REQUIRE(image_error(a, b, f));
    CHECK(f.psnr == doctest::Approx(20.0).epsilon(1e-6));
    REQUIRE(image_error(a, a, f));
    CHECK(f.rmse == 0.0);
    CHECK(std::isinf(f.psnr));
    // Rows of 2 pixels 7 floats apart: what is between them does not count.
    std::vector<float> wide(13, std::numeric_limits<float>::quiet_NaN());
    for (std::size_t i = 0; i < 6; ++i) wide[i] = wide[7 + i] = 0.5f;
    wide[8] = 0.0f;
    REQUIRE(image_error(rgb_image{a, {2, 2}}, rgb_image{wide, {2, 2}, 7}, f));
    CHECK(f.largest == 0.5);
    CHECK(f.rmse == doctest::Approx(std::sqrt(0.25 / 12.0)));
}

TEST_CASE("bad input is named, and the result stays") {
    const std::vector<std::byte> bytes(64, std::byte(1));
    std::vector<float> a(12, 0.5f), b = a;
    image_figures f;
    f.rmse = -7.0;
    const auto refused = [&](const status& s, error code, const char* argument) {
        CHECK(s.code() == code);
        CHECK(std::string_view(s.argument()) == argument);
        CHECK(f.rmse == -7.0);
    };
    refused(image_error(view(bytes, {4, 4}, 3), view(bytes, {5, 4}, 3), f), error::mismatch, "picture extent.x");
    refused(image_error(view(bytes, {4, 4}, 3), view(bytes, {4, 3}, 3), f), error::mismatch, "picture extent.y");
    refused(image_error(view(bytes, {4, 4}, 3), view(bytes, {4, 4}, 2), f), error::mismatch, "picture channels");
    refused(image_error(view(bytes, {4, 6}, 3), view(bytes, {4, 6}, 3), f), error::too_small, "picture size");
    refused(image_error(const_pixels{}, const_pixels{}, f), error::not_positive, "picture extent.x");

    refused(image_error(rgb_image{a, {2, 2}}, rgb_image{b, {1, 2}}, f), error::mismatch, "image extent.x");
    refused(image_error(rgb_image{a, {2, 2}}, rgb_image{b, {2, 1}}, f), error::mismatch, "image extent.y");
    refused(image_error(rgb_image{a, {2, 3}}, rgb_image{b, {2, 3}}, f), error::too_small, "image size");
    refused(image_error(rgb_image{a, {2, 2}}, rgb_image{b, {2, 2}}, f, 0.0), error::not_positive, "peak");
    b[10] = std::numeric_limits<float>::quiet_NaN();
    const status s = image_error(rgb_image{a, {2, 2}}, rgb_image{b, {2, 2}}, f);
    refused(s, error::not_finite, "image");
    CHECK(s.texel() == glm::ivec2(1, 1));
    refused(image_error(a, b, f), error::not_finite, "image");
    refused(image_error(a, std::span(b).first(9), f), error::mismatch, "result size");
    refused(image_error(std::span<const float>(), {}, f), error::missing, "truth");
    refused(image_error(a, a, f, std::numeric_limits<double>::quiet_NaN()), error::not_positive, "peak");
}
