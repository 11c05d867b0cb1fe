#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

#include <bumpshadow/config.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_bounds.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/relief.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/scratch.hpp>
#include <bumpshadow/status.hpp>

// The analytic horizon: what every other method is judged by.
//
// The surface is bilinear between texel centers, so along a ray its height in one cell is a polynomial A + B t + C t^2
// and the slope A/t + B + C t has its maximum at an end of the cell or at t = sqrt(A/C). All cells that can matter are
// visited in double precision; one is left out only where a bound on its heights proves that it cannot beat the best.

namespace bumpshadow {

// The horizon of one texel in one direction.
struct horizon_sample {
    double slope = double(no_horizon);  // tangent of its elevation, signed; double(no_horizon) where nothing occludes
    // How far the occluder is, in the unit of texel_size, the nearest where several are equally high; 0 where the
    // surface at the texel itself is the horizon, infinity where the horizon is infinitely far or absent.
    double distance = std::numeric_limits<double>::infinity();
};

namespace exact_detail {

// Directions are known to rounding only: a component this small beside the other one is taken as 0, two components this
// close as equal, and a cell that a ray touches for less than this part of its way is only touched at its corner.
inline constexpr double rounding = 1e-13;
// After this many texels a ray ends where occluders farther on can be higher than the best only by an allowance, which
// is a slope of `impatience` * texels gone * range of heights a texel. It ends any ray over an endless map after about
// ten million texels, most of them far earlier.
inline constexpr double patience = 1e6;
inline constexpr double impatience = 1e-14;
// Cells farther than this along the main axis are beyond what doubles can tell apart.
inline constexpr double farthest = 1e15;
// The same for endless maps with holes, where a ray may meet no surface at all.
inline constexpr double farthest_with_holes = 1e7;
// Slope below any that heights make.
inline constexpr double nothing = -1e300;

// One axis of the map as a ray sees it that starts at a texel: its cell i lies between texels i and i + 1 from there.
struct axis {
    std::int64_t count = 0;     // texels of the map
    std::ptrdiff_t stride = 0;  // samples from one texel to the next
    int step = 1;               // the way the ray goes
    bool moves = true;          // false: it stays on the grid line that it starts on
    edge_mode edge = edge_mode::repeat;

