// What happens to horizons when heights or directions change.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include <bumpshadow/height_bounds.hpp>

#include "properties/maps.hpp"

namespace properties {
namespace {

namespace bs = bumpshadow;

struct change {
    glm::ivec2 texel;
    float by;
};

// A texel that is no hole becomes higher.
change any_change(const world& w) {
    const int x = *rc::gen::resize(100, rc::gen::inRange(0, w.extent.x)),
              y = *rc::gen::resize(100, rc::gen::inRange(0, w.extent.y));
    RC_PRE(w.at(x, y) != hole);
    return {{x, y}, float(*rc::gen::resize(100, rc::gen::inRange(1, 200))) / 8.0f};
}

// ---- Raising a texel ----

// Exact horizons of other texels do not fall. The surface between texels is nowhere lower than before, so that only
// what exact_horizon() states of itself is left: 1e-12 of the slope and 1e-15 of the range of heights a texel, or 1e-7
// where an endless ray is cut short. The base, flat, round or hollow, stays as it is.
bool raising_lights_nothing() {
    return holds("exact: raising one texel lights no other", [] {
        world w = *any_world({.extent = {16, 16}});
        const list directions = *any_directions(3, true);
        const change c = any_change(w);
        const int sample = std::max(1, w.extent.x * w.extent.y / 24);
        const double radius = *rc::gen::element(std::numeric_limits<double>::infinity(), 5.3);
        glm::dvec2 curvature = *rc::gen::element(glm::dvec2(0.0), glm::dvec2(0.02, 0.0), glm::dvec2(0.3, -0.1));
        if (!std::isfinite(radius)) curvature.y = 0.0;  // hollow bases need a radius
        world raised = w;
        raised.at(c.texel.x, c.texel.y) += c.by;
        const auto [low, high] = std::minmax_element(raised.samples.begin(), raised.samples.end());
        const double range = double(*high) - double(*low);
        const double rounding = std::isfinite(radius) ? 1e-15 : 1e-7;
        const double allowed = rounding * range / std::min(w.texel_size.x, w.texel_size.y);
        for (int i = 0; i < w.extent.x * w.extent.y; i += sample) {
            const glm::ivec2 p(i % w.extent.x, i / w.extent.x);
            if (p == c.texel || w.at(p.x, p.y) == hole) continue;
            for (const glm::dvec2 d : directions) {
                const double before = bs::exact_horizon(w.view(), p, d, radius, curvature).slope;
                const double after = bs::exact_horizon(raised.view(), p, d, radius, curvature).slope;
                RC_ASSERT(after >= before - 1e-12 * std::abs(before) - allowed);
            }
        }
    });
}

// The fast methods look at means, cells and lines, whose choice of occluder can change for the worse. In exact nothing
// falls, so that what falls here is at most the sum of the errors before and after: in the mean twice what
// tests/stability states, 1 and 0.3 degrees. These ceilings are far below that, some times what a million horizons of
// small maps came to. The neighborhood takes a largest slope over texels, which cannot fall, but for heights that are
// rounded anew where the texel is reference_texel().
struct ceiling {
    method which;
    double share, mean;  // of all horizons; degrees
};
constexpr ceiling ceilings[] = {{method::cascade, 0.005, 0.005},
                                {method::fine, 0.002, 0.001},
                                {method::sweep, 0.0001, 1e-5},
                                {method::sweep_classic, 0.05, 0.5},
                                {method::neighborhood, 0.0, 1e-4}};

bool raising_in_fast_methods() {
    constexpr double worth_mentioning = 0.01;
    bool all = true;
    std::printf(
        "\nHorizons that fall where another texel rises: share above %.2f degrees, means, largest\n\n"
        "| method | horizons | share | mean | mean of those | largest | ceiling: share, mean | |\n"
        "| --- | ---: | ---: | ---: | ---: | ---: | ---: | --- |\n",
        worth_mentioning);
    for (const ceiling& limit : ceilings) {
        angles falls;
        double sum_above = 0.0;
        const bool ran = holds(std::string(name_of(limit.which)) + ": raising one texel", [&] {
            world w = *any_world({.extent = {40, 40}});
            const list directions = *any_directions(4);
            const change c = any_change(w);
            const slopes before = bake(limit.which, w.view(), directions);
            w.at(c.texel.x, c.texel.y) += c.by;
            const slopes after = bake(limit.which, w.view(), directions);
            for (std::size_t i = 0; i < before.size(); ++i) {
                if (i % w.samples.size() == w.index(c.texel.x, c.texel.y)) continue;
                const double fall = std::max(0.0, degrees(before[i]) - degrees(after[i]));
                falls.add(fall, worth_mentioning);
                if (fall > worth_mentioning) sum_above += fall;
                if (limit.which == method::neighborhood) RC_ASSERT(fall <= limit.mean);
            }
        });
        const bool held = ran && falls.share() <= limit.share && falls.mean() <= limit.mean;
        std::printf("| %s | %zu | %.4f %% | %.2g | %.2g | %.2g | %g %%, %g | %s |\n", name_of(limit.which), falls.count,
                    100.0 * falls.share(), falls.mean(), falls.above == 0 ? 0.0 : sum_above / double(falls.above),
                    falls.largest, 100.0 * limit.share, limit.mean, held ? "held" : "BROKEN");
        std::fflush(stdout);
        all = all && held;
    }
    std::printf("\n");
    return all;
}

// ---- Twice the heights ----

// True where the reach of a cascade depends on the relief: on maps that repeat it looks for slopes of 1/1024 and
// steeper, at most 4096 texels far on maps as small as these.
bool shallow(method which, const bs::height_map<float>& map, const world& w) {
    if (which != method::cascade && which != method::fine) return false;
    if (map.edge != bs::edge_mode::repeat && map.edge != bs::edge_mode::mirror) return false;
    float low = std::numeric_limits<float>::max(), high = -low;
    for (const float h : w.samples)
        if (h != hole) low = std::min(low, h), high = std::max(high, h);
    const double relief = double(high - low) * std::abs(map.height_scale);
    return relief > 0.0 && 1024.0 * relief < 2.0 * 4096.0 * (w.texel_size.x + w.texel_size.y);
}

// All that is done to heights on the way to a slope is sums, differences, products with other numbers and comparisons,
// which doubling passes through. The neighborhood averages sines, whose slope does not double, and is left out. So are
// cascades whose reach would double with the relief.
bool doubling() {
    bool all = true;
    for (const method which : all_methods) {
        if (which == method::neighborhood) continue;
        const auto property = [&] {
            world w = *any_world({.extent = which == method::exact ? glm::ivec2(12, 12) : glm::ivec2(60, 60)});
            const list directions = *any_directions(3, which == method::exact);
            bs::height_map<float> map = w.view();
            map.height_scale = *rc::gen::element(1.0, 0.3, -1.0, 1e6, 1e-6);
            if (shallow(which, map, w)) map.height_scale = 0.7e6;
            RC_PRE(!shallow(which, map, w));
            slopes expected = bake(which, map, directions);
            for (float& s : expected)
                if (s != bs::no_horizon) s *= 2.0f;
            map.height_scale *= 2.0;
            RC_ASSERT(differing(bake(which, map, directions), expected) == 0u);
            map.height_scale *= 0.5;
            for (float& h : w.samples) h *= 2.0f;
            if (map.no_data) map.no_data = 2.0f * hole;
            RC_ASSERT(differing(bake(which, map, directions), expected) == 0u);
        };
        all =
            holds(std::string(name_of(which)) + ": twice the heights, twice the slopes, bit for bit", property) && all;
    }
    return all;
}

// ---- Directions of any length ----

// Bit for bit for powers of two, which change no quotient of components; others round it, which moves places between
// texels by 1e-16 of their distance.
bool lengths() {
    bool all = true;
    for (const method which : all_methods)
        all = holds(std::string(name_of(which)) + ": directions of any length",
                    [&] {
                        const glm::ivec2 most = which == method::exact ? glm::ivec2(10, 10) : glm::ivec2(40, 40);
                        const world w = *any_world({.extent = most});
                        list directions = *any_directions(3, which == method::exact);
                        const slopes expected = bake(which, w.view(), directions);
                        const int power = *rc::gen::resize(100, rc::gen::inRange(-900, 900));
                        for (glm::dvec2& d : directions) d *= std::ldexp(1.0, power);
                        RC_ASSERT(differing(bake(which, w.view(), directions), expected) == 0u);
                    }) &&
              all;
    return all;
}

}  // namespace

bool check_heights() {
    const bool checks[] = {raising_lights_nothing(), raising_in_fast_methods(), doubling(), lengths()};
    return std::all_of(std::begin(checks), std::end(checks), [](bool held) { return held; });
}

}  // namespace properties
