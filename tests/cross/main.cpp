// What floating-point arithmetic of another machine or compiler changes: bakes and packs the demo's wall here and
// compares with what another build wrote.
//   bumpshadow_cross write FILE     bakes, packs, writes all of it
//   bumpshadow_cross compare FILE   does the same from the other's heights and slopes, prints and judges differences

#include <bumpshadow/bearing.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/normal_map.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string_view>
#include <vector>

#include "common/stone_wall.hpp"

namespace {

using namespace bumpshadow;

// Bounds, several times what was measured between x86-64, 64-bit Arm and WebAssembly.
constexpr double most_degrees = 0.001;  // elevation of any horizon
constexpr double most_share = 2e-5;     // of bytes that differ, by 1; none may by more

constexpr int bearings = 16, part_rows = 128;

struct record {
    const char* name;
    std::vector<std::byte> bytes;

    template <class Value>
    [[nodiscard]] std::span<const Value> as() const {
        return {reinterpret_cast<const Value*>(bytes.data()), bytes.size() / sizeof(Value)};
    }
};

void require(const status& s) {
    if (s) return;
    std::printf("%s\n", s.message().c_str());
    std::exit(1);
}

// Runs make(std::span<std::byte>) on memory of its own.
template <class Make>
record made(const char* name, std::size_t size, const Make& make) {
    record r{name, std::vector<std::byte>(size)};
    require(make(r.bytes));
    return r;
}

std::vector<glm::dvec2> directions() {
    std::vector<glm::dvec2> result(bearings);
    fill_directions(result);
    return result;
}

// Horizons of a part of the wall by every method.
std::vector<record> baked(std::span<const std::uint16_t> samples, glm::ivec2 extent, double height_scale) {
    auto heights = tight_height_map(samples.data(), extent);
    heights.height_scale = height_scale;
    const auto ways = directions();
    const auto with = [&](const char* name, int rows, int steps, const auto& bake) {
        const bake_options options{.steps = steps, .region = {{0, 100}, {extent.x, rows}}};
        const glm::ivec2 size = options.region.extent;
        return made(name, 4 * required_size(size, bearings), [&](std::span<std::byte> bytes) {
            const std::span slopes(reinterpret_cast<float*>(bytes.data()), bytes.size() / 4);
            return bake(horizon_map{.values = slopes, .extent = size, .bearings = bearings}, options);
        });
    };
    const auto cascade = [&](const auto& out, const auto& options) {
        return bake_cascade(heights, ways, out, options);
    };
    const auto sweep = [&](const auto& out, const auto& options) { return bake_sweep(heights, ways, out, options); };
    const auto classic = [&](const auto& out, const auto& options) {
        return bake_sweep_classic(heights, ways, out, options);
    };
    const auto neighborhood = [&](const auto& out, const auto& options) {
        return bake_neighborhood(heights, ways, out, options);
    };
    const auto exact = [&](const auto& out, const auto& options) { return bake_exact(heights, ways, out, options); };
    std::vector<record> all;
    all.push_back(with("cascade", part_rows, 12, cascade));
    all.push_back(with("cascade, 48 steps", part_rows, 48, cascade));
    all.push_back(with("sweep", part_rows, 12, sweep));
    all.push_back(with("sweep-classic", part_rows, 12, classic));
    all.push_back(with("neighborhood", part_rows, 12, neighborhood));
    all.push_back(with("exact", 4, 12, exact));  // a thousand times as slow
    return all;
}

// Textures of those horizons.
std::vector<record> packed(std::span<float> slopes, glm::ivec2 extent) {
    const horizon_map map{.values = slopes, .extent = extent, .bearings = bearings};
    const auto ways = directions();
    const auto with = [&](const char* name, const texture_layout& layout, const auto& pack) {
        return made(name, layout.required_size(), [&](std::span<std::byte> bytes) {
            return pack(texture{bytes, layout});
        });
    };
    std::vector<record> all;
    tangent_volume volume;
    const auto pack_volume = [&](const texture& out) { return pack_tangent_volume(map, ways, volume, {}, out); };
    all.push_back(with("8 slices, 8 bits", layout_of(volume, extent), pack_volume));
    volume.format = texel_format::bc4;
    all.push_back(with("8 slices, BC4", layout_of(volume, extent), pack_volume));
    const slice_layers layers;
    all.push_back(with("layers", layout_of(layers, extent),
                       [&](const texture& out) { return pack_slice_layers(map, ways, layers, {}, out); }));
    const sine_layers sines;
    all.push_back(with("sine layers", layout_of(sines, extent),
                       [&](const texture& out) { return pack_sine_layers(map, ways, sines, {}, std::span(&out, 1)); }));
    fourier series;
    series.coefficients = 3;
    all.push_back(with("3 Fourier coefficients", layout_of(series, extent),
                       [&](const texture& out) { return pack_fourier(map, ways, series, {}, std::span(&out, 1)); }));
    const ssbump masks;
    const std::size_t texels = std::size_t(extent.x) * std::size_t(extent.y);
    std::vector<float> up(3 * texels);  // planes of x, y and z
    std::fill_n(up.begin() + std::ptrdiff_t(2 * texels), texels, 1.0f);
    const normal_map normals{.values = up, .extent = extent};
    all.push_back(with("SSBump", layout_of(masks, extent),
                       [&](const texture& out) { return pack_ssbump(map, ways, normals, masks, out); }));
    return all;
}

// ---- Files: a 64-bit size before each record ----

void write(std::FILE* file, const record& r) {
    const std::uint64_t size = r.bytes.size();
    std::fwrite(&size, sizeof size, 1, file);
    std::fwrite(r.bytes.data(), 1, r.bytes.size(), file);
}

record read(std::FILE* file) {
    std::uint64_t size = 0;
    if (std::fread(&size, sizeof size, 1, file) != 1 || size > (1u << 30)) return {};
    record r{"", std::vector<std::byte>(std::size_t(size))};
    if (std::fread(r.bytes.data(), 1, r.bytes.size(), file) != r.bytes.size()) return {};
    return r;
}

// ---- Judging ----

bool good = true;

void judge(const char* name, bool held, const char* pattern, double first, double second) {
    std::printf("%-24s ", name);
    std::printf(pattern, first, second);
    std::printf("%s\n", held ? "" : "   NOT held");
    good = good && held;
}

void compare_slopes(const record& here, const record& there) {
    const auto a = here.as<float>(), b = there.as<float>();
    double worst = a.size() == b.size() ? 0.0 : 90.0;
    std::size_t different = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        different += a[i] != b[i];
        worst = std::max(worst, std::abs(std::atan(double(a[i])) - std::atan(double(b[i]))) * 57.29577951308232);
    }
    judge(here.name, worst <= most_degrees, "%8.4f %% of slopes differ, by at most %.2g degrees",
          100.0 * double(different) / double(a.size()), worst);
}

