#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <bumpshadow/encode/emboss.hpp>
#include <bumpshadow/encode/fourier.hpp>
#include <bumpshadow/encode/sine_layers.hpp>
#include <bumpshadow/encode/slice_layers.hpp>
#include <bumpshadow/encode/ssbump.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>
#include <bumpshadow/texture.hpp>

#include "common/heights.hpp"
#include "common/method.hpp"

// Declared alone: CLI11 takes seconds to compile.
namespace CLI {
class App;
}

namespace examples {

enum class encoding_kind { tangent, layers, sine, fourier, ssbump, emboss, traced, none };
enum class stored_bits { eight, sixteen, bc4 };

// What the command line says of an encoding; what is not given takes the encoding's own default.
struct encoding_settings {
    encoding_kind kind = encoding_kind::tangent;
    std::optional<int> bearings;
    stored_bits bits = stored_bits::eight;
    int reduce = 1;
    bumpshadow::slice_fit fit = bumpshadow::slice_fit::least_squares;
    bumpshadow::bearing_function function = bumpshadow::slice_set{}.function;
    std::optional<bumpshadow::quantity> stored;
    std::optional<double> max_slope;
    bool mips = false;
    std::optional<std::pair<double, double>> arc;                                    // tangent: degrees
    bool array = false;                                                              // tangent
    bool overlapping = false;                                                        // layers
    bool published = false;                                                          // sine, fourier
    bool factor_cube = false;                                                        // sine
    int coefficients = 5;                                                            // fourier
    bool square_root = false;                                                        // fourier
    bumpshadow::normal_y y = bumpshadow::normal_y::down;                             // ssbump
    bumpshadow::mask_occlusion occlusion = bumpshadow::mask_occlusion::directional;  // ssbump
};

// A texture with its bytes.
struct owned_texture {
    bumpshadow::texture_layout layout;
    std::vector<std::byte> bytes;

    explicit owned_texture(const bumpshadow::texture_layout& l) : layout(l), bytes(l.required_size()) {}
    [[nodiscard]] bumpshadow::texture view() { return {bytes, layout}; }
    [[nodiscard]] bumpshadow::const_texture view() const { return {bytes, layout}; }
};

// An encoded height map: the constants that decoding needs, and its textures.
struct encoded {
    std::variant<bumpshadow::tangent_volume, bumpshadow::slice_layers, bumpshadow::sine_layers, bumpshadow::fourier,
                 bumpshadow::ssbump, bumpshadow::emboss>
        how;
    std::vector<owned_texture> textures;
    glm::ivec2 extent{0};  // of the height map
    int directions = 0;    // baked
    bumpshadow::pack_report report;
    double bake_seconds = 0.0, pack_seconds = 0.0;
};

// --encoding and all that belongs to it. `extra`: kinds beside those that make a texture (traced, none).
void add_encoding_options(CLI::App& app, encoding_settings& settings, bool extra);

[[nodiscard]] std::string name_of(encoding_kind kind);

// Bakes what the encoding needs and packs it. Throws failure.
[[nodiscard]] encoded encode_heights(const height_samples& samples, const height_source& source,
                                     const horizon_settings& horizons, const encoding_settings& settings, int threads);

// Normals of a map, as planes. Throws failure.
[[nodiscard]] std::vector<float> normals_of(const height_samples& samples, const height_source& source, int threads);

// What a shader author has to know, as the end of a sentence.
[[nodiscard]] std::string for_shaders(const encoded& map);

// Members of a JSON object (without braces) with every constant that decoding needs, and the layouts of the textures.
[[nodiscard]] std::string json_of(const encoded& map);

}  // namespace examples
