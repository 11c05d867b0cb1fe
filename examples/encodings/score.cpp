#include "encodings/score.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <bumpshadow/shader/shader.hpp>

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr double degree = std::numbers::pi / 180.0;

float light_of(bs::quantity stored, glm::vec3 light) {
    switch (stored) {
        case bs::quantity::sine: return bs::shader::bumpshadow_sine(light);
        case bs::quantity::angle: return bs::shader::bumpshadow_angle(light);
        case bs::quantity::slope: break;
    }
    return bs::shader::bumpshadow_slope(light);
}

// Of each patch, in percent, over the elevations from first to before end.
std::vector<double> by_patch(const score& s, std::size_t first, std::size_t end) {
    std::vector<double> shares;
    for (std::size_t i = 0; i < s.wrong.size(); ++i) {
        double wrong = 0.0, all = 0.0;
        for (std::size_t e = first; e < end; ++e) {
            wrong += s.wrong[i][e];
            all += s.all[i][e];
        }
        shares.push_back(100.0 * wrong / all);
    }
    return shares;
}

double share(const score& s, std::size_t first, std::size_t end) {
    double wrong = 0.0, all = 0.0;
    for (std::size_t i = 0; i < s.wrong.size(); ++i)
        for (std::size_t e = first; e < end; ++e) {
            wrong += s.wrong[i][e];
            all += s.all[i][e];
        }
    return 100.0 * wrong / all;
}

// 97.5 % quantile of Student's t.
double student(std::size_t degrees_of_freedom) {
    constexpr std::array table{12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228,
                               2.201,  2.179, 2.160, 2.145, 2.131, 2.120, 2.110, 2.101, 2.093, 2.086};
    if (degrees_of_freedom <= table.size()) return table[degrees_of_freedom - 1];
    return 1.960 + 2.5 / double(degrees_of_freedom);  // within 0.002
}

}  // namespace

double confidence(const std::vector<double>& values) {
    if (values.size() < 2) return std::numeric_limits<double>::quiet_NaN();
    const double n = double(values.size());
    double sum = 0.0, squares = 0.0;
    for (const double v : values) sum += v;
    for (const double v : values) squares += (v - sum / n) * (v - sum / n);
    return student(values.size() - 1) * std::sqrt(squares / (n - 1.0) / n);
}

double score::percent() const { return share(*this, 0, light_elevations.size()); }
double score::percent(std::size_t elevation) const { return share(*this, elevation, elevation + 1); }
double score::interval() const { return confidence(by_patch(*this, 0, light_elevations.size())); }
double score::interval(std::size_t elevation) const { return confidence(by_patch(*this, elevation, elevation + 1)); }

double score::size() const {
    double sum = 0.0;
    for (const counts& patch : all)
        for (const double count : patch) sum += count;
    return sum;
}

judge::judge(const sample_map& map, const bs::horizon_scale& scale, int margin)
    : map_(map), scale_(scale), margin_(margin) {
    score_.wrong.resize(std::size_t(map.extent.x / map.side));
    score_.all.resize(score_.wrong.size());
}

void judge::look(int bearing, const float* horizons) { look(bearing, horizons, 0, light_elevations.size()); }
void judge::look(int bearing, const float* horizons, std::size_t elevation) {
    look(bearing, horizons, elevation, elevation + 1);
}

void judge::look(int bearing, const float* horizons, std::size_t first, std::size_t end) {
    const glm::dvec2 d = map_.directions[std::size_t(bearing)];
    const int judged = map_.side - 2 * margin_;
    for (std::size_t e = first; e < end; ++e) {
        const double angle = light_elevations[e] * degree, along = std::cos(angle);
        const float light =
            light_of(scale_.stored, glm::vec3(d.x * along, d.y * along, std::sin(angle))) * bs::stored_scale(scale_);
        const float slope = float(std::tan(angle));
        const float* const exact = map_.slopes.data() + std::size_t(bearing) * map_.texels();
        for (std::size_t patch = 0; patch < score_.wrong.size(); ++patch) {
            int wrong = 0;
            for (int y = margin_; y < map_.extent.y - margin_; ++y) {
                const std::size_t at =
                    std::size_t(y) * std::size_t(map_.extent.x) + patch * std::size_t(map_.side) + std::size_t(margin_);
                for (int x = 0; x < judged; ++x) {
                    const bool lit = bs::shader::bumpshadow_shadow_hard(light, horizons[at + std::size_t(x)]) > 0.5f;
                    wrong += lit != (slope >= exact[at + std::size_t(x)]) ? 1 : 0;
                }
            }
            score_.wrong[patch][e] += wrong;
            score_.all[patch][e] += double(judged) * double(map_.extent.y - 2 * margin_);
        }
    }
}

}  // namespace examples
