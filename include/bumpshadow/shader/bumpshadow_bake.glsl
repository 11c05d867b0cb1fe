// bumpshadow: horizons baked on the GPU, for height fields that change every frame. Compute shader for OpenGL 4.3,
// OpenGL ES 3.1, Vulkan, and newer. MIT license. Generated; the single source is shader/bake.h beside it.
//
// The slopes are those that bake_cascade computes on the CPU, to rounding: heights of any extent, all edge modes,
// texel sizes and directions, holes and a radius; not curvature, regions and distances.
//
// How to use it
//   1. Put `#version 430`, `#version 310 es` or `#version 450` (Vulkan) above this text and compile it.
//   2. Make a plan for the size of the map and the directions: plan_bake in bumpshadow/shader/bake_plan.hpp. It gives
//      the tables, the sizes of the buffers and the list of dispatches. It does not depend on the heights.
//   3. Bind the buffers:
//        0  heights  float, row by row, in units of height_scale; yours, written by your simulation
//        1  tables   ivec4 [table_count], uploaded once
//        2  scratch  float [scratch_floats], left to the kernel, which reads nothing that it has not written
//        3  slopes   float [slope_count], the output: [direction][y][x], tangents of the horizon's elevation;
//                    the lowest float where nothing occludes
//        4  constants, a uniform block of four ints: those of the dispatch
//   4. Each frame carry out the dispatches in their order, with a barrier after each: all that one writes is read by
//      the next. Later ones work on all directions at once.
//   5. Sample the slopes as a tangent volume does, or encode them in a pass of your own.
//
// The kind of a dispatch is its first constant: 0 level 0 with a halo, 1 its resampling (where needed), 2 a coarser
// level of heights, 3 what the cells of a level see, from the highest down, 4 texels. For a program of its own for each
// kind, which needs fewer registers, define BUMPSHADOW_BAKE_KIND as that number.
//
// Cost for a texel and direction, with 12 steps: 12 looks of two neighbors each, 1.5 of four and, by cells, 11 to 13 of
// two on maps from 256 x 256 on. With 48 steps: 28, 6 and 55. 256 x 256 texels and 16 directions take 0.6 MB of tables,
// 3.1 MB of scratch, 4.2 MB of slopes and 10 dispatches; with 48 steps 0.8, 8.0 and 4.2 MB and 12 dispatches.
//
// The host's side, in C++ with OpenGL:
//
//   bumpshadow::height_map<float> map{.extent = {256, 256}, .row_stride = 256};  // samples stay on the GPU
//   bumpshadow::bake_plan plan;
//   plan_bake(map, directions, plan, {}, 2.0);             // sizes; heights differ by 2 units at the most
//   std::vector<glm::ivec4> tables(plan.table_count);
//   std::vector<bumpshadow::bake_dispatch> dispatches(plan.dispatch_count);
//   plan.tables = tables;
//   plan.dispatches = dispatches;
//   plan_bake(map, directions, plan, {}, 2.0);             // each returns a status, to be checked
//   GLuint buffers[4];
//   glCreateBuffers(4, buffers);
//   glNamedBufferStorage(buffers[0], 256 * 256 * 4, nullptr, 0);
//   glNamedBufferStorage(buffers[1], tables.size() * 16, tables.data(), 0);
//   glNamedBufferStorage(buffers[2], plan.scratch_floats * 4, nullptr, 0);
//   glNamedBufferStorage(buffers[3], plan.slope_count * 4, nullptr, 0);
//   ... a uniform buffer `constants` that holds the constants of dispatch i at i * stride, stride being a multiple of
//   GL_UNIFORM_BUFFER_OFFSET_ALIGNMENT (Vulkan: dynamic offsets)
//
//   glUseProgram(program);                                 // each frame
//   glBindBuffersBase(GL_SHADER_STORAGE_BUFFER, 0, 4, buffers);
//   for (size_t i = 0; i < dispatches.size(); ++i) {
//       const glm::ivec3 n = dispatches[i].groups;
//       glBindBufferRange(GL_UNIFORM_BUFFER, 4, constants, i * stride, 16);
//       glDispatchCompute(n.x, n.y, n.z);
//       glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
//   }

