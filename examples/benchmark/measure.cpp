#include "benchmark/measure.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <memory_resource>
#include <numbers>
#include <span>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>

#include "common/progress.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

// Knows how many bytes are held, and were at most.
class counting_resource : public std::pmr::memory_resource {
public:
    [[nodiscard]] std::size_t peak() const { return peak_; }

private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override {
        held_ += bytes;
        peak_ = std::max(peak_, held_);
        return std::pmr::new_delete_resource()->allocate(bytes, alignment);
    }
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
        held_ -= bytes;
        std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const std::pmr::memory_resource& other) const noexcept override {
        return this == &other;
    }

    std::size_t held_ = 0, peak_ = 0;
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const std::size_t half = values.size() / 2;
    return values.size() % 2 != 0 ? values[half] : 0.5 * (values[half - 1] + values[half]);
}

errors errors_of(std::span<const float> found, std::span<const double> exact) {
    errors e;
    std::vector<double> sizes(found.size());
    for (std::size_t i = 0; i < found.size(); ++i) {
        const double off = (std::atan(double(found[i])) - std::atan(exact[i])) * 180.0 / std::numbers::pi;
        sizes[i] = std::abs(off);
        e.mean += sizes[i] / double(found.size());
        e.bias += off / double(found.size());
    }
    std::sort(sizes.begin(), sizes.end());
    e.percentile_99 = sizes[std::size_t(0.99 * double(sizes.size() - 1))];
    e.largest = sizes.back();
    return e;
}

