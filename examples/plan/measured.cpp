#include "plan/measured.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <span>
#include <variant>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/reference/pixel_shadow.hpp>

#include "common/file.hpp"
#include "common/shading.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;

constexpr int arc_bearings = 16, arc_elevations = 4;
constexpr int texels_wanted = 3000, squares_wanted = 1000;

// As many answers in different bearings where there are fewer lights than a moving one has bearings.
int pixels_wanted(bool squares, std::size_t rays) {
    const int usual = squares ? squares_wanted * arc_bearings / 2 : texels_wanted * arc_bearings;
    return std::max(usual / int(rays), squares ? squares_wanted : texels_wanted);
}

// Towards the lights of a scene, seen from a place: those of one bearing behind each other, `elevations` of them.
class lamps {
public:
    lamps(const bs::scene& scene, int side) : scene_(scene), bearings_(side > 1 ? arc_bearings / 2 : arc_bearings) {}

    [[nodiscard]] std::size_t elevations() const { return moving() ? arc_elevations : 1; }
    [[nodiscard]] std::size_t count() const {
        if (!scene_.lights.empty()) return scene_.lights.size();
        if (!scene_.positions.empty()) return scene_.positions.size();
        return std::size_t(bearings_) * arc_elevations;
    }

    void at(glm::dvec2 place, std::mt19937& random, std::vector<glm::dvec3>& lights) const {
        lights.clear();
        for (const glm::dvec3 light : scene_.lights) lights.push_back(light);
        if (scene_.lights.empty())
            for (const glm::dvec3 position : scene_.positions) lights.push_back(position - glm::dvec3(place, 0.0));
        if (!moving()) return;
        std::uniform_real_distribution<double> share(0.0, 1.0);
        const bs::light_arc& arc = scene_.arc;
        for (int b = 0; b < bearings_; ++b) {
            const double turns =
                arc.first_bearing + (arc.last_bearing - arc.first_bearing) * (b + share(random)) / bearings_;
            const glm::dvec2 flat = bs::exact_direction(turns - std::floor(turns));
            for (int e = 0; e < arc_elevations; ++e) {
                const double degrees = arc.lowest + (arc.highest - arc.lowest) * (e + share(random)) / arc_elevations;
                const double angle = degrees * std::numbers::pi / 180.0;
                lights.emplace_back(flat * std::cos(angle), std::sin(angle));
            }
        }
    }

private:
    [[nodiscard]] bool moving() const { return scene_.lights.empty() && scene_.positions.empty(); }

    const bs::scene& scene_;
    int bearings_;
};

double slope_of(glm::dvec3 light) {
    const double flat = std::hypot(light.x, light.y);
    return flat > 0.0 ? light.z / flat : std::numeric_limits<double>::infinity();
}

}  // namespace

lit_pixels::lit_pixels(const height_samples& samples, const height_source& source, const bs::scene& scene,
                       std::uint32_t seed) {
    how_.x = how_.y = address_of(source.edge);
    side_ = std::max(1, std::min({int(scene.texels_per_pixel), samples.extent.x, samples.extent.y}));
    const glm::ivec2 room = samples.extent - side_ + 1;
    const lamps all(scene, side_);
    const int wanted = pixels_wanted(side_ > 1, all.count() / all.elevations());
    std::vector<glm::ivec2> corners(std::size_t(std::min<std::int64_t>(wanted, std::int64_t(room.x) * room.y)));
    if (const bs::status s = bs::sample_texels(room, seed, corners); !s) throw failure(s.message().c_str());
    lights_ = all.count();
    std::mt19937 random(seed);
    with_height_map(samples, source, source.height_scale.value_or(1.0), [&]<class Map>(const Map& map) {
        using sample = std::remove_cvref_t<decltype(*map.samples)>;
        std::vector<sample> storage(bs::height_bounds<sample>::required_size(map.extent));
        const bs::height_bounds<sample> bounds(map, storage);
        constexpr double far = std::numeric_limits<double>::infinity();
        std::vector<glm::dvec3> lights;
        std::vector<float> lit;
        for (const glm::ivec2 corner : corners) {
            const glm::dvec2 middle = glm::dvec2(corner) + 0.5 * side_;
            all.at((middle - 0.5) * map.texel_size, random, lights);
            lit.assign(lights.size(), 0.0f);
            int there = 0;
            for (int y = corner.y; y < corner.y + side_; ++y)
                for (int x = corner.x; x < corner.x + side_; ++x) {
                    if (is_no_data(map, sample_at(map, x, y))) continue;
                    ++there;
                    for (std::size_t i = 0; i < lights.size(); i += all.elevations()) {
                        const bool up = lights[i].x == 0.0 && lights[i].y == 0.0;
                        const double horizon =
                            up ? 0.0
                               : bs::exact_horizon(map, {x, y}, glm::dvec2(lights[i]), far, {0.0, 0.0}, &bounds).slope;
                        for (std::size_t e = i; e < i + all.elevations(); ++e)
                            lit[e] += slope_of(lights[e]) < horizon ? 0.0f : 1.0f;
                    }
                }
            if (there == 0) continue;
            places_.push_back(glm::vec2(middle) / glm::vec2(map.extent));
            for (std::size_t i = 0; i < lights.size(); ++i)
                answers_.push_back({glm::vec3(lights[i]), lit[i] / float(there)});
        }
    });
    if (places_.empty()) throw failure(source.path + " is nothing but holes");
}

template <class Factor>
measured_error lit_pixels::judge(const Factor& factor) const {
    double sum = 0.0, squares = 0.0;
    for (std::size_t p = 0; p < places_.size(); ++p) {
        double wrong = 0.0;
        for (std::size_t i = p * lights_; i < (p + 1) * lights_; ++i)
            wrong += std::abs(double(factor(places_[p], answers_[i].light)) - double(answers_[i].lit));
        wrong /= double(lights_);
        sum += wrong;
        squares += wrong * wrong;
    }
    const double n = double(places_.size());
    const double variance = n > 1.0 ? std::max(squares - sum * sum / n, 0.0) / (n - 1.0) : 0.0;
    return {sum / n, bs::standard_errors_95(n - 1.0) * std::sqrt(variance / n)};
}

measured_error lit_pixels::of(const encoded& map, const bs::shadow_edge& edge, int taps) const {
    const auto& e = std::get<bs::tangent_volume>(map.how);
    const bs::const_texture from = map.textures[0].view();
    const glm::vec2 pixel = glm::vec2(float(side_)) / glm::vec2(map.extent);
    return judge(
        [&](glm::vec2 uv, glm::vec3 light) { return pixel_factor(e, from, how_, uv, pixel, taps, light, edge); });
}

measured_error lit_pixels::without_shadows() const {
    return judge([](glm::vec2, glm::vec3) { return 1.0f; });
}

}  // namespace examples
