// How exact each way of baking is, and how long it takes.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/measure/time.hpp>

#include "common/file.hpp"
#include "common/report_text.hpp"
#include "report/baking.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr double infinite = std::numeric_limits<double>::infinity();
// Bearings that lie along axes and diagonals are easy, half of 16 do not.
constexpr int bearings = 16;
constexpr int most_repeats = 3;
constexpr std::size_t between_yardsticks = 4;
// Of the rows, baked where a method's cost grows with the square of the radius.
constexpr int part_of_rows = 16;
constexpr double small_radius = 16.0;  // texels up to which they are all baked

struct contender {
    std::string family;
    bake_setup setup;
    std::string skipped = {};
};

std::string text_of_radius(double radius) {
    return std::isinf(radius) ? std::string() : format(", radius %.0f", radius);
}

std::string name_of(const contender& who) {
    std::string name = who.family;
    if (who.setup.how == method::cascade) name += format(", %d steps", who.setup.steps);
    name += text_of_radius(who.setup.radius);
    return name + (who.setup.threads == 1 ? "" : ", all cores");
}

std::vector<double> radii(bool quick) {
    return quick ? std::vector{infinite, 16.0} : std::vector{infinite, 64.0, 16.0};
}

// The yardstick first.
std::vector<contender> contenders(bool quick) {
    const std::vector<int> steps = quick ? std::vector{4, 12, 48} : std::vector{4, 8, 12, 16, 24, 48};
    std::vector<contender> all{{"sweep-classic", {.how = method::sweep_classic}},
                               {"sweep", {.how = method::sweep}},
                               {"cascade", {.threads = 0}}};
    for (const double radius : radii(quick)) {
        for (const int s : steps) all.push_back({"cascade", {.steps = s, .radius = radius}});
        // Without a limit it still looks no farther than 16 texels, which is then an error as any other.
        all.push_back({"neighborhood", {.how = method::neighborhood, .radius = radius}});
        if (std::isinf(radius)) continue;
        for (const method how : {method::sweep_classic, method::sweep})
            all.push_back({name_of(how), {.how = how, .radius = radius}, "a sweep has no limit of range"});
    }
    return all;
}

class bench {
public:
    bench(const report_context& context, const report_map& map)
        : context_(context),
          map_(map),
          baker_(map.heights, map.source, map.scale, bearings),
          contenders_(contenders(context.quick)),
          texels_(context.quick ? 1024 : 2048) {
        for (contender& c : contenders_)
            if (c.setup.how == method::neighborhood && std::isfinite(c.setup.radius) && c.setup.radius > small_radius)
                c.setup.rows = std::max(1, map.heights.extent.y / part_of_rows);
    }

    void run() {
        require(bs::sample_texels(map_.heights.extent, context_.seed, texels_));
        for (const double radius : radii(context_.quick)) find_exact(radius);
        for (const contender& c : contenders_) look_at(c);
        take_times();
        for (const result& r : results_) context_.add(r.figures);
        for (const judge& j : judges_) context_.add(exact_record(j));
        for (const contender& c : contenders_)
            if (!c.skipped.empty()) {
                record skipped = record_of(c);
                skipped.skipped = c.skipped;
                context_.add(skipped);
            }
    }

private:
    struct judge {
        double radius;
        std::vector<float> slopes;  // [bearing][texel of the sample]
        double seconds;
    };
    struct result {
        contender who;
        record figures;
        std::vector<double> times = {}, ratios = {};
    };

    void step(const std::string& what) const {
        std::string text = map_.name;
        context_.step(text.append(": ").append(what));
    }

    record record_of(const contender& who) const {
        record r;
        r.section = "bake";
        r.map = map_.name;
        r.family = who.family;
        r.name = name_of(who);
        r[column::extent] = std::sqrt(baker_.texels());
        r[column::bearings] = bearings;
        if (who.setup.how == method::cascade) r[column::steps] = who.setup.steps;
        r[column::radius] = who.setup.radius;
        r[column::threads] = bs::threads(who.setup.threads).concurrency();
        return r;
    }

    record exact_record(const judge& j) const {
        record r = record_of({"exact", {.how = method::exact, .radius = j.radius}});
        const auto samples = double(j.slopes.size());
        r[column::bake_ns] = j.seconds * 1e9 / samples;
        r[column::bake_ratio] = results_.front().figures[column::bake_ns] / r[column::bake_ns];
        r[column::bytes] = double(baker_.scratch_bytes({.how = method::exact})) / baker_.texels();
        r[column::samples] = samples;
        for (const column c :
             {column::error_mean, column::error_99, column::error_largest, column::error_bias, column::error_interval})
            r[c] = 0.0;
        return r;
    }

