#include "report/sampled_map.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "common/report_text.hpp"
#include "encodings/setups.hpp"

namespace examples {
named_map named(const report_map& map) { return {map.name, map.source, map.heights, map.scale}; }

int sampled_patches(const report_context& context, const report_map& map) {
    const int along = std::min(map.heights.extent.x, map.heights.extent.y) / patch_side;
    const int most = context.quick ? 2 : 3;
    return std::min(along, most) * std::min(along, most);
}

std::shared_ptr<const sample_map> sample_of(const report_context& context, const report_map& map) {
    std::shared_ptr<const sample_map>& known = context.samples[map.name];
    const int patches = sampled_patches(context, map);
    const auto step = [&] { context.step("exact horizons of " + map.name); };
    if (known)
        for (int i = 0; i < patches; ++i) step();
    else
        known = std::make_shared<const sample_map>(
            take_sample(named(map), patches * patch_side * patch_side, context.seed, step));
    return known;
}

report_section section_of(patch_section all) {
    const double full = all.seconds, quick = all.quick_seconds;
    report_section section{.name = all.name, .title = std::move(all.title), .steps = {}, .seconds = {}, .run = {}};
    section.steps = [steps = std::move(all.steps)](const report_context& context) {
        int sum = 0;
        for (const report_map& map : context.maps)
            if (sampled_patches(context, map) > 0) sum += steps(context, map);
        return sum;
    };
    section.seconds = [full, quick](const report_context& context) {
        return (context.quick ? quick : full) * double(context.maps.size());
    };
    section.run = [name = all.name, measure = std::move(all.measure)](const report_context& context) {
        for (const report_map& map : context.maps) {
            if (sampled_patches(context, map) > 0) {
                measure(context, map);
                continue;
            }
            record r;
            r.section = name;
            r.map = map.name;
            r.name = "all set-ups";
            r.skipped = format("the map is smaller than %d x %d texels", patch_side, patch_side);
            context.add(r);
        }
    };
    return section;
}

sampled_map::sampled_map(const report_context& context, std::string section, sample_map sample)
    : context_(context), section_(std::move(section)) {
    cuts_.emplace(patch_side, std::move(sample));
}

const sample_map& sampled_map::cut(int side) {
    const auto known = cuts_.find(side);
    if (known != cuts_.end()) return known->second;
    return cuts_.emplace(side, crop(cuts_.at(patch_side), side)).first->second;
}

double sampled_map::yardstick(int side, int margin) {
    const auto [at, is_new] = yardsticks_.try_emplace({side, margin}, 0.0);
    if (is_new) at->second = published_sine_layers(side, margin).measure({}, {&cut(side), 1}).front().percent();
    return at->second;
}

void sampled_map::add(record r, const score& s, int side, int margin) {
    r.section = section_;
    r.map = cut(side).name;
    r[column::mismatch] = s.percent();
    r[column::mismatch_interval] = s.interval();
    // A flat map has no shadows to be wrong about.
    if (const double unit = yardstick(side, margin); unit > 0.0) r[column::mismatch_ratio] = s.percent() / unit;
    r[column::samples] = s.size();
    context_.add(r);
}

void sampled_map::add_skipped(record r, const std::string& why) {
    r.section = section_;
    r.map = cut(patch_side).name;
    r.skipped = why;
    context_.add(r);
}

void sampled_map::add_with_elevations(const record& r, const score& s, int side, int margin) {
    add(r, s, side, margin);
    for (std::size_t e = 0; e < light_elevations.size(); ++e) {
        record one{.section = section_,
                   .map = cut(side).name,
                   .family = r.family,
                   .name = r.name + format(", light at %g degrees", light_elevations[e]),
                   .format = r.format,
                   .fit = r.fit,
                   .function = r.function,
                   .quantity = r.quantity,
                   .snippet = r.snippet,
                   .skipped = {}};
        one[column::elevation] = light_elevations[e];
        one[column::mismatch] = s.percent(e);
        one[column::mismatch_interval] = s.interval(e);
        one[column::samples] = s.size() / double(light_elevations.size());
        context_.add(one);
    }
}

}  // namespace examples
