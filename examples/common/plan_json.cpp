#include "common/plan_json.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>

#include "common/file.hpp"
#include "common/json_object.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;
using namespace json_file;

glm::dvec3 towards(double azimuth, double elevation) {
    const double turn = azimuth * std::numbers::pi / 180.0, rise = elevation * std::numbers::pi / 180.0;
    const double flat = elevation == 90.0 ? 0.0 : std::cos(rise);
    return {std::cos(turn) * flat, std::sin(turn) * flat, std::sin(rise)};
}

void read_lights(object& all, const std::string& name, std::vector<glm::dvec3>& lights) {
    const json& list = all.list("lights");
    for (std::size_t i = 0; i < list.size(); ++i) {
        object light(list[i], name, "lights[" + std::to_string(i) + "]");
        const double azimuth = light.number("azimuth"), elevation = light.number("elevation");
        if (!(elevation >= 0.0 && elevation <= 90.0)) light.refuse("elevation", "from 0 to 90 degrees");
        light.end();
        lights.push_back(towards(azimuth, elevation));
    }
}

void read_positions(object& all, const std::string& name, std::vector<glm::dvec3>& positions) {
    const json& list = all.list("positions");
    for (std::size_t i = 0; i < list.size(); ++i) {
        const json& p = list[i];
        const bool three = p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() && p[2].is_number();
        const std::string key = "positions[" + std::to_string(i) + "]";
        if (!three) throw failure(name + ": " + key + " is " + shown(p) + ", but has to be three numbers [x, y, z]");
        const double z = p[2].get<double>();
        if (!(z > 0.0)) throw failure(name + ": " + key + " is " + shown(p) + ", but z has to be above 0");
        positions.emplace_back(p[0].get<double>(), p[1].get<double>(), z);
    }
}

void read_arc(object arc, bs::light_arc& to) {
    if (arc.has("azimuth")) {
        const auto [first, last] = arc.range("azimuth");
        if (!(last > first)) arc.refuse("azimuth", "an arc: the second one above the first one");
        // Ends that are rounded: -487.3 and -127.3 are more than 360 apart.
        const bool turn = std::abs(last - first - 360.0) < 1e-9;
        if (last > first + 360.0 && !turn) arc.refuse("azimuth", "a turn of 360 degrees at the most");
        to.first_bearing = first / 360.0;
        to.last_bearing = turn ? to.first_bearing + 1.0 : last / 360.0;
    }
    if (arc.has("elevation")) {
        const auto [low, high] = arc.range("elevation");
        if (!(low >= 0.0 && high <= 90.0)) arc.refuse("elevation", "from 0 to 90 degrees");
        if (!(high >= low)) arc.refuse("elevation", "a range: the second one not below the first one");
        to.lowest = low;
        to.highest = high;
    }
    arc.end();
}

}  // namespace

const char* const scene_help =
    "A scene is a JSON object; all keys may be left out.\n"
    "  \"lights\": [{\"azimuth\": 140, \"elevation\": 35}]     far lights that do not move, in degrees: azimuth from "
    "+x\n"
    "                                                    (right) towards +y (down), elevation above the surface\n"
    "  \"positions\": [[x, y, z]]                          point lights, in the unit of --texel-size: from the middle "
    "of\n"
    "                                                    texel 0 0, z above the surface that the bumps stand on\n"
    "  \"arc\": {\"azimuth\": [90, 270], \"elevation\": [5, 60]}  far lights that move, a sun's path say\n"
    "     one of these three; without any, light from anywhere at 5 degrees or more\n"
    "  \"light_radius\": 0.27     half the lights' apparent size in degrees (default 0: hard edges)\n"
    "  \"mismatch\": 0.015        share of texels that may be wrongly lit or shadowed (default 0.015)\n"
    "  \"degrees\"                mean error of the horizons' elevation (default: any)\n"
    "  \"bytes\" (a texel), \"bake_seconds\" (of one thread), \"gpu_cost\" (cycles a wave as shader_cost prints them)\n"
    "                           what may be spent (default: any)\n"
    "  \"volumes\", \"arrays\", \"bc4\": true     textures that there are\n"
    "  \"normals\": true          a normal map exists\n"
    "  \"lightmaps\": false       light is baked in three directions\n"
    "  \"texels_per_pixel\": 1    of the nearest view\n";

planned_scene scene_of(const std::string& text, const std::string& name) {
    const json tree = parse(text, name);
    object all(tree, name, "");
    planned_scene result;
    bs::scene& s = result.limits;
    std::string first;
    for (const char* key : {"lights", "positions", "arc"}) {
        if (!all.has(key)) continue;
        if (!first.empty())
            throw failure(name + ": \"" + key + "\": " + shown(all.at(key)) + " is given beside \"" + first +
                          "\": a scene has one of them");
        first = key;
    }
    if (first == "lights") read_lights(all, name, result.lights);
    if (first == "positions") read_positions(all, name, result.positions);
    if (first == "arc") read_arc(all.inside("arc"), s.arc);
    const auto number = [&](const char* key, double& to, double least, bool above, double most = infinity) {
        if (!all.has(key)) return;
        to = all.number(key);
        if ((above ? to > least : to >= least) && to <= most) return;
        std::string wanted = above ? "above " : "at least ";
        wanted += shown(json(least));
        if (most < infinity) wanted += " and at most " + shown(json(most));
        all.refuse(key, wanted);
    };
    number("light_radius", s.light_radius, 0.0, false, 45.0);
    number("mismatch", s.mismatch, 0.0, false, 1.0);
    number("degrees", s.degrees, 0.0, true);
    number("bytes", s.bytes, 0.0, true);
    number("bake_seconds", s.bake_seconds, 0.0, true);
    number("gpu_cost", s.gpu_cost, 0.0, true);
    number("texels_per_pixel", s.texels_per_pixel, 1.0, false);
    const auto truth = [&](const char* key, bool& to) {
        if (all.has(key)) to = all.truth(key);
    };
    truth("volumes", s.volumes);
    truth("arrays", s.arrays);
    truth("bc4", s.bc4);
    truth("normals", s.has_normals);
    truth("lightmaps", s.has_lightmaps);
    all.end();
    require(check(result.view()), name);
    return result;
}

planned_scene read_scene(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = read_file(path);
    return scene_of({bytes.begin(), bytes.end()}, path.string());
}

}  // namespace examples