    // Cells before the border of the map.
    [[nodiscard]] std::int64_t inside(std::int64_t origin) const { return step > 0 ? count - 1 - origin : origin; }
    // True where the surface no longer changes along this axis.
    [[nodiscard]] bool endless(std::int64_t origin, std::int64_t i) const {
        return !moves || (edge == edge_mode::clamp && i >= inside(origin));
    }
    [[nodiscard]] std::int64_t texel(std::int64_t origin, std::int64_t i) const {
        return resolve_edge(origin + step * i, count, edge);
    }
    // First cell after those that begin in the same block of 2^shift texels as cell i does, whose texel is `at`.
    [[nodiscard]] std::int64_t leave(std::int64_t origin, std::int64_t i, std::int64_t at, int shift) const {
        const std::int64_t unfolded = origin + step * i;
        const bool reflected = edge == edge_mode::mirror && resolve_edge(unfolded, 2 * count, edge_mode::repeat) != at;
        const std::int64_t first = (at >> shift) << shift;
        const std::int64_t last = (std::min)(first + (std::int64_t(1) << shift), count) - 1;
        return i + 1 + ((step > 0) != reflected ? last - at : at - first);
    }
};

// How far a ray over an endless map has to go before it may end because it runs beside its own beginning. If it has
// come back to within `drift` texels of that after `length` texels, it meets heights from there on that are at most
// drift * range above those it met before, and can raise a best slope that is not negative by drift / length * range,
// which has to be within the allowance. The lengths are found among the convergents of the continued fraction of the
// ray's tangent.
[[nodiscard]] inline double recurrence(double tangent, double major_period, double minor_period, bool has_holes) {
    const double turns = tangent * major_period / minor_period;
    double x = turns, p = std::floor(x), q = 1.0, p_before = 1.0, q_before = 0.0, enough = farthest;
    while (q * major_period < enough) {
        const double length = q * major_period, rise = std::abs(q * turns - p) * minor_period / length;
        // Next to a hole the least drift may bring an occluder into view.
        if (!has_holes || rise <= rounding) enough = (std::min)(enough, (std::max)(length, rise / impatience));
        x = 1.0 / (x - std::floor(x));
        const double a = std::floor(x);
        p = a * p + std::exchange(p_before, p);
        q = a * q + std::exchange(q_before, q);
    }
    return enough;
}

// Rays in one direction. Lengths along a ray are counted in texels of its main axis, the one of which it crosses more
// texels, and slopes in height per such texel; `reach` units are one of them.
template <height_sample Sample>
class rays {
public:
    rays(const height_map<Sample>& heights, const height_bounds<Sample>& bounds, glm::dvec2 direction, double radius,
         glm::dvec2 curvature)
        : heights_(heights), bounds_(bounds), unit_(unit_height(heights)) {
        BUMPSHADOW_ASSERT(is_finite(direction.x) && is_finite(direction.y));
        BUMPSHADOW_ASSERT(direction.x != 0.0 || direction.y != 0.0);
        BUMPSHADOW_ASSERT(radius > 0.0);
        // Before any rounding of the length, so that a ray meant to pass through corners does.
        const double largest = (std::max)(std::abs(direction.x), std::abs(direction.y));
        double x = std::abs(direction.x / largest) / heights.texel_size.x;
        double y = std::abs(direction.y / largest) / heights.texel_size.y;
        swapped_ = y > x;
        major_ = {heights.extent.x, 1, direction.x < 0.0 ? -1 : 1, true, heights.edge};
        minor_ = {heights.extent.y, heights.row_stride, direction.y < 0.0 ? -1 : 1, true, heights.edge};
        glm::dvec2 size = heights.texel_size;
        if (swapped_) {
            std::swap(major_, minor_);
            std::swap(x, y);
            std::swap(size.x, size.y);
            std::swap(curvature.x, curvature.y);
        }
        tangent_ = y / x;
        // Where texels are very long a ray that hardly leaves its row still goes far along them.
        const double aside = tangent_ * size.y < rounding * size.x ? 0.0 : tangent_ * size.y;
        if (tangent_ < rounding) tangent_ = 0.0;
        if (tangent_ > 1.0 - rounding) tangent_ = 1.0;
        minor_.moves = tangent_ > 0.0;

        const glm::dvec2 way(size.x, minor_.moves ? tangent_ * size.y : aside);
        reach_ = std::hypot(way.x, way.y);
        bend_ = 0.5 * (curvature.x * way.x * way.x + curvature.y * way.y * way.y);
        const bool endless = is_infinite(radius);
        BUMPSHADOW_ASSERT(!endless ||
                          bend_ >= -1e-12 * (std::abs(curvature.x) + std::abs(curvature.y)) * reach_ * reach_);
        if (endless) bend_ = (std::max)(bend_, 0.0);
        starts_at_zero_ = horizon_is_never_negative(heights.edge, radius, bend_);

        range_ = std::abs((double(bounds.highest()) - double(bounds.lowest())) * unit_);
        limit_ = endless ? farthest : (std::min)(radius / reach_, farthest);
        const bool recurs = heights.edge == edge_mode::repeat || heights.edge == edge_mode::mirror;
        if (recurs) {
            const double fold = heights.edge == edge_mode::mirror ? 2.0 : 1.0;
            again_ = recurrence(tangent_, fold * double(major_.count), fold * double(minor_.count), bounds.has_holes());
            if (bounds.has_holes()) limit_ = (std::min)(limit_, farthest_with_holes);
        }
    }

    [[nodiscard]] horizon_sample operator()(glm::ivec2 texel) const {
        BUMPSHADOW_ASSERT(texel.x >= 0 && texel.x < heights_.extent.x && texel.y >= 0 && texel.y < heights_.extent.y);
        const Sample own = sample_at(heights_, texel.x, texel.y);
        if (is_no_data(heights_, own)) return {};

        walk ray{*this, double(own), swapped_ ? texel.y : texel.x, swapped_ ? texel.x : texel.y, limit_};
        ray.run();
        if (ray.best <= 0.5 * nothing) return {};
        return {ray.best / reach_, is_infinite(ray.distance) ? ray.distance : ray.distance * reach_};
    }

private:
    // One ray on its way.
    struct walk {
        const rays& of;
        const double own;  // sample at the start
        const std::int64_t major_origin, minor_origin;
        double limit;
        double best = of.starts_at_zero_ ? 0.0 : nothing;
        double distance = std::numeric_limits<double>::infinity();
        double slope_there = best;

