#include "stability/missing.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/finite.hpp>
#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/figures.hpp>
#include <bumpshadow/status.hpp>

namespace stability {
namespace {

namespace bs = bumpshadow;

constexpr glm::ivec2 extent{41, 37};
constexpr glm::ivec2 places[] = {{7, 5}, {20, 5}, {3, 30}};
constexpr int bearings = 8;
constexpr float untouched = 12345.0f;

template <class Sample>
std::vector<Sample> hills(Sample at_places) {
    std::vector<Sample> samples;
    for (int y = 0; y < extent.y; ++y)
        for (int x = 0; x < extent.x; ++x) samples.push_back(Sample(3.0 * std::sin(0.4 * x) + 2.0 * std::cos(0.7 * y)));
    for (const glm::ivec2 p : places) samples[std::size_t(p.y * extent.x + p.x)] = at_places;
    return samples;
}

using slopes = std::vector<float>;

enum class way { exact, cascade, sweep, sweep_classic, neighborhood };
constexpr const char* names[] = {"exact", "cascade", "sweep", "sweep-classic", "neighborhood"};

template <class Sample>
bs::status bake(way how, const bs::height_map<Sample>& map, slopes& values) {
    values.assign(bs::required_size(extent, bearings), untouched);
    std::vector<glm::dvec2> directions(bearings);
    bs::fill_directions(directions);
    const bs::horizon_map out{.values = values, .extent = extent, .bearings = bearings};
    switch (how) {
        case way::exact: return bs::bake_exact(map, directions, out);
        case way::cascade: return bs::bake_cascade(map, directions, out);
        case way::sweep: return bs::bake_sweep(map, directions, out);
        case way::sweep_classic: return bs::bake_sweep_classic(map, directions, out);
        case way::neighborhood: break;
    }
    return bs::bake_neighborhood(map, directions, out);
}

class checker {
public:
    template <class Sample>
    void refuses(const char* what, Sample bad) {
        const std::vector<Sample> samples = hills(bad);
        for (const way how : all_) {
            slopes values;
            const bs::status s = bake(how, bs::tight_height_map(samples.data(), extent), values);
            const bool clean = std::all_of(values.begin(), values.end(), [](float v) { return v == untouched; });
            say(what, how,
                refused_for_the_build(how, s) || (s.code() == bs::error::not_finite && s.texel() == places[0]),
                clean ? s.message().c_str() : "something was written");
        }
    }

    // A hole has no horizon, and neighbors are what they are where it holds anything else that is a hole.
    template <class Sample>
    void leaves_out(const char* what, Sample bad) {
        const std::vector<Sample> samples = hills(bad), others = hills(Sample(-77));
        for (const way how : all_) {
            bs::height_map<Sample> map = bs::tight_height_map(samples.data(), extent), other = map;
            map.no_data = bad;
            other.samples = others.data();
            other.no_data = Sample(-77);
            slopes values, expected;
            const bs::status s = bake(how, map, values);
            if (refused_for_the_build(how, s)) {
                say(what, how, true, s.message().c_str());
                continue;
            }
            bool right = bool(s) && bool(bake(how, other, expected)) && values == expected;
            for (int b = 0; right && b < bearings; ++b)
                for (int y = 0; y < extent.y; ++y)
                    for (int x = 0; x < extent.x; ++x) {
                        const float v = values[std::size_t((b * extent.y + y) * extent.x + x)];
                        const bool hole =
                            std::find(std::begin(places), std::end(places), glm::ivec2(x, y)) != std::end(places);
                        right = right && bs::is_finite(v) && (v == bs::no_horizon) == hole;
                    }
            say(what, how, right, s ? "holes" : s.message().c_str());
        }
    }

    // What is found where nothing was baked: 90 degrees below level ground at one of two texels, in both bearings.
    void measures(const char* what, float missing) {
        const float found[] = {0.0f, missing, 0.0f, missing}, exact[] = {0.0f, 0.0f, 0.0f, 0.0f};
        bs::error_figures figures;
        const bs::status s = bs::elevation_error(found, 2, exact, figures);
        const bool right = bool(s) && figures.count == 4 && std::abs(figures.mean - 45.0) < 1e-9;
        std::printf("| %s | elevation_error | mean of %zu: %g degrees | %s |\n", what, figures.count, figures.mean,
                    right ? "held" : "BROKEN");
        wrong_ += right ? 0 : 1;
    }

    [[nodiscard]] int wrong() const { return wrong_; }

private:
    // exact (with holes alone, which have no_data) and the sweeps need NaN or infinity on their way.
    static bool refused_for_the_build(way how, const bs::status& s) {
        if (how == way::cascade || how == way::neighborhood) return false;
        return bs::finite_math_only && s.code() == bs::error::not_supported &&
               std::string_view(s.message().c_str()).find("-ffast-math") != std::string_view::npos;
    }
    void say(const char* what, way how, bool right, const char* answer) {
        std::printf("| %s | %s | %s | %s |\n", what, names[int(how)], answer, right ? "held" : "BROKEN");
        wrong_ += right ? 0 : 1;
    }

    static constexpr way all_[] = {way::exact, way::cascade, way::sweep, way::sweep_classic, way::neighborhood};
    int wrong_ = 0;
};

}  // namespace

int check_missing_heights() {
    constexpr float infinite = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
    checker check;
    std::printf("\n| heights | method | answer | |\n| --- | --- | --- | --- |\n");
    check.refuses("NaN", nan);
    check.refuses("infinity", infinite);
    check.refuses("-infinity in double", -double(infinite));
    check.refuses("NaN in double", double(nan));
    check.leaves_out("NaN as no_data", nan);
    check.leaves_out("infinity as no_data", infinite);
    check.leaves_out("-infinity as no_data in double", -double(infinite));
    check.leaves_out("-9999 as no_data", -9999.0f);
    check.leaves_out("the largest float as no_data", std::numeric_limits<float>::max());
    check.measures("no_horizon among slopes", bs::no_horizon);
    check.measures("NaN among slopes", nan);
    return check.wrong();
}

}  // namespace stability
