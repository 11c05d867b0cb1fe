#include "faults/cases.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/fourier_mips.hpp>
#include <bumpshadow/encode/reduce.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/horizon/cascade.hpp>
#include <bumpshadow/horizon/exact.hpp>
#include <bumpshadow/horizon/neighborhood.hpp>
#include <bumpshadow/horizon/sweep.hpp>
#include <bumpshadow/measure/elevation.hpp>
#include <bumpshadow/measure/flip.hpp>
#include <bumpshadow/measure/sample.hpp>
#include <bumpshadow/normal_map.hpp>
#include <bumpshadow/pixels.hpp>
#include <bumpshadow/reference/shade.hpp>
#include <bumpshadow/reference/shadow.hpp>
#include <bumpshadow/shader/bake_plan.hpp>

#include "support/horizons.hpp"
#include "support/shapes.hpp"

namespace faults {
namespace {

using namespace bumpshadow;

constexpr glm::ivec2 extent{40, 37};
constexpr int width = usual_width;

// Inputs live as long as the program, since producers keep views of them.
const shapes::field<float>& field() {
    static const auto heights = [] {
        shapes::noise random(3);
        return shapes::sampled<float>(extent,
                                      [&](double x, double) { return (x > 20.0 ? 4.0 : 0.0) + random.uniform(); });
    }();
    return heights;
}
const std::vector<glm::dvec2>& ways() {
    static const std::vector<glm::dvec2> all = shapes::directions(5, 0.03);
    return all;
}
// A map and two mips, all in 32 directions.
const std::array<horizons, 3>& chain() {
    static const std::array<horizons, 3> all{horizons::random(extent, 32, 5), horizons::random(extent / 2, 32, 6),
                                             horizons::random(extent / 4, 32, 7)};
    return all;
}
const std::vector<horizon_map>& levels() {
    static const std::vector<horizon_map> all{chain()[0].view(), chain()[1].view(), chain()[2].view()};
    return all;
}
const std::vector<glm::dvec2>& around() { return chain()[0].directions; }

outputs floats(std::size_t count) { return {std::vector<float>(count, -7.0f), {}}; }
outputs bytes(std::size_t count) { return {{}, std::vector<std::byte>(count, std::byte(77))}; }

template <class Options>
Options options_of(const from& f) {
    Options options;
    options.scratch = f.scratch;
    options.memory = f.memory;
    return options;
}

horizon_map view_of(outputs& o, glm::ivec2 size, int bearings, std::size_t offset = 0) {
    return {.values = std::span(o.numbers).subspan(offset, required_size(size, bearings)),
            .extent = size,
            .bearings = bearings};
}

// bake(heights, directions, out, options, executor), of a part with the distances behind the slopes.
template <class Bake>
producer baker(const char* name, std::size_t scratch, const bake_options& how, Bake bake) {
    const bool part = !how.region.empty();
    const glm::ivec2 texels = region_or_all(how.region, extent).extent;
    const int count = int(ways().size());
    const std::size_t size = required_size(texels, count);
    return {name, floats(part ? 2 * size : size), scratch, [=](outputs& o, const from& f, const any_executor& execute) {
                bake_options options = how;
                options.scratch = f.scratch, options.memory = f.memory;
                if (part) options.distances = view_of(o, texels, count, size);
                return bake(field().view(part ? edge_mode::open : edge_mode::repeat), ways(), view_of(o, texels, count),
                            options, execute);
            }};
}

void add_bakers(std::vector<producer>& all) {
    const auto map = field().view();
    bake_options how;
    const auto each = [&](const char* name, std::size_t scratch, auto bake) {
        all.push_back(baker(name, scratch, how, bake));
    };
    const auto exact = [](const auto&... a) { return bake_exact(a...); };
    const auto cascade = [](const auto&... a) { return bake_cascade(a...); };
    each("bake_exact", exact_scratch_size(map), exact);
    each("bake_cascade", cascade_scratch_size(map, {}, width), cascade);
    each("bake_sweep", sweep_scratch_size(map, ways(), {}, any_executor{}),
         [](const auto&... a) { return bake_sweep(a...); });
    each("bake_sweep_classic", sweep_classic_scratch_size(map, ways(), {}, any_executor{}),
         [](const auto&... a) { return bake_sweep_classic(a...); });
    each("bake_neighborhood", neighborhood_scratch_size(map, ways()),
         [](const auto&... a) { return bake_neighborhood(a...); });
    // On a hollow base.
    how.steps = 40, how.radius = 9.0, how.curvature = {-0.01, -0.02}, how.region = {{5, 3}, {17, 21}};
    each("bake_exact, of a part", exact_scratch_size(map, ways(), how), exact);
    each("bake_cascade, of a part", cascade_scratch_size(map, how, width), cascade);
}

// pack(encoding, options, textures, executor), with the bytes of all textures one after the other.
template <class Encoding, class Pack>
producer packer(const char* name, const Encoding& encoding, int mips, std::size_t scratch, Pack pack) {
    std::vector<texture_layout> layouts;
    std::size_t size = 0;
    if constexpr (requires { layout_of(encoding, extent, mips, 0); })
        for (int i = 0; i < texture_count(encoding); ++i) layouts.push_back(layout_of(encoding, extent, mips, i));
    else
        layouts.push_back(layout_of(encoding, extent, mips));
    for (const texture_layout& l : layouts) size += l.required_size();
    return {name, bytes(size), scratch, [=](outputs& o, const from& f, const any_executor& execute) {
                std::vector<texture> textures;
                std::size_t start = 0;
                for (const texture_layout& l : layouts) {
                    textures.push_back({std::span(o.bytes).subspan(start, l.required_size()), l});
                    start += l.required_size();
                }
                return pack(encoding, options_of<pack_options>(f), std::span<const texture>(textures), execute);
            }};
}

void add_packers(std::vector<producer>& all) {
    const auto add = [&](const char* name, const auto& encoding, int mips, int slices, auto pack) {
        all.push_back(packer(name, encoding, mips, slice_scratch_size(extent, 32, slices, width), pack));
    };
    const tangent_volume volume{.slices = {.count = 8}, .scale = {.max_slope = 2.0f}};
    const auto pack_volume = [](const auto& encoding, const auto& options, const auto& out, const auto& execute) {
        return pack_tangent_volume(std::span(levels()).first(std::size_t(out[0].layout.mips)), around(), encoding,
                                   options, out[0], execute);
    };
    add("pack_tangent_volume", volume, 1, 8, pack_volume);
    add("pack_tangent_volume, mips", volume, 3, 8, pack_volume);
    add("pack_tangent_volume, least error of the elevation", volume, 3, 8,
        [pack_volume](const auto& encoding, auto options, const auto& out, const auto& execute) {
            options.fit = slice_fit::least_angle;
            return pack_volume(encoding, options, out, execute);
        });
    tangent_volume blocks = volume;
    blocks.format = texel_format::bc4;
    add("pack_tangent_volume, bc4", blocks, 3, 8, pack_volume);
    static const std::vector<std::byte> whole(layout_of(volume, extent, 3).required_size(), std::byte(50));
    add("halve_slices, mips", halved(volume), 3, 8,
        [volume](const auto&, const auto& options, const auto& out, const auto& execute) {
            return halve_slices({whole, layout_of(volume, extent, 3)}, volume, options, out[0], execute);
        });
    const slice_layers layers{.slices = {.count = 12}, .scale = {.max_slope = 2.0f}};
    add("pack_slice_layers, mips", layers, 3, 12,
        [](const auto& encoding, const auto& options, const auto& out, const auto& execute) {
            return pack_slice_layers(levels(), around(), encoding, options, out[0], execute);
        });
    const auto sines = [](const auto& encoding, const auto& options, const auto& out, const auto& execute) {
        return pack_sine_layers(levels(), around(), encoding, options, out, execute);
    };
    add("pack_sine_layers, mips", sine_layers{}, 3, 8, sines);
    add("pack_sine_layers_averaged, mips", sine_layers{}, 3, 32,
        [](const auto& encoding, const auto& options, const auto& out, const auto& execute) {
            return pack_sine_layers_averaged(levels(), around(), encoding, options, out, execute);
        });
    const fourier series{.coefficients = 5, .scale = {.max_slope = 2.0f}};
    all.push_back(packer("pack_fourier, mips", series, 3, fourier_scratch_size(extent, 32, series, width),
                         [](const auto& encoding, const auto& options, const auto& out, const auto& execute) {
                             return pack_fourier(levels(), around(), encoding, options, out, execute);
                         }));
    // Those that take no memory.
    static normal_map normals;
    static std::vector<float> straight_up(required_size(extent, 3), 0.0f);
    std::fill_n(straight_up.end() - std::ptrdiff_t(required_size(extent, 1)), required_size(extent, 1), 1.0f);
    normals.values = straight_up, normals.extent = extent;
    all.push_back(packer("pack_ssbump, mips", ssbump{}, 3, 0,
                         [](const auto& encoding, const auto&, const auto& out, const auto& execute) {
                             return pack_ssbump(levels()[0], around(), normals, encoding, out[0], execute);
                         }));
    all.back().memory = false;
    all.push_back(packer("pack_ssbump of normals, mips", ssbump{.occlusion = mask_occlusion::none}, 3, 0,
                         [](const auto& encoding, const auto&, const auto& out, const auto& execute) {
                             return pack_ssbump(normals, encoding, out[0], execute);
                         }));
    all.back().memory = false;
    const texture_layout flat{.format = texel_format::r8, .extent = extent, .mips = 3};
    all.push_back({"pack_emboss, mips", bytes(flat.required_size()), 0,
                   [flat](outputs& o, const from&, const any_executor& execute) {
                       return pack_emboss(field().view(), emboss{.lowest = 0.0, .scale = 0.1}, texture{o.bytes, flat},
                                          {}, nullptr, execute);
                   },
                   false});
}

// Levels 1 and 2 of the map, one after the other.
std::vector<horizon_map> mips_in(outputs& o) {
    const std::size_t first = required_size(extent / 2, 32);
    return {view_of(o, extent / 2, 32), view_of(o, extent / 4, 32, first)};
}

void add_mips(std::vector<producer>& all) {
    const std::size_t size = required_size(extent / 2, 32) + required_size(extent / 4, 32);
    static constexpr horizon_scale scale{.max_slope = 2.0f};
    static const fourier series{.coefficients = 5, .scale = scale};
    for (const bool keep : {true, false})
        all.push_back({keep ? "make_mips" : "make_mips, averages", floats(size), mip_scratch_size(extent, 32, width),
                       [keep](outputs& o, const from& f, const any_executor& execute) {
                           auto options = options_of<mip_options>(f);
                           options.keep_distribution = keep;
                           return make_mips(levels()[0], scale, mips_in(o), options, execute);
                       },
                       true, !keep});
    all.push_back({"make_fourier_mips", floats(size), fourier_mip_scratch_size(extent, 32, series, width),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       return make_fourier_mips(levels()[0], around(), series, mips_in(o), options_of<mip_options>(f),
                                                execute);
                   },
                   true, false});
    all.push_back({"reduce", floats(required_size(extent / 2, 32)), 0,
                   [](outputs& o, const from& f, const any_executor& execute) {
                       return reduce(levels()[0], scale, view_of(o, extent / 2, 32), execute, f.memory);
                   }});
    all.push_back({"fit_slices", floats(required_size(extent, 8)), slice_scratch_size(extent, 32, 8, width),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       return fit_slices(levels()[0], around(), slice_set{.count = 8}, scale,
                                         options_of<pack_options>(f), view_of(o, extent, 8), execute);
                   }});
    all.push_back({"tighten_ranges", floats(10), fourier_scratch_size(extent, 32, series, width),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       fourier encoding = series;
                       for (std::size_t i = 0; i < 5; ++i)
                           encoding.ranges[i] = {o.numbers[2 * i], o.numbers[2 * i + 1]};
                       const status s =
                           tighten_ranges(levels(), around(), encoding, options_of<pack_options>(f), execute);
                       for (std::size_t i = 0; i < 5; ++i) {
                           o.numbers[2 * i] = encoding.ranges[i].low;
                           o.numbers[2 * i + 1] = encoding.ranges[i].high;
                       }
                       return s;
                   },
                   true, true, false});
}

