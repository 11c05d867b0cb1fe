#include "common/plan_json.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include <bumpshadow/encode/slices.hpp>
#include <bumpshadow/encode/tangent_volume.hpp>

#include "common/choices.hpp"
#include "common/file.hpp"
#include "common/json_object.hpp"

namespace examples {

namespace {

namespace bs = bumpshadow;
using namespace json_file;
using nlohmann::ordered_json;

const std::vector<std::pair<std::string, bs::texel_format>> formats{{"r8", bs::texel_format::r8},
                                                                    {"r16", bs::texel_format::r16},
                                                                    {"r16f", bs::texel_format::r16f},
                                                                    {"bc4", bs::texel_format::bc4}};
const std::vector<std::pair<std::string, bs::texture_kind>> kinds{
    {"flat", bs::texture_kind::flat}, {"array", bs::texture_kind::array}, {"volume", bs::texture_kind::volume}};
const std::vector<std::pair<std::string, bs::slice_fit>> fits{{"point", bs::slice_fit::point},
                                                              {"least-squares", bs::slice_fit::least_squares},
                                                              {"least-angle", bs::slice_fit::least_angle}};
std::vector<std::pair<std::string, bs::plan_obstacle>> obstacles() {
    std::vector<std::pair<std::string, bs::plan_obstacle>> all;
    for (int i = 0; i <= int(bs::plan_obstacle::textures); ++i)
        all.emplace_back(name_of(bs::plan_obstacle(i)), bs::plan_obstacle(i));
    return all;
}

ordered_json number_or_null(double n) { return std::isfinite(n) ? ordered_json(n) : ordered_json(nullptr); }

}  // namespace

std::string json_of(const bs::recipe& r) {
    const bs::tangent_volume& e = r.encoding;
    const bs::plan_figures& p = r.predicted;
    ordered_json all;
    all["shadows"] = r.shadows;
    all["obstacle"] = name_of(r.obstacle);
    all["bake"] = {{"method", "cascade"},
                   {"steps", r.steps},
                   {"radius", number_or_null(r.radius)},
                   {"reduced_heights", r.reduced_heights},
                   {"directions", r.directions}};
    all["texture"] = {{"reduction", r.reduction},
                      {"slices", e.slices.count},
                      {"phase", e.slices.phase},
                      {"arc", e.slices.arc},
                      {"bearing_function", word_of(bearing_function_names, e.slices.function)},
                      {"stored", word_of(quantity_names, e.scale.stored)},
                      {"max_slope", number_or_null(double(e.scale.max_slope))},
                      {"format", word_of(formats, e.format)},
                      {"kind", word_of(kinds, e.kind)},
                      {"fit", word_of(fits, r.fit)},
                      {"mips", r.mips}};
    all["shader"] = {{"k", number_or_null(double(r.edge.k))}, {"c", double(r.edge.c)}, {"above", r.above}};
    all["wants_normals"] = r.wants_normals;
    all["wants_masks"] = r.wants_masks;
    all["free_tiles"] = r.free_tiles;
    all["predicted"] = {{"mismatch", p.mismatch}, {"interval", number_or_null(p.interval)}, {"degrees", p.degrees},
                        {"bytes", p.bytes},       {"bake_seconds", p.bake_seconds},         {"gpu_cost", p.gpu_cost},
                        {"fetches", p.fetches}};
    all["why"] = ordered_json::array();
    for (int i = 0; i < r.lines; ++i) all["why"].push_back(r.why[std::size_t(i)].text);
    return all.dump(-1, ' ', false, json::error_handler_t::replace);
}

bs::recipe recipe_of(const std::string& text, const std::string& name) {
    const json tree = parse(text, name);
    object all(tree, name, "");
    bs::recipe r;
    bs::tangent_volume& e = r.encoding;
    r.shadows = all.truth("shadows");
    r.obstacle = all.choice("obstacle", obstacles());
    {
        object bake = all.inside("bake");
        if (bake.word("method") != "cascade") bake.refuse("method", "cascade");
        r.steps = bake.whole("steps", 1, 1 << 20);
        r.radius = bake.number("radius", true);
        if (!(r.radius > 0.0)) bake.refuse("radius", "above 0, or null for none");
        r.reduced_heights = bake.whole("reduced_heights", 1, 64);
        r.directions = bake.whole("directions", 1, 65536);
        bake.end();
    }
    {
        object texture = all.inside("texture");
        r.reduction = texture.whole("reduction", 1, 64);
        e.slices.count = texture.whole("slices", 1, 4096);
        e.slices.phase = texture.number("phase");
        e.slices.arc = texture.number("arc");
        e.slices.function = texture.choice("bearing_function", bearing_function_names);
        e.scale.stored = texture.choice("stored", quantity_names);
        e.scale.max_slope = float(texture.number("max_slope", true));
        e.format = texture.choice("format", formats);
        e.kind = texture.choice("kind", kinds);
        r.fit = texture.choice("fit", fits);
        r.mips = texture.truth("mips");
        if (r.mips && e.kind == bs::texture_kind::volume && is_arc(e.slices))
            texture.refuse("mips", "false for a volume over an arc");
        if (r.mips && e.kind == bs::texture_kind::volume && r.fit == bs::slice_fit::point)
            texture.refuse("mips", "false for a volume of a point fit");
        if (r.directions < e.slices.count)
            texture.refuse("slices", "at most bake.directions, " + std::to_string(r.directions));
        texture.end();
    }
    {
        object shader = all.inside("shader");
        r.edge.k = float(shader.number("k", true));
        r.edge.c = float(shader.number("c"));
        r.above = shader.truth("above");
        shader.end();
    }
    r.wants_normals = all.truth("wants_normals");
    r.wants_masks = all.truth("wants_masks");
    r.free_tiles = all.number("free_tiles");
    {
        object predicted = all.inside("predicted");
        bs::plan_figures& p = r.predicted;
        p.mismatch = predicted.number("mismatch");
        p.interval = predicted.number("interval", true);
        p.degrees = predicted.number("degrees");
        p.bytes = predicted.number("bytes");
        p.bake_seconds = predicted.number("bake_seconds");
        p.gpu_cost = predicted.number("gpu_cost");
        p.fetches = predicted.whole("fetches", 0, 64);
        predicted.end();
    }
    const json& why = all.at("why");
    if (!why.is_array() || why.size() > r.why.size())
        all.refuse("why", "a list of at most " + std::to_string(r.why.size()) + " texts");
    for (const json& line : why) {
        if (!line.is_string() || line.get_ref<const std::string&>().size() >= sizeof bs::plan_line::text)
            throw failure(name + ": why has " + shown(line) + ", but has to have texts of less than " +
                          std::to_string(sizeof bs::plan_line::text) + " bytes");
        r.say("%s", line.get_ref<const std::string&>().c_str());
    }
    all.end();
    require(check(e), name + ": texture");
    require(check(r.edge), name + ": shader");
    return r;
}

bs::recipe read_recipe(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = read_file(path);
    return recipe_of({bytes.begin(), bytes.end()}, path.string());
}

}  // namespace examples
