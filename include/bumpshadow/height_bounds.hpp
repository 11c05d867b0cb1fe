#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include <bumpshadow/config.hpp>
#include <bumpshadow/glm.hpp>
#include <bumpshadow/height_map.hpp>

namespace bumpshadow {

// Highest samples over square blocks of texels, coarser and coarser, so that a ray can jump over what is too low for
// it. They lie in the caller's `storage`, which has to outlive this; holes do not count.
template <height_sample Sample>
class height_bounds {
public:
    static constexpr int finest_shift = 3;  // blocks of 8 x 8 texels; a larger one is taken where the storage is small

    // Samples of storage for blocks of 2^shift texels; 0 for an extent without texels.
    [[nodiscard]] static constexpr std::size_t required_size(glm::ivec2 extent, int shift = finest_shift) {
        std::size_t size = 0;
        if (extent.x <= 0 || extent.y <= 0) return size;
        for (int s = shift;; ++s) {
            const std::int64_t x = blocks(extent.x, s), y = blocks(extent.y, s);
            size += std::size_t(x * y);
            if (x == 1 && y == 1) return size;
        }
    }

    // One pass over the samples of heights that pass check() and check_samples(). storage: one sample or more; less
    // than required_size() makes the blocks larger.
    height_bounds(const height_map<Sample>& heights, std::span<Sample> storage)
        : descending_(unit_height(heights) < 0.0) {
        BUMPSHADOW_ASSERT(!storage.empty());
        while (required_size(heights.extent, shift_) > storage.size()) ++shift_;
        highest_ = lowest_sample();
        lowest_ = descending_ ? std::numeric_limits<Sample>::lowest() : (std::numeric_limits<Sample>::max)();

        std::size_t offset = 0;
        for (int s = shift_;; ++s) {
            layer& now = levels_[count_++];
            now = {storage.data() + offset, blocks(heights.extent.x, s), blocks(heights.extent.y, s)};
            offset += std::size_t(now.width * now.height);
            if (count_ == 1)
                gather(heights, now);
            else
                halve(levels_[count_ - 2], now);
            if (now.width == 1 && now.height == 1) break;
        }
    }

    // Levels, the last of one block.
    [[nodiscard]] int levels() const { return count_; }
    // Blocks of a level have 2^shift texels a side.
    [[nodiscard]] int shift(int level) const { return shift_ + level; }
    // No texel in or next to the block of texel (x, y) is higher than this sample.
    [[nodiscard]] Sample highest(int level, std::int64_t x, std::int64_t y) const {
        const auto& l = levels_[level];
        return l.samples[(y >> shift(level)) * l.width + (x >> shift(level))];
    }
    // Sample of the highest texel of the map.
    [[nodiscard]] Sample highest() const { return highest_; }
    // Sample of the lowest texel of the map.
    [[nodiscard]] Sample lowest() const { return lowest_; }
    // True where a texel of the map is a hole.
    [[nodiscard]] bool has_holes() const { return has_holes_; }

private:
    struct layer {
        Sample* samples = nullptr;
        std::int64_t width = 0, height = 0;
    };

    [[nodiscard]] static constexpr std::int64_t blocks(std::int64_t texels, int shift) {
        return (texels + (std::int64_t(1) << shift) - 1) >> shift;
    }
    [[nodiscard]] Sample lowest_sample() const {
        return descending_ ? (std::numeric_limits<Sample>::max)() : std::numeric_limits<Sample>::lowest();
    }
    // With a negative scale the smallest sample is the highest texel.
    [[nodiscard]] Sample higher(Sample a, Sample b) const { return descending_ ? (std::min)(a, b) : (std::max)(a, b); }
    [[nodiscard]] Sample lower(Sample a, Sample b) const { return descending_ ? (std::max)(a, b) : (std::min)(a, b); }

    void gather(const height_map<Sample>& heights, layer& out) {
        const std::int64_t side = std::int64_t(1) << shift_, width = heights.extent.x, height = heights.extent.y;
        for (std::int64_t by = 0; by < out.height; ++by) {
            for (std::int64_t bx = 0; bx < out.width; ++bx) {
                Sample top = lowest_sample();
                // One texel more all around: the cells that a ray crosses there reach as far, whichever way it goes.
                for (std::int64_t y = by * side - 1; y <= (std::min)(by * side + side, height); ++y) {
                    const std::int64_t row = resolve_edge(y, height, heights.edge);
                    if (row < 0) continue;
                    for (std::int64_t x = bx * side - 1; x <= (std::min)(bx * side + side, width); ++x) {
                        const std::int64_t column = resolve_edge(x, width, heights.edge);
                        if (column < 0) continue;
                        const Sample sample = sample_at(heights, column, row);
                        if (is_no_data(heights, sample)) {
                            has_holes_ = true;
                            continue;
                        }
                        top = higher(top, sample);
                        lowest_ = lower(lowest_, sample);
                    }
                }
                out.samples[by * out.width + bx] = top;
                highest_ = higher(highest_, top);
            }
        }
    }

    void halve(const layer& fine, layer& out) {
        for (std::int64_t y = 0; y < out.height; ++y) {
            for (std::int64_t x = 0; x < out.width; ++x) {
                const std::int64_t x1 = (std::min)(2 * x + 1, fine.width - 1),
                                   y1 = (std::min)(2 * y + 1, fine.height - 1);
                const Sample* upper = fine.samples + 2 * y * fine.width;
                const Sample* under = fine.samples + y1 * fine.width;
                out.samples[y * out.width + x] =
                    higher(higher(upper[2 * x], upper[x1]), higher(under[2 * x], under[x1]));
            }
        }
    }

    bool descending_ = false;
    bool has_holes_ = false;
    int shift_ = finest_shift;
    int count_ = 0;
    Sample highest_{}, lowest_{};
    layer levels_[32];
};

}  // namespace bumpshadow
