#include "report/image_setups.hpp"

#include <utility>

#include "common/report_text.hpp"

namespace examples {
namespace {

namespace bs = bumpshadow;

// Where a case has several edges, "soft" stands for all: they cost the same.
constexpr const char* volume = "tangent volume, cubic, soft";

image_setup slices(int count, stored_bits bits, int reduce = 1) {
    encoding_settings s;
    s.bearings = count;
    s.bits = bits;
    s.reduce = reduce;
    const char* const format = bits == stored_bits::bc4 ? "BC4" : "R8";
    image_setup setup{std::string("tangent volume, ").append(format), {}, s, volume};
    setup.name = examples::format("%d slices, %s", count, format);
    if (reduce > 1) setup.name += examples::format(", 1/%d extent", reduce);
    return setup;
}

// Slices of their own horizons, where Forsyth's function puts them.
image_setup published_slices() {
    image_setup setup = slices(8, stored_bits::eight);
    setup.settings.fit = bs::slice_fit::point;
    setup.settings.function = bs::bearing_function::octant;
    setup.name += ", as published";
    setup.snippet = "tangent volume, octant, soft";
    return setup;
}

image_setup layers(int count, bool overlapping) {
    encoding_settings s;
    s.kind = encoding_kind::layers;
    s.bearings = count;
    s.overlapping = overlapping;
    image_setup setup{"slice layers, RGBA8", format("%d slices in layers%s", count, overlapping ? ", overlapping" : ""),
                      s};
    setup.snippet = overlapping ? "slice layers, overlapping, one fetch, cubic, soft"
                                : "slice layers, grouped, two fetches, cubic, soft";
    return setup;
}

image_setup sines(bool published) {
    encoding_settings s;
    s.kind = encoding_kind::sine;
    s.published = published;
    return {"sine layers", published ? "sine layers, as published" : "sine layers, fitted", s,
            published ? "eight channels, published cube, sines, soft" : "eight channels, no cube, sines, soft"};
}

image_setup series(int coefficients, bool published = false) {
    encoding_settings s;
    s.kind = encoding_kind::fourier;
    s.coefficients = coefficients;
    s.published = published;
    image_setup setup{"Fourier", format("Fourier, %d coefficients%s", coefficients, published ? ", as posted" : ""), s};
    setup.snippet = published ? std::string("yardstick, Fourier, 5, with the unit vector that is meant")
                              : format("Fourier, %d, soft", coefficients);
    return setup;
}

image_setup simple(encoding_kind kind, const char* name, const char* snippet) {
    encoding_settings s;
    s.kind = kind;
    return {name, name, s, snippet};
}

}  // namespace

std::vector<image_setup> image_setups(bool quick) {
    using enum stored_bits;
    const auto pictured = [](image_setup setup) {
        setup.pictured = true;
        return setup;
    };
    std::vector<image_setup> all{
        pictured(simple(encoding_kind::none, "no shadows", "")),
        pictured(slices(8, eight)),
        pictured(slices(16, bc4)),
        pictured(sines(true)),
        pictured(series(5)),
        pictured(simple(encoding_kind::ssbump, "SSBump", "SSBump, dynamic light")),
    };
    if (quick) return all;
    for (const int count : {4, 16, 32}) all.push_back(slices(count, eight));
    all.push_back(slices(8, bc4));
    for (const int reduce : {2, 4}) all.push_back(slices(16, eight, reduce));
    all.push_back(published_slices());
    all.push_back(layers(16, false));
    all.push_back(layers(12, true));
    all.push_back(sines(false));
    for (const int coefficients : {3, 7, 9}) all.push_back(series(coefficients));
    all.push_back(series(5, true));
    all.push_back(simple(encoding_kind::emboss, "emboss", "emboss, shift a pixel, two heights"));
    return all;
}

}  // namespace examples
