// Fuzz target: every method of baking over any view of heights and any options. It never crashes; on an error nothing
// is written; else every value of the output is written and finite, nothing beside it is touched, and neither the
// order of the items nor what the scratch memory held before changes a bit.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include <glm/common.hpp>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/finite.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/normal_map.hpp>

#include "fuzz/input.hpp"

namespace {

using namespace bumpshadow;
using fuzz::input;

enum class method : unsigned char { cascade, exact, sweep, sweep_classic, neighborhood, normals };
constexpr int methods = 6;

// Runs items forwards or backwards, and lets the library believe that it runs several at a time.
struct ordered {
    int believed = 1;
    bool backwards = false;

    [[nodiscard]] int concurrency() const { return believed; }
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        for (std::size_t i = 0; i < count; ++i) body(backwards ? count - 1 - i : i);
    }
};

// Values with a margin all around, which hold a NaN of their own until they are written.
class canvas {
public:
    canvas(glm::ivec2 extent, int slices, int gap, int slice_gap)
        : extent_(extent),
          slices_(slices),
          row_(std::size_t(extent.x + gap)),
          slice_(row_ * std::size_t(extent.y) + std::size_t(slice_gap)),
          values_(margin + slice_ * std::size_t(slices) + margin, unwritten()) {}

    [[nodiscard]] horizon_map view() {
        return {.values = std::span(values_).subspan(margin, values_.size() - 2 * margin),
                .extent = extent_,
                .bearings = slices_,
                .row_stride = row_,
                .slice_stride = slice_};
    }
    [[nodiscard]] bool untouched() const {
        for (const float& value : values_)
            if (!is_unwritten(value)) return false;
        return true;
    }
    // What to require of all values that belong to the map; the others have to be as they were.
    template <class Holds>
    [[nodiscard]] bool all(const Holds& holds) const {
        for (std::size_t i = 0; i < values_.size(); ++i) {
            const std::size_t at = i - margin, slice = at / slice_, in_slice = at % slice_;
            const bool inside = i >= margin && slice < std::size_t(slices_) &&
                                in_slice / row_ < std::size_t(extent_.y) && in_slice % row_ < std::size_t(extent_.x);
            if (inside ? !holds(values_[i]) : !is_unwritten(values_[i])) return false;
        }
        return true;
    }
    [[nodiscard]] bool same_as(const canvas& other) const {
        return values_.size() == other.values_.size() &&
               std::memcmp(values_.data(), other.values_.data(), values_.size() * sizeof(float)) == 0;
    }
    [[nodiscard]] static bool is_unwritten(const float& value) {
        return std::bit_cast<std::uint32_t>(value) == pattern;
    }

private:
    static constexpr std::uint32_t pattern = 0x7fc12345u;
    static constexpr std::size_t margin = 40;
    [[nodiscard]] static float unwritten() { return std::bit_cast<float>(pattern); }

    glm::ivec2 extent_;
    int slices_;
    std::size_t row_, slice_;
    std::vector<float> values_;
};

constexpr double lengths[] = {1.0, 0.5, 3.0, 0.125, 1e-3, 1e3, 1e-30, 1e30, 1e-300, 1e300, 0.1, 7.0};
constexpr double radii[] = {1.0, 0.3, 2.5, 8.0, 16.0, 100.0, 1e-9, 1e5, 1e-300, 1e300};
constexpr double bends[] = {0.0, 0.0, 0.01, 0.3, 1e-9, -0.01, 10.0, 1e300, -1e-300, 1e-30};
constexpr double ways[] = {1.0, 0.0, -1.0, 0.5, -0.5, 2.0, 1e-9, -1e-300, 1e300, 0.3, 0.70710678118654752, -0.1};

double length(input& in) { return in.byte() < 240 ? in.one_of(lengths) : in.number<double>(); }

struct request {
    method how;
    std::vector<glm::dvec2> directions;
    bake_options options;
    bool distances;
    int gap, slice_gap, concurrency;
    std::optional<int> scratch_short_of;  // bytes below what is asked for
};

template <height_sample Sample>
std::size_t scratch_size(const request& r, const height_map<Sample>& heights) {
    switch (r.how) {
        case method::cascade: return cascade_scratch_size(heights, r.options, r.concurrency);
        case method::exact: return exact_scratch_size(heights, r.directions, r.options);
        case method::sweep: return sweep_scratch_size(heights, r.directions, r.options, ordered{r.concurrency});
        case method::sweep_classic:
            return sweep_classic_scratch_size(heights, r.directions, r.options, ordered{r.concurrency});
        case method::neighborhood: return neighborhood_scratch_size(heights, r.directions, r.options);
        case method::normals: break;
    }
    return 0;
}

