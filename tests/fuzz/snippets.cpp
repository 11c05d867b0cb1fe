// Fuzz target: shader text put together for any choice and for any list of names. Whatever is asked for, what comes
// out is whole: known functions, each once and after all that it calls, nothing that is not called, in parentheses
// that close.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>
#include <vector>

#include <bumpshadow/shader/snippets.hpp>

#include "fuzz/input.hpp"
#include "support/scan.hpp"

namespace {

using fuzz::require;
using namespace bumpshadow;
using namespace bumpshadow::shader_text;

bool has(const std::vector<std::string>& words, std::string_view word) {
    return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_snippet(std::string_view name) {
    return std::any_of(std::begin(snippets), std::end(snippets), [&](const snippet& s) { return s.name == name; });
}

// roots: what the caller asked for by name; allowed: names that are no snippets.
void inspect(const std::string& text, dialect language, const std::vector<std::string>& roots,
             const std::vector<std::string>& allowed) {
    for (std::size_t at = 0; at < text.size(); at = std::min(text.find('\n', at), text.size() - 1) + 1)
        require(text[std::min(text.find_first_not_of(' ', at), text.size() - 1)] != '#', "no line for a preprocessor");
    require(text.empty() || text.back() == '\n', "the last line ends");

    const std::vector<std::string> tokens = scan::tokens_of(scan::without_comments(text));
    std::string open;
    for (const std::string& token : tokens) {
        if (token == "(" || token == "{" || token == "[") open += token;
        if (token == ")" || token == "}" || token == "]") {
            require(!open.empty() && open.back() == (token == ")" ? '(' : token == "}" ? '{' : '['), "brackets close");
            open.pop_back();
        }
    }
    require(open.empty(), "brackets close");
    const char* const foreign = language == dialect::glsl ? "float2" : "vec2";
    require(!has(tokens, foreign), "types of one language alone");

    const std::vector<scan::definition> all = scan::definitions_of(text);
    std::vector<std::string> known;
    for (const scan::definition& d : all) {
        require(!has(known, d.name), "each function once");
        require(is_snippet(d.name) || has(allowed, d.name), "known functions alone");
        known.push_back(d.name);
        for (const std::string& token : d.tokens)
            if (token.starts_with("bumpshadow_")) require(has(known, token), "functions after those that they call");
    }
    for (const std::string& root : roots) require(has(known, root), "what was asked for is there");
    require(scan::not_called(all, roots).empty(), "nothing that is not called");
}

void compose_choice(fuzz::input& in, dialect language) {
    choice chosen;
    chosen.decode = decoder(in.below(int(decoder::emboss) + 1));
    chosen.bearing = bearing_function(in.below(int(bearing_function::diamond) + 1));
    chosen.stored = quantity(in.below(int(quantity::angle) + 1));
    chosen.shadow = edge(in.below(int(edge::centered_above) + 1));
    chosen.square_root = in.flag();
    chosen.vertex = in.flag();
    std::string text;
    compose(chosen, language, [&](std::string_view part) { text += part; });

    const bool slices = chosen.decode <= decoder::overlapping, shadow = chosen.decode < decoder::ssbump;
    std::vector<std::string> short_names;
    if (slices) short_names.emplace_back("bumpshadow_bearing");
    if (shadow) short_names.insert(short_names.end(), {"bumpshadow_level", "bumpshadow_shadow"});
    if (slices && chosen.vertex) short_names.emplace_back("bumpshadow_vertex_bearing");
    // Which functions of a decoder are called by name is the composer's own knowledge; tests/shader/snippets.cpp has
    // its own list of those.
    std::vector<std::string> roots = short_names;
    for (const std::string_view name : snippets_detail::entries(chosen))
        if (!name.empty()) roots.emplace_back(name);
    if (slices && chosen.vertex)
        roots.insert(roots.end(), std::begin(snippets_detail::of_vertices), std::end(snippets_detail::of_vertices));
    inspect(text, language, roots, short_names);
}

void compose_names(fuzz::input& in, dialect language) {
    std::vector<std::string> names;
    bool all_known = true;
    for (int count = in.below(12); count > 0; --count) {
        std::string name(snippets[std::size_t(in.below(int(std::size(snippets))))].name);
        if (in.byte() >= 224) name.resize(std::size_t(in.below(int(name.size()) + 4)), char(in.byte()));
        all_known = all_known && is_snippet(name);
        names.push_back(name);
    }
    const std::vector<std::string_view> views(names.begin(), names.end());
    std::string text;
    const bool composed = compose(views, language, [&](std::string_view part) { text += part; });
    require(composed == all_known, "an unknown name is refused");
    require(composed || text.empty(), "where a name is unknown nothing is written");
    if (composed) inspect(text, language, names, {});
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
    fuzz::input in(bytes, size);
    const dialect language = in.flag() ? dialect::hlsl : dialect::glsl;
    if (in.flag())
        compose_names(in, language);
    else
        compose_choice(in, language);
    return 0;
}
