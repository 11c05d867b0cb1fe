// Vector quantization of whole horizon profiles: a texel stores the index of a row of a codebook, which holds all
// slices of a profile.
// Source: Forsyth, Self-shadowing Bumpmap using 3D Texture Hardware, section 5, which suggests vector quantization;
// k-means++ seeds: Arthur and Vassilvitskii, k-means++: The Advantages of Careful Seeding (2007).

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <bumpshadow/texture.hpp>

#include "common/report_text.hpp"
#include "encodings/planes.hpp"
#include "encodings/stored.hpp"
#include "report/sampled_map.hpp"
#include "report/sections.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

constexpr const char* section_name = "codebook";
constexpr double texels_of_a_map = 1024.0 * 1024.0;  // that share a codebook
constexpr int rounds = 12;                           // of k-means
constexpr std::size_t chunk = 256;                   // texels that a core takes at a time

// Numbers of 32 bits, the same with every standard library (Steele, Lea and Flood, Fast Splittable Pseudorandom Number
// Generators, 2014).
class generator {
public:
    explicit generator(std::uint64_t seed) : state_(seed) {}
    double below_one() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }

private:
    std::uint64_t state_;
};

// Profiles one after the other.
struct profiles {
    std::size_t slices = 0;
    std::vector<float> values;  // [profile][slice]

    [[nodiscard]] std::size_t size() const { return values.size() / slices; }
    [[nodiscard]] const float* operator[](std::size_t i) const { return values.data() + i * slices; }
    [[nodiscard]] float* operator[](std::size_t i) { return values.data() + i * slices; }
};