template <height_sample Sample>
status bake(const request& r, const height_map<Sample>& heights, const horizon_map& out, const bake_options& options,
            ordered execute) {
    switch (r.how) {
        case method::cascade: return bake_cascade(heights, r.directions, out, options, execute);
        case method::exact: return bake_exact(heights, r.directions, out, options, execute);
        case method::sweep: return bake_sweep(heights, r.directions, out, options, execute);
        case method::sweep_classic: return bake_sweep_classic(heights, r.directions, out, options, execute);
        case method::neighborhood: return bake_neighborhood(heights, r.directions, out, options, execute);
        case method::normals: break;
    }
    const normal_map normals{
        .values = out.values, .extent = out.extent, .row_stride = out.row_stride, .plane_stride = out.slice_stride};
    return bake_normals(heights, normals, options.region, execute);
}

// The request in words, for whoever looks at a finding.
template <height_sample Sample>
void describe(const request& r, const height_map<Sample>& heights) {
    constexpr const char* names[] = {"cascade", "exact", "sweep", "sweep_classic", "neighborhood", "normals"};
    const bake_options& o = r.options;
    std::fprintf(stderr, "%s of %d x %d texels (stride %td) of %zu bytes, edge %d, scale %g, datum %g, texel %g x %g\n",
                 names[int(r.how)], heights.extent.x, heights.extent.y, heights.row_stride, sizeof(Sample),
                 int(heights.edge), heights.height_scale, heights.datum, heights.texel_size.x, heights.texel_size.y);
    if (heights.no_data) std::fprintf(stderr, "no_data %g; ", double(*heights.no_data));
    std::fprintf(stderr, "steps %d, radius %g, curvature %g %g, region %d %d %d %d, distances %d, concurrency %d\n",
                 o.steps, o.radius, o.curvature.x, o.curvature.y, o.region.origin.x, o.region.origin.y,
                 o.region.extent.x, o.region.extent.y, int(r.distances), r.concurrency);
    for (const glm::dvec2 d : r.directions) std::fprintf(stderr, "direction %.17g %.17g\n", d.x, d.y);
    std::fprintf(stderr, "samples");
    for (int x = 0; x < 12 && x < heights.extent.x; ++x) std::fprintf(stderr, " %.9g", double(heights.samples[x]));
    std::fprintf(stderr, " ...\n");
}

// True where the slopes of the base are far from the limits of float. Those of heights always are where a bake is not
// refused.
template <height_sample Sample>
bool is_moderate(const request& r, const height_map<Sample>& heights) {
    constexpr double most = 1e15;
    const bake_options& o = r.options;
    const double large = std::max(heights.texel_size.x, heights.texel_size.y),
                 bend = std::max(std::abs(o.curvature.x), std::abs(o.curvature.y));
    const double farthest = bend == 0.0 ? 0.0 : is_finite(o.radius) ? o.radius : 1e6 * large;
    return bend * std::max(farthest, large) <= most;
}

// Bakes twice, in both orders and over scratch memory that held ones and zeros.
template <height_sample Sample>
void run(const request& r, const height_map<Sample>& heights) {
    const bool valid = bool(check(heights)) && r.options.steps > 0 && r.options.steps <= most_steps;
    const glm::ivec2 whole = heights.extent.x > 0 && heights.extent.y > 0 ? heights.extent : glm::ivec2(1);
    // A region outside the map is refused, so its output need not be that large.
    glm::ivec2 extent = region_or_all(r.options.region, whole).extent;
    if (extent.x > 64 || extent.y > 64) extent = whole;
    const int slices = r.how == method::normals ? 3 : int(r.directions.size());
    canvas slopes[2] = {{extent, slices, r.gap, r.slice_gap}, {extent, slices, r.gap, r.slice_gap}};
    canvas distances[2] = {{extent, slices, r.gap, r.slice_gap}, {extent, slices, r.gap, r.slice_gap}};
    std::vector<std::byte> scratch;
    const auto require = [&](bool holds, const char* what) {
        if (!holds) describe(r, heights);
        fuzz::require(holds, what);
    };
    status first;
    for (int i = 0; i < 2; ++i) {
        bake_options options = r.options;
        if (r.distances) options.distances = distances[i].view();
        if (valid && r.scratch_short_of && r.how != method::normals) {
            const std::size_t size = scratch_size(r, heights);
            if (size > (std::size_t(1) << 28)) return;  // a neighborhood of a huge radius
            scratch.assign(size - std::size_t(*r.scratch_short_of), std::byte(i == 0 ? 0xff : 0x00));
            options.scratch = scratch;
        }
        const status s = bake(r, heights, slopes[i].view(), options, {r.concurrency, i == 1});
        if (i == 0) first = s;
        require(s.code() == first.code(), "the status does not depend on the order of the items");
        if (!s) {
            // One byte less may do, since the sizes are those for any number of directions.
            require(r.scratch_short_of.value_or(1) != 0 || std::strcmp(s.argument(), "options.scratch") != 0,
                    "scratch of the stated size is enough");
            require(s.message().view().size() > 4, "an error has a text");
            require(slopes[i].untouched() && distances[i].untouched(), "on an error nothing is written");
            continue;
        }
        const bool moderate = is_moderate(r, heights);
        require(slopes[i].all(
                    [&](const float& value) { return moderate ? is_finite(value) : !canvas::is_unwritten(value); }),
                "every value is written and finite");
        const bool with = r.distances && r.how != method::normals;
        if (!with) require(distances[i].untouched(), "distances are not touched where none are asked for");
        if (with)
            require(distances[i].all([&](const float& value) {
                return moderate ? !is_nan(value) && value >= 0.0f : !canvas::is_unwritten(value);
            }),
                    "every distance is written and not negative");
    }
    require(slopes[0].same_as(slopes[1]) && distances[0].same_as(distances[1]),
            "values depend on neither the order of the items nor what scratch memory held");
}

