#include "source.hpp"

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace shaders {

namespace {

bool in_word(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

// Calls word(text) for each identifier or number of `code` that is not in a comment, and other(text) for all between.
template <class Word, class Other>
void for_words(std::string_view code, const Word& word, const Other& other) {
    for (std::size_t i = 0; i < code.size();) {
        if (code.substr(i, 2) == "//") {
            const std::size_t end = std::min(code.find('\n', i), code.size());
            other(code.substr(i, end - i));
            i = end;
            continue;
        }
        std::size_t end = i + 1;
        if (in_word(code[i])) {
            while (end < code.size() && in_word(code[end])) ++end;
            word(code.substr(i, end - i));
        } else {
            other(code.substr(i, 1));
        }
        i = end;
    }
}

std::vector<std::string> lines_of(const std::filesystem::path& path) {
    std::ifstream file(path);
    if (!file) throw std::runtime_error("cannot read " + path.string());
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) lines.push_back(line);
    return lines;
}

[[noreturn]] void fail(const std::filesystem::path& path, std::size_t line, const std::string& why) {
    throw std::runtime_error(path.string() + ":" + std::to_string(line + 1) + ": " + why);
}

// The word before the first parenthesis or brace.
std::string name_of(const std::string& code) {
    std::size_t end = std::min(code.find_first_of("({"), code.size());
    while (end > 0 && !in_word(code[end - 1])) --end;
    std::size_t start = end;
    while (start > 0 && in_word(code[start - 1])) --start;
    const std::string name = code.substr(start, end - start);
    return name.starts_with("bumpshadow_") ? name : std::string();
}

void read_file(const std::filesystem::path& path, source& all) {
    constexpr std::string_view mark = "BUMPSHADOW_FUNCTION ";
    const std::vector<std::string> lines = lines_of(path);
    section here{path.stem().string(), {}, int(all.snippets.size()), 0};
    std::string comment;
    bool top = true;
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string& line = lines[i];
        if (line.starts_with("// ----")) continue;  // a heading within the file
        if (line.starts_with("//")) {
            comment += line + '\n';
            continue;
        }
        if (line.empty()) {
            if (top)
                here.comment = comment;
            else if (!comment.empty())
                fail(path, i, "a comment that belongs to nothing");
            comment.clear();
            top = false;
            continue;
        }
        if (!line.starts_with(mark) && !line.starts_with("struct "))
            fail(path, i, "neither a function nor a structure");
        std::string code = line.starts_with(mark) ? line.substr(mark.size()) : line;
        code += '\n';
        const std::size_t start = i;
        while (lines[i] != "}" && lines[i] != "};" && !lines[i].ends_with("}")) {
            if (++i == lines.size()) fail(path, start, "no end");
            code += lines[i] + '\n';
        }
        snippet s{name_of(code), comment, code, {}};
        if (s.name.empty()) fail(path, start, "no name that starts with bumpshadow_");
        for_words(
            code,
            [&](std::string_view word) {
                if (!word.starts_with("bumpshadow_") || word == s.name) return;
                const auto at = std::find_if(all.snippets.begin(), all.snippets.end(),
                                             [&](const snippet& other) { return other.name == word; });
                if (at == all.snippets.end()) fail(path, start, std::string(word) + " is not defined above");
                s.needs.push_back(int(at - all.snippets.begin()));
            },
            [](std::string_view) {});
        std::sort(s.needs.begin(), s.needs.end());
        s.needs.erase(std::unique(s.needs.begin(), s.needs.end()), s.needs.end());
        all.snippets.push_back(std::move(s));
        ++here.count;
        comment.clear();
        top = false;
    }
    all.sections.push_back(std::move(here));
}

}  // namespace

source read_source(const std::filesystem::path& folder) {
    constexpr std::string_view include = "#include <bumpshadow/shader/";
    source all;
    for (const std::string& line : lines_of(folder / "shader.hpp"))
        if (line.starts_with(include) && line.ends_with(".h>"))
            read_file(folder / line.substr(include.size(), line.size() - include.size() - 1), all);
    return all;
}

std::string plain_numbers(std::string_view glsl) {
    std::string text;
    for_words(
        glsl,
        [&](std::string_view word) {
            const bool number = word[0] >= '0' && word[0] <= '9' && word.back() == 'f' && !word.starts_with("0x");
            text += number ? word.substr(0, word.size() - 1) : word;
        },
        [&](std::string_view other) { text += other; });
    return text;
}

std::string hlsl(std::string_view glsl) {
    constexpr std::string_view names[][2] = {
        {"vec2", "float2"},
        {"vec3", "float3"},
        {"vec4", "float4"},
        {"ivec2", "int2"},
        {"ivec3", "int3"},
        {"ivec4", "int4"},
        {"mix", "lerp"},
        {"fract", "frac"},
        {"mat3", "float3x3"},
        {"inversesqrt", "rsqrt"},
        {"intBitsToFloat", "asfloat"},
    };
    std::string text;
    for_words(
        glsl,
        [&](std::string_view word) {
            for (const auto& [from, to] : names)
                if (word == from) {
                    text += to;
                    return;
                }
            text += word;
        },
        [&](std::string_view other) { text += other; });
    return text;
}

}  // namespace shaders
