#include "report/lit_window.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <glm/common.hpp>

#include <bumpshadow/measure/flip.hpp>
#include <bumpshadow/measure/image.hpp>
#include <bumpshadow/normal_map.hpp>

#include "common/file.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

bs::const_pixels pixels_of(const image8& picture) {
    return {std::as_bytes(std::span(picture.samples)), picture.extent, picture.channels};
}

}  // namespace

std::vector<double> light_azimuths(bool quick) { return quick ? std::vector{260.0} : std::vector{20.0, 140.0, 260.0}; }
std::vector<double> light_elevations(bool quick) {
    return quick ? std::vector{10.0, 20.0, 45.0} : std::vector{10.0, 20.0, 30.0, 45.0};
}

lit_window::lit_window(const report_map& map, int longest) : whole_(map.heights.extent) {
    window_.extent = glm::min(whole_, glm::ivec2(longest));
    window_.origin = (whole_ - window_.extent) / 2;
    surface_.extent = window_.extent;
    surface_.normals.resize(3 * std::size_t(window_.extent.x) * std::size_t(window_.extent.y));
    const bs::normal_map normals{.values = surface_.normals, .extent = window_.extent};
    require(with_height_map(map.heights, map.source, map.scale,
                            [&](const auto& view) { return bs::bake_normals(view, normals, window_); }));
}

const std::vector<float>& picture_errors::add(const image8& truth, const image8& result) {
    bs::image_figures figures;
    require(bs::image_error(pixels_of(truth), pixels_of(result), figures));
    difference_.resize(std::size_t(truth.extent.x) * std::size_t(truth.extent.y));
    require(bs::flip(pixels_of(truth), pixels_of(result), difference_, {}, bs::threads()));
    squares_ += figures.rmse * figures.rmse;
    flips_ += bs::mean_difference(difference_);
    pictures_ += 1.0;
    pixels_ += double(difference_.size());
    return difference_;
}

void picture_errors::put(record& r) const {
    const double rmse = std::sqrt(squares_ / pictures_);
    r[column::samples] = pixels_;
    r[column::rmse] = rmse;
    r[column::psnr] = rmse > 0.0 ? 20.0 * std::log10(255.0 / rmse) : std::numeric_limits<double>::infinity();
    r[column::flip] = flips_ / pictures_;
}

image8 picture_of_flip(std::span<const float> difference, glm::ivec2 extent) {
    // After the map "magma" of Matplotlib (Smith and van der Walt 2015), every eighth of it.
    constexpr std::array<glm::vec3, 9> colors{{{0, 0, 4},
                                               {29, 17, 71},
                                               {81, 18, 124},
                                               {130, 37, 129},
                                               {182, 54, 121},
                                               {230, 81, 99},
                                               {251, 136, 97},
                                               {254, 194, 135},
                                               {252, 253, 191}}};
    image8 picture(extent, 3);
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const float place = 8.0f * std::clamp(difference[i], 0.0f, 1.0f);
        const std::size_t below = std::min(std::size_t(place), std::size_t(7));
        const glm::vec3 color = glm::mix(colors[below], colors[below + 1], place - float(below));
        for (int c = 0; c < 3; ++c) picture.samples[3 * i + std::size_t(c)] = std::uint8_t(color[c] + 0.5f);
    }
    return picture;
}

}  // namespace examples
