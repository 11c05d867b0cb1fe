#include "encodings/triangle.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <vector>

#include <glm/ext/vector_double3.hpp>

#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/reference/triangle.hpp>

#include "common/report_text.hpp"
#include "encodings/score.hpp"
#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

// Where the light stands, one unit above the plane.
enum class place { aside, above_vertex, above_middle };

struct column {
    place where;
    double edge;  // length of the triangle's edges
};
constexpr std::array columns{
    column{place::aside, 0.1},        column{place::aside, 0.2},        column{place::aside, 0.5},
    column{place::aside, 1.0},        column{place::aside, 2.0},        column{place::above_vertex, 0.2},
    column{place::above_vertex, 0.5}, column{place::above_vertex, 1.0}, column{place::above_vertex, 2.0},
    column{place::above_middle, 0.2}, column{place::above_middle, 0.5}, column{place::above_middle, 1.0},
    column{place::above_middle, 2.0}};

struct form {
    const char* name;
    bs::interpolant what;
};
constexpr std::array forms{form{"bearing and slope, the seam left as it is", bs::interpolant::raw_bearing},
                           form{"bearing and slope, the seam fixed", bs::interpolant::bearing},
                           form{"direction and slope", bs::interpolant::direction},
                           form{"the light itself", bs::interpolant::light}};

constexpr int division = 8;  // of an edge: points are the middles of the small triangles that stand upright
constexpr int texels = 8;    // a point, anywhere on the map

glm::dvec3 level(double angle, double length) { return {length * std::cos(angle), length * std::sin(angle), 0.0}; }

// Vectors from the vertices to the light. bearing and turn: in radians
std::array<glm::dvec3, 3> vectors_to_light(const column& c, double bearing, double turn) {
    const double radius = c.edge / std::sqrt(3.0);
    const glm::dvec3 light = c.where == place::aside          ? level(bearing, 1.0)
                             : c.where == place::above_vertex ? level(turn, radius)
                                                              : glm::dvec3(0.0);
    std::array<glm::dvec3, 3> vectors;
    for (int i = 0; i < 3; ++i)
        vectors[std::size_t(i)] =
            light + glm::dvec3(0.0, 0.0, 1.0) - level(turn + i * 2.0 * std::numbers::pi / 3.0, radius);
    return vectors;
}

const char* name_of(place where) {
    switch (where) {
        case place::aside: return "45 degrees";
        case place::above_vertex: return "vertex";
        case place::above_middle: break;
    }
    return "middle";
}

class triangle_judge {
public:
    explicit triangle_judge(const sample_map& map) : map_(map), volume_(pack(map)) {}

    // Triangles stand around the light, each turned by another angle.
    [[nodiscard]] std::array<triangle_figure, forms.size()> look(const column& c, int triangles) const {
        std::array<std::vector<double>, forms.size()> shares;  // of each triangle, in percent
        double all = 0.0;
        std::uint32_t random = 1;
        for (int n = 0; n < triangles; ++n) {
            // Golden ratio: turns that have nothing to do with the bearings.
            const double whole = 2.0 * std::numbers::pi, turn = n * std::numbers::phi;
            const auto exact = vectors_to_light(c, (n + 0.5) / triangles * whole, (turn - std::floor(turn)) * whole);
            std::array<glm::vec3, 3> lights;
            for (std::size_t i = 0; i < 3; ++i) lights[i] = glm::vec3(exact[i]);
            std::array<double, forms.size()> wrong{};
            double points = 0.0;
            for (int i = 0; i < division; ++i)
                for (int j = 0; i + j < division; ++j) {
                    const double u = (i + 1.0 / 3.0) / division, v = (j + 1.0 / 3.0) / division;
                    const glm::dvec3 light = u * exact[0] + v * exact[1] + (1.0 - u - v) * exact[2];
                    const glm::vec3 weights(u, v, 1.0 - u - v);
                    std::array<bs::pixel_light, forms.size()> found;
                    for (std::size_t f = 0; f < forms.size(); ++f)
                        found[f] = bs::interpolate_light(lights, weights, forms[f].what, encoding_.slices.function,
                                                         encoding_.scale.max_slope);
                    for (int k = 0; k < texels; ++k) {
                        random = random * 1664525u + 1013904223u;
                        const glm::vec2 uv = center(random);
                        const float truth = bs::shadow_factor(encoding_, volume_.view(), {}, uv, glm::vec3(light));
                        for (std::size_t f = 0; f < forms.size(); ++f)
                            wrong[f] += bs::shadow_factor(encoding_, volume_.view(), {}, uv, found[f]) != truth;
                    }
                    points += texels;
                }
            all += points;
            for (std::size_t f = 0; f < forms.size(); ++f) shares[f].push_back(100.0 * wrong[f] / points);
        }
        std::array<triangle_figure, forms.size()> figures;
        for (std::size_t f = 0; f < forms.size(); ++f) {
            const double sum = std::accumulate(shares[f].begin(), shares[f].end(), 0.0);
            figures[f] = {forms[f].name, name_of(c.where), c.edge, sum / triangles, confidence(shares[f]), all};
        }
        return figures;
    }

private:
    stored pack(const sample_map& map) {
        encoding_.slices.count = 16;
        stored volume(bs::layout_of(encoding_, map.extent));
        require(bs::pack_tangent_volume(map.every(light_bearings), map.directions, encoding_, {}, volume.view()));
        return volume;
    }
    // Of a texel that the high bits draw: filtering between texels gives that one alone.
    [[nodiscard]] glm::vec2 center(std::uint32_t random) const {
        const int texel = int((std::uint64_t(random) * map_.texels()) >> 32);
        const int x = texel % map_.extent.x, y = texel / map_.extent.x;
        return {(float(x) + 0.5f) / float(map_.extent.x), (float(y) + 0.5f) / float(map_.extent.y)};
    }

    const sample_map& map_;
    bs::tangent_volume encoding_;
    stored volume_;
};

}  // namespace

std::vector<triangle_figure> measure_triangles(const sample_map& map, int triangles,
                                               const std::function<void()>& between) {
    const triangle_judge judge(map);
    std::array<std::array<triangle_figure, forms.size()>, columns.size()> found;
    constexpr std::size_t part = (columns.size() + triangle_pauses - 1) / triangle_pauses;
    for (std::size_t first = 0; first < columns.size(); first += part) {
        on_all_cores(std::min(part, columns.size() - first),
                     [&](std::size_t i) { found[first + i] = judge.look(columns[first + i], triangles); });
        if (between) between();
    }
    std::vector<triangle_figure> all;
    for (const auto& figures : found) all.insert(all.end(), figures.begin(), figures.end());
    return all;
}

grid grid_of(const std::vector<triangle_figure>& figures) {
    grid g{"Interpolated over a triangle, wrong %: middle at 45 degrees, or light above; edge over height", {}, {}};
    for (const form& f : forms) g.lines.push_back({f.name, {}});
    for (std::size_t i = 0; i < figures.size(); ++i) {
        if (i % forms.size() == 0) g.columns.push_back(figures[i].place + format(", %g", figures[i].edge));
        g.lines[i % forms.size()].values.push_back(figures[i].percent);
    }
    return g;
}

}  // namespace examples
