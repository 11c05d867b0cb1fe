#include "report/plots.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "report/columns.hpp"
#include "report/pareto.hpp"
#include "report/tables.hpp"

namespace examples {
namespace {

enum class scale { linear, decimal, binary };  // marks of a logarithmic axis: 1 2 5 10, or powers of two

enum class front_kind {
    pareto,  // few of x and little of y
    best,    // the least y at each x, which is no cost
    nothing,
};

// What a line goes through where its family was measured more than once at one x.
enum class line_kind { none, least, largest };

struct plot_kind {
    const char* name;
    const char* title;
    column x, y;
    const char *x_label, *y_label;
    scale x_scale, y_scale;
    line_kind lines;
    front_kind front;
    const char* about;  // in the subtitle
};

constexpr const char* mismatch_label = "mismatch: texels and lights that are wrong, %";

constexpr const char* best_line = "lines: the best of each family";
constexpr const char* growth_label = "bake time, ns a sample (of this machine)";

constexpr plot_kind kinds[] = {
    {"bake", "Baking: error against time", column::bake_ns, column::error_mean,
     "bake time, ns a sample (one thread; of this machine)", "mean error of the horizon's elevation, degrees",
     scale::decimal, scale::decimal, line_kind::none, front_kind::pareto, ""},
    {"bytes", "Encodings: mismatch against memory", column::bytes, column::mismatch, "bytes a texel", mismatch_label,
     scale::binary, scale::decimal, line_kind::none, front_kind::pareto, ""},
    {"gpu", "Encodings: mismatch against cost of the shader", column::gpu, column::mismatch,
     "inverse throughput on RDNA2, cycles a wave, less the empty shader", mismatch_label, scale::linear, scale::decimal,
     line_kind::none, front_kind::pareto, ""},
    {"elevation", "Encodings: mismatch against elevation of the light", column::elevation, column::mismatch,
     "elevation of the light, degrees", mismatch_label, scale::linear, scale::decimal, line_kind::least,
     front_kind::best, best_line},
    {"bearings", "Encodings: mismatch against bearings", column::bearings, column::mismatch, "bearings", mismatch_label,
     scale::binary, scale::decimal, line_kind::least, front_kind::pareto, best_line},
    {"triangles", "Bearings a vertex: mismatch against size of the triangle", column::triangle, column::mismatch,
     "side of a triangle over the height of the light above it", mismatch_label, scale::decimal, scale::decimal,
     line_kind::largest, front_kind::nothing, "light interpolated from the vertices, the worst light"},
    {"growth-extent", "Baking: time a sample against extent of the map", column::extent, column::bake_ns,
     "side of the map, texels", growth_label, scale::binary, scale::linear, line_kind::least, front_kind::nothing,
     "one thread"},
    {"growth-bearings", "Baking: time a sample against bearings", column::bearings, column::bake_ns, "bearings",
     growth_label, scale::binary, scale::linear, line_kind::least, front_kind::nothing, "one thread"},
};

bool is_wanted(const record& r, const plot_kind& kind) {
    if (!r.skipped.empty() || !r.has(kind.x) || !r.has(kind.y)) return false;
    if (std::isinf(r[kind.x]) || std::isinf(r[kind.y])) return false;
    if (kind.x == column::triangle) return r.section == "triangle";
    if (kind.front == front_kind::nothing)
        return r.section == "growth" && r.family.ends_with(kind.x == column::extent ? ", extent" : ", bearings");
    // Elsewhere lights or the truth are others, so that a mismatch is not comparable.
    if (kind.y == column::mismatch && r.section != "encoding" && r.section != "codebook") return false;
    // What is judged by the horizons within a radius answers another question.
    if (kind.y == column::error_mean && std::isfinite(r[column::radius])) return false;
    if (kind.x == column::bake_ns && r.has(column::threads) && r[column::threads] != 1.0) return false;
    return (kind.x == column::elevation) == r.has(column::elevation);
}

// The records of the mean, or of the first map that has any.
std::vector<const record*> choose(const findings& all, const plot_kind& kind) {
    std::string map;
    bool is_first = true;
    for (const record& r : all.records) {
        if (!is_wanted(r, kind)) continue;
        if (is_first || r.map == mean_map) map = r.map;
        is_first = false;
    }
    std::vector<const record*> chosen;
    for (const record& r : all.records)
        if (is_wanted(r, kind) && r.map == map) chosen.push_back(&r);
    return chosen;
}

// In the section growth families say what grows, too: "cascade, extent".
std::string series_of(const record& r) {
    return r.section == "growth" ? r.family.substr(0, r.family.rfind(", ")) : r.family;
}

// Methods and encodings never meet in a plot, so each count from zero.
std::map<std::string, std::size_t> styles_of(const findings& all) {
    std::set<std::string> encodings;
    for (const record& r : all.records)
        if (r.has(column::mismatch)) encodings.insert(r.family);
    std::map<std::string, std::size_t> styles;
    std::size_t methods = 0, others = 0;
    for (const record& r : all.records)
        if (const std::string family = series_of(r); !styles.contains(family))
            styles[family] = encodings.contains(family) ? others++ : methods++;
    return styles;
}

// 1, 2 and 5 times powers of ten, or powers of two; fewer where they would stand too close.
std::vector<double> marks_between(double low, double high, scale how) {
    std::vector<double> marks;
    if (how == scale::binary) {
        const double step = std::log2(high / low) > 10.0 ? 2.0 : 1.0;
        for (double power = std::ceil(std::log2(low) / step) * step; std::exp2(power) <= high; power += step)
            marks.push_back(std::exp2(power));
        return marks;
    }
    const double decades = std::log10(high / low);
    for (double power = std::pow(10.0, std::floor(std::log10(low))); power <= high; power *= 10.0)
        for (const double digit : {1.0, 2.0, 5.0}) {
            const double mark = power * digit;
            if (mark >= low && mark <= high && (digit == 1.0 || decades < 3.5)) marks.push_back(mark);
        }
    return marks;
}

// `values` are those of the points that are drawn.
plot_axis make_axis(plot_axis axis, scale how, const std::vector<double>& values) {
    double low = std::numeric_limits<double>::infinity(), high = 0.0;
    for (const double value : values) low = std::min(low, value), high = std::max(high, value);
    if (!(low <= high)) return axis;
    if (!axis.is_logarithmic) {
        axis.high = high > 0.0 ? 1.05 * high : 1.0;
        return axis;
    }
    // Room for the numbers at the outermost points.
    const double room = std::pow(high / low, 0.06) * 1.15;
    axis.low = low / room;
    axis.high = high * room;
    axis.marks = marks_between(axis.low, axis.high, how);
    return axis;
}

// By growing x, one point for each.
std::vector<plot_point> one_at_each(std::vector<plot_point> points, line_kind which) {
    const double sign = which == line_kind::largest ? -1.0 : 1.0;
    std::stable_sort(points.begin(), points.end(), [&](const plot_point& a, const plot_point& b) {
        return a.x < b.x || (a.x == b.x && sign * a.y < sign * b.y);
    });
    const auto same = [](const plot_point& a, const plot_point& b) { return a.x == b.x; };
    points.erase(std::unique(points.begin(), points.end(), same), points.end());
    return points;
}

std::vector<plot_point> front_of(const std::vector<plot_point>& points, front_kind kind) {
    if (kind == front_kind::nothing) return {};
    if (kind == front_kind::best) return one_at_each(points, line_kind::least);
    std::vector<cost_pair> costs;
    for (const plot_point& p : points) costs.push_back({p.x, p.y});
    std::vector<plot_point> front;
    for (const std::size_t i : pareto_front(costs)) front.push_back(points[i]);
    return front;
}

plot make_plot(const findings& all, const plot_kind& kind, const std::vector<const record*>& records,
               const std::map<std::string, std::size_t>& styles) {
    plot result;
    result.name = kind.name;
    result.title = kind.title;
    result.has_lines = kind.lines != line_kind::none;
    result.subtitle = records.front()->map.empty() ? "" : title_of(all, records.front()->map);
    std::vector<plot_point> points;
    for (const record* r : records) {
        // A set-up under several lights goes by the name of its family.
        points.push_back({kind.x == column::elevation ? r->family : r->name, r->family, (*r)[kind.x], (*r)[kind.y]});
        const std::string family = series_of(*r);
        const auto is_its = [&](const plot_series& s) { return s.family == family; };
        auto at = std::find_if(result.series.begin(), result.series.end(), is_its);
        if (at == result.series.end()) at = result.series.insert(at, {family, styles.at(family), {}});
        at->points.push_back(points.back());
    }
    if (result.has_lines)
        for (plot_series& series : result.series) series.points = one_at_each(series.points, kind.lines);
    result.x = {.label = kind.x_label,
                .is_logarithmic = kind.x_scale != scale::linear,
                .are_marks_binary = kind.x_scale == scale::binary};
    result.y = {.label = kind.y_label,
                .is_logarithmic = kind.y_scale != scale::linear,
                .are_marks_binary = kind.y_scale == scale::binary};
    std::vector<double> xs, ys;
    for (const plot_series& series : result.series)
        for (const plot_point& point : series.points)
            if (result.x.holds(point.x) && result.y.holds(point.y)) xs.push_back(point.x), ys.push_back(point.y);
    result.x = make_axis(std::move(result.x), kind.x_scale, xs);
    result.front = front_of(points, kind.front);
    if (kind.front == front_kind::pareto) result.front_title = "Pareto front: nothing is better in both";
    if (kind.front == front_kind::best) result.front_title = "The best at each elevation";
    if (!result.front.empty() && !result.x.holds(result.front.front().x)) result.nothing = result.front.front();
    if (result.nothing && result.y.holds(result.nothing->y)) ys.push_back(result.nothing->y);
    result.y = make_axis(std::move(result.y), kind.y_scale, ys);
    if (*kind.about != '\0') result.subtitle.append(result.subtitle.empty() ? "" : "; ").append(kind.about);
    return result;
}

}  // namespace

std::vector<plot> plots_of(const findings& all) {
    const std::map<std::string, std::size_t> styles = styles_of(all);
    std::vector<plot> plots;
    for (const plot_kind& kind : kinds) {
        const std::vector<const record*> records = choose(all, kind);
        if (!records.empty()) plots.push_back(make_plot(all, kind, records, styles));
    }
    return plots;
}

}  // namespace examples
