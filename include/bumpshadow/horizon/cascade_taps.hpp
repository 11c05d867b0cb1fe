#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/horizon/cascade_levels.hpp>
#include <bumpshadow/simd.hpp>

// Where the cells of a level look, and the loop that looks. Part of horizon/cascade.hpp; nothing here is public.
namespace bumpshadow::cascade_detail {

// One look at the surface, at a distance that is the same for all cells of a level. The slope to it is
//   sum of weight * height there - inverse * own height + bend,    inverse = 1 / distance, weights add up to inverse
// Where a grid line is crossed the surface lies between two cells, elsewhere between four.
template <int Corners>
struct look {
    std::ptrdiff_t offset[Corners];  // from the origin's place in the occluder grid
    float weight[Corners];
    float inverse;
    float bend;  // fall of a curved base
};
using crossing = look<2>;
using inside = look<4>;

// Crossings that lie so close together that any of them may speak for the distance of the highest.
struct group {
    int end;  // one past its last crossing
    float inverse;
};

// At level 0 the surface right beside a texel counts too; its distance is 0.
inline constexpr float inverse_of_zero = 1e30f;
inline constexpr int most_crossings = 4096;  // of one level, or the steps of level 0 if those are more

[[nodiscard]] constexpr int capacity(int steps) { return (std::max)(most_crossings, 2 * steps) + 8; }

struct looks {
    crossing* crossings = nullptr;
    group* groups = nullptr;
    inside* insides = nullptr;
    int crossing_count = 0;
    int group_count = 0;
    int inside_count = 0;

    [[nodiscard]] bool empty() const { return crossing_count + inside_count == 0; }
};

// A ray seen from a cell of one level, in cells of its occluder grid.
struct ray {
    const level* l = nullptr;
    edge_mode edge = edge_mode::repeat;
    glm::dvec2 step{0.0};   // cells a unit of length
    glm::dvec2 start{0.0};  // place of the origin: between cells where an origin covers two of them
    double bend = 0.0;      // curvature / 2
    bool along_x = true;    // the axis of which it crosses more cells
    double main_step = 0.0;

