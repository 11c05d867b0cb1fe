// Prints how far each fast method is from the exact horizon on height fields, scales and options that are hard on it,
// what it promises, and whether that held. Exit code 1 where a promise was not kept and no exception is stated.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>

#if defined(__SSE__)
#include <xmmintrin.h>
#endif

#include "stability/cases.hpp"
#include "stability/encoders.hpp"
#include "stability/missing.hpp"

namespace {

using namespace stability;
namespace bs = bumpshadow;

constexpr int texels = 300;

// Along axes and diagonals, through texels, between them, and almost along an axis.
std::vector<glm::dvec2> directions() {
    std::vector<glm::dvec2> all(12);
    bs::fill_directions(all, 0.0);
    for (const glm::dvec2 d : {glm::dvec2(1.0, 1.0),
                               {-1.0, 1.0},
                               {1.0, 2.0},
                               {3.0, -1.0},
                               {0.3, 0.9},
                               {-0.7, -0.2},
                               {1e-4, 1.0},
                               {1.0, -1e-4}})
        all.push_back(d);
    return all;
}

struct result {
    error of;
    double largest = 0.0;
    int not_finite = 0;
    std::string refused;
    bool for_a_reason = false;  // of the method's own; anything else that is refused is broken
};

double degrees(double slope, double unit) { return std::atan(slope / unit) * 180.0 / std::numbers::pi; }

class trial {
public:
    explicit trial(const stiff_map& map) : map_(map), directions_(directions()) {
        const bs::height_map<double> truth = view(map, map.heights);
        std::vector<double> storage(bs::height_bounds<double>::required_size(map.extent));
        const bs::height_bounds<double> bounds(truth, storage);
        for (int i = 0; i < texels; ++i) texels_.emplace_back(i * 61 % map.extent.x, (i * 37 + i / 7) % map.extent.y);
        for (const glm::dvec2 d : directions_)
            for (const glm::ivec2 p : texels_)
                exact_.push_back(
                    bs::exact_horizon(truth, p, d, map.options.radius, map.options.curvature, &bounds).slope);
    }

    result operator()(method which) const {
        if (map_.as_double) return bake(which, view(map_, map_.heights));
        if (map_.as_bytes) {
            std::vector<std::uint8_t> bytes;
            for (const double h : map_.heights) bytes.push_back(std::uint8_t(std::round(255.0 * h)));
            return bake(which, view(map_, bytes));
        }
        const std::vector<float> samples(map_.heights.begin(), map_.heights.end());
        return bake(which, view(map_, samples));
    }

private:
    template <bs::height_sample Sample>
    result bake(method which, const bs::height_map<Sample>& heights) const {
        std::vector<float> slopes(bs::required_size(map_.extent, int(directions_.size())), 12345.0f);
        const bs::horizon_map out{.values = slopes, .extent = map_.extent, .bearings = int(directions_.size())};
        bs::bake_options options = map_.options;
        if (which == fine) options.steps = 48;
        const bs::status s = which == sweep           ? bs::bake_sweep(heights, directions_, out, options)
                             : which == sweep_classic ? bs::bake_sweep_classic(heights, directions_, out, options)
                             : which == neighborhood  ? bs::bake_neighborhood(heights, directions_, out, options)
                                                      : bs::bake_cascade(heights, directions_, out, options);
        result r;
        if (!s) {
            r.refused = s.message().c_str();
            const bool base = map_.options.curvature != glm::dvec2(0.0) || bs::is_finite(map_.options.radius);
            const bool a_sweep = which == sweep || which == sweep_classic;
            r.for_a_reason = which == neighborhood ? base : a_sweep && (base || bs::finite_math_only);
            return r;
        }
        // Every texel, not only those of the sample.
        for (const float slope : slopes) r.not_finite += bs::is_finite(slope) ? 0 : 1;
        std::vector<double> errors;
        for (std::size_t i = 0; i < exact_.size(); ++i) {
            const glm::ivec2 p = texels_[i % texels_.size()];
            const double found = double(out.row(int(i / texels_.size()), p.y)[p.x]);
            errors.push_back(std::abs(degrees(found, map_.slope_unit) - degrees(exact_[i], map_.slope_unit)));
        }
        std::sort(errors.begin(), errors.end());
        for (const double e : errors) r.of.mean += e / double(errors.size());
        r.of.percentile_99 = errors[errors.size() * 99 / 100];
        r.largest = errors.back();
        return r;
    }

    const stiff_map& map_;
    std::vector<glm::dvec2> directions_;
    std::vector<glm::ivec2> texels_;
    std::vector<double> exact_;  // [direction][texel]
};

}  // namespace

// Rounds what is denormal to 0, before and after every operation, as engines set it and as GPUs do.
bool flush_denormals() {
#if defined(__SSE__)
    _mm_setcsr(_mm_getcsr() | 0x8040u);
    return true;
#else
    return false;
#endif
}

int main(int argc, char** argv) {
    if (argc > 1 && std::string(argv[1]) == "--flush-denormals") {
        if (!flush_denormals()) {
            std::printf("skipped: no way known to flush denormals here\n");
            return 77;
        }
        --argc, ++argv;
    }
    int broken = 0, excepted = 0, held = 0;
    std::printf(
        "| case | method | mean | 99 %% | largest | bound | |\n| --- | --- | ---: | ---: | ---: | ---: | --- |\n");
    for (const stiff_case& one : all_cases()) {
        if (argc > 1 && one.name.find(argv[1]) == std::string::npos) continue;
        const stiff_map map = one.make();
        const trial look(map);
        for (int m = 0; m < method_count; ++m) {
            const result r = look(method(m));
            if (!r.refused.empty()) {
                std::printf("| %s | %s | | | | | %s: %s |\n", one.name.c_str(), method_names[m],
                            r.for_a_reason ? "refused" : "BROKEN", r.refused.c_str());
                broken += r.for_a_reason ? 0 : 1;
                continue;
            }
            error bound = promised[m];
            const auto within = [&](error e) { return r.of.mean <= e.mean && r.of.percentile_99 <= e.percentile_99; };
            const auto exception = std::find_if(one.exceptions.begin(), one.exceptions.end(),
                                                [&](const auto& e) { return e.which == method(m); });
            std::string verdict = "held";
            if (r.not_finite > 0) {
                verdict = "BROKEN: " + std::to_string(r.not_finite) + " not finite";
                ++broken;
            } else if (within(bound)) {
                ++held;
            } else if (exception != one.exceptions.end() && within(exception->most)) {
                verdict = "not held: " + exception->reason;
                ++excepted;
            } else {
                verdict = "BROKEN";
                ++broken;
            }
            std::printf("| %s | %s | %.3g | %.3g | %.3g | %g / %g | %s |\n", one.name.c_str(), method_names[m],
                        r.of.mean, r.of.percentile_99, r.largest, bound.mean, bound.percentile_99, verdict.c_str());
        }
        broken += check_encoders(one);
        std::fflush(stdout);
    }
    broken += check_missing_heights();
    std::printf("\n%d held, %d not held for the reason stated, %d broken\n", held, excepted, broken);
    return broken == 0 && held > 0 ? 0 : 1;
}