template <height_sample Sample>
void fuzz_samples(input& in, request r) {
    height_map<Sample> heights;
    glm::ivec2 extent(1 + in.below(40), 1 + in.below(40));
    const int gap = in.below(4);
    heights.height_scale = length(in) * (in.flag() ? -1.0 : 1.0);
    heights.datum = in.byte() < 128 ? 0.0 : in.number<double>();
    heights.texel_size = {length(in), length(in)};
    if (in.flag()) heights.texel_size.y = heights.texel_size.x;
    heights.edge = edge_mode(in.below(4));
    const auto sample = [&in] {
        if constexpr (std::is_floating_point_v<Sample>)
            return in.number<Sample>();
        else
            return in.bits<Sample>();
    };
    if (in.flag()) heights.no_data = sample();
    if (in.byte() == 255) extent[in.below(2)] = -in.below(2);
    heights.extent = extent;
    heights.row_stride = extent.x + gap;
    if (in.byte() == 255) heights.row_stride -= 5;

    // Samples of the input, again and again. Exactly as many as the view says, on the heap, so that reading beyond
    // them is found.
    const int period = 1 + in.below(97);
    std::vector<Sample> some(std::size_t(period), Sample{});
    for (Sample& s : some) {
        if (in.empty()) break;
        s = sample();
        if constexpr (std::is_floating_point_v<Sample>)
            // Most inputs would be refused for one sample among so many.
            if (!is_finite(s) && in.byte() < 200) s = Sample(1);
    }
    const int lines = extent.y > 0 ? extent.y : 1;
    std::vector<Sample> samples(std::size_t(lines - 1) * std::size_t(extent.x > 0 ? extent.x + gap : 1) +
                                std::size_t(extent.x > 0 ? extent.x : 1));
    for (std::size_t i = 0; i < samples.size(); ++i) samples[i] = some[(i * 7 + i / 31) % some.size()];
    heights.samples = samples.data();
    // A ray over an endless map may take ten million texels.
    const bool endless = heights.edge == edge_mode::repeat || heights.edge == edge_mode::mirror;
    if (r.how == method::exact && endless) {
        r.options.region.extent = glm::min(r.options.region.extent, glm::ivec2(1));
        if (r.options.region.empty()) r.options.region = {{0, 0}, {1, 1}};
        if (r.directions.size() > 1) r.directions.erase(r.directions.begin() + 1, r.directions.end());
    }
    run(r, heights);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    input in(bytes, size);
    request r{};
    r.how = method(in.below(methods));
    const int type = in.below(4);
    bake_options& options = r.options;
    options.steps = in.byte() < 250 ? 1 + in.below(64) : int(in.bits<std::int32_t>());
    options.radius = in.byte() < 128   ? std::numeric_limits<double>::infinity()
                     : in.byte() < 240 ? in.one_of(radii)
                                       : in.number<double>();
    if (in.flag()) options.curvature = {in.one_of(bends), in.one_of(bends)};
    if (in.byte() >= 250) options.curvature.x = in.number<double>();
    if (in.flag())
        options.region = {{in.bits<std::int8_t>() & 31, in.bits<std::int8_t>() & 31}, {in.below(40), in.below(40)}};
    if (in.byte() == 255) options.region = {{in.bits<int>(), in.bits<int>()}, {in.bits<int>(), in.bits<int>()}};
    r.distances = in.flag();
    r.gap = in.below(3) * in.below(8);
    r.slice_gap = in.below(3) * in.below(8);
    r.concurrency = in.byte() < 250 ? 1 + in.below(4) : int(in.bits<std::int8_t>());
    if (in.flag()) r.scratch_short_of = in.below(8) == 0 ? 1 : 0;
    const int directions = in.byte() == 255 ? 0 : 1 + in.below(4);
    for (int i = 0; i < directions; ++i) {
        const glm::dvec2 way(in.one_of(ways), in.one_of(ways));
        r.directions.push_back(in.byte() < 240 ? way : glm::dvec2(in.number<double>(), in.number<double>()));
        // A rest of zeros means no vector of length 0.
        if (in.flag() && r.directions.back() == glm::dvec2(0.0)) r.directions.back().x = 1.0;
    }
    switch (type) {
        case 0: fuzz_samples<std::uint8_t>(in, r); break;
        case 1: fuzz_samples<std::uint16_t>(in, r); break;
        case 2: fuzz_samples<float>(in, r); break;
        default: fuzz_samples<double>(in, r); break;
    }
    return 0;
}