// Seconds that `work` takes.
template <class Work>
double time_of(const Work& work) {
    const auto start = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

// The cascade at some steps, among them the default and the fine setting.
std::vector<contender> contenders() {
    const int usual = bs::bake_options{}.steps;
    std::vector<int> steps{4, 8, 16, 32, usual, fine_steps};
    std::sort(steps.begin(), steps.end());
    steps.erase(std::unique(steps.begin(), steps.end()), steps.end());
    std::vector<contender> all{{.name = "sweep-classic", .how = method::sweep_classic},
                               {.name = "sweep", .how = method::sweep},
                               {.name = "neighborhood, 8 bearings", .how = method::neighborhood, .bearings = 8}};
    for (const int s : steps)
        all.push_back({.name = "cascade, " + std::to_string(s) + " steps" +
                               (s == usual        ? " (default)"
                                : s == fine_steps ? " (fine)"
                                                  : ""),
                       .steps = s});
    all.push_back({.name = "cascade, default, 2 threads", .threads = 2});
    return all;
}

template <class Sample>
class bench {
public:
    explicit bench(const bs::height_map<Sample>& map, const settings& how)
        : map_(map), settings_(how), slopes_(bs::required_size(map.extent, 32)) {}

    measurement run(const std::string& name) {
        result_.name = name;
        result_.extent = map_.extent;
        find_exact();
        std::size_t scratch = 0;
        for (const contender& who : contenders()) {
            result_.rows.push_back(look_at(who));
            scratch = std::max(scratch, result_.rows.back().scratch);
        }
        for (const int bearings : {4, 32})
            (bearings == 4 ? result_.scratch_4 : result_.scratch_32) = look_at({.bearings = bearings}).scratch;
        scratch_.resize(scratch);
        take_times();
        result_.rows.push_back(exact_row_);
        return std::move(result_);
    }

private:
    void bake(const contender& who, bs::bake_options options) {
        std::vector<glm::dvec2> directions(std::size_t(who.bearings));
        bs::fill_directions(directions);
        const bs::horizon_map out{.values = slopes_, .extent = map_.extent, .bearings = who.bearings};
        options.steps = who.steps;
        const auto with = [&](auto execute) {
            switch (who.how) {
                case method::sweep_classic: return bs::bake_sweep_classic(map_, directions, out, options, execute);
                case method::sweep: return bs::bake_sweep(map_, directions, out, options, execute);
                case method::neighborhood: return bs::bake_neighborhood(map_, directions, out, options, execute);
                case method::exact: return bs::bake_exact(map_, directions, out, options, execute);
                case method::cascade: break;
            }
            return bs::bake_cascade(map_, directions, out, options, execute);
        };
        const bs::status s = who.threads == 1 ? with(bs::serial{}) : with(bs::threads{who.threads});
        if (!s) throw failure(who.name + ": " + s.message().c_str());
    }

    // The exact horizons of a random sample of texels, the same in every run, in all bearings.
    void find_exact() {
        std::uint64_t state = 1;
        const auto random = [&](int below) {  // SplitMix64 (Steele, Lea and Flood 2014)
            std::uint64_t z = (state += 0x9e3779b97f4a7c15u);
            z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
            z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
            return int((z ^ (z >> 31)) % std::uint64_t(below));
        };
        for (int i = 0; i < settings_.texels; ++i) {
            const int x = random(map_.extent.x);
            texels_.emplace_back(x, random(map_.extent.y));
        }
        std::vector<glm::dvec2> directions(yardstick_bearings);
        bs::fill_directions(directions);
        exact_.reserve(texels_.size() * directions.size());
        std::vector<Sample> storage(bs::height_bounds<Sample>::required_size(map_.extent));
        const double seconds = time_of([&] {
            const bs::height_bounds<Sample> bounds(map_, storage);
            for (const glm::dvec2 d : directions)
                for (const glm::ivec2 texel : texels_)
                    exact_.push_back(bs::exact_horizon(map_, texel, d, bs::bake_options{}.radius, {}, &bounds).slope);
        });
        result_.error_samples = exact_.size();
        exact_row_.who = {.name = "exact, on a sample", .how = method::exact};
        exact_row_.nanoseconds = seconds * 1e9 / double(exact_.size());
        exact_row_.scratch = bs::exact_scratch_size(map_);
    }

    // One bake whose time does not count: its errors and its memory.
    figures look_at(const contender& who) {
        counting_resource memory;
        bs::bake_options options;
        options.memory = &memory;
        bake(who, options);
        figures row{.who = who, .scratch = memory.peak()};
        if (yardstick_bearings % who.bearings != 0) return row;

        std::vector<float> found;
        std::vector<double> exact;
        const int every = yardstick_bearings / who.bearings;
        for (int i = 0; i < who.bearings; ++i)
            for (std::size_t k = 0; k < texels_.size(); ++k) {
                const glm::ivec2 p = texels_[k];
                const bs::horizon_map out{.values = slopes_, .extent = map_.extent, .bearings = who.bearings};
                found.push_back(out.row(i, p.y)[p.x]);
                exact.push_back(exact_[std::size_t(i * every) * texels_.size() + k]);
            }
        row.error = errors_of(found, exact);
        return row;
    }

    // Nanoseconds a sample of one bake. Its scratch and its output have been written to before, so that the system
    // does not have to find memory while it runs.
    double time(const figures& row) {
        bs::bake_options options;
        options.scratch = scratch_;
        const double samples = double(bs::required_size(map_.extent, row.who.bearings));
        return time_of([&] { bake(row.who, options); }) * 1e9 / samples;
    }

    // All contenders by turns, with a run of the yardstick before and after every two: each is compared with the mean
    // of these, so that a machine that becomes slower or faster meanwhile does not matter.
    void take_times() {
        constexpr std::size_t pair = 2;
        const std::size_t count = result_.rows.size();
        std::vector<std::vector<double>> times(count), ratios(count);
        std::vector<double> speedups;
        for (int repeat = 0; repeat < settings_.repeats; ++repeat) {
            if (stderr_is_terminal())
                std::fprintf(stderr, "\r%s: %d of %d\033[K", result_.name.c_str(), repeat + 1, settings_.repeats);
            double before = time(result_.rows.front());
            times.front().push_back(before);
            for (std::size_t first = 1; first < count; first += pair) {
                const std::size_t end = std::min(first + pair, count);
                for (std::size_t i = first; i < end; ++i) times[i].push_back(time(result_.rows[i]));
                const double after = time(result_.rows.front());
                times.front().push_back(after);
                for (std::size_t i = first; i < end; ++i) ratios[i].push_back(0.5 * (before + after) / times[i].back());
                before = after;
            }
            const double alone = time(result_.row(method::cascade, bs::bake_options{}.steps, 1));
            const double together = time(result_.row(method::cascade, bs::bake_options{}.steps, 2));
            speedups.push_back(alone / together);
        }
        if (stderr_is_terminal()) std::fputs("\r\033[K", stderr);
        for (std::size_t i = 0; i < count; ++i) {
            result_.rows[i].nanoseconds = median(times[i]);
            result_.rows[i].ratio = i == 0 ? 1.0 : median(ratios[i]);
        }
        exact_row_.ratio = result_.rows.front().nanoseconds / exact_row_.nanoseconds;
        result_.thread_speedup = median(speedups);
    }

    const bs::height_map<Sample>& map_;
    settings settings_;
    std::vector<float> slopes_;
    std::vector<std::byte> scratch_;
    std::vector<glm::ivec2> texels_;
    std::vector<double> exact_;  // [bearing][texel of the sample]
    figures exact_row_;
    measurement result_;
};

}  // namespace

const figures& measurement::row(method how, int steps, int threads) const {
    return *std::find_if(rows.begin(), rows.end(), [&](const figures& r) {
        return r.who.how == how && r.who.steps == steps && r.who.threads == threads;
    });
}

measurement measure(const std::string& name, const height_samples& heights, const height_source& source,
                    double height_scale, const settings& how) {
    return with_height_map(heights, source, height_scale, [&]<class Sample>(const bs::height_map<Sample>& map) {
        return bench<Sample>(map, how).run(name);
    });
}

}  // namespace examples
