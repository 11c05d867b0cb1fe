#include "encodings/triangle.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include <glm/ext/vector_double3.hpp>

#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/reference/triangle.hpp>

#include "common/report_text.hpp"
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

constexpr int triangles = 480;  // around the light, each turned by another angle
constexpr int division = 8;     // of an edge: points are the middles of the small triangles that stand upright
constexpr int texels = 8;       // a point, anywhere on the map

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

std::string title_of(const column& c) {
    return (c.where == place::aside          ? "45 degrees, "
            : c.where == place::above_vertex ? "vertex, "
                                             : "middle, ") +
           format("%g", c.edge);
}

class judge {
public:
    explicit judge(const sample_map& map) : map_(map), volume_(pack(map)) {}

    // Wrong answers of each form, in percent.
    [[nodiscard]] std::array<double, forms.size()> look(const column& c) const {
        std::array<double, forms.size()> wrong{};
        double all = 0.0;
        std::uint32_t random = 1;
        for (int n = 0; n < triangles; ++n) {
            // Golden ratio: turns that have nothing to do with the bearings.
            const double whole = 2.0 * std::numbers::pi, turn = n * std::numbers::phi;
            const auto exact = vectors_to_light(c, (n + 0.5) / triangles * whole, (turn - std::floor(turn)) * whole);
            std::array<glm::vec3, 3> lights;
            for (std::size_t i = 0; i < 3; ++i) lights[i] = glm::vec3(exact[i]);
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
                    all += texels;
                }
        }
        for (double& w : wrong) w *= 100.0 / all;
        return wrong;
    }

private:
    stored pack(const sample_map& map) {
        encoding_.slices.count = 16;
        stored volume(bs::layout_of(encoding_, map.extent));
        expect(bs::pack_tangent_volume(map.every(light_bearings), map.directions, encoding_, {}, volume.view()));
        return volume;
    }
    // Of a texel that the high bits draw: filtering between texels gives that one alone.
    [[nodiscard]] glm::vec2 center(std::uint32_t random) const {
        const int texel = int((std::uint64_t(random) * map_.texels()) >> 32);
        return {(float(texel % map_.extent.x) + 0.5f) / float(map_.extent.x),
                (float(texel / map_.extent.x) + 0.5f) / float(map_.extent.y)};
    }

    const sample_map& map_;
    bs::tangent_volume encoding_;
    stored volume_;
};

}  // namespace

grid measure_triangles(const sample_map& map) {
    grid g{"Interpolated over a triangle, wrong %: middle at 45 degrees, or light above; edge over height", {}, {}};
    for (const form& f : forms) g.lines.push_back({f.name, {}});
    const judge judge(map);
    for (const column& c : columns) {
        g.columns.push_back(title_of(c));
        const auto wrong = judge.look(c);
        for (std::size_t f = 0; f < forms.size(); ++f) g.lines[f].values.push_back(wrong[f]);
    }
    return g;
}

}  // namespace examples
