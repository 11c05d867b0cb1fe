#include "encodings/planes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/stb_blocks.hpp>
#include <bumpshadow/encode/stored_rows.hpp>
#include <bumpshadow/shader/shader.hpp>

#include "encodings/stored.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;
namespace shader = bumpshadow::shader;

// encode(values, block) and back for every block of 4 x 4; at the border the last row and column repeat.
template <class Encode>
void pass_through_blocks(planes& p, const Encode& encode) {
    const glm::ivec2 last = p.extent - 1;
    for (std::vector<float>& plane : p.values)
        for (int y = 0; y < p.extent.y; y += 4)
            for (int x = 0; x < p.extent.x; x += 4) {
                const auto at = [&](int i) -> float& {
                    return plane[std::size_t(std::min(y + i / 4, last.y)) * std::size_t(p.extent.x) +
                                 std::size_t(std::min(x + i % 4, last.x))];
                };
                std::array<float, 16> values;
                std::array<std::byte, 8> block;
                for (int i = 0; i < 16; ++i) values[std::size_t(i)] = at(i);
                encode(values.data(), block.data());
                bs::decode_bc4(block.data(), values.data());
                // Backwards, so that what repeats a texel does not replace it.
                for (int i = 16; i-- > 0;) at(i) = values[std::size_t(i)];
            }
}

// Where the center of a texel of the map falls on a smaller axis.
struct tap {
    std::size_t first, second;
    float weight;  // of the second
};

std::vector<tap> taps_of(int size, int small) {
    std::vector<tap> taps;
    for (int i = 0; i < size; ++i) {
        const float position = (float(i) + 0.5f) / float(size) * float(small) - 0.5f;
        const float below = std::floor(position);
        const int first = int(below);
        taps.push_back({std::size_t((first + small) % small), std::size_t((first + 1) % small), position - below});
    }
    return taps;
}

}  // namespace

horizons reduced(const bs::horizon_map& slopes, const bs::horizon_scale& scale, int factor) {
    horizons small;
    const glm::ivec2 extent = bs::reduced_extent(slopes.extent, factor);
    small.values.resize(bs::required_size(extent, slopes.bearings));
    small.view = {.values = small.values, .extent = extent, .bearings = slopes.bearings};
    require(bs::reduce(slopes, scale, small.view));
    return small;
}

planes fit_planes(const bs::horizon_map& slopes, std::span<const glm::dvec2> directions, const bs::slice_set& slices,
                  const bs::horizon_scale& scale, bs::slice_fit fit) {
    planes p{slopes.extent, {}};
    const std::size_t width = std::size_t(slopes.extent.x);
    p.values.assign(std::size_t(slices.count), std::vector<float>(width * std::size_t(slopes.extent.y)));
    bs::pack_options options;
    options.fit = fit;
    require(bs::for_slice_rows(
        slopes, directions, slices, scale, options, bs::serial{}, [&](int slice, int y, const float* values) {
            std::copy_n(values, width, p.values[std::size_t(slice)].data() + std::size_t(y) * width);
        }));
    return p;
}

void pass_through(planes& p, bs::texel_format format) {
    if (format == bs::texel_format::bc4) return pass_through_blocks(p, bs::encode_bc4);
    std::vector<std::byte> row(2 * std::size_t(p.extent.x));
    for (std::vector<float>& plane : p.values)
        for (int y = 0; y < p.extent.y; ++y) {
            float* const values = plane.data() + std::size_t(y) * std::size_t(p.extent.x);
            bs::write_row(format, values, p.extent.x, row.data());
            bs::read_row(format, row.data(), 0, p.extent.x, values);
        }
}

void pass_through_stb(planes& p) { pass_through_blocks(p, bs::encode_bc4_stb); }

planes enlarged(const planes& small, glm::ivec2 extent) {
    if (small.extent == extent) return small;
    const std::vector<tap> columns = taps_of(extent.x, small.extent.x), rows = taps_of(extent.y, small.extent.y);
    planes large{extent, {}};
    for (const std::vector<float>& from : small.values) {
        std::vector<float>& to = large.values.emplace_back();
        to.reserve(columns.size() * rows.size());
        for (const tap& r : rows) {
            const float* const first = from.data() + r.first * std::size_t(small.extent.x);
            const float* const second = from.data() + r.second * std::size_t(small.extent.x);
            for (const tap& c : columns)
                to.push_back(glm::mix(glm::mix(first[c.first], first[c.second], c.weight),
                                      glm::mix(second[c.first], second[c.second], c.weight), r.weight));
        }
    }
    return large;
}

score judge_slices(const sample_map& map, const planes& slices, const bs::slice_set& set,
                   const bs::horizon_scale& scale, int margin) {
    judge judge(map, scale, margin);
    std::vector<float> found(map.texels());
    for (int b = 0; b < light_bearings; ++b) {
        const glm::vec3 taps = shader::bumpshadow_tangent_layers(
            shader_bearing(set.function, map.directions[std::size_t(b)]), float(set.phase), float(set.count));
        const float* const here = slices.values[std::size_t(taps.x)].data();
        const float* const next = slices.values[std::size_t(taps.y)].data();
        for (std::size_t i = 0; i < found.size(); ++i)
            found[i] = shader::bumpshadow_tangent_horizon(here[i], next[i], taps.z);
        judge.look(b, found.data());
    }
    return judge.result();
}

score judge_layers(const sample_map& map, const planes& channels, const bs::slice_layers& encoding, int margin) {
    judge judge(map, encoding.scale, margin);
    std::vector<float> found(map.texels());
    const bs::slice_set& set = encoding.slices;
    for (int b = 0; b < light_bearings; ++b) {
        const float position = shader::bumpshadow_slice_position(
            shader_bearing(set.function, map.directions[std::size_t(b)]), float(set.phase), float(set.count));
        const auto plane = [&](float layer, std::size_t channel) {
            return channels.values[4 * std::size_t(layer) + channel].data();
        };
        if (encoding.grouping == bs::slice_grouping::four) {
            const std::size_t layers = channels.values.size() / 4;
            const glm::vec3 at = shader::bumpshadow_grouped_layers(position, float(layers));
            const float *const x = plane(at.x, 0), *const y = plane(at.x, 1), *const z = plane(at.x, 2),
                               *const w = plane(at.x, 3), *const next = plane(at.y, 0);
            for (std::size_t i = 0; i < found.size(); ++i)
                found[i] = shader::bumpshadow_grouped_horizon({x[i], y[i], z[i], w[i]}, next[i], at.z);
        } else {
            const glm::vec2 at = shader::bumpshadow_overlapping_layer(position);
            const float *const x = plane(at.x, 0), *const y = plane(at.x, 1), *const z = plane(at.x, 2),
                               *const w = plane(at.x, 3);
            for (std::size_t i = 0; i < found.size(); ++i)
                found[i] = shader::bumpshadow_overlapping_horizon({x[i], y[i], z[i], w[i]}, at.y);
        }
        judge.look(b, found.data());
    }
    return judge.result();
}

}  // namespace examples