#ifdef BUMPSHADOW_BAKE_KIND
#if BUMPSHADOW_BAKE_KIND < 0 || BUMPSHADOW_BAKE_KIND > 4
#error "BUMPSHADOW_BAKE_KIND is 0 (level 0), 1 (resampling), 2 (heights), 3 (cells) or 4 (texels)"
#endif
#endif

precision highp float;
precision highp int;
layout(local_size_x = 16, local_size_y = 4) in;
layout(std430, binding = 0) readonly buffer bumpshadow_bake_heights_block { float bumpshadow_bake_heights[]; };
layout(std430, binding = 1) readonly buffer bumpshadow_bake_tables_block { ivec4 bumpshadow_bake_tables[]; };
layout(std430, binding = 2) buffer bumpshadow_bake_scratch_block { float bumpshadow_bake_scratch[]; };
layout(std430, binding = 3) writeonly buffer bumpshadow_bake_slopes_block { float bumpshadow_bake_slopes[]; };
layout(std140, binding = 4) uniform bumpshadow_bake_constants_block { ivec4 bumpshadow_bake_dispatch; };

// Horizons by the cascade (bumpshadow/horizon/cascade.hpp), an invocation a texel or a cell of a level. All that does
// not depend on the heights is in bumpshadow_bake_tables, which bumpshadow::plan_bake (shader/bake_plan.hpp) fills: a
// record of five entries for each frame or direction, and what the records point to. Places are counted in floats of
// bumpshadow_bake_scratch or in entries of the tables. A frame is the map, or its transpose, whichever makes rays cross
// more rows than columns.

// Height of a hole.
float bumpshadow_bake_hole() { return -1e37f; }
// True for a hole, and for what was interpolated with one.
bool bumpshadow_bake_is_hole(float height) { return height < -1e20f; }
// Slope of a horizon where nothing occludes.
float bumpshadow_bake_no_horizon() { return -3.402823466e38f; }
// Inverse of a distance of 0.
float bumpshadow_bake_inverse_of_zero() { return 1e30f; }
// bumpshadow::edge_mode::clamp, as the tables have it.
int bumpshadow_bake_edge_clamp() { return 1; }
// bumpshadow::edge_mode::mirror.
int bumpshadow_bake_edge_mirror() { return 2; }
// bumpshadow::edge_mode::open.
int bumpshadow_bake_edge_open() { return 3; }

// i / n, rounded down. Unsigned, since GPUs divide integers with a sign more slowly.
int bumpshadow_bake_quotient(int i, int n) {
    int quotient = int(uint(i >= 0 ? i : -1 - i) / uint(n));
    return i >= 0 ? quotient : -1 - quotient;
}
// What is left of i, 0 to n - 1.
int bumpshadow_bake_remainder(int i, int n) { return i - n * bumpshadow_bake_quotient(i, n); }

// Index that stands in for index i of n, or -1.
int bumpshadow_bake_resolve(int i, int n, int edge) {
    int there = i;
    if (i < 0 || i >= n) {
        if (edge == bumpshadow_bake_edge_open()) {
            there = -1;
        } else if (edge == bumpshadow_bake_edge_clamp()) {
            there = i < 0 ? 0 : n - 1;
        } else {
            there = bumpshadow_bake_remainder(i, edge == bumpshadow_bake_edge_mirror() ? 2 * n : n);
            there = min(there, 2 * n - 1 - there);
        }
    }
    return there;
}

// ---- Levels of heights ----

