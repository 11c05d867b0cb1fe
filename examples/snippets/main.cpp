// snippets: prints shader source for one choice, without a preprocessor line in it. `snippets --help` lists the
// options.

#include <cstdio>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <bumpshadow/shader/snippets.hpp>

#include "common/arguments.hpp"
#include "common/choices.hpp"
#include "common/file.hpp"

namespace {

using namespace examples;
namespace text = bumpshadow::shader_text;

struct arguments {
    text::choice chosen;
    text::dialect language = text::dialect::glsl;
    std::vector<std::string> names;
    bool list = false;
};

void work(const arguments& arguments) {
    std::string source;
    const auto write = [&](std::string_view part) { source += part; };
    if (arguments.list) {
        for (const text::snippet& s : text::snippets) source += std::string(s.name) + '\n';
    } else if (!arguments.names.empty()) {
        for (const std::string& name : arguments.names) {
            const std::string_view one[] = {name};
            if (!text::compose(one, arguments.language, [](std::string_view) {}))
                throw failure(name + " is no snippet; --list names them");
        }
        const std::vector<std::string_view> views(arguments.names.begin(), arguments.names.end());
        static_cast<void>(text::compose(views, arguments.language, write));
    } else {
        text::compose(arguments.chosen, arguments.language, write);
    }
    std::fwrite(source.data(), 1, source.size(), stdout);
    flush_stdout();
}

}  // namespace

int main(int argc, char** argv) try {
    CLI::App app(
        "Prints the shader functions that one way of decoding needs and no others, as GLSL or HLSL without a line for "
        "a "
        "preprocessor: for engines that have none.",
        "snippets");
    arguments arguments;
    using text::decoder;
    using text::edge;
    add_choice<decoder>(app, "--decoder", arguments.chosen.decode,
                        {{"volume", decoder::volume},
                         {"slices", decoder::slices},
                         {"arc", decoder::arc},
                         {"arc-slices", decoder::arc_slices},
                         {"grouped", decoder::grouped},
                         {"overlapping", decoder::overlapping},
                         {"flat", decoder::flat},
                         {"sine-layers", decoder::sine_layers},
                         {"sine-layers-cube", decoder::sine_layers_cube},
                         {"sine-layers-half", decoder::sine_layers_half},
                         {"fourier-3", decoder::fourier_3},
                         {"fourier-5", decoder::fourier_5},
                         {"fourier-7", decoder::fourier_7},
                         {"fourier-9", decoder::fourier_9},
                         {"ssbump", decoder::ssbump},
                         {"ssbump-lightmaps", decoder::ssbump_lightmaps},
                         {"emboss", decoder::emboss}},
                        "how a horizon is decoded")
        ->type_name("DECODER");
    add_choice<text::dialect>(app, "--dialect", arguments.language,
                              {{"glsl", text::dialect::glsl}, {"hlsl", text::dialect::hlsl}}, "language")
        ->type_name("DIALECT");
    add_choice(app, "--bearing-function", arguments.chosen.bearing, bearing_function_names, "how bearings are measured")
        ->type_name("FUNCTION");
    add_choice(app, "--stored", arguments.chosen.stored, quantity_names, "quantity that the texture stores")
        ->type_name("QUANTITY");
    add_choice<edge>(app, "--edge", arguments.chosen.shadow,
                     {{"hard", edge::hard},
                      {"soft", edge::soft},
                      {"soft-above", edge::soft_above},
                      {"centered", edge::centered},
                      {"centered-above", edge::centered_above}},
                     "edge of the shadow; above: for lights that never shine from below the surface")
        ->type_name("EDGE");
    app.add_flag("--square-root", arguments.chosen.square_root, "fourier: signed square roots are stored");
    app.add_flag("--vertex", arguments.chosen.vertex,
                 "volume, slices, arc, arc-slices, grouped, overlapping: bearing and level a vertex at a time, too");
    app.add_option("NAME", arguments.names, "functions to print instead, with all that they call")
        ->type_name("NAME...");
    app.add_flag("--list", arguments.list, "print the names of all snippets");
    return run_program(app, argc, argv, [&] { work(arguments); });
} catch (const std::exception& error) {
    std::fprintf(stderr, "snippets: %s\n", error.what());
    return 1;
}
