#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/relief.hpp>
#include <bumpshadow/horizon_map.hpp>

// The machinery of sweep.hpp: lines over a map, and the hulls of the heights along them.
//
// For one direction, parallel lines are laid over the map, one texel apart. They step from column to column of the axis
// along which the direction crosses more texels, so that a height along a line is a linear interpolation between the
// texels of two rows. "Rows" and "columns" are meant that way here: for half of the directions they are those of the
// transposed map.

namespace bumpshadow {

namespace sweep_detail {

// Columns that bake_sweep looks at from the texel itself.
inline constexpr int near_columns = 12;
// Lines whose results are kept before they are written, so that writes run along the rows of the output.
inline constexpr int lines_per_block = 16;
inline constexpr int largest_extent = 1 << 22;  // positions along a line are floats

// Columns beyond the map that a sweep begins with.
[[nodiscard]] constexpr int warm_up(int extent, edge_mode edge) {
    switch (edge) {
        // One length of the map, and more of small ones. Lines that close after one length (the axes, and diagonals of
        // square maps) have the nearest copy of every height there; on others, what is left out has a slope of at most
        // (range of heights) / (that way in units).
        case edge_mode::repeat:
        case edge_mode::mirror: return (std::max)(extent, 256);
        // The endless border is left to push_beyond_clamped_border(), but not so near to a texel.
        case edge_mode::clamp: return near_columns + 1;
        case edge_mode::open: break;
    }
    return 0;
}

// Floats from row to row of a scratch array: no power of two, whose multiples would share a set of the cache.
[[nodiscard]] constexpr std::ptrdiff_t pitch(int width) { return std::ptrdiff_t(width) / 32 * 32 + 48; }

// A direction as the lines see it.
struct slanted {
    bool along_y;          // columns are rows of the map
    bool forward;          // the direction leads to larger column numbers
    double slant;          // rows for one column
    double column_length;  // units of the way from one column to the next
};

[[nodiscard]] inline slanted resolve(glm::dvec2 direction, glm::dvec2 texel_size) {
    const double largest = (std::max)(std::abs(direction.x), std::abs(direction.y));
    glm::dvec2 d(direction.x / largest / texel_size.x, direction.y / largest / texel_size.y);
    const bool along_y = std::abs(d.y) > std::abs(d.x);
    if (along_y) {
        std::swap(d.x, d.y);
        std::swap(texel_size.x, texel_size.y);
    }
    double slant = d.y / d.x;
    if (std::abs(slant) > 1.0 - 1e-12) slant = slant < 0.0 ? -1.0 : 1.0;
    // Before the slant is rounded: where texels are very long a line that hardly leaves its row still goes far.
    const double column_length = std::hypot(texel_size.x, slant * texel_size.y);
    if (std::abs(slant) < 1e-12) slant = 0.0;
    return {along_y, d.x > 0.0, slant, column_length};
}

// Where a line through row 0 of column 0 meets a column: between row_a and row_b, with this weight of row_b.
struct crossing {
    int row_a, row_b;
    float weight;
};

[[nodiscard]] inline crossing cross(double slant, int column) {
    constexpr double snap = 1e-6;  // less than this beside a row is on it, and needs no second one, which may be a hole
    const double position = slant * double(column);
    const double row = std::floor(position + snap);
    const double weight = position - row;
    if (weight < snap) return {int(row), int(row), 0.0f};
    return {int(row), int(row) + 1, float(weight)};
}

// A hull is a stack of these. `slope` leads to the vertex below. At the bottom lies a point at minus infinity whose
// slope compares false with everything, so that no loop has to look for the end, and a slope to it means: nothing
// occludes.
struct vertex {
    float at, height, slope;
};

inline constexpr float minus_infinity = -std::numeric_limits<float>::infinity();
inline constexpr vertex hull_bottom{std::numeric_limits<float>::lowest(), minus_infinity,
                                    std::numeric_limits<float>::quiet_NaN()};

// The vertex that the line from (at, height) touches.
[[nodiscard]] inline vertex* touch(vertex* top, float at, float height) {
    while (top->height - height <= top->slope * (at - top->at)) --top;
    return top;
}

[[nodiscard]] inline float slope_to(const vertex& v, float at, float height) {
    return (v.height - height) / (at - v.at);
}

[[nodiscard]] inline vertex* push(vertex* top, float at, float height) {
    top = touch(top, at, height);
    const float slope = slope_to(*top, at, height);
    *++top = {at, height, slope};
    return top;
}

// Heights as floats, see relief.hpp, holes as NaN, row by row with a margin on both sides; and column by column.
struct planes {
    float* rows;
    std::ptrdiff_t row_stride;
    float* columns;  // null where no direction needs it
    std::ptrdiff_t column_stride;
    glm::ivec2 extent;
    edge_mode edge;
    bool gaps;    // there are holes, or no surface beyond the border
    float floor;  // what horizons cannot be below
};

// True where there are holes.
template <height_sample Sample>
[[nodiscard]] inline bool fill(const planes& to, const height_map<Sample>& heights, int margin,
                               relief_detail::height_range& range) {
    constexpr float hole = std::numeric_limits<float>::quiet_NaN();
    const double unit = relief_detail::height_in_texels(heights), reference = reference_sample(heights);
    bool holes = false;
    for (int y = 0; y < to.extent.y; ++y) {
        float* const row = to.rows + y * to.row_stride;
        if (relief_detail::copy_row(heights, y, reference, unit, hole, row, range)) holes = true;
        for (int i = 1; i <= margin; ++i) {
            const std::int64_t left = resolve_edge(-i, to.extent.x, to.edge);
            const std::int64_t right = resolve_edge(to.extent.x - 1 + i, to.extent.x, to.edge);
            row[-i] = left < 0 ? hole : row[left];
            row[to.extent.x - 1 + i] = right < 0 ? hole : row[right];
        }
    }
    // One row of nothing for what lies beyond an open border.
    std::fill_n(to.rows + to.extent.y * to.row_stride - margin, to.row_stride, hole);
    if (to.columns != nullptr) {
        constexpr int tile = 16;
        for (int y0 = 0; y0 < to.extent.y; y0 += tile)
            for (int x = 0; x < to.extent.x; ++x)
                for (int y = y0; y < (std::min)(y0 + tile, to.extent.y); ++y)
                    to.columns[x * to.column_stride + y] = to.rows[y * to.row_stride + x];
        std::fill_n(to.columns + to.extent.x * to.column_stride, to.extent.y, hole);
    }
    return holes;
}

// What the lines of one direction have in common, and room for one block of them. Indices of columns are in the order
// of the sweep, far to near. Line l meets column i between rows row_a[i] + l and row_b[i] + l of the tables source and
// target.
struct lines {
    std::int32_t* row_a;
    std::int32_t* row_b;
    std::int32_t* column;
    float* weight;           // of row_b
    std::ptrdiff_t* source;  // by row: its place in the plane
    std::ptrdiff_t* target;  // by row: its place in the output, negative outside of the region
    float* height;           // along a line; NaN where it touches a gap
    float* height_a;         // of the texels beside it
    float* height_b;
    float* horizon_a;  // by line of a block, and column: what the texels beside the line see over its hull;
    float* horizon_b;  // the first line of it is the last of the block before
    vertex* hull;