// Level 0 with a halo, in which the edge mode has been carried out.
void bumpshadow_bake_ground(int x, int y, int record) {
    ivec4 to = bumpshadow_bake_tables[record];          // first float, floats a row, columns, rows
    ivec4 halo = bumpshadow_bake_tables[record + 1];    // columns, rows; then texels along x, y
    ivec4 from = bumpshadow_bake_tables[record + 2];    // heights from texel to texel along x, along y; edge
    ivec4 values = bumpshadow_bake_tables[record + 3];  // scale, datum
    if (x >= to.z || y >= to.w) {
        return;
    }
    int column = bumpshadow_bake_resolve(x - halo.x, halo.z, from.z);
    int row = bumpshadow_bake_resolve(y - halo.y, halo.w, from.z);
    float height = bumpshadow_bake_hole();
    if (column >= 0 && row >= 0) {
        float there = bumpshadow_bake_heights[from.x * column + from.y * row];
        if (!bumpshadow_bake_is_hole(there)) {
            height = there * intBitsToFloat(values.x) - intBitsToFloat(values.y);
        }
    }
    bumpshadow_bake_scratch[to.x + to.y * y + x] = height;
}

// Interpolated height, raised towards the higher of the two.
float bumpshadow_bake_resample(float a, float b, float part, float bias) {
    float height = a;
    if (part != 0.0f) {
        float mean = a + (b - a) * part;
        bool absent = bumpshadow_bake_is_hole(a) || bumpshadow_bake_is_hole(b);
        height = absent ? bumpshadow_bake_hole() : mean + bias * (max(a, b) - mean);
    }
    return height;
}

// The finest grid that can be halved, where level 0 cannot: continued, or resampled so that it still tiles.
void bumpshadow_bake_base(int x, int y, int record) {
    ivec4 to = bumpshadow_bake_tables[record];          // first float, columns, rows, edge
    ivec4 from = bumpshadow_bake_tables[record + 1];    // float of texel (0, 0), floats a row, texels along x, y
    ivec4 values = bumpshadow_bake_tables[record + 2];  // bias of what is resampled
    if (x >= to.y || y >= to.z) {
        return;
    }
    float height = bumpshadow_bake_hole();
    if (to.w == bumpshadow_bake_edge_clamp() || to.w == bumpshadow_bake_edge_open()) {
        int column = bumpshadow_bake_resolve(x, from.z, to.w);
        int row = bumpshadow_bake_resolve(y, from.w, to.w);
        if (column >= 0 && row >= 0) {
            height = bumpshadow_bake_scratch[from.x + from.y * row + column];
        }
    } else {
        // (x + 1/2) texels / columns - 1/2, over twice the columns.
        int u = (2 * x + 1) * from.z - to.y;
        int v = (2 * y + 1) * from.w - to.z;
        int left = bumpshadow_bake_quotient(u, 2 * to.y);
        int above = bumpshadow_bake_quotient(v, 2 * to.z);
        float right = float(u - 2 * to.y * left) / float(2 * to.y);
        float below = float(v - 2 * to.z * above) / float(2 * to.z);
        int at = from.x + from.y * above + left;
        float bias = intBitsToFloat(values.x);
        float first =
            bumpshadow_bake_resample(bumpshadow_bake_scratch[at], bumpshadow_bake_scratch[at + from.y], below, bias);
        float second = bumpshadow_bake_resample(bumpshadow_bake_scratch[at + 1],
                                                bumpshadow_bake_scratch[at + 1 + from.y], below, bias);
        height = bumpshadow_bake_resample(first, second, right, bias);
    }
    bumpshadow_bake_scratch[to.x + to.y * y + x] = height;
}

// Mean and maximum of a square, from those of the level below. from: means, maxima, floats a row of both; size.zw: how
// many of them along x, y
vec2 bumpshadow_bake_square(ivec4 from, ivec4 size, int x, int y) {
    float sum = 0.0f;
    float count = 0.0f;
    float highest = bumpshadow_bake_hole();
    for (int j = 0; j < size.w; ++j) {
        for (int i = 0; i < size.z; ++i) {
            int at = from.z * (size.w * y + j) + size.z * x + i;
            float mean = bumpshadow_bake_scratch[from.x + at];
            if (!bumpshadow_bake_is_hole(mean)) {
                sum += mean;
                count += 1.0f;
                highest = max(highest, bumpshadow_bake_scratch[from.y + at]);
            }
        }
    }
    return vec2(count > 0.0f ? sum / count : bumpshadow_bake_hole(), highest);
}