template <class Value>
void compare_numbers(const record& here, const record& there) {
    const auto a = here.as<Value>(), b = there.as<Value>();
    int worst = a.size() == b.size() ? 0 : 1 << 16;
    std::size_t different = 0;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) {
        different += a[i] != b[i];
        worst = std::max(worst, std::abs(int(a[i]) - int(b[i])));
    }
    const double share = double(different) / double(a.size());
    judge(here.name, worst <= 1 && share <= most_share, "%8.4f %% of numbers differ, by at most %g", 100.0 * share,
          double(worst));
}

// Blocks of another choice of ends hold other bits, so what they decode to is compared, in 255ths.
void compare_blocks(const record& here, const record& there) {
    record values[2] = {{here.name, {}}, {there.name, {}}};
    for (int side = 0; side < 2; ++side) {
        const record& r = side == 0 ? here : there;
        for (std::size_t at = 0; at + 8 <= r.bytes.size(); at += 8) {
            float decoded[16];
            decode_bc4(r.bytes.data() + at, decoded);
            for (const float v : decoded) values[side].bytes.push_back(std::byte(int(255.0f * v + 0.5f)));
        }
    }
    compare_numbers<std::uint8_t>(values[0], values[1]);
}

}  // namespace

int main(int argc, char** argv) {
    const std::string_view mode = argc == 3 ? argv[1] : "";
    if (mode != "write" && mode != "compare") return 2;
    std::FILE* const file = std::fopen(argv[2], mode == "write" ? "wb" : "rb");
    if (file == nullptr) {
        std::printf("cannot open %s\n", argv[2]);
        return 1;
    }
    const examples::stone_wall wall = examples::make_stone_wall();
    record heights{"heights", {}};
    const auto samples = std::as_bytes(std::span(wall.heights));
    heights.bytes.assign(samples.begin(), samples.end());

    if (mode == "write") {
        write(file, heights);
        auto horizons = baked(wall.heights, wall.extent, wall.height_scale);
        for (const record& r : horizons) write(file, r);
        const std::span slopes(reinterpret_cast<float*>(horizons[0].bytes.data()), horizons[0].bytes.size() / 4);
        for (const record& r : packed(slopes, {wall.extent.x, part_rows})) write(file, r);
        return std::fclose(file) == 0 ? 0 : 1;
    }
    // From the same heights and slopes, so that each step answers for itself.
    const record there = read(file);
    compare_numbers<std::uint16_t>(heights, there);
    if (!good) return 1;
    std::vector<float> slopes;
    for (const record& r : baked(there.as<std::uint16_t>(), wall.extent, wall.height_scale)) {
        const record other = read(file);
        compare_slopes(r, other);
        if (slopes.empty()) slopes.assign(other.as<float>().begin(), other.as<float>().end());
    }
    if (!good) return 1;
    for (const record& r : packed(slopes, {wall.extent.x, part_rows})) {
        const record other = read(file);
        if (std::strcmp(r.name, "8 slices, BC4") == 0)
            compare_blocks(r, other);
        else
            compare_numbers<std::uint8_t>(r, other);
    }
    std::fclose(file);
    return good ? 0 : 1;
}