        [[nodiscard]] double rise(Sample sample) const { return (double(sample) - own) * of.unit_; }

        // Height above the start; NaN in a hole, which makes every comparison that follows from it false.
        [[nodiscard]] double rise(std::int64_t u, std::int64_t v) const {
            const Sample sample = of.heights_.samples[u * of.major_.stride + v * of.minor_.stride];
            return is_no_data(of.heights_, sample) ? std::numeric_limits<double>::quiet_NaN() : rise(sample);
        }

        // Cell of the minor axis at s, by the same divisions that find where the ray crosses its grid lines.
        [[nodiscard]] std::int64_t minor_cell(double s) const {
            if (!of.minor_.moves) return 0;
            const auto j = std::int64_t(of.tangent_ * s);
            if (double(j + 1) / of.tangent_ <= s) return j + 1;
            return double(j) / of.tangent_ > s ? j - 1 : j;
        }

        void offer(double slope, double s) {
            if (!(slope > best)) return;
            best = slope;
            // The nearest of those that differ by no more than rounding.
            if (slope - slope_there <= 1e-12 * std::abs(slope) + 1e-15 * of.range_) return;
            distance = s;
            slope_there = slope;
        }
        void point(double height, double s) {
            if (height > (best + of.bend_ * s) * s) offer(height / s - of.bend_ * s, s);
        }

        // The part of the ray from a to b, which lies in cell (i, j).
        void cell(std::int64_t i, std::int64_t j, double a, double b) {
            const std::int64_t u0 = of.major_.texel(major_origin, i), u1 = of.major_.texel(major_origin, i + 1);
            const std::int64_t v0 = of.minor_.texel(minor_origin, j);
            const std::int64_t v1 = of.minor_.moves ? of.minor_.texel(minor_origin, j + 1) : v0;
            const double h00 = rise(u0, v0), h10 = rise(u1, v0), h01 = rise(u0, v1), h11 = rise(u1, v1);
            const double du = h10 - h00, dv = h01 - h00, twist = (h00 + h11) - (h10 + h01);

            // Height start + w (gradient + w turn) at a + w: relative to a, so that nothing cancels far away.
            const double u = a - double(i), v = of.tangent_ * a - double(j);
            const double start = h00 + (du * u + dv * v) + twist * u * v;
            const double gradient = (du + of.tangent_ * dv) + twist * (v + of.tangent_ * u);
            const double turn = of.tangent_ * twist;
            if (a == 0.0)
                offer(gradient, 0.0);
            else
                point(start, a);
            const double width = b - a;
            point(start + width * (gradient + width * turn), b);

            const double constant = start - a * (gradient - a * turn), square = turn - of.bend_;
            if (constant < 0.0 && square < 0.0) {
                const double s = std::sqrt(constant / square), w = s - a;
                if (w > 0.0 && s < b) point(start + w * (gradient + w * turn), s);
            }
        }

        // True where heights up to `height` cannot beat the best anywhere from a to b.
        [[nodiscard]] bool below(double height, double a, double b, double allowance = 0.0) const {
            const double slope = best + allowance + of.bend_ * (of.bend_ >= 0.0 ? a : b);
            return height <= slope * (height > 0.0 ? a : b);
        }

        [[nodiscard]] bool nothing_more(double s) const {
            const double allowance = s < patience ? 0.0 : impatience * s * of.range_;
            if (below(rise(of.bounds_.highest()), s, limit, allowance)) return true;
            // Over a hollow base what has been met comes again with a slope that is larger by what the base rose.
            return s >= of.again_ && best >= -allowance && -of.bend_ * limit <= allowance;
        }

