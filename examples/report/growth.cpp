// How the time of a bake grows with the extent of the map, with the bearings and with the range.

#include "report/growth.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/report_text.hpp"
#include "report/baking.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr int usual_bearings = 8;
// Seconds that a call takes at the most, in round numbers, and that a small bake is repeated for at each turn.
constexpr double longest_call = 0.8, shortest_turn = 0.02;

// Texels that are looked at one by one, beyond which levels of cells begin: all that a radius of so many leaves.
double near_radius() { return bs::bake_options{}.steps; }

// One thing that is measured.
struct point {
    method how = method::cascade;
    int extent = 0, bearings = usual_bearings;
    double radius = infinite;  // texels
    int turns = 1;
    double best = infinite;  // seconds

    // Calls of a bake, so that none takes much longer than a second: the classic sweep shares nothing between bearings
    // but a copy of the heights.
    [[nodiscard]] int bearings_a_call() const {
        if (how != method::sweep_classic) return bearings;
        const double seconds = double(extent) * extent * bearings * 20e-9;
        const int calls = std::clamp(int(std::ceil(seconds / longest_call)), 1, bearings);
        return (bearings + calls - 1) / calls;
    }
    [[nodiscard]] int calls() const { return (bearings + bearings_a_call() - 1) / bearings_a_call(); }
    [[nodiscard]] std::string name() const {
        std::string text = name_of(how);
        text += format(", %d texels, %d bearings", extent, bearings);
        return std::isinf(radius) ? text : text + format(", radius %.0f", radius);
    }
};

struct point_series {
    const char* of;  // what changes
    std::vector<point> points;
};

// The classic is there for comparison, at fewer turns; only the cascade is held to something.
std::vector<point_series> all_points(const report_context& context) {
    // On maps of 128 texels what the cascade does once a map and what it sees beyond the border are as much as the
    // rest; over a short range of extents that alone would bend the line.
    const std::vector<int> extents =
        context.quick ? std::vector{256, 512, 1024} : std::vector{128, 256, 512, 1024, 2048, 4096};
    const int extent = context.quick ? 512 : 1024;
    const int turns = context.repeats, fewer = std::max(1, turns / 2);
    point_series by_extent{"extent", {}}, by_bearings{"bearings", {}}, by_range{"range", {}};
    for (const int e : extents) {
        by_extent.points.push_back({.extent = e, .turns = turns});
        by_extent.points.push_back({.how = method::sweep_classic, .extent = e, .turns = e < 4096 ? fewer : 1});
    }
    for (const int b : {4, 8, 16, 32, 64}) {
        by_bearings.points.push_back({.extent = extent, .bearings = b, .turns = turns});
        by_bearings.points.push_back(
            {.how = method::sweep_classic, .extent = extent, .bearings = b, .turns = b < 64 ? fewer : 1});
    }
    for (const double radius : {infinite, near_radius()})
        by_range.points.push_back({.extent = 1024, .radius = radius, .turns = 2 * turns});
    return {by_extent, by_bearings, by_range};
}

// Cut from the map, or laid side by side: texels are as rough and as steep at any extent, and only the range and the
// memory grow. A larger or smaller picture of the same map would be smoother or rougher by the texel.
height_samples laid_out(const height_samples& map, int extent) {
    height_samples result;
    result.extent = glm::ivec2(extent);
    std::visit(
        [&]<class Sample>(const std::vector<Sample>& from) {
            const auto side = std::size_t(extent);
            std::vector<Sample> to(side * side);
            for (std::size_t y = 0; y < side; ++y)
                for (std::size_t x = 0; x < side; ++x)
                    to[y * side + x] =
                        from[y % std::size_t(map.extent.y) * std::size_t(map.extent.x) + x % std::size_t(map.extent.x)];
            result.samples = std::move(to);
        },
        map.samples);
    return result;
}

// A map with a baker of its own.
struct oven {
    height_samples heights;
    baker bake;

    oven(const report_map& map, int extent, int bearings)
        : heights(laid_out(map.heights, extent)), bake(heights, map.source, map.scale, bearings) {}
};

class bench {
public:
    explicit bench(const report_context& context) : context_(context), map_(context.maps.front()) {}