// What cells of a level look at, and their own heights: those of two squares, one above the other.
void bumpshadow_bake_level(int x, int y, int record) {
    ivec4 from = bumpshadow_bake_tables[record];      // means, maxima, floats a row of both
    ivec4 to = bumpshadow_bake_tables[record + 1];    // means, maxima, occluders, cells; -1: not wanted
    ivec4 size = bumpshadow_bake_tables[record + 2];  // squares along x, y; squares of the level below in one
    float bias = intBitsToFloat(bumpshadow_bake_tables[record + 3].x);
    if (x >= size.x || 2 * y >= size.y) {
        return;
    }
    int second = min(2 * y + 1, size.y - 1);
    vec2 above = bumpshadow_bake_square(from, size, x, 2 * y);
    vec2 below = bumpshadow_bake_square(from, size, x, second);
    int at_above = size.x * (2 * y) + x;
    int at_below = size.x * second + x;
    if (to.x >= 0) {
        bumpshadow_bake_scratch[to.x + at_above] = above.x;
        bumpshadow_bake_scratch[to.x + at_below] = below.x;
        bumpshadow_bake_scratch[to.y + at_above] = above.y;
        bumpshadow_bake_scratch[to.y + at_below] = below.y;
    }
    if (to.z >= 0) {
        bumpshadow_bake_scratch[to.z + at_above] = above.x + bias * (above.y - above.x);
        bumpshadow_bake_scratch[to.z + at_below] = below.x + bias * (below.y - below.x);
    }
    float mean = (above.x + below.x) * 0.5f;
    bumpshadow_bake_scratch[to.w + size.x * y + x] = bumpshadow_bake_is_hole(mean) ? max(above.x, below.x) : mean;
}

// ---- Horizons ----

// Column i of a row, which lies within two periods if the edge has one.
float bumpshadow_bake_column(int row, int i, int columns, int edge) {
    int there = clamp(i, 0, columns - 1);
    if (edge != bumpshadow_bake_edge_clamp() && edge != bumpshadow_bake_edge_open()) {
        int period = edge == bumpshadow_bake_edge_mirror() ? 2 * columns : columns;
        int first = i < period ? i : i - period;
        there = min(first, 2 * columns - 1 - first);
    }
    // Beside an open border the surface is taken to go on for two cells, as it is on the CPU.
    bool absent = edge == bumpshadow_bake_edge_open() && (i < -2 || i >= columns + 2);
    return absent ? bumpshadow_bake_hole() : bumpshadow_bake_scratch[row + there];
}

// Height of a row on a lane. at: where the row begins, or -1; columns from the lane on, whole and fraction
float bumpshadow_bake_on_lane(ivec4 at, int lane, int columns, int edge) {
    float height = bumpshadow_bake_hole();
    if (at.x >= 0) {
        float left = bumpshadow_bake_column(at.x, lane + at.y, columns, edge);
        float right = bumpshadow_bake_column(at.x, lane + at.y + 1, columns, edge);
        height = left + (right - left) * intBitsToFloat(at.z);
    }
    return height;
}

// A lane brought into the first period.
int bumpshadow_bake_lane(int lane, int columns, int edge) {
    bool once = edge == bumpshadow_bake_edge_clamp() || edge == bumpshadow_bake_edge_open();
    return once ? lane : bumpshadow_bake_remainder(lane, edge == bumpshadow_bake_edge_mirror() ? 2 * columns : columns);
}

// Weight of a parent, and its pair times that: as far `ahead` along the ray as the row of the parent is behind.
vec3 bumpshadow_bake_corner(int at, float weight, float ahead) {
    float a = bumpshadow_bake_scratch[at];
    float b = bumpshadow_bake_scratch[at + 1];
    float x = b * ahead;
    float factor = weight * (1.0f + x * (1.0f + x * (1.0f + x)));
    bool taken = weight != 0.0f && !bumpshadow_bake_is_hole(a);
    return taken ? vec3(weight, a * factor, b * factor) : vec3(0.0f, 0.0f, 0.0f);
}

