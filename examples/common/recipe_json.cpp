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

template <class Value>
using words_of = std::vector<std::pair<std::string, Value>>;

const words_of<bs::texel_format> formats{{"r8", bs::texel_format::r8},
                                         {"r16", bs::texel_format::r16},
                                         {"r16f", bs::texel_format::r16f},
                                         {"bc4", bs::texel_format::bc4}};
const words_of<bs::texture_kind> kinds{
    {"flat", bs::texture_kind::flat}, {"array", bs::texture_kind::array}, {"volume", bs::texture_kind::volume}};
const words_of<bs::slice_fit> fits{{"point", bs::slice_fit::point},
                                   {"least-squares", bs::slice_fit::least_squares},
                                   {"least-angle", bs::slice_fit::least_angle}};
words_of<bs::plan_obstacle> obstacles() {
    words_of<bs::plan_obstacle> all;
    for (int i = 0; i <= int(bs::plan_obstacle::textures); ++i)
        all.emplace_back(name_of(bs::plan_obstacle(i)), bs::plan_obstacle(i));
    return all;
}

constexpr int most_taps = 16;

// The fields of a recipe, in their order, for writing and for reading. A visitor has
//   inside(key, body)             an object, whose fields body(visitor) lists
//   truth, whole, number, choice  a field; a number that may be infinite is null then
template <class Visitor, class Recipe>
void list_fields(Visitor& v, Recipe& r) {
    auto& e = r.encoding;
    v.truth("shadows", r.shadows);
    v.choice("obstacle", r.obstacle, obstacles());
    v.inside("bake", [&](Visitor& bake) {
        bake.fixed("method", "cascade");
        bake.whole("steps", r.steps, 1, 1 << 20);
        bake.number("radius", r.radius, true);
        bake.whole("reduced_heights", r.reduced_heights, 1, 64);
        bake.whole("directions", r.directions, 1, 65536);
    });
    v.inside("texture", [&](Visitor& texture) {
        texture.whole("reduction", r.reduction, 1, 64);
        texture.whole("slices", e.slices.count, 1, 4096);
        texture.number("phase", e.slices.phase);
        texture.number("arc", e.slices.arc);
        texture.choice("bearing_function", e.slices.function, bearing_function_names);
        texture.choice("stored", e.scale.stored, quantity_names);
        texture.number("max_slope", e.scale.max_slope, true);
        texture.choice("format", e.format, formats);
        texture.choice("kind", e.kind, kinds);
        texture.choice("fit", r.fit, fits);
        texture.truth("mips", r.mips);
    });
    v.inside("shader", [&](Visitor& shader) {
        shader.number("k", r.edge.k, true);
        shader.number("c", r.edge.c);
        shader.whole("taps", r.taps, 1, most_taps);
        shader.truth("above", r.above);
    });
    v.truth("wants_normals", r.wants_normals);
    v.truth("wants_masks", r.wants_masks);
    v.number("free_tiles", r.free_tiles);
    v.inside("predicted", [&](Visitor& predicted) {
        auto& p = r.predicted;
        predicted.number("mismatch", p.mismatch);
        predicted.number("interval", p.interval, true);
        predicted.number("degrees", p.degrees);
        predicted.number("bytes", p.bytes);
        predicted.number("bake_seconds", p.bake_seconds);
        predicted.number("pack_seconds", p.pack_seconds);
        predicted.number("gpu_cost", p.gpu_cost);
        predicted.whole("fetches", p.fetches, 0, 2 * most_taps * most_taps);
    });
}

class writer {
public:
    explicit writer(ordered_json& to) : to_(to) {}

    template <class Body>
    void inside(const char* key, const Body& body) {
        ordered_json part = ordered_json::object();
        writer w(part);
        body(w);
        to_[key] = std::move(part);
    }
    void fixed(const char* key, const char* word) { to_[key] = word; }
    void truth(const char* key, bool value) { to_[key] = value; }
    void whole(const char* key, int value, int, int) { to_[key] = value; }
    template <class Number>
    void number(const char* key, Number value, bool = false) {
        to_[key] = std::isfinite(value) ? ordered_json(double(value)) : ordered_json(nullptr);
    }
    template <class Value>
    void choice(const char* key, Value value, const words_of<Value>& words) {
        to_[key] = word_of(words, value);
    }

private:
    ordered_json& to_;
};

class reader {
public:
    explicit reader(object& from) : from_(from) {}

    template <class Body>
    void inside(const char* key, const Body& body) {
        object part = from_.inside(key);
        reader r(part);
        body(r);
        part.end();
    }
    void fixed(const char* key, const char* word) {
        if (from_.word(key) != word) from_.refuse(key, word);
    }
    void truth(const char* key, bool& value) { value = from_.truth(key); }
    void whole(const char* key, int& value, int least, int most) { value = from_.whole(key, least, most); }
    template <class Number>
    void number(const char* key, Number& value, bool or_null = false) {
        value = Number(from_.number(key, or_null));
    }
    template <class Value>
    void choice(const char* key, Value& value, const words_of<Value>& words) {
        value = from_.choice(key, words);
    }

private:
    object& from_;
};

// What no field says by itself.
void check_together(const bs::recipe& r, object& all) {
    const bs::tangent_volume& e = r.encoding;
    if (!(r.radius > 0.0)) all.inside("bake").refuse("radius", "above 0, or null for none");
    object texture = all.inside("texture");
    if (r.mips && e.kind == bs::texture_kind::volume && is_arc(e.slices))
        texture.refuse("mips", "false for a volume over an arc");
    if (r.mips && e.kind == bs::texture_kind::volume && r.fit == bs::slice_fit::point)
        texture.refuse("mips", "false for a volume of a point fit");
    if (r.directions < e.slices.count)
        texture.refuse("slices", "at most bake.directions, " + std::to_string(r.directions));
}

}  // namespace

std::string json_of(const bs::recipe& r) {
    ordered_json all;
    writer w(all);
    list_fields(w, r);
    all["why"] = ordered_json::array();
    for (int i = 0; i < r.lines; ++i) all["why"].push_back(r.why[std::size_t(i)].text);
    return all.dump(-1, ' ', false, json::error_handler_t::replace);
}

bs::recipe recipe_of(const std::string& text, const std::string& name) {
    const json tree = parse(text, name);
    object all(tree, name, "");
    bs::recipe r;
    reader fields(all);
    list_fields(fields, r);
    check_together(r, all);
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
    require(check(r.encoding), name + ": texture");
    require(check(r.edge), name + ": shader");
    return r;
}

bs::recipe read_recipe(const std::filesystem::path& path) {
    const std::vector<unsigned char> bytes = read_file(path);
    return recipe_of({bytes.begin(), bytes.end()}, path.string());
}

}  // namespace examples