    void find_exact(double radius) {
        step("exact" + text_of_radius(radius));
        judge j{radius, std::vector<float>(texels_.size() * baker_.directions().size()), 0.0};
        bs::bake_options options;
        options.radius = radius * map_.source.texel_size.x;
        j.seconds = bs::measure_time(1, [&] {
                        with_height_map(map_.heights, map_.source, map_.scale, [&](const auto& view) {
                            require(bs::sample_horizons(view, texels_, baker_.directions(), j.slopes, options));
                        });
                    }).median;
        judges_.push_back(std::move(j));
    }

    // One bake whose time does not count, and its errors.
    void look_at(const contender& who) {
        if (!who.skipped.empty()) return;
        step(name_of(who));
        baker_.reserve(who.setup);
        baker_.bake(who.setup);
        result r{who, record_of(who)};
        const judge& truth =
            *std::find_if(judges_.begin(), judges_.end(), [&](const judge& j) { return j.radius == who.setup.radius; });
        // Those of the sample's texels that were baked.
        std::vector<glm::ivec2> texels;
        std::vector<float> exact;
        const auto baked = [&](glm::ivec2 p) { return who.setup.rows == 0 || p.y < who.setup.rows; };
        std::copy_if(texels_.begin(), texels_.end(), std::back_inserter(texels), baked);
        for (std::size_t i = 0; i < truth.slopes.size(); ++i)
            if (baked(texels_[i % texels_.size()])) exact.push_back(truth.slopes[i]);
        bs::error_figures errors;
        require(bs::elevation_error(baker_.horizons(), texels, exact, errors));
        r.figures[column::samples] = double(errors.count);
        r.figures[column::error_mean] = errors.mean;
        r.figures[column::error_99] = errors.percentile_99;
        r.figures[column::error_largest] = errors.largest;
        r.figures[column::error_bias] = errors.bias;
        r.figures[column::error_interval] = errors.interval;
        r.figures[column::bytes] = double(baker_.scratch_bytes(who.setup)) / baker_.texels();
        results_.push_back(std::move(r));
    }

    // Nanoseconds a sample.
    double time(const contender& who) {
        const double rows = who.setup.rows > 0 ? double(who.setup.rows) / map_.heights.extent.y : 1.0;
        return baker_.time(who.setup) * 1e9 / (baker_.texels() * rows * bearings);
    }

    // All contenders by turns, with a run of the yardstick before and after every few: each is compared with the mean
    // of these, so that a machine that becomes slower or faster meanwhile does not matter.
    void take_times() {
        result& yardstick = results_.front();
        for (int repeat = 0; repeat < std::min(context_.repeats, most_repeats); ++repeat) {
            step(name_of(yardstick.who));
            double before = time(yardstick.who);
            yardstick.times.push_back(before);
            for (std::size_t first = 1; first < results_.size(); first += between_yardsticks) {
                const auto some =
                    std::span(results_).subspan(first).first(std::min(between_yardsticks, results_.size() - first));
                for (result& r : some) {
                    step(name_of(r.who));
                    r.times.push_back(time(r.who));
                }
                step(name_of(yardstick.who));
                const double after = time(yardstick.who);
                yardstick.times.push_back(after);
                for (result& r : some) r.ratios.push_back(0.5 * (before + after) / r.times.back());
                before = after;
            }
        }
        for (result& r : results_) {
            r.figures[column::bake_ns] = median(r.times);
            r.figures[column::bake_ratio] = &r == &yardstick ? 1.0 : median(r.ratios);
        }
    }

    static double median(std::vector<double> values) {
        std::sort(values.begin(), values.end());
        const std::size_t half = values.size() / 2;
        return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
    }

    const report_context& context_;
    const report_map& map_;
    baker baker_;
    std::vector<contender> contenders_;
    std::vector<glm::ivec2> texels_;
    std::vector<judge> judges_;
    std::vector<result> results_;
};

int steps_of(const report_context& context) {
    const std::vector<contender> all = contenders(context.quick);
    const auto run = int(std::count_if(all.begin(), all.end(), [](const contender& c) { return c.skipped.empty(); }));
    const int groups = (run - 1 + int(between_yardsticks) - 1) / int(between_yardsticks);
    const int repeat = 1 + (run - 1) + groups;
    const int map = int(radii(context.quick).size()) + run + std::min(context.repeats, most_repeats) * repeat;
    return map * int(context.maps.size());
}

}  // namespace

report_section bake_section() {
    return {.name = "bake",
            .title = "Baking: error and time of every method",
            .steps = steps_of,
            .seconds =
                [](const report_context& context) {
                    double texels = 0.0;
                    for (const report_map& map : context.maps)
                        texels += double(map.heights.extent.x) * double(map.heights.extent.y);
                    return texels / 1048576.0 * (context.quick ? 8.0 : 18.0);
                },
            .run =
                [](const report_context& context) {
                    for (const report_map& map : context.maps) bench(context, map).run();
                }};
}

}  // namespace examples
