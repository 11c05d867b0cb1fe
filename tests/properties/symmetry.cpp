// Maps that are transposed, mirrored and turned, and maps that are symmetric in themselves.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>

#include "properties/maps.hpp"

namespace properties {
namespace {

namespace bs = bumpshadow;

enum class motion { transposed, mirrored, turned };
const char* const motion_names[] = {"transposed", "mirrored", "turned"};

struct moved {
    world map;
    list directions;
};

// Where a texel goes: turned is a quarter from +x towards +y.
glm::ivec2 place(motion by, glm::ivec2 n, int x, int y) {
    switch (by) {
        case motion::transposed: return {y, x};
        case motion::mirrored: return {n.x - 1 - x, y};
        case motion::turned: break;
    }
    return {n.y - 1 - y, x};
}

moved move(const world& w, const list& directions, motion by) {
    moved m{w, {}};
    if (by != motion::mirrored) {
        m.map.extent = {w.extent.y, w.extent.x};
        m.map.texel_size = {w.texel_size.y, w.texel_size.x};
    }
    for (int y = 0; y < w.extent.y; ++y)
        for (int x = 0; x < w.extent.x; ++x) {
            const glm::ivec2 to = place(by, w.extent, x, y);
            m.map.at(to.x, to.y) = w.at(x, y);
        }
    for (const glm::dvec2 d : directions)
        m.directions.push_back(by == motion::transposed ? glm::dvec2(d.y, d.x)
                               : by == motion::mirrored ? glm::dvec2(-d.x, d.y)
                                                        : glm::dvec2(-d.y, d.x));
    return m;
}

// visit(slope of w, slope of the moved map) for every texel and direction.
template <class Visit>
void compare(const world& w, const list& directions, method which, motion by, const Visit& visit) {
    const moved m = move(w, directions, by);
    const slopes here = bake(which, w.view(), directions), there = bake(which, m.map.view(), m.directions);
    const std::size_t slice = w.samples.size();
    for (std::size_t i = 0; i < directions.size(); ++i)
        for (int y = 0; y < w.extent.y; ++y)
            for (int x = 0; x < w.extent.x; ++x) {
                const glm::ivec2 to = place(by, w.extent, x, y);
                visit(here[i * slice + w.index(x, y)], there[i * slice + m.map.index(to.x, to.y)]);
            }
}

enum class kind { any, off_diagonals, diagonals, own, own_axes };
const char* const kind_names[] = {"any map", "any map, off cells' diagonals", "any map, along cells' diagonals",
                                  "symmetric in itself", "symmetric in itself, along axes"};

bool along_diagonal(const world& w, glm::dvec2 d) {
    const double x = std::abs(d.x) / w.texel_size.x, y = std::abs(d.y) / w.texel_size.y;
    return std::abs(x - y) <= 1e-6 * (x + y);
}

// What holds: bits where the bound is 0, else the mean of differences in degrees.
//   heights are taken above the first texel that is no hole; where that is texel (0, 0) it stays so when transposed
//   exact walks the same way whatever axis and sign a direction has, but on the diagonal, where it takes one of both;
//     blocks that it may jump over lie elsewhere in a mirrored map, and leave out what is higher by rounding alone
//   the cascade turns steep directions into flat ones of the transposed map; on the diagonal between them it does not,
//     and cuts cells and lanes from the first texel on, so that other motions show as much as its errors, twice:
//     less than 2 * 0.5 and 2 * 0.15 degrees (tests/stability), of which the ceilings here are a part. Maps that are
//     symmetric in themselves are no exception
//   sweeps count lines from the first column on; their bound is 2 * 0.15. Along axes lines are rows and columns
//   the neighborhood adds up five sines from first to last, of heights above another first texel
struct claim {
    method which;
    motion by;
    kind of;
    double mean;
};
constexpr claim claims[] = {
    {method::exact, motion::transposed, kind::off_diagonals, 0.0},
    {method::exact, motion::transposed, kind::diagonals, 1e-12},
    {method::exact, motion::mirrored, kind::any, 1e-12},
    {method::exact, motion::turned, kind::any, 1e-12},
    {method::cascade, motion::transposed, kind::off_diagonals, 0.0},
    {method::cascade, motion::transposed, kind::diagonals, 0.5},
    {method::cascade, motion::mirrored, kind::any, 0.05},
    {method::cascade, motion::turned, kind::any, 0.05},
    {method::cascade, motion::mirrored, kind::own, 0.05},
    {method::fine, motion::transposed, kind::off_diagonals, 0.0},
    {method::fine, motion::transposed, kind::diagonals, 0.3},
    {method::fine, motion::mirrored, kind::any, 0.02},
    {method::fine, motion::turned, kind::any, 0.02},
    {method::fine, motion::mirrored, kind::own, 0.02},
    {method::sweep, motion::transposed, kind::off_diagonals, 1e-5},
    {method::sweep, motion::transposed, kind::diagonals, 0.3},
    {method::sweep, motion::mirrored, kind::any, 0.3},
    {method::sweep, motion::turned, kind::any, 0.3},
    {method::sweep, motion::mirrored, kind::own_axes, 0.0},
    {method::sweep_classic, motion::transposed, kind::off_diagonals, 0.0},
    {method::sweep_classic, motion::mirrored, kind::own_axes, 0.0},
    {method::neighborhood, motion::transposed, kind::any, 1e-4},
    {method::neighborhood, motion::mirrored, kind::any, 1e-4},
    {method::neighborhood, motion::turned, kind::any, 1e-4},
};

// Directions of a random list that are of the kind; at least one.
list chosen(const world& w, kind of) {
    if (of == kind::own_axes) return {{1.0, 0.0}, {-1.0, 0.0}, {0.0, 1.0}, {0.0, -1.0}};
    if (of == kind::diagonals) return {w.texel_size, -w.texel_size, {-w.texel_size.x, w.texel_size.y}};
    list directions = *any_directions(4, true);
    if (of == kind::off_diagonals) std::erase_if(directions, [&](glm::dvec2 d) { return along_diagonal(w, d); });
    if (directions.empty()) directions.emplace_back(1.0, 0.0);
    return directions;
}

}  // namespace

bool check_symmetry() {
    bool all = true;
    std::printf(
        "\nMaps that are moved, and their horizons with them: differences in degrees\n\n"
        "| method | motion | of | horizons | other bits | share above 0.01 | mean | largest | promised mean | |\n"
        "| --- | --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n");
    for (const claim& c : claims) {
        angles differences;
        std::size_t bits = 0;
        std::string name = name_of(c.which);
        name.append(", ").append(motion_names[int(c.by)]).append(", ").append(kind_names[int(c.of)]);
        const bool ran = holds(name, [&] {
            world w = *any_world({.extent = c.which == method::exact ? glm::ivec2(12, 12) : glm::ivec2(48, 48)});
            if (c.by == motion::transposed && w.at(0, 0) == hole) w.at(0, 0) = 0.0f;
            if (c.of == kind::own || c.of == kind::own_axes)
                for (int y = 0; y < w.extent.y; ++y)
                    for (int x = 0; x < w.extent.x / 2; ++x) w.at(w.extent.x - 1 - x, y) = w.at(x, y);
            compare(w, chosen(w, c.of), c.which, c.by, [&](float a, float b) {
                // NOLINTNEXTLINE(bugprone-suspicious-memory-comparison): bit for bit
                const bool same = std::memcmp(&a, &b, sizeof a) == 0;
                bits += same ? 0 : 1;
                differences.add(std::abs(degrees(a) - degrees(b)), 0.01);
                if (c.mean == 0.0) RC_ASSERT(same);
            });
        });
        const bool held = ran && differences.mean() <= c.mean;
        char promised[16];
        std::snprintf(promised, sizeof promised, "%g", c.mean);
        std::printf("| %s | %s | %s | %zu | %zu | %.3f %% | %.2g | %.2g | %s | %s |\n", name_of(c.which),
                    motion_names[int(c.by)], kind_names[int(c.of)], differences.count, bits,
                    100.0 * differences.share(), differences.mean(), differences.largest,
                    c.mean == 0.0 ? "bit for bit" : promised, held ? "held" : "BROKEN");
        std::fflush(stdout);
        all = all && held;
    }
    std::printf("\n");
    return all;
}

}  // namespace properties