    void run() const {
        for (point_series& series : all_points(context_)) {
            measure(series.points);
            for (const point& p : series.points) add(p, series.of);
            if (std::string(series.of) == "range") continue;
            for (const method how : {method::cascade, method::sweep_classic}) add_exponent(how, series);
        }
    }

private:
    // The least of some turns, in time of the processor: what disturbs a measurement makes it longer. By turns, so that
    // it disturbs all alike; everything is allocated and written to before.
    void measure(std::vector<point>& points) const {
        std::map<int, std::unique_ptr<oven>> ovens;  // by extent
        int turns = 0;
        for (const point& p : points) {
            int most = 0;
            for (const point& other : points)
                if (other.extent == p.extent) most = std::max(most, other.bearings);
            std::unique_ptr<oven>& o = ovens[p.extent];
            if (o == nullptr) o = std::make_unique<oven>(map_, p.extent, most);
            o->bake.reserve({.how = p.how, .radius = p.radius});
            turns = std::max(turns, p.turns);
        }
        for (int turn = 0; turn < turns; ++turn)
            for (point& p : points)
                if (turn < p.turns) take_turn(p, ovens.at(p.extent)->bake);
    }

    void take_turn(point& p, baker& oven) const {
        const bake_setup setup{.how = p.how, .radius = p.radius};
        const auto part = std::size_t(p.bearings_a_call()), all = std::size_t(p.bearings);
        double spent = 0.0;
        for (bool first = true; first || spent < shortest_turn; first = false) {
            double seconds = 0.0;
            for (std::size_t from = 0; from < all; from += part) {
                if (first) context_.step(p.name());
                const std::clock_t start = std::clock();
                oven.bake(setup, from, std::min(part, all - from));
                seconds += double(std::clock() - start) / CLOCKS_PER_SEC;
            }
            p.best = std::min(p.best, seconds);
            spent += seconds;
        }
    }

    record record_of(method how, const char* of) const {
        record r;
        r.section = "growth";
        r.map = map_.name;
        r.family = name_of(how);
        r.family.append(", ").append(of);
        r[column::threads] = 1;
        if (how == method::cascade) r[column::steps] = bs::bake_options{}.steps;
        return r;
    }

    void add(const point& p, const char* of) const {
        record r = record_of(p.how, of);
        r.name = of;
        r.name.append(": ").append(p.name());
        // What stays the same is in the name: plots take what has an extent.
        if (std::string(of) == "extent") r[column::extent] = p.extent;
        r[column::bearings] = p.bearings;
        r[column::radius] = p.radius;
        r[column::bake_ns] = p.best * 1e9 / (double(p.extent) * p.extent * p.bearings);
        context_.add(r);
    }

    void add_exponent(method how, const point_series& series) const {
        const bool of_extent = std::string(series.of) == "extent";
        std::vector<double> x, y;
        for (const point& p : series.points) {
            if (p.how != how) continue;
            x.push_back(of_extent ? double(p.extent) * p.extent : double(p.bearings));
            y.push_back(p.best);
        }
        record r = record_of(how, series.of);
        r.name = name_of(how);
        r.name.append(", exponent in ").append(of_extent ? "texels" : "bearings");
        r[column::exponent] = fitted_exponent(x, y);
        context_.add(r);
    }

    const report_context& context_;
    const report_map& map_;
};

int steps_of(const report_context& context) {
    int steps = 0;
    for (const point_series& series : all_points(context))
        for (const point& p : series.points) steps += p.turns * p.calls();
    return steps;
}

}  // namespace

double fitted_exponent(std::span<const double> x, std::span<const double> y) {
    const auto count = double(x.size());
    double sum_x = 0.0, sum_y = 0.0, square = 0.0, product = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        const double u = std::log(x[i]), v = std::log(y[i]);
        sum_x += u;
        sum_y += v;
        square += u * u;
        product += u * v;
    }
    return (count * product - sum_x * sum_y) / (count * square - sum_x * sum_x);
}

std::string text_of(const growth_check& check) {
    return (check.held() ? "held: " : "NOT held: ") + check.what + format(": %.4g", check.value);
}

std::vector<growth_check> checks_of_growth(std::span<const record> records) {
    std::vector<growth_check> checks;
    double unlimited = std::numeric_limits<double>::quiet_NaN(), limited = unlimited;
    for (const record& r : records) {
        if (r.section != "growth") continue;
        for (const char* in : {"texels", "bearings"})
            if (r.name == std::string("cascade, exponent in ").append(in))
                checks.push_back(
                    {std::string("cascade: exponent of the time in ").append(in), r[column::exponent], 0.9, 1.1});
        if (r.family == "cascade, range") (std::isinf(r[column::radius]) ? unlimited : limited) = r[column::bake_ns];
    }
    if (const double ratio = unlimited / limited; ratio == ratio)
        checks.push_back(
            {format("cascade: time of unlimited range over that of a radius of %.0f texels", near_radius()), ratio, 0.0,
             2.0});
    return checks;
}

report_section growth_section() {
    return {.name = "growth",
            .title = "How the time grows: extent, bearings, range",
            .steps = steps_of,
            .seconds = [](const report_context& context) { return context.quick ? 2.5 : 25.0; },
            .run = [](const report_context& context) { bench(context).run(); }};
}

}  // namespace examples