void add_measures(std::vector<producer>& all) {
    static const std::vector<glm::ivec2> texels{{3, 4}, {20, 30}, {39, 36}, {0, 0}};
    all.push_back({"sample_horizons", floats(texels.size() * ways().size()), sample_scratch_size(field().view()),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       return sample_horizons(field().view(), texels, ways(), o.numbers, options_of<bake_options>(f),
                                              execute);
                   }});
    static const std::vector<float> exact(texels.size() * 32, 0.5f);
    all.push_back({"elevation_error", floats(1), elevation_scratch_size(texels.size(), 32),
                   [](outputs& o, const from& f, const any_executor&) {
                       error_figures figures{.mean = double(o.numbers[0])};
                       const status s =
                           elevation_error(levels()[0], texels, exact, figures, options_of<measure_options>(f));
                       o.numbers[0] = float(figures.mean);
                       return s;
                   },
                   true, true, false});
    all.push_back({"plan_bake", floats(1), 0,
                   [](outputs& o, const from& f, const any_executor&) {
                       bake_plan plan;
                       const status s = plan_bake(field().view(), ways(), plan, options_of<bake_options>(f));
                       if (s) o.numbers[0] = float(plan.table_count);
                       return s;
                   },
                   true, true, false});
    static const std::vector<std::byte> black(required_size(extent, 3), std::byte(0)),
        gray(required_size(extent, 3), std::byte(99));
    all.push_back({"flip", floats(required_size(extent, 1)), flip_scratch_size(extent, {}, width),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       const const_pixels a{.bytes = black, .extent = extent, .channels = 3},
                           b{.bytes = gray, .extent = extent, .channels = 3};
                       return flip(a, b, o.numbers, options_of<flip_options>(f), execute);
                   }});
    static std::vector<float> linear(required_size(extent, 3), 0.25f), darker(linear.size(), 0.0f);
    all.push_back({"flip of linear light", floats(required_size(extent, 1)), flip_scratch_size(extent, {}, width),
                   [](outputs& o, const from& f, const any_executor& execute) {
                       return flip(rgb_image{.values = linear, .extent = extent},
                                   rgb_image{.values = darker, .extent = extent}, o.numbers,
                                   options_of<flip_options>(f), execute);
                   }});
}

