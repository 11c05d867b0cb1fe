#include "report/sampled_map.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <variant>

#include "common/report_text.hpp"
#include "encodings/setups.hpp"

namespace examples {
namespace {

// What tells one sample from another: FNV-1a over the heights and all that gives them a meaning.
std::uint64_t key_of(const report_context& context, const report_map& map) {
    std::uint64_t key = 14695981039346656037u;
    const auto add = [&](const void* data, std::size_t size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i < size; ++i) key = (key ^ bytes[i]) * 1099511628211u;
    };
    std::visit([&](const auto& samples) { add(samples.data(), samples.size() * sizeof samples[0]); },
               map.heights.samples);
    const double no_data = map.source.no_data.value_or(0.0);
    const int rest[] = {map.heights.extent.x,
                        map.heights.extent.y,
                        int(map.source.edge),
                        map.source.no_data ? 1 : 0,
                        int(context.seed),
                        sampled_patches(context, map),
                        int(map.heights.samples.index())};
    add(rest, sizeof rest);
    add(&map.scale, sizeof map.scale);
    add(&map.source.texel_size, sizeof map.source.texel_size);
    add(&no_data, sizeof no_data);
    return key;
}

}  // namespace

named_map named(const report_map& map) { return {map.name, map.source, map.heights, map.scale}; }

int sampled_patches(const report_context& context, const report_map& map) {
    const int along = std::min(map.heights.extent.x, map.heights.extent.y) / patch_side;
    const int most = context.quick ? 2 : 3;
    return std::min(along, most) * std::min(along, most);
}

std::shared_ptr<const sample_map> sample_of(const report_context& context, const report_map& map) {
    static std::map<std::uint64_t, std::shared_ptr<const sample_map>> samples;
    std::shared_ptr<const sample_map>& known = samples[key_of(context, map)];
    const int patches = sampled_patches(context, map);
    const auto step = [&] { context.step("exact horizons of " + map.name); };
    if (known)
        for (int i = 0; i < patches; ++i) step();
    else
        known = std::make_shared<const sample_map>(
            take_sample(named(map), patches * patch_side * patch_side, context.seed, step));
    return known;
}

record too_small(const std::string& section, const report_map& map) {
    record r;
    r.section = section;
    r.map = map.name;
    r.name = "all set-ups";
    r.skipped = format("the map is smaller than %d x %d texels", patch_side, patch_side);
    return r;
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
