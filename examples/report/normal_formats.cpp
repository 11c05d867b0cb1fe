#include "report/normal_formats.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>

#include <glm/ext/vector_double3.hpp>
#include <glm/ext/vector_double4.hpp>
#include <glm/ext/vector_float3.hpp>
#include <glm/ext/vector_float4.hpp>
#include <glm/geometric.hpp>

#include <bumpshadow/encode/bc1.hpp>
#include <bumpshadow/encode/bc4.hpp>
#include <bumpshadow/encode/stb_blocks.hpp>
#include <bumpshadow/executor.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/quantize.hpp>

#include "common/file.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

std::size_t texels_of(const bs::normal_map& normals) {
    return std::size_t(normals.extent.x) * std::size_t(normals.extent.y);
}

// RGB or RGBA as other tools write it.
std::vector<std::byte> bytes_of(const bs::normal_map& normals, int channels) {
    std::vector<std::byte> bytes(texels_of(normals) * std::size_t(channels));
    require(bs::encode_normals(normals, {}, {.bytes = bytes, .extent = normals.extent, .channels = channels}));
    return bytes;
}

std::vector<float> planes_of(std::span<const std::byte> bytes, glm::ivec2 extent, int channels) {
    std::vector<float> planes(3 * std::size_t(extent.x) * std::size_t(extent.y));
    require(bs::decode_normals({.bytes = bytes, .extent = extent, .channels = channels}, {},
                               {.values = planes, .extent = extent}));
    return planes;
}

// z is what is left to unit length; of x and y that are too long already, the direction counts.
glm::vec3 with_z(float stored_x, float stored_y) {
    constexpr float least = 1e-12f;  // 0 would make a hole
    const float x = 2.0f * stored_x - 1.0f, y = 2.0f * stored_y - 1.0f;
    return glm::normalize(glm::vec3(x, y, std::sqrt(std::max(least, 1.0f - x * x - y * y))));
}

// Runs body(first texel, texels of the block in rows) for each block of 4 x 4.
template <class Body>
void for_blocks(glm::ivec2 extent, const Body& body) {
    bs::threads()(std::size_t((extent.y + 3) / 4), [&](std::size_t row) {
        for (int x = 0; x < extent.x; x += 4) {
            std::array<glm::ivec2, 16> texels;
            for (int i = 0; i < 16; ++i)
                texels[std::size_t(i)] = {std::min(x + i % 4, extent.x - 1),
                                          std::min(4 * int(row) + i / 4, extent.y - 1)};
            body(texels);
        }
    });
}

double blocks_of(glm::ivec2 extent) {
    const glm::ivec2 blocks = (extent + 3) / 4;
    return double(blocks.x) * double(blocks.y);
}

// A color that occurs, as a normal in units of its bytes.
struct entry {
    glm::vec3 color{0.0f};
    double count = 0.0;
    int nearest = 0;
};

glm::vec3 color_of(std::uint32_t key) { return {float(key & 255u), float(key >> 8 & 255u), float(key >> 16 & 255u)}; }

// Entries begin ... end as one color of the palette.
struct box {
    std::size_t begin, end;
    int axis = 0;
    double spread = 0.0;  // sum of squares along the axis

    box(std::span<const entry> all, std::size_t b, std::size_t e) : begin(b), end(e) {
        glm::dvec3 sum(0.0), square(0.0);
        double count = 0.0;
        for (const entry& c : all.subspan(b, e - b)) {
            const glm::dvec3 color(c.color);
            sum += c.count * color;
            square += c.count * color * color;
            count += c.count;
        }
        const glm::dvec3 deviation = square - sum * sum / count;
        for (int i = 0; i < 3; ++i)
            if (deviation[i] > spread) spread = deviation[i], axis = i;
    }
};