float distance(const float* a, const float* b, std::size_t slices) {
    float sum = 0.0f;
    for (std::size_t i = 0; i < slices; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    return sum;
}

// Nearest row of a codebook for each profile; rows are kept slice by slice, so that many are compared at a time.
std::vector<std::uint16_t> nearest(const profiles& all, const profiles& book) {
    const std::size_t rows = book.size();
    std::vector<float> turned(book.values.size());
    for (std::size_t r = 0; r < rows; ++r)
        for (std::size_t i = 0; i < book.slices; ++i) turned[i * rows + r] = book[r][i];
    std::vector<std::uint16_t> indices(all.size());
    on_all_cores((all.size() + chunk - 1) / chunk, [&](std::size_t item) {
        std::vector<float> sums(rows);
        for (std::size_t p = item * chunk; p < std::min(all.size(), (item + 1) * chunk); ++p) {
            std::fill(sums.begin(), sums.end(), 0.0f);
            for (std::size_t i = 0; i < book.slices; ++i) {
                const float value = all[p][i];
                const float* const row = turned.data() + i * rows;
                for (std::size_t r = 0; r < rows; ++r) sums[r] += (row[r] - value) * (row[r] - value);
            }
            indices[p] = static_cast<std::uint16_t>(std::min_element(sums.begin(), sums.end()) - sums.begin());
        }
    });
    return indices;
}

// Rows that are drawn one after the other, each with a chance in proportion to its square distance from those before.
profiles draw_rows(const profiles& all, std::size_t rows, generator& random) {
    profiles book{all.slices, {}};
    std::vector<float> squares(all.size(), std::numeric_limits<float>::max());
    std::size_t drawn = std::size_t(random.below_one() * double(all.size()));
    while (true) {
        book.values.insert(book.values.end(), all[drawn], all[drawn] + all.slices);
        if (book.size() == rows) return book;
        double sum = 0.0;
        for (std::size_t p = 0; p < all.size(); ++p) {
            squares[p] = std::min(squares[p], distance(all[p], all[drawn], all.slices));
            sum += double(squares[p]);
        }
        double left = random.below_one() * sum;
        for (drawn = 0; drawn + 1 < all.size() && left >= double(squares[drawn]); ++drawn)
            left -= double(squares[drawn]);
    }
}

// Least mean square distance of the profiles from their rows, as far as `rounds` of Lloyd's iteration get.
profiles train(const profiles& all, std::size_t rows, generator random) {
    profiles book = draw_rows(all, rows, random);
    for (int round = 0; round < rounds; ++round) {
        const std::vector<std::uint16_t> indices = nearest(all, book);
        std::vector<double> sums(book.values.size()), counts(rows);
        for (std::size_t p = 0; p < all.size(); ++p) {
            counts[indices[p]] += 1.0;
            for (std::size_t i = 0; i < all.slices; ++i) sums[indices[p] * all.slices + i] += double(all[p][i]);
        }
        for (std::size_t r = 0; r < rows; ++r)
            for (std::size_t i = 0; i < all.slices && counts[r] > 0.0; ++i)
                book[r][i] = float(sums[r * all.slices + i] / counts[r]);
    }
    return book;
}

// Every other texel, as on a chessboard: the codebook has to serve the others, too.
profiles part_of(const planes& slices) {
    profiles part{slices.values.size(), {}};
    for (int y = 0; y < slices.extent.y; ++y)
        for (int x = y % 2; x < slices.extent.x; x += 2)
            for (const std::vector<float>& plane : slices.values)
                part.values.push_back(plane[std::size_t(y) * std::size_t(slices.extent.x) + std::size_t(x)]);
    return part;
}

profiles all_of(const planes& slices) {
    profiles all{slices.values.size(), {}};
    for (std::size_t i = 0; i < slices.values.front().size(); ++i)
        for (const std::vector<float>& plane : slices.values) all.values.push_back(plane[i]);
    return all;
}

// What a shader reads: the row of the index of the nearest texel. Indices cannot be filtered.
planes read(const planes& slices, const profiles& book) {
    const std::vector<std::uint16_t> indices = nearest(all_of(slices), book);
    planes found{slices.extent, {}};
    for (std::size_t s = 0; s < book.slices; ++s) {
        std::vector<float>& plane = found.values.emplace_back();
        for (const std::uint16_t index : indices) plane.push_back(book[index][s]);
    }
    pass_through(found, bs::texel_format::r8);
    return found;
}

struct choice {
    int slices, rows;
};

std::vector<choice> choices(bool quick) {
    std::vector<choice> all;
    for (const int slices : {8, 16})
        for (const int rows : {64, 256, 1024})
            if (!quick || (slices == 8 && rows <= 256)) all.push_back({slices, rows});
    return all;
}

void measure(const report_context& context, const report_map& from) {
    sampled_map map(context, section_name, *sample_of(context, from));
    const sample_map& sample = map.cut(patch_side);
    for (const choice& c : choices(context.quick)) {
        const bs::slice_set set{c.slices, 0.0, bs::bearing_function::cubic};
        const bs::horizon_scale scale;
        const planes slices =
            fit_planes(sample.every(light_bearings), sample.directions, set, scale, bs::slice_fit::least_squares);
        const profiles book = train(part_of(slices), std::size_t(c.rows), generator(context.seed));
        record r;
        r.family = format("codebook of %d slices", c.slices);
        r.name = format("%d profiles of %d slices", c.rows, c.slices);
        r.format = c.rows > 256 ? "R16 index" : "R8 index";
        r.fit = "least squares";
        r.function = "cubic";
        r.quantity = name_of(scale.stored);
        r[column::entries] = c.rows;
        r[column::bearings] = c.slices;
        r[column::reduction] = 1.0;
        r[column::bytes] = (c.rows > 256 ? 2.0 : 1.0) + c.rows * c.slices / texels_of_a_map;
        r[column::fetches] = 2.0;  // index, then profile, whose slices the texture unit interpolates
        const score found = judge_slices(sample, read(slices, book), set, scale);
        context.step("codebooks of " + from.name);
        if (c.slices == 8 && c.rows == 256)
            map.add_with_elevations(r, found);
        else
            map.add(r, found);
    }
}

}  // namespace

report_section codebook_section() {
    return section_of({.name = section_name,
                       .title = "Codebooks: a texel stores the index of a whole profile",
                       .steps =
                           [](const report_context& context, const report_map& map) {
                               return sampled_patches(context, map) + int(choices(context.quick).size());
                           },
                       .seconds = 4.0,
                       .quick_seconds = 0.3,
                       .measure = measure});
}

}  // namespace examples
