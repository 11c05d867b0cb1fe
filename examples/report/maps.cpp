#include "report/maps.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>

#include "common/file.hpp"
#include "common/manifest.hpp"
#include "common/stone_wall.hpp"

namespace examples {
namespace {

constexpr const char* made = "made by the program";

// Textures rarely say how deep they are; a 16th of their size suits most.
double usual_scale(const height_samples& samples, const height_source& source) {
    if (!samples.is_normalized()) return 1.0;
    return std::min(samples.extent.x * source.texel_size.x, samples.extent.y * source.texel_size.y) / 16.0;
}

report_map made_wall(const height_source& settings) {
    stone_wall wall = make_stone_wall();
    report_map map;
    map.name = "stone wall";
    map.source = settings;
    map.source.path = made;
    map.heights = {wall.extent, std::move(wall.heights)};
    map.scale = settings.height_scale.value_or(wall.height_scale);
    return map;
}

std::vector<height_source> png_files(const std::filesystem::path& folder, const height_source& settings) {
    std::vector<std::string> names;
    std::error_code error;
    for (std::filesystem::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
        std::string ending = at->path().extension().string();
        for (char& c : ending) c = char(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
        if (ending == ".png") names.push_back(at->path().string());
    }
    if (error) throw failure("cannot read folder " + folder.string() + ": " + error.message());
    std::sort(names.begin(), names.end());
    std::vector<height_source> sources;
    for (std::string& name : names) {
        sources.push_back(settings);
        sources.back().path = std::move(name);
    }
    return sources;
}

std::vector<height_source> sources_of(const std::string& path, const height_source& settings) {
    std::error_code ignored;
    if (!std::filesystem::is_directory(path, ignored)) {
        height_source source = settings;
        source.path = path;
        return {source};
    }
    if (std::filesystem::exists(std::filesystem::path(path) / "MANIFEST.tsv", ignored)) return read_manifest(path);
    std::vector<height_source> sources = png_files(path, settings);
    if (sources.empty()) throw failure("no PNG files in folder " + path);
    return sources;
}

// Four maps of the folder that the environment names, those that the README speaks of first.
std::vector<height_source> usual_maps() {
    const std::filesystem::path folder = known_folder();
    if (folder.empty()) return {};
    std::vector<height_source> all = read_manifest(folder);
    std::stable_partition(all.begin(), all.end(), [](const height_source& map) {
        const std::string name = name_of(map);
        for (const char* usual : {"acg_Bricks059", "acg_RoofingTiles013A", "dx_stones", "ogre_Rock20"})
            if (name.rfind(usual, 0) == 0) return true;
        return false;
    });
    all.resize(std::min<std::size_t>(all.size(), 4));
    return all;
}

// Records are told apart by the names of maps.
std::string free_name(const std::string& wanted, const std::vector<report_map>& maps) {
    const auto taken = [&](const std::string& name) {
        return name == mean_map ||
               std::any_of(maps.begin(), maps.end(), [&](const report_map& map) { return map.name == name; });
    };
    std::string name = wanted;
    for (int i = 2; taken(name); ++i) name = wanted + " (" + std::to_string(i) + ')';
    return name;
}

}  // namespace

map_choice choose_maps(const std::vector<std::string>& paths, const height_source& settings, bool quick) {
    map_choice choice;
    std::vector<height_source> sources;
    if (paths.empty()) {
        choice.maps.push_back(made_wall(settings));
        if (!quick) sources = usual_maps();
    }
    for (const std::string& path : paths) try {
            for (height_source& source : sources_of(path, settings)) sources.push_back(std::move(source));
        } catch (const failure& error) {
            choice.skipped.push_back({path, error.what()});
        }

    for (height_source& source : sources) try {
            report_map map;
            map.heights = read_heights(source);
            map.name = free_name(name_of(source), choice.maps);
            map.scale = source.height_scale.value_or(usual_scale(map.heights, source));
            map.source = std::move(source);
            choice.maps.push_back(std::move(map));
        } catch (const failure& error) {
            choice.skipped.push_back({source.path, error.what()});
        }
    if (choice.maps.empty() && choice.skipped.size() == 1) throw failure(choice.skipped.front().reason);
    for (const skipped_map& map : choice.skipped) std::fprintf(stderr, "report: skipped: %s\n", map.reason.c_str());
    if (choice.maps.empty())
        throw failure("none of the " + std::to_string(choice.skipped.size()) + " height maps can be used");
    return choice;
}

map_facts facts_of(const report_map& map) {
    constexpr const char* edges[] = {"repeat", "clamp", "mirror", "open"};
    using bumpshadow::edge_mode;
    const edge_mode edge = map.source.edge;
    const int index = edge == edge_mode::repeat ? 0 : edge == edge_mode::clamp ? 1 : edge == edge_mode::mirror ? 2 : 3;
    return {map.name, map.source.path, map.heights.extent, map.scale, map.source.texel_size, edges[index]};
}

}  // namespace examples