        // As far as nothing beyond s can beat the best over a hollow base, on which that may be many lengths of a map.
        [[nodiscard]] double passed(double s) const {
            const double highest = (std::max)(rise(of.bounds_.highest()), 0.0);
            const double way = (1.0 - 1e-12) * (highest / s - best) / of.bend_;
            return way > s ? (std::min)(way, limit) : s;
        }

        void run() {
            if (of.major_.edge == edge_mode::open) {
                limit = (std::min)(limit, double(of.major_.inside(major_origin)));
                if (of.minor_.moves) limit = (std::min)(limit, double(of.minor_.inside(minor_origin)) / of.tangent_);
            }
            // Where all is below, or the base is hollow, the farthest point is likely the best. A little less than its
            // slope lets the ray jump from the start on and still find that point, or a nearer one as high.
            if (!of.starts_at_zero_ && limit > 1.0 && (limit < farthest || of.bend_ < 0.0)) {
                const double a = std::nextafter(limit, 0.0);
                cell(std::int64_t(a), minor_cell(a), a, limit);
                best -= best == 0.0 ? (std::numeric_limits<double>::min)() : 1e-11 * std::abs(best);
                slope_there = best;
            }
            const double never = (std::numeric_limits<double>::max)();
            double s = 0.0;
            std::int64_t i = 0, j = 0;
            int level = 0;
            while (s < limit && !nothing_more(s)) {
                const bool endless_u = of.major_.endless(major_origin, i);
                const bool endless_v = of.minor_.endless(minor_origin, j);
                const std::int64_t u = of.major_.texel(major_origin, i), v = of.minor_.texel(minor_origin, j);
                const int shift = of.bounds_.shift(level);
                const std::int64_t i_end = of.major_.leave(major_origin, i, u, shift);
                const std::int64_t j_end = of.minor_.leave(minor_origin, j, v, shift);
                const double end = (std::min)(
                    {limit, endless_u ? never : double(i_end), endless_v ? never : double(j_end) / of.tangent_});
                const Sample top = of.swapped_ ? of.bounds_.highest(level, v, u) : of.bounds_.highest(level, u, v);
                if (below(rise(top), s, end)) {
                    s = of.bend_ < 0.0 ? passed(end) : end;
                    i = std::int64_t(s);
                    j = minor_cell(s);
                    level = (std::min)(level + 1, of.bounds_.levels() - 1);
                } else if (level > 0) {
                    --level;
                } else {
                    while (s < end) {
                        const double next_i = of.major_.endless(major_origin, i) ? never : double(i + 1);
                        const double next_j = of.minor_.endless(minor_origin, j) ? never : double(j + 1) / of.tangent_;
                        const double next = (std::min)({next_i, next_j, end});
                        if (next - s > rounding * s) cell(i, j, s, next);
                        if (next_i <= next) ++i;
                        if (next_j <= next) ++j;
                        s = next;
                    }
                }
            }
        }
    };