std::vector<glm::vec3> cut_at_medians(std::vector<entry>& entries, std::size_t wanted) {
    std::vector<box> boxes{box(entries, 0, entries.size())};
    while (boxes.size() < wanted) {
        const auto widest = std::max_element(boxes.begin(), boxes.end(),
                                             [](const box& a, const box& b) { return a.spread < b.spread; });
        if (!(widest->spread > 0.0)) break;
        const box whole = *widest;
        const auto first = entries.begin() + std::ptrdiff_t(whole.begin);
        const auto last = entries.begin() + std::ptrdiff_t(whole.end);
        // The colors differ, so that the order is the same everywhere.
        std::sort(first, last, [axis = whole.axis](const entry& a, const entry& b) {
            if (a.color[axis] != b.color[axis]) return a.color[axis] < b.color[axis];
            return std::array{a.color.x, a.color.y, a.color.z} < std::array{b.color.x, b.color.y, b.color.z};
        });
        double count = 0.0, half = 0.0;
        for (auto e = first; e != last; ++e) count += e->count;
        std::size_t middle = whole.begin;
        while (middle < whole.end - 1 && (half += entries[middle].count) < 0.5 * count) ++middle;
        middle = std::clamp(middle, whole.begin + 1, whole.end - 1);
        *widest = box(entries, whole.begin, middle);
        boxes.emplace_back(entries, middle, whole.end);
    }
    std::vector<glm::vec3> colors;
    for (const box& b : boxes) {
        glm::dvec3 sum(0.0);
        double count = 0.0;
        for (const entry& e : std::span(entries).subspan(b.begin, b.end - b.begin)) {
            sum += e.count * glm::dvec3(e.color);
            count += e.count;
        }
        colors.emplace_back(sum / count);
    }
    return colors;
}

void assign(std::vector<entry>& entries, const std::vector<glm::vec3>& palette) {
    constexpr std::size_t chunk = 256;
    bs::threads()((entries.size() + chunk - 1) / chunk, [&](std::size_t item) {
        for (std::size_t i = item * chunk; i < std::min((item + 1) * chunk, entries.size()); ++i) {
            float least = std::numeric_limits<float>::max();
            for (std::size_t p = 0; p < palette.size(); ++p) {
                const glm::vec3 d = entries[i].color - palette[p];
                const float square = d.x * d.x + d.y * d.y + d.z * d.z;
                if (square < least) least = square, entries[i].nearest = int(p);
            }
        }
    });
}

// Bytes that stand for a direction.
glm::vec3 as_bytes(glm::vec3 color) {
    const glm::vec3 normal = color - 127.5f;
    const float length = glm::length(normal);
    const glm::vec3 unit = length > 0.0f ? normal / length : glm::vec3(0.0f, 0.0f, 1.0f);
    return glm::floor(255.0f * (0.5f + 0.5f * unit) + 0.5f);
}

}  // namespace

stored_normals normals_as_rgb(const bs::normal_map& normals) {
    const std::vector<std::byte> bytes = bytes_of(normals, 3);
    return {"RGB, 8 bits a channel", "rgb8", planes_of(bytes, normals.extent, 3), double(bytes.size())};
}

stored_normals normals_as_xy(const bs::normal_map& normals) {
    stored_normals stored{"x and y, 8 bits each", "rg8", std::vector<float>(3 * texels_of(normals)),
                          2.0 * double(texels_of(normals))};
    const bs::normal_map out{.values = stored.planes, .extent = normals.extent};
    const auto rounded = [](float v) { return bs::from_unorm8(bs::to_unorm8(0.5f + 0.5f * v)); };
    for (int y = 0; y < normals.extent.y; ++y)
        for (int x = 0; x < normals.extent.x; ++x) {
            const glm::vec3 n = normals.at(x, y);
            out.set(x, y, with_z(rounded(n.x), rounded(n.y)));
        }
    return stored;
}