// Normals and pictures, which take no memory.
void add_pictures(std::vector<producer>& all) {
    static const std::vector<float> bumpy = [] {
        std::vector<float> values(required_size(extent, 3));
        static_cast<void>(bake_normals(field().view(), normal_map{.values = values, .extent = extent}));
        return values;
    }();
    static std::vector<float> storage = bumpy;  // views of normals are of floats that may be written
    static const normal_map normals{.values = storage, .extent = extent};
    all.push_back({"bake_normals", floats(required_size(extent, 3)), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return bake_normals(field().view(), normal_map{.values = o.numbers, .extent = extent}, {},
                                           execute);
                   },
                   false});
    static const std::vector<std::byte> gray(required_size(extent, 4), std::byte(99));
    static const const_pixels picture{.bytes = gray, .extent = extent, .channels = 4};
    all.push_back({"encode_normals", bytes(gray.size()), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return encode_normals(normals, {}, pixels{.bytes = o.bytes, .extent = extent}, execute);
                   },
                   false});
    all.push_back({"decode_normals", floats(required_size(extent, 3)), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return decode_normals(picture, {}, normal_map{.values = o.numbers, .extent = extent}, execute);
                   },
                   false});
    static const tangent_volume volume{.slices = {.count = 8}, .scale = {.max_slope = 2.0f}};
    static const texture_layout layout = layout_of(volume, extent);
    static const std::vector<std::byte> slices(layout.required_size(), std::byte(50));
    all.push_back({"recover_normals", floats(required_size(extent, 3)), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       const ssbump masks;
                       return recover_normals({gray, layout_of(masks, extent)}, masks,
                                              normal_map{.values = o.numbers, .extent = extent}, 0, execute);
                   },
                   false});
    all.push_back({"bend_normals", floats(required_size(extent, 3)), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return bend_normals(levels()[0], around(), normal_map{.values = o.numbers, .extent = extent},
                                           execute);
                   },
                   false});
    all.push_back({"to_srgb8", bytes(gray.size()), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return to_srgb8(rgb_image{.values = storage, .extent = extent},
                                       pixels{.bytes = o.bytes, .extent = extent}, 0.9f, execute);
                   },
                   false});
    using shadow = encoded_shadow<tangent_volume>;
    static const shadow with{.encoding = volume, .textures = {slices, layout}, .edge = {8.0f, 1.0f}};
    for (const bool near : {false, true})
        all.push_back({near ? "shade, a near light" : "shade, a far light", floats(required_size(extent, 3)), 0,
                       [near](outputs& o, const from&, const any_executor& execute) {
                           shade_options options{.normals = normals, .diffuse = picture, .specular = glm::vec3(0.2f)};
                           if (near) options.light = {.kind = light_kind::point, .position = {20.0f, 10.0f, 5.0f}};
                           return shade(options, with, flat_surface{extent},
                                        rgb_image{.values = o.numbers, .extent = extent}, execute);
                       },
                       false});
}

