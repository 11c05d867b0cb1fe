// shaders FOLDER [--check]: makes bumpshadow.glsl, bumpshadow.hlsl, snippets_text.hpp, bumpshadow_bake.glsl and
// bumpshadow_bake.hlsl in include/bumpshadow/shader from the single source beside them. With --check writes nothing and
// fails where a file is not what would be written.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "source.hpp"

namespace {

using namespace shaders;

std::string read_text(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

std::string replace(std::string text, std::string_view mark, std::string_view by) {
    const std::size_t at = text.find(mark);
    if (at == std::string::npos) throw std::runtime_error("no " + std::string(mark) + " in the template");
    return text.replace(at, mark.size(), by);
}

// Everything, section by section, in GLSL.
std::string flattened(const source& all) {
    std::string text;
    for (const section& s : all.sections) {
        text += "// ---- " + s.name + " ----\n//\n" + s.comment + '\n';
        for (int i = s.first; i < s.first + s.count; ++i)
            text += all.snippets[std::size_t(i)].comment + all.snippets[std::size_t(i)].code + '\n';
    }
    text.pop_back();
    return text;
}

// The compute kernel, in GLSL.
std::string kernel(const std::filesystem::path& folder) {
    constexpr std::string_view mark = "BUMPSHADOW_FUNCTION ";
    std::string text = read_text(folder / "bake.h");
    for (std::size_t at; (at = text.find(mark)) != std::string::npos;) text.erase(at, mark.size());
    return text;
}

constexpr std::size_t words = 4;  // of 64 bits; what a snippet needs is a set of 256 at the most

std::string table(const source& all) {
    if (all.snippets.size() > 64 * words) throw std::runtime_error("more snippets than a set holds");
    std::vector<std::vector<std::uint64_t>> closures;
    std::string text =
        "#pragma once\n\n"
        "// Generated from the .h files beside it by the target `shaders`: change those.\n// clang-format off\n\n"
        "#include <array>\n#include <cstdint>\n#include <string_view>\n\n"
        "#include <bumpshadow/config.hpp>\n\n"
        "namespace bumpshadow::shader_text {\n\n"
        "// A function or structure; `needs` has a bit for each snippet that it uses, through others too, and its "
        "own.\n"
        "struct snippet {\n    std::string_view name, comment, glsl, hlsl;\n    std::array<std::uint64_t, " +
        std::to_string(words) +
        "> needs;\n};\n\n"
        "// Each stands after those that it needs.\n"
        "inline constexpr snippet snippets[] = {\n";
    for (std::size_t i = 0; i < all.snippets.size(); ++i) {
        const snippet& s = all.snippets[i];
        std::vector<std::uint64_t> needs(words);
        needs[i / 64] |= std::uint64_t{1} << (i % 64);
        for (const int other : s.needs)
            for (std::size_t w = 0; w < words; ++w) needs[w] |= closures[std::size_t(other)][w];
        closures.push_back(needs);
        const auto raw = [](const std::string& t) { return "R\"~(" + t + ")~\""; };
        text += "    {\"" + s.name + "\",\n" + raw(s.comment) + ",\n" + raw(plain_numbers(s.code)) + ",\n" +
                raw(hlsl(plain_numbers(s.code))) + ",\n     {";
        for (std::size_t w = 0; w < words; ++w) {
            char number[32];
            std::snprintf(number, sizeof number, "%s0x%llxu", w == 0 ? "" : ", ",
                          static_cast<unsigned long long>(needs[w]));
            text += number;
        }
        text += "}},\n";
    }
    return text + "};\n\n}  // namespace bumpshadow::shader_text\n";
}

}  // namespace

int main(int argc, char** argv) try {
    const std::vector<std::string_view> arguments(argv + 1, argv + argc);
    if (arguments.empty()) throw std::runtime_error("usage: shaders FOLDER_OF_THE_PROJECT [--check]");
    const bool check = arguments.size() > 1 && arguments[1] == "--check";
    const std::filesystem::path project = arguments[0];
    const std::filesystem::path folder = project / "include/bumpshadow/shader", templates = project / "cmake/shaders";
    const source all = read_source(folder);
    const std::string glsl = flattened(all), bake = kernel(folder);
    const std::string files[][2] = {
        {"bumpshadow.glsl", replace(read_text(templates / "bumpshadow.glsl.in"), "@snippets@\n", plain_numbers(glsl))},
        {"bumpshadow.hlsl",
         replace(read_text(templates / "bumpshadow.hlsl.in"), "@snippets@\n", hlsl(plain_numbers(glsl)))},
        {"snippets_text.hpp", table(all)},
        {"bumpshadow_bake.glsl", replace(read_text(templates / "bumpshadow_bake.glsl.in"), "@kernel@\n", bake)},
        {"bumpshadow_bake.hlsl", replace(read_text(templates / "bumpshadow_bake.hlsl.in"), "@kernel@\n", hlsl(bake))},
    };
    int stale = 0;
    for (const auto& [name, text] : files) {
        const std::filesystem::path path = folder / name;
        if (read_text(path) == text) continue;
        if (check) {
            std::fprintf(stderr, "shaders: %s is not what its source gives; build the target `shaders`\n",
                         path.string().c_str());
            ++stale;
            continue;
        }
        std::ofstream file(path, std::ios::binary);
        file << text;
        if (!file.flush()) throw std::runtime_error("cannot write " + path.string());
        std::printf("shaders: wrote %s\n", path.string().c_str());
    }
    return stale == 0 ? 0 : 1;
} catch (const std::exception& error) {
    std::fprintf(stderr, "shaders: %s\n", error.what());
    return 1;
}
