#pragma once

// Random height fields, directions and options that rapidcheck can shrink, and what is done with them.

#include <cstddef>
#include <functional>
#include <memory_resource>
#include <ostream>
#include <string>
#include <vector>

#include <rapidcheck.h>
#include <glm/ext/vector_double2.hpp>
#include <glm/ext/vector_int2.hpp>

#include <bumpshadow/height_map.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/status.hpp>

// Where rapidcheck looks for it.
namespace glm {
inline void showValue(const dvec2& v, std::ostream& out) { out << '(' << v.x << ", " << v.y << ')'; }
}  // namespace glm

namespace properties {

using list = std::vector<glm::dvec2>;
using slopes = std::vector<float>;

enum class method { exact, cascade, fine, sweep, sweep_classic, neighborhood };
inline constexpr method all_methods[] = {method::exact, method::cascade,       method::fine,
                                         method::sweep, method::sweep_classic, method::neighborhood};
[[nodiscard]] const char* name_of(method which);

// What a map is made of, added up in order.
enum class shape { step, wall, needle, plateau, ramp, rough, checkers, waves, hole };
struct feature {
    shape kind = shape::step;
    glm::ivec2 at{0}, size{0};
    int height = 0;  // in eighths: sums of them are exact in floats
};

// A height field and how it is seen. Owns its samples, row by row without gaps.
struct world {
    glm::ivec2 extent{1};
    std::vector<feature> features;
    bumpshadow::edge_mode edge = bumpshadow::edge_mode::repeat;
    glm::dvec2 texel_size{1.0};
    std::vector<float> samples;

    [[nodiscard]] bumpshadow::height_map<float> view() const;
    [[nodiscard]] float& at(int x, int y) { return samples[index(x, y)]; }
    [[nodiscard]] float at(int x, int y) const { return samples[index(x, y)]; }
    [[nodiscard]] std::size_t index(int x, int y) const {
        return std::size_t(y) * std::size_t(extent.x) + std::size_t(x);
    }
};
inline constexpr float hole = -12345.0f;

void showValue(const feature& f, std::ostream& out);
void showValue(const world& w, std::ostream& out);

// The samples of its features.
void draw(world& w);

struct limits {
    glm::ivec2 extent{24, 24};  // at the most
    bool holes = true;
    bool square = false;  // texels
    bool endless = true;  // edges, besides clamped and open ones
};
[[nodiscard]] rc::Gen<world> any_world(const limits& of = {});
// Along axes and diagonals, between them, almost along an axis; never zero. Whole numbers alone: those of small ones.
[[nodiscard]] rc::Gen<list> any_directions(std::size_t count, bool whole_numbers = false);

// Fills what it hands out with bytes of `value`: 0xff makes floats and doubles NaN.
class filling : public std::pmr::memory_resource {
public:
    explicit filling(unsigned char value) : value_(value) {}

private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override;
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override;
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    unsigned char value_;
};

// What the method can do of the options: sweeps and the neighborhood have no distances and no curvature.
[[nodiscard]] bumpshadow::bake_options allowed(method which, bumpshadow::bake_options options);

// Fails the property where the bake does. Slopes, and distances where `far` is given.
template <bumpshadow::executor Executor = bumpshadow::serial>
[[nodiscard]] slopes bake(method which, const bumpshadow::height_map<float>& map, const list& directions,
                          bumpshadow::bake_options options = {}, Executor&& execute = {}, slopes* far = nullptr) {
    namespace bs = bumpshadow;
    options = allowed(which, options);
    const glm::ivec2 extent = bs::region_or_all(options.region, map.extent).extent;
    const int count = int(directions.size());
    const bool fast = which == method::cascade || which == method::fine;
    slopes values(bs::required_size(extent, count), 12345.0f);
    const bs::horizon_map out{.values = values, .extent = extent, .bearings = count};
    if (far != nullptr) {
        far->assign(fast || which == method::exact ? values.size() : 0, 12345.0f);
        if (!far->empty()) options.distances = {.values = *far, .extent = extent, .bearings = count};
    }
    bs::status s;
    switch (which) {
        case method::exact: s = bs::bake_exact(map, directions, out, options, execute); break;
        case method::cascade:
        case method::fine: s = bs::bake_cascade(map, directions, out, options, execute); break;
        case method::sweep: s = bs::bake_sweep(map, directions, out, options, execute); break;
        case method::sweep_classic: s = bs::bake_sweep_classic(map, directions, out, options, execute); break;
        case method::neighborhood: s = bs::bake_neighborhood(map, directions, out, options, execute); break;
    }
    if (!s) RC_FAIL(s.message().c_str());
    return values;
}

// Numbers of a and b that differ in any bit.
[[nodiscard]] std::size_t differing(const slopes& a, const slopes& b);
[[nodiscard]] double degrees(float slope);

// Angles that were added up one by one.
struct angles {
    std::size_t count = 0, above = 0;  // above: those that are worth mentioning
    double sum = 0.0, largest = 0.0;

    void add(double angle, double worth_mentioning) {
        ++count;
        above += angle > worth_mentioning ? 1 : 0;
        sum += angle;
        if (angle > largest) largest = angle;
    }
    [[nodiscard]] double share() const { return count == 0 ? 0.0 : double(above) / double(count); }
    [[nodiscard]] double mean() const { return count == 0 ? 0.0 : sum / double(count); }
};

// Runs a property; false where it does not hold, which is printed.
bool holds(const std::string& name, const std::function<void()>& property);

// Each prints what it found and is false where something did not hold.
[[nodiscard]] bool check_heights();
[[nodiscard]] bool check_symmetry();
[[nodiscard]] bool check_regions();
[[nodiscard]] bool check_steps();

}  // namespace properties
