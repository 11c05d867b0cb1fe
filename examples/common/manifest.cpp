#include "common/manifest.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <string>

#include "common/file.hpp"

namespace examples {
namespace {

std::vector<std::string> split(const std::string& text, char separator) {
    std::vector<std::string> parts(1);
    for (const char c : text)
        if (c == separator)
            parts.emplace_back();
        else if (c != '\r')
            parts.back() += c;
    return parts;
}

}  // namespace

std::vector<height_source> read_manifest(const std::filesystem::path& folder) {
    const std::filesystem::path path = folder / "MANIFEST.tsv";
    const std::vector<unsigned char> bytes = read_file(path);
    const std::vector<std::string> lines = split(std::string(bytes.begin(), bytes.end()), '\n');
    const std::vector<std::string> names = split(lines.front(), '\t');
    const auto column = [&](const char* name) {
        const auto at = std::find(names.begin(), names.end(), name);
        if (at == names.end()) throw failure("cannot use " + path.string() + ": it has no column " + name);
        return std::size_t(at - names.begin());
    };
    const std::size_t file = column("file"), scale = column("height_scale"), size = column("texel_size"),
                      tiles = column("tiles");

    std::vector<height_source> maps;
    for (std::size_t i = 1; i < lines.size(); ++i) {
        if (lines[i].empty()) continue;
        std::vector<std::string> cells = split(lines[i], '\t');
        cells.resize(std::max(cells.size(), names.size()));
        const auto number = [&](const std::string& text, bool positive) {
            char* end = nullptr;
            const double value = std::strtod(text.c_str(), &end);
            if (text.empty() || end != text.c_str() + text.size() || !std::isfinite(value) ||
                (positive && value <= 0.0))
                throw failure("cannot use " + path.string() + ": line " + std::to_string(i + 1) + " has '" + text +
                              "' for a " + (positive ? "positive" : "finite") + " number");
            return value;
        };
        const std::vector<std::string> sides = split(cells[size], ' ');
        height_source map;
        map.path = (folder / cells[file]).string();
        map.height_scale = number(cells[scale], false);
        map.texel_size = {number(sides.front(), true), number(sides.back(), true)};
        map.edge = cells[tiles] == "yes" ? bumpshadow::edge_mode::repeat : bumpshadow::edge_mode::clamp;
        maps.push_back(map);
    }
    return maps;
}

std::filesystem::path known_folder() {
    const char* const folder = std::getenv("BUMPSHADOW_HEIGHT_MAPS");
    if (folder == nullptr || !std::filesystem::exists(std::filesystem::path(folder) / "MANIFEST.tsv")) return {};
    return folder;
}

std::string name_of(const height_source& map) { return path_of(map.path).stem().string(); }

std::vector<height_source> known_maps(std::initializer_list<const char*> names) {
    const std::filesystem::path folder = known_folder();
    if (folder.empty()) return {};
    const std::vector<height_source> all = read_manifest(folder);
    std::vector<height_source> chosen;
    for (const char* name : names) {
        const auto at = std::find_if(all.begin(), all.end(),
                                     [&](const height_source& map) { return name_of(map).starts_with(name); });
        if (at == all.end()) throw failure(std::string("no ") + name + " in " + (folder / "MANIFEST.tsv").string());
        chosen.push_back(*at);
    }
    return chosen;
}

}  // namespace examples
