#include "shader/compile/calls.hpp"

#include <algorithm>

#include "source.hpp"

namespace calls {

namespace {

std::vector<std::string> words_of(std::string_view text) {
    std::vector<std::string> words;
    std::string word;
    for (const char c : std::string(text) + ' ') {
        if (c != ' ' && c != '\n' && c != ';' && c != ',') {
            word += c;
        } else if (!word.empty()) {
            words.push_back(word);
            word.clear();
        }
    }
    return words;
}

structure structure_of(const shaders::snippet& s) {
    structure result{s.name, {}};
    const std::size_t first = s.code.find('{') + 1;
    std::string body;
    for (std::size_t i = first; i < s.code.find('}', first); ++i) {
        if (s.code.compare(i, 2, "//") == 0) i = s.code.find('\n', i);
        body += s.code[i];
    }
    const std::vector<std::string> words = words_of(body);
    for (std::size_t i = 0; i + 1 < words.size(); i += 2) result.members.push_back({words[i], words[i + 1]});
    return result;
}

function function_of(const shaders::snippet& s) {
    function result{words_of(s.code).front(), s.name, {}};
    const std::size_t open = s.code.find('('), close = s.code.find(')');
    const std::vector<std::string> words = words_of(std::string_view(s.code).substr(open + 1, close - open - 1));
    for (std::size_t i = 0; i < words.size(); i += 2) result.parameters.push_back(words[i]);
    return result;
}

const structure* find_structure(const everything& all, std::string_view type) {
    const auto at =
        std::find_if(all.structures.begin(), all.structures.end(), [&](const structure& s) { return s.name == type; });
    return at == all.structures.end() ? nullptr : &*at;
}

// An expression of a type that the compiler cannot know, from the vec4 `value`.
std::string argument(std::string_view type) {
    if (type == "bool") return "value.x > 0.0f";
    if (type == "int") return "int(value.x)";
    if (type == "float") return "value.x";
    if (type == "vec2") return "vec2(value.x, value.y)";
    if (type == "vec3") return "vec3(value.x, value.y, value.z)";
    if (type == "vec4") return "value";
    return "some_" + std::string(type);
}

// Statements that add what `name` holds to the vec4 `sum`.
std::string added(const everything& all, std::string_view type, const std::string& name) {
    if (type == "bool") return "sum.x += " + name + " ? 1.0f : 0.0f; ";
    if (type == "int") return "sum.x += float(" + name + "); ";
    if (type == "float") return "sum.x += " + name + "; ";
    if (type == "vec4") return "sum += " + name + "; ";
    std::string text;
    if (const structure* const s = find_structure(all, type)) {
        for (const variable& member : s->members) text += added(all, member.type, name + '.' + member.name);
        return text;
    }
    for (const char* component : {"x", "y", "z"})
        if (type == "vec3" || *component != 'z')
            text += std::string("sum.") + component + " += " + name + '.' + component + "; ";
    return text;
}

}  // namespace

everything read() {
    everything all;
    for (const shaders::snippet& s : shaders::read_source(BUMPSHADOW_SHADER_FOLDER).snippets) {
        all.code += s.code + '\n';
        if (s.code.starts_with("struct "))
            all.structures.push_back(structure_of(s));
        else
            all.functions.push_back(function_of(s));
    }
    return all;
}

std::string body_of(const everything& all) {
    std::string text = "    vec4 sum = vec4(0.0f, 0.0f, 0.0f, 0.0f);\n";
    for (const structure& s : all.structures) {
        text += "    " + s.name + " some_" + s.name + ";\n";
        for (const variable& member : s.members)
            text += "    some_" + s.name + '.' + member.name + " = " + argument(member.type) + ";\n";
    }
    for (const function& f : all.functions) {
        std::string arguments;
        for (const std::string& type : f.parameters) arguments += (arguments.empty() ? "" : ", ") + argument(type);
        text += "    { " + f.result + " result = " + f.name + '(' + arguments + "); " + added(all, f.result, "result") +
                "}\n";
    }
    return text;
}

std::string glsl_of(const everything& all, std::string_view header, std::string_view stage) {
    const std::string body = body_of(all);
    std::string text = std::string(header) + all.code;
    if (stage == "frag")
        return text + "IN vec4 value;\nlayout(location = 0) out vec4 color;\nvoid main() {\n" + body +
               "    color = sum;\n}\n";
    if (stage == "vert")
        return text + "layout(location = 0) in vec4 value;\nvoid main() {\n" + body + "    gl_Position = sum;\n}\n";
    return text +
           "layout(local_size_x = 1) in;\nlayout(std430, binding = 0) buffer Values { vec4 values[]; };\nvoid main() "
           "{\n"
           "    vec4 value = values[0];\n" +
           body + "    values[0] = sum;\n}\n";
}

std::string hlsl_of(const everything& all) {
    const std::string body = shaders::hlsl(body_of(all));
    return shaders::hlsl(all.code) + "float4 pixel(float4 value : TEXCOORD0) : SV_Target0 {\n" + body +
           "    return sum;\n}\nfloat4 vertex(float4 value : POSITION) : SV_Position {\n" + body +
           "    return sum;\n}\nRWStructuredBuffer<float4> values : register(u0);\n"
           "[numthreads(1, 1, 1)] void compute() {\n    float4 value = values[0];\n" +
           body + "    values[0] = sum;\n}\n";
}

}  // namespace calls