    const height_map<Sample>& heights_;
    const height_bounds<Sample>& bounds_;
    double unit_;
    axis major_, minor_;
    bool swapped_ = false;
    double tangent_ = 0.0;  // texels of the minor axis for one of the major
    double reach_ = 1.0;    // units
    double bend_ = 0.0;     // the base falls by bend s^2
    bool starts_at_zero_ = false;
    double range_ = 0.0;
    double limit_ = farthest;
    double again_ = (std::numeric_limits<double>::max)();
};

}  // namespace exact_detail

// The horizon of a texel: the largest slope (h(p + t d) - h(p) - curvature t^2 / 2) / t over 0 < t <= radius, with h
// the bilinear surface through the texels, and the limit t -> 0 included.
//   texel: inside the map
//   direction: in surface space (units of texel_size), not zero, need not be of unit length
//   radius: above zero, in the unit of texel_size; at most 1e15 texels count
//   curvature: principal curvatures along x and y, see bake_options; not negative along an endless ray
//   bounds: of the same heights; without them a call takes a pass over the map first
// Anything else is a programmer error, and so are heights that do not pass check() and check_samples().
//
// Accuracy: 1e-12 of the slope and 1e-15 * (range of heights) a texel, except for rays over an endless map that have
// not met their horizon after a million texels, or that come back to their own beginning and drift from it: they end
// where the slope can rise no more, or at most by 1e-7 * (range of heights) a texel. Where such a map has holes,
// nothing farther than ten million texels is looked for.
//
// Cost: 1 to 3 microseconds on real maps of 1024 x 1024 texels, bounds given and no radius. At worst, for rays that
// meet nothing higher, tens of milliseconds there, and a few hundred on maps of a few texels.
template <height_sample Sample>
[[nodiscard]] horizon_sample exact_horizon(const height_map<Sample>& heights, glm::ivec2 texel, glm::dvec2 direction,
                                           double radius = std::numeric_limits<double>::infinity(),
                                           glm::dvec2 curvature = {0.0, 0.0},
                                           const height_bounds<Sample>* bounds = nullptr) {
    BUMPSHADOW_ASSERT(check(heights));
    if (bounds != nullptr) return exact_detail::rays<Sample>(heights, *bounds, direction, radius, curvature)(texel);
    Sample storage[1400];  // blocks of 32 x 32 texels on a map of 1024 x 1024
    const height_bounds<Sample> coarse(heights, storage);
    return exact_detail::rays<Sample>(heights, coarse, direction, radius, curvature)(texel);
}

// Bytes of scratch that bake_exact takes: about 1/48 of the samples; 0 where check_grid() refuses the map.
template <height_sample Sample>
[[nodiscard]] std::size_t exact_scratch_size(const height_map<Sample>& heights,
                                             std::span<const glm::dvec2> /*directions*/ = {},
                                             const bake_options& /*options*/ = {}) {
    if (!check_grid(heights.extent, heights.texel_size)) return 0;
    return scratch_layout().template add<Sample>(height_bounds<Sample>::required_size(heights.extent)).bytes();
}

// Bakes exact_horizon() for every texel of options.region and every direction.
//   directions: in surface space, at least one; slice i of the output is direction i
//   out: slopes, [direction][y][x], of the region's extent; no_horizon where nothing occludes
//   options.distances: see horizon_sample; options.steps is ignored
// Errors: what check_bake() and check_samples() find; out_of_range where heights differ by more than 1e38 smaller texel
// sides, of which floats hold no slopes; a scratch span that is too small, no memory. On an error nothing is written.
// The result does not depend on the executor or on the region, bit for bit.
template <height_sample Sample, executor Executor = serial>
[[nodiscard]] status bake_exact(const height_map<Sample>& heights, std::span<const glm::dvec2> directions,
                                const horizon_map& out, const bake_options& options = {}, Executor&& execute = {}) {
    if (finite_math_only && heights.no_data)
        return {error::not_supported, "no_data (in a build with -ffast-math)", double(*heights.no_data)};
    if (status s = check_bake(heights, directions, out, options); !s) return s;
    if (status s = check_samples(heights); !s) return s;

    scratch_block scratch;
    if (status s = scratch.allocate(options, exact_scratch_size(heights, directions, options), "bake_exact"); !s)
        return s;
    const std::size_t samples = height_bounds<Sample>::required_size(heights.extent);
    const height_bounds<Sample> bounds(heights, std::span<Sample>(scratch.carve<Sample>(samples), samples));
    if (status s = relief_detail::check(heights, bounds); !s) return s;

    const rectangle region = region_or_all(options.region, heights.extent);
    constexpr int band = 8;
    const auto bands = std::size_t((region.extent.y + band - 1) / band);
    const bool wants_distances = !options.distances.values.empty();
    execute(bands * directions.size(), [&](std::size_t item) {
        const std::size_t bearing = item / bands;
        const int begin = int(item % bands) * band, end = (std::min)(begin + band, region.extent.y);
        const exact_detail::rays<Sample> rays(heights, bounds, directions[bearing], options.radius, options.curvature);
        for (int y = begin; y < end; ++y) {
            float* slopes = out.row(int(bearing), y);
            float* distances = wants_distances ? options.distances.row(int(bearing), y) : nullptr;
            for (int x = 0; x < region.extent.x; ++x) {
                const horizon_sample horizon = rays(region.origin + glm::ivec2(x, y));
                slopes[x] = float(horizon.slope);
                if (distances != nullptr) distances[x] = float(horizon.distance);
            }
        }
    });
    return {};
}

}  // namespace bumpshadow
