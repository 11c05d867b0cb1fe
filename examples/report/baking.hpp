#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include <glm/ext/vector_double2.hpp>

#include <bumpshadow/horizon_map.hpp>

#include "common/heights.hpp"
#include "common/method.hpp"

namespace examples {

// A way to bake a map.
struct bake_setup {
    method how = method::cascade;
    int steps = bumpshadow::bake_options{}.steps;
    double radius = std::numeric_limits<double>::infinity();  // texels along x
    int threads = 1;                                          // 0: one for each core
    int rows = 0;                                             // the first so many; 0: all
};

// Bakes one map again and again, evenly spaced bearings beginning at 0, into the same memory. It has been written to
// before, as has the scratch that reserve() takes, so that the system does not have to find memory while time is taken.
class baker {
public:
    baker(const height_samples& heights, const height_source& source, double scale, int bearings);
    baker(const baker&) = delete;
    baker& operator=(const baker&) = delete;

    [[nodiscard]] std::size_t scratch_bytes(const bake_setup& setup) const;
    // Holds scratch for this setup; bake() is for those that were reserved.
    void reserve(const bake_setup& setup);
    // Bearings first ... first + count - 1; all by default. Throws failure.
    void bake(const bake_setup& setup, std::size_t first = 0, std::size_t count = std::size_t(-1));
    // The same, and the seconds that it took.
    double time(const bake_setup& setup, std::size_t first = 0, std::size_t count = std::size_t(-1));

    [[nodiscard]] const std::vector<glm::dvec2>& directions() const { return directions_; }
    [[nodiscard]] const bumpshadow::horizon_map& horizons() const { return horizons_; }
    [[nodiscard]] double texels() const { return double(horizons_.extent.x) * double(horizons_.extent.y); }

private:
    const height_samples& heights_;
    height_source source_;
    double scale_;
    std::vector<glm::dvec2> directions_;
    std::vector<float> slopes_;
    bumpshadow::horizon_map horizons_;
    std::vector<std::byte> scratch_;
};

}  // namespace examples