stored_normals normals_as_bc1(const bs::normal_map& normals) {
    const glm::ivec2 extent = normals.extent;
    std::vector<std::byte> bytes = bytes_of(normals, 4);
    for_blocks(extent, [&](const std::array<glm::ivec2, 16>& texels) {
        std::array<std::byte, 64> block;
        std::array<std::byte, 8> packed;
        const auto at = [&](glm::ivec2 p) {
            return bytes.data() + 4 * (std::size_t(p.y) * std::size_t(extent.x) + std::size_t(p.x));
        };
        for (std::size_t i = 0; i < 16; ++i) std::copy_n(at(texels[i]), 4, block.data() + 4 * i);
        bs::encode_bc1_stb(block.data(), packed.data());
        // Backwards, so that what was repeated beyond the border does not count.
        for (int i = 15; i >= 0; --i) {
            const glm::vec4 color = bs::decode_bc1(packed.data(), i);
            for (int c = 0; c < 3; ++c) at(texels[std::size_t(i)])[c] = std::byte(bs::to_unorm8(color[c]));
        }
    });
    return {"DXT1", "bc1", planes_of(bytes, extent, 4), 8.0 * blocks_of(extent)};
}

stored_normals normals_as_bc5(const bs::normal_map& normals) {
    stored_normals stored{"BC5", "bc5", std::vector<float>(3 * texels_of(normals)), 16.0 * blocks_of(normals.extent)};
    const bs::normal_map out{.values = stored.planes, .extent = normals.extent};
    for_blocks(normals.extent, [&](const std::array<glm::ivec2, 16>& texels) {
        float decoded[2][16];
        for (int c = 0; c < 2; ++c) {
            float values[16];
            std::array<std::byte, 8> packed;
            for (std::size_t i = 0; i < 16; ++i) values[i] = 0.5f + 0.5f * normals.at(texels[i].x, texels[i].y)[c];
            bs::encode_bc4(values, packed.data());
            bs::decode_bc4(packed.data(), decoded[c]);
        }
        for (std::size_t i = 16; i-- > 0;) out.set(texels[i].x, texels[i].y, with_z(decoded[0][i], decoded[1][i]));
    });
    return stored;
}

stored_normals normals_as_palette(const bs::normal_map& normals, int rounds) {
    std::vector<std::byte> bytes = bytes_of(normals, 3);
    const std::size_t texels = texels_of(normals);
    std::vector<std::uint32_t> keys(texels), sorted;
    for (std::size_t i = 0; i < texels; ++i)
        for (std::size_t c = 0; c < 3; ++c) keys[i] |= std::to_integer<std::uint32_t>(bytes[3 * i + c]) << 8 * c;
    sorted = keys;
    std::sort(sorted.begin(), sorted.end());
    std::vector<entry> entries;
    std::vector<std::uint32_t> different;
    for (const std::uint32_t key : sorted) {
        if (different.empty() || different.back() != key) {
            different.push_back(key);
            entries.push_back({color_of(key)});
        }
        entries.back().count += 1.0;
    }

    std::vector<entry> ordered = entries;
    std::vector<glm::vec3> palette = cut_at_medians(ordered, 256);
    for (int round = 0; round < rounds; ++round) {
        assign(entries, palette);
        std::vector<glm::dvec4> sums(palette.size(), glm::dvec4(0.0));
        for (const entry& e : entries) sums[std::size_t(e.nearest)] += e.count * glm::dvec4(glm::dvec3(e.color), 1.0);
        for (std::size_t p = 0; p < palette.size(); ++p)
            if (sums[p].w > 0.0) palette[p] = glm::vec3(glm::dvec3(sums[p]) / sums[p].w);
    }
    for (glm::vec3& color : palette) color = as_bytes(color);
    assign(entries, palette);

    for (std::size_t i = 0; i < texels; ++i) {
        const auto at = std::size_t(std::lower_bound(different.begin(), different.end(), keys[i]) - different.begin());
        const glm::vec3 color = palette[std::size_t(entries[at].nearest)];
        for (int c = 0; c < 3; ++c) bytes[3 * i + std::size_t(c)] = std::byte(int(color[c]));
    }
    return {"palette of 256", "p8", planes_of(bytes, normals.extent, 3), double(texels) + 4.0 * double(palette.size()),
            int(palette.size())};
}

}  // namespace examples