    [[nodiscard]] double main_start() const { return along_x ? start.x : start.y; }
    [[nodiscard]] double distance_of_line(double n) const { return (n - main_start()) / main_step; }
};

[[nodiscard]] inline ray make_ray(const level& l, edge_mode edge, glm::dvec2 unit_direction, double curvature) {
    ray r{.l = &l, .edge = edge, .step = unit_direction / l.occluders.spacing};
    r.start = (glm::dvec2(l.ratio) - 1.0) * 0.5;
    r.bend = 0.5 * curvature;
    // Along an axis of one cell nothing changes, unless the surface ends there.
    if (edge != edge_mode::open && l.occluders.cells.x == 1) r.step.x = 0.0;
    if (edge != edge_mode::open && l.occluders.cells.y == 1) r.step.y = 0.0;
    r.along_x = std::abs(r.step.x) >= std::abs(r.step.y);
    r.main_step = (std::max)(std::abs(r.step.x), std::abs(r.step.y));
    return r;
}

// An offset that may lie beyond the halo, brought back to where the same height is found.
[[nodiscard]] inline std::int64_t fold(std::int64_t offset, int cells, int halo, edge_mode edge) {
    if (std::abs(offset) + border <= halo + 1) return offset;
    const std::int64_t p = period(cells, edge);
    if (edge == edge_mode::repeat || edge == edge_mode::mirror) return resolve_edge(offset, p, edge_mode::repeat);
    return std::clamp(offset, -p, p);
}

// Where between cells a coordinate lies; within rounding of a cell it is taken to be there, since a hole beside it
// would count otherwise.
inline void split(double at, std::int64_t& cell, double& part) {
    const double nearest = std::round(at);
    const double floor = std::abs(at - nearest) < 1e-9 ? nearest : std::floor(at);
    cell = std::int64_t(floor);
    part = (std::max)(at - floor, 0.0);
    if (floor == nearest && part < 1e-9) part = 0.0;
}

[[nodiscard]] inline std::ptrdiff_t offset_of(const ray& r, std::int64_t x, std::int64_t y) {
    const grid& g = r.l->occluders;
    return g.offset(fold(x, g.cells.x, g.halo.x, r.edge), fold(y, g.cells.y, g.halo.y, r.edge)) - g.offset(0, 0);
}

// The surface where the ray crosses line n of the main axis or, with `minor`, of the other one.
[[nodiscard]] inline crossing look_at_line(const ray& r, double t, std::int64_t n, bool minor) {
    const bool line_in_x = r.along_x != minor;
    const double step = line_in_x ? r.step.x : r.step.y, start = line_in_x ? r.start.x : r.start.y;
    const double other = (line_in_x ? r.start.y : r.start.x) + t * (line_in_x ? r.step.y : r.step.x);
    const std::int64_t line = step > 0.0 ? n : std::int64_t(2.0 * start) - n;
    std::int64_t cell;
    double part;
    split(other, cell, part);
    crossing c{};
    for (int i = 0; i < 2; ++i) c.offset[i] = line_in_x ? offset_of(r, line, cell + i) : offset_of(r, cell + i, line);
    c.weight[0] = float((1.0 - part) / t);
    c.weight[1] = float(part / t);
    c.inverse = float(1.0 / t);
    c.bend = float(-r.bend * t);
    return c;
}

[[nodiscard]] inline inside look_between_lines(const ray& r, double t) {
    std::int64_t x, y;
    double u, v;
    split(r.start.x + t * r.step.x, x, u);
    split(r.start.y + t * r.step.y, y, v);
    inside c{};
    for (int i = 0; i < 4; ++i) {
        c.offset[i] = offset_of(r, x + (i & 1), y + (i >> 1));
        c.weight[i] = float(((i & 1) != 0 ? u : 1.0 - u) * ((i >> 1) != 0 ? v : 1.0 - v) / t);
    }
    c.inverse = float(1.0 / t);
    c.bend = float(-r.bend * t);
    return c;
}

// The slope of the surface beside the origin: the limit of the slope to points ever closer.
[[nodiscard]] inline crossing look_beside(const ray& r) {
    crossing c{};
    c.offset[0] = offset_of(r, r.step.x < 0.0 ? -1 : 1, 0);
    c.offset[1] = offset_of(r, 0, r.step.y < 0.0 ? -1 : 1);
    c.weight[0] = float(std::abs(r.step.x));
    c.weight[1] = float(std::abs(r.step.y));
    c.inverse = c.weight[0] + c.weight[1];
    return c;
}

inline void add_crossing(looks& out, const crossing& c, float inverse_of_group) {
    out.crossings[out.crossing_count++] = c;
    out.groups[out.group_count++] = {out.crossing_count, inverse_of_group};
}

// Looks at the lines of the main axis at distances in (from, to], the first `most` of them.
inline void look_at_lines(const ray& r, double from, double to, int most, looks& out) {
    out.crossing_count = out.group_count = out.inside_count = 0;
    if (!(r.main_step > 0.0)) return;
    const double start = r.main_start();
    const double last = (std::min)(std::floor(to * r.main_step + start + 1e-9), 1e15);
    std::int64_t n = std::int64_t(std::floor(from * r.main_step + start + 1e-9)) + 1;
    for (int i = 0; i < most && double(n) <= last; ++i, ++n)
        out.crossings[out.crossing_count++] = look_at_line(r, r.distance_of_line(double(n)), n, false);
    for (int first = 0; first < out.crossing_count;) {
        const int size = std::clamp(int(r.main_step / (10.0 * double(out.crossings[first].inverse))), 1, 4);
        const int end = (std::min)(first + size, out.crossing_count);
        out.groups[out.group_count++] = {end, 0.5f * (out.crossings[first].inverse + out.crossings[end - 1].inverse)};
        first = end;
    }
}

// What level 0 sees besides, where it matters most: the surface right beside the texel; near by, lines of the other
// axis; and points half way between lines, since inside a cell the surface may be higher than on its edges.
inline void look_closer(const ray& r, double lines_up_to, double between_up_to, int most, looks& out) {
    if (!(r.main_step > 0.0)) return;
    add_crossing(out, look_beside(r), inverse_of_zero);
    const double minor_step = (std::min)(std::abs(r.step.x), std::abs(r.step.y));
    const bool minor = minor_step > 1e-6 * r.main_step && minor_step < (1.0 - 1e-9) * r.main_step;
    if (minor)
        for (std::int64_t n = 1; double(n) / minor_step <= lines_up_to && out.crossing_count < most; ++n)
            add_crossing(out, look_at_line(r, double(n) / minor_step, n, true), float(minor_step / double(n)));
    double here = 0.0;
    for (double main = 1.0, other = 1.0; out.inside_count < most;) {
        const double to_main = main / r.main_step;
        const double to_other = minor ? other / minor_step : to_main;
        const double next = (std::min)(to_main, to_other);
        if (next > between_up_to) break;
        // In the first cell the slope is linear, and where lines are close together there is nothing between them.
        if (here > 0.0 && (next - here) * r.main_step > 0.25)
            out.insides[out.inside_count++] = look_between_lines(r, 0.5 * (here + next));
        if (to_main <= next) main += 1.0;
        if (to_other <= next && minor) other += 1.0;
        here = next;
    }
}

// For the cells of a chunk of a row: the highest slope seen, and the inverse distance of what makes it.
//   occluders, heights: the first cell's place in the occluder grid, and its height
//   floor: slope where nothing is seen, with inverse distance 0
// Track: whether inverse distances are wanted. All slopes are measured from the cells' own heights.
template <bool Track>
inline void scan_chunk(const looks& look, const float* occluders, const float* heights, float floor, float* slopes,
                       float* inverses) {
    using simd::pack;
    constexpr int packs = chunk / simd::width;
    pack own[packs], best[packs], best_inverse[packs];
    for (int u = 0; u < packs; ++u) {
        own[u] = simd::subtract(simd::splat(0.0f), simd::load(heights + u * simd::width));
        best[u] = simd::splat(floor);
        best_inverse[u] = simd::splat(0.0f);
    }
    const auto slope = [&](const auto& l, int u) {
        pack s = simd::multiply_add(own[u], simd::splat(l.inverse), simd::splat(l.bend));
        for (std::size_t i = 0; i < std::size(l.offset); ++i)
            s = simd::multiply_add(simd::load(occluders + l.offset[i] + u * simd::width), simd::splat(l.weight[i]), s);
        return s;
    };
    const auto take = [&](pack s, float inverse, int u) {
        best_inverse[u] = simd::select_greater(s, best[u], simd::splat(inverse), best_inverse[u]);
        best[u] = simd::max(s, best[u]);
    };
    if constexpr (!Track) {
        for (int i = 0; i < look.crossing_count; ++i)
            for (int u = 0; u < packs; ++u) best[u] = simd::max(slope(look.crossings[i], u), best[u]);
        for (int i = 0; i < look.inside_count; ++i)
            for (int u = 0; u < packs; ++u) best[u] = simd::max(slope(look.insides[i], u), best[u]);
    } else {
        int i = 0;
        for (int g = 0; g < look.group_count; ++g) {
            pack highest[packs];
            for (int u = 0; u < packs; ++u) highest[u] = slope(look.crossings[i], u);
            for (++i; i < look.groups[g].end; ++i)
                for (int u = 0; u < packs; ++u) highest[u] = simd::max(slope(look.crossings[i], u), highest[u]);
            for (int u = 0; u < packs; ++u) take(highest[u], look.groups[g].inverse, u);
        }
        for (i = 0; i < look.inside_count; ++i)
            for (int u = 0; u < packs; ++u) take(slope(look.insides[i], u), look.insides[i].inverse, u);
    }
    for (int u = 0; u < packs; ++u) {
        simd::store(slopes + u * simd::width, best[u]);
        if constexpr (Track) simd::store(inverses + u * simd::width, best_inverse[u]);
    }
}

}  // namespace bumpshadow::cascade_detail