    const float* plane;
    std::ptrdiff_t stride;                      // of the plane's rows
    int count;                                  // lines; the one before the first, 0, is only there for its neighbor
    int first, last;                            // columns of the region; the sweep ends with it
    int rows, first_row;                        // of the map; number of the tables' first
    std::ptrdiff_t column_step, column_origin;  // in the output
    slanted way;

    // Calls visit(pointer, count) for each array.
    template <class Visit>
    void arrays(int side, edge_mode edge, const Visit& visit) {
        const std::size_t n = std::size_t(side) + std::size_t(warm_up(side, edge));
        for (std::int32_t** array : {&row_a, &row_b, &column}) visit(*array, n);
        for (float** array : {&weight, &height, &height_a, &height_b}) visit(*array, n);
        for (float** array : {&horizon_a, &horizon_b}) visit(*array, (lines_per_block + 1) * std::size_t(pitch(side)));
        for (std::ptrdiff_t** array : {&source, &target}) visit(*array, 3 * n + 8);
        visit(hull, n + std::size_t(side) + 1);
    }

    void prepare(const planes& map, slanted direction, rectangle region, std::size_t output_row) {
        way = direction;
        glm::ivec2 extent = map.extent;
        plane = map.rows;
        stride = map.row_stride;
        column_step = 1;
        std::ptrdiff_t row_step = std::ptrdiff_t(output_row);
        if (way.along_y) {
            plane = map.columns;
            stride = map.column_stride;
            std::swap(extent.x, extent.y);
            std::swap(region.origin.x, region.origin.y);
            std::swap(region.extent.x, region.extent.y);
            std::swap(column_step, row_step);
        }
        rows = extent.y;
        const int before = warm_up(extent.x, map.edge), columns = before + extent.x;
        first = way.forward ? columns - region.origin.x - region.extent.x : before + region.origin.x;
        last = first + region.extent.x;
        column_origin = -column_step * region.origin.x;

        int lowest = 0, highest = 0, lowest_inside = 0, highest_inside = 0;
        for (int i = 0; i < columns; ++i) {
            const int number = way.forward ? columns - 1 - i : i - before;
            const crossing c = cross(way.slant, number);
            const int turns = map.edge == edge_mode::repeat ? int(resolve_edge(c.row_a, rows, map.edge)) - c.row_a : 0;
            row_a[i] = c.row_a + turns;
            row_b[i] = c.row_b + turns;
            column[i] = int(resolve_edge(number, extent.x, map.edge));
            weight[i] = c.weight;
            lowest = (std::min)(lowest, row_a[i]);
            highest = (std::max)(highest, row_b[i]);
            if (i < before) continue;
            lowest_inside = (std::min)(lowest_inside, row_a[i]);
            highest_inside = (std::max)(highest_inside, row_a[i]);
        }
        // A tiling map is covered by as many lines as it has rows.
        int first_line = 0;
        count = rows;
        if (map.edge != edge_mode::repeat) {
            first_line = -highest_inside;
            count += highest_inside - lowest_inside;
        }
        first_row = first_line - 1 + lowest;
        for (int i = 0; i < columns; ++i) {
            row_a[i] -= lowest;
            row_b[i] -= lowest;
        }
        for (int i = 0; i <= highest - lowest + count; ++i) {
            const std::int64_t row = resolve_edge(first_row + i, rows, map.edge);
            source[i] = std::ptrdiff_t((row < 0 ? rows : row) * stride);
            const bool inside = map.edge == edge_mode::repeat || first_row + i == row;
            const std::int64_t in_region = row - region.origin.y;
            target[i] =
                inside && in_region >= 0 && in_region < region.extent.y ? std::ptrdiff_t(in_region * row_step) : -1;
        }
    }