// What the parents around a place have seen, as the pair (a, b): the slope of it for a height h is a - b h.
//   row: the second entry of the row; columns / cells: of the parent's lanes, for one of these
vec2 bumpshadow_bake_parents(int row, int x, int cells, int columns) {
    ivec4 at = bumpshadow_bake_tables[row];           // lane 0 of the row above, of that below; lane at x = 0, and rest
    ivec4 weights = bumpshadow_bake_tables[row + 1];  // of the row above, of that below; how far each is to be brought
    int lane = bumpshadow_bake_quotient(x * cells, columns);
    float right = float(x * cells - lane * columns) / float(columns) + intBitsToFloat(at.w);
    lane += at.z;
    if (right >= 1.0f) {
        right -= 1.0f;
        lane += 1;
    }
    float above = intBitsToFloat(weights.x);
    float below = intBitsToFloat(weights.y);
    vec3 sum = bumpshadow_bake_corner(at.x + 2 * lane, (1.0f - right) * above, intBitsToFloat(weights.z));
    sum += bumpshadow_bake_corner(at.x + 2 * lane + 2, right * above, intBitsToFloat(weights.z));
    sum += bumpshadow_bake_corner(at.y + 2 * lane, (1.0f - right) * below, intBitsToFloat(weights.w));
    sum += bumpshadow_bake_corner(at.y + 2 * lane + 2, right * below, intBitsToFloat(weights.w));
    return sum.x > 0.0f ? vec2(sum.y / sum.x, sum.z / sum.x) : vec2(bumpshadow_bake_hole(), 0.0f);
}

// What a cell sees, or its parents where that is higher, as a pair.
void bumpshadow_bake_cell(int x, int y, int record) {
    ivec4 size = bumpshadow_bake_tables[record];       // lanes, rows, entry of the first row, float of the first pair
    ivec4 looks = bumpshadow_bake_tables[record + 1];  // entries of rows of occluders: the first that is seen from the
                                                       // first row, from row to row, from look to look; how many looks
    ivec4 shape = bumpshadow_bake_tables[record + 2];  // occluders along x, cells along x, occluders a lane, edge
    ivec4 more = bumpshadow_bake_tables[record + 3];   // entry of the first distance, whether there are parents
    if (x >= size.x || y >= size.y) {
        return;
    }
    ivec4 row = bumpshadow_bake_tables[size.z + 3 * y];  // of cells, as on_lane takes it; first lane
    int lane = row.w + x;
    float height = bumpshadow_bake_on_lane(row, bumpshadow_bake_lane(lane, shape.y, shape.w), shape.y, shape.w);
    float slope = bumpshadow_bake_hole();
    float inverse = 0.0f;
    int seen = bumpshadow_bake_lane(shape.z * lane, shape.x, shape.w);
    int from = looks.x + looks.y * y;
    for (int i = 0; i < looks.w; ++i) {
        ivec4 distance = bumpshadow_bake_tables[more.x + i];  // inverse, and the one that is noted
        float there = bumpshadow_bake_on_lane(bumpshadow_bake_tables[from + looks.z * i], seen, shape.x, shape.w);
        float rise = (there - height) * intBitsToFloat(distance.x);
        if (rise > slope) {
            slope = rise;
            inverse = intBitsToFloat(distance.y);
        }
    }
    vec2 found = vec2(inverse * height + slope, inverse);
    if (more.y != 0) {
        vec2 theirs = bumpshadow_bake_parents(size.z + 3 * y + 1, lane, 1, 2);
        if (theirs.x - theirs.y * height > slope) {
            found = theirs;
        }
    }
    if (bumpshadow_bake_is_hole(height) || bumpshadow_bake_is_hole(found.x)) {
        found = vec2(bumpshadow_bake_hole(), 0.0f);
    }
    int to = size.w + 2 * (size.x * y + x);
    bumpshadow_bake_scratch[to] = found.x;
    bumpshadow_bake_scratch[to + 1] = found.y;
}