// Embossing takes no memory either. The base is another picture than the output, so that items may run again.
void add_embossed(std::vector<producer>& all) {
    static const texture_layout layout = layout_of(emboss{}, extent);
    static const std::vector<std::byte> stored = [] {
        std::vector<std::byte> made(layout.required_size());
        static_cast<void>(pack_emboss(field().view(), emboss{.lowest = 0.0, .scale = 0.1}, texture{made, layout}));
        return made;
    }();
    static const std::vector<std::byte> gray(required_size(extent, 3), std::byte(99));
    static const auto shift = [](glm::vec2 uv) { return glm::vec2(1.5f, uv.y); };
    all.push_back({"draw_relief", bytes(required_size(extent, 1)), 0,
                   [](outputs& o, const from&, const any_executor& execute) {
                       return draw_relief({stored, layout}, edge_mode::repeat, shift,
                                          pixels{.bytes = o.bytes, .extent = extent, .channels = 1}, execute);
                   },
                   false});
    for (const emboss_passes passes : {emboss_passes::three, emboss_passes::one})
        all.push_back({passes == emboss_passes::one ? "draw_emboss, one pass" : "draw_emboss, three passes",
                       bytes(gray.size()), 0,
                       [passes](outputs& o, const from&, const any_executor& execute) {
                           return draw_emboss({stored, layout}, edge_mode::open,
                                              const_pixels{.bytes = gray, .extent = extent, .channels = 3}, shift,
                                              pixels{.bytes = o.bytes, .extent = extent, .channels = 3}, passes,
                                              {1.0f, 0.5f, 0.25f}, execute);
                       },
                       false});
}

}  // namespace

std::vector<producer> all_producers() {
    std::vector<producer> all;
    add_bakers(all);
    add_packers(all);
    add_mips(all);
    add_measures(all);
    add_pictures(all);
    add_embossed(all);
    return all;
}

}  // namespace faults