    [[nodiscard]] bool touches_region(int line) const {
        for (int i = first; i < last; ++i)
            if (target[row_a[i] + line] >= 0 || target[row_b[i] + line] >= 0) return true;
        return false;
    }

    // The border's heights go on for ever, so a line beyond it bends only where it crosses rows.
    [[nodiscard]] vertex* push_beyond_clamped_border(vertex* top, int line) const {
        const double step = way.forward ? way.slant : -way.slant;
        if (step == 0.0) return top;
        const double start = first_row + line + row_a[0] + double(weight[0]);
        const int towards = step > 0.0 ? 1 : -1, end = step > 0.0 ? rows : -1;
        const int next =
            step > 0.0 ? (std::max)(int(std::floor(start)) + 1, 0) : (std::min)(int(std::ceil(start)) - 1, rows - 1);
        for (int row = end - towards; (row - next) * towards >= 0; row -= towards) {
            const float h = plane[row * stride + column[0]];
            if (h == h) top = push(top, -float((row - start) / step), h);
        }
        return top;
    }

    template <bool beside>
    void load(int line) {
        const std::ptrdiff_t* const start = source + line;
        for (int i = 0; i < last; ++i) {
            const float a = plane[start[row_a[i]] + column[i]], b = plane[start[row_b[i]] + column[i]];
            if constexpr (beside) {
                height_a[i] = a;
                height_b[i] = b;
            }
            height[i] = a + weight[i] * (b - a);
        }
    }