// Slope of the horizon of a texel.
void bumpshadow_bake_texel(int x, int y, int record) {
    ivec4 size = bumpshadow_bake_tables[record];         // texels along x, y; float of texel (0, 0), floats a row
    ivec4 to = bumpshadow_bake_tables[record + 1];       // slopes: first, along x, along y; the least slope
    ivec4 looks = bumpshadow_bake_tables[record + 2];    // crossings of rows: first entry, count; others: the same
    ivec4 parents = bumpshadow_bake_tables[record + 3];  // cells / columns of the parents' lanes, entry of the first
                                                         // row, whether there are parents
    if (x >= size.x || y >= size.y) {
        return;
    }
    int at = size.z + size.w * y + x;
    float height = bumpshadow_bake_scratch[at];
    float slope = intBitsToFloat(to.w);
    for (int i = 0; i < looks.y; ++i) {
        ivec4 look = bumpshadow_bake_tables[looks.x + i];  // offset, weights of two neighbors, inverse distance
        float rise = bumpshadow_bake_scratch[at + look.x] * intBitsToFloat(look.y) - height * intBitsToFloat(look.w);
        slope = max(slope, bumpshadow_bake_scratch[at + look.x + 1] * intBitsToFloat(look.z) + rise);
    }
    for (int j = 0; j < looks.w; ++j) {
        ivec4 offsets = bumpshadow_bake_tables[looks.z + 3 * j];  // of four corners
        ivec4 weights = bumpshadow_bake_tables[looks.z + 3 * j + 1];
        float rise = -height * intBitsToFloat(bumpshadow_bake_tables[looks.z + 3 * j + 2].x);
        rise += bumpshadow_bake_scratch[at + offsets.x] * intBitsToFloat(weights.x);
        rise += bumpshadow_bake_scratch[at + offsets.y] * intBitsToFloat(weights.y);
        rise += bumpshadow_bake_scratch[at + offsets.z] * intBitsToFloat(weights.z);
        rise += bumpshadow_bake_scratch[at + offsets.w] * intBitsToFloat(weights.w);
        slope = max(slope, rise);
    }
    if (parents.w != 0) {
        int row = parents.z + 3 * y;
        vec2 theirs = bumpshadow_bake_parents(row + 1, x, parents.x, parents.y);
        // Inverse of the distance at which the ray leaves an open map; 0 for others.
        float leaves = intBitsToFloat(bumpshadow_bake_tables[row].x);
        float sideways = intBitsToFloat(bumpshadow_bake_tables[record + 4].x);
        if (sideways != 0.0f) {
            int way = sideways > 0.0f ? size.x - 1 - x : x;
            leaves = max(leaves, way > 0 ? abs(sideways) / float(way) : bumpshadow_bake_inverse_of_zero());
        }
        if (leaves <= theirs.y) {
            slope = max(slope, theirs.x - theirs.y * height);
        }
    }
    if (bumpshadow_bake_is_hole(height) || bumpshadow_bake_is_hole(slope)) {
        slope = bumpshadow_bake_no_horizon();
    }
    bumpshadow_bake_slopes[to.x + to.y * x + to.z * y] = slope;
}

// One invocation. kind, first: the first two constants of the dispatch
void bumpshadow_bake(int kind, int first, ivec3 id) {
    int record = first + 5 * id.z;
    if (kind == 0) {
        bumpshadow_bake_ground(id.x, id.y, record);
    } else if (kind == 1) {
        bumpshadow_bake_base(id.x, id.y, record);
    } else if (kind == 2) {
        bumpshadow_bake_level(id.x, id.y, record);
    } else if (kind == 3) {
        bumpshadow_bake_cell(id.x, id.y, record);
    } else {
        bumpshadow_bake_texel(id.x, id.y, record);
    }
}

void main() {
#ifdef BUMPSHADOW_BAKE_KIND
    int kind = BUMPSHADOW_BAKE_KIND;
#else
    int kind = bumpshadow_bake_dispatch.x;
#endif
    bumpshadow_bake(kind, bumpshadow_bake_dispatch.y, ivec3(gl_GlobalInvocationID));
}
