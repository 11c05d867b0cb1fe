#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "encodings/sample.hpp"
#include "encodings/score.hpp"
#include "report/record.hpp"
#include "report/section.hpp"

namespace examples {

[[nodiscard]] named_map named(const report_map& map);

// Patches that are judged: 9 of a map, 4 where quick or where the map has no room for more, or 1; 0: too small a map.
[[nodiscard]] int sampled_patches(const report_context& context, const report_map& map);

// The exact horizons of these patches, baked once in a run (context.samples), with a step after each patch. The map has
// room for them.
[[nodiscard]] std::shared_ptr<const sample_map> sample_of(const report_context& context, const report_map& map);

// A section that judges patches of each map. Maps without room for one are named in a record.
//   steps: of one map; seconds: roughly, of one map, in full and where quick
struct patch_section {
    std::string name, title;
    std::function<int(const report_context&, const report_map&)> steps;
    double seconds = 1.0, quick_seconds = 1.0;
    std::function<void(const report_context&, const report_map&)> measure;
};
[[nodiscard]] report_section section_of(patch_section all);

// A sample in the cuts that set-ups need, and the way from scores to records.
class sampled_map {
public:
    sampled_map(const report_context& context, std::string section, sample_map sample);

    // Less what is beyond `side` texels of every patch.
    [[nodiscard]] const sample_map& cut(int side);

    // Adds a record with the mismatch, its confidence interval and its ratio to that of Lengyel's layout for the same
    // texels: patches of `side` less `margin` texels at their border.
    void add(record r, const score& s, int side = patch_side, int margin = 0);
    // The same, and one record for each elevation of the light.
    void add_with_elevations(const record& r, const score& s, int side = patch_side, int margin = 0);

    // What could not be measured.
    void add_skipped(record r, const std::string& why);

private:
    [[nodiscard]] double yardstick(int side, int margin);

    const report_context& context_;
    std::string section_;
    std::map<int, sample_map> cuts_;  // by side
    std::map<std::pair<int, int>, double> yardsticks_;
};

}  // namespace examples