    // Horizons of the points where a line meets the columns.
    template <bool gaps>
    void sweep_classic(int line, edge_mode edge, float floor, float* horizon) {
        load<gaps>(line);
        vertex* top = hull;
        *top = hull_bottom;
        if (edge == edge_mode::clamp) top = push_beyond_clamped_border(top, line);
        for (int i = 0; i < first; ++i)
            if (!gaps || height[i] == height[i]) top = push(top, float(i), height[i]);
        for (int i = first; i < last; ++i) {
            float own = height[i];
            const bool gap = gaps && own != own;
            if (gap) own = height_a[i] == height_a[i] ? height_a[i] : height_b[i];
            vertex* const touched = touch(top, float(i), own);
            const float slope = slope_to(*touched, float(i), own);
            horizon[i - first] = slope > floor ? slope : floor;
            if (gap) continue;
            top = touched + 1;
            *top = {float(i), own, slope};
        }
    }

    // Horizons of the texels on both sides of a line over the heights of the line from `near_columns` columns on.
    template <bool gaps>
    void sweep_beside(int line, edge_mode edge, float floor, float* above_a, float* above_b) {
        load<true>(line);
        vertex* top = hull;
        *top = hull_bottom;
        if (edge == edge_mode::clamp) top = push_beyond_clamped_border(top, line);
        for (int i = 0; i < last; ++i) {
            const int joining = i - (near_columns + 1);
            if (joining >= 0 && (!gaps || height[joining] == height[joining]))
                top = push(top, float(joining), height[joining]);
            if (i < first) continue;
            const float at = float(i), a = height_a[i], b = height_b[i];
            const float slope_a = slope_to(*touch(top, at, a), at, a);
            const float slope_b = slope_to(*touch(top, at, b), at, b);
            above_a[i - first] = slope_a > floor ? slope_a : floor;
            above_b[i - first] = slope_b > floor ? slope_b : floor;
        }
    }

    // Interpolates between the two lines beside each texel. raise: what is there already stays where it is higher.
    template <bool gaps, bool raise>
    void write(int block, int size, float* out) const {
        const float scale = float(1.0 / way.column_length);
        const std::ptrdiff_t width = pitch(last - first);
        const auto texel = [&](int k, int i) {
            const int row = row_a[i] + block + k;
            if (target[row] < 0) return;
            const float w = weight[i], a = horizon_a[k * width + i - first];
            float slope = a;
            bool none = a == minus_infinity;
            if (w != 0.0f) {
                const float b = horizon_b[(k - 1) * width + i - first];
                slope = a + w * (b - a);
                // A texel between a line that still meets something and one that does not is at the end of an open map.
                none = none || b == minus_infinity;
            }
            slope *= scale;
            if constexpr (gaps) {
                const float own = plane[source[row] + column[i]];
                if (none || own != own) slope = no_horizon;
            }
            float& value = out[target[row] + column[i] * column_step + column_origin];
            value = raise && value > slope ? value : slope;
        };
        if (column_step == 1) {
            for (int k = 1; k <= size; ++k)
                for (int i = first; i < last; ++i) texel(k, i);
        } else {
            for (int i = first; i < last; ++i)
                for (int k = 1; k <= size; ++k) texel(k, i);
        }
    }

    // Sweeps the lines of blocks [begin, end) and writes what they give. `improved` is bake_sweep, else
    // bake_sweep_classic.
    template <bool improved, bool gaps>
    void run(int begin, int end, edge_mode edge, float floor, float* out) {
        const std::ptrdiff_t width = pitch(last - first);
        const auto sweep = [&](int line, int k) {
            if (!touches_region(line)) return;
            if constexpr (improved)
                sweep_beside<gaps>(line, edge, floor, horizon_a + k * width, horizon_b + k * width);
            else
                sweep_classic<gaps>(line, edge, floor, horizon_b + k * width);
        };
        if constexpr (!improved) horizon_a = horizon_b;
        sweep(begin * lines_per_block, 0);
        for (int block = begin; block < end; ++block) {
            const int before = block * lines_per_block, size = (std::min)(lines_per_block, count - before);
            for (int k = 1; k <= size; ++k) sweep(before + k, k);
            write<gaps, improved>(before, size, out);
            std::copy_n(horizon_b + size * width, last - first, horizon_b);
        }
    }
};

}  // namespace sweep_detail
}  // namespace bumpshadow
