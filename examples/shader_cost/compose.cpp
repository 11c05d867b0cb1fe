#include <cctype>
#include <cstddef>
#include <set>
#include <stdexcept>

#include "shader_cost/cases.hpp"

namespace examples {
namespace {

// What belongs to an encoding or a look stands in the shader as numbers, as in the listings of the papers; the scale of
// the heights does not, and light and coordinates differ from thread to thread.
constexpr const char* head = R"(#version 450
layout(local_size_x = 64) in;
layout(push_constant) uniform constants {
    vec4 light_origin, steps;
    float max_slope;  // what a stored 1 stands for
    float some_k, some_offset, some_slices;
    vec4 scale0, offset0, scale1, offset1;
};
const float k = 8.0, offset = 0.03125, phase = 0.0, most = 4.0;
)";

constexpr const char* tail = R"(void main() {
    vec2 uv = vec2(gl_GlobalInvocationID.xy) * steps.xy;
    vec3 light = light_origin.xyz + vec3(uv, 0.0) * steps.z;
    results[gl_GlobalInvocationID.x] = shade(uv, light);
}
)";

std::set<std::string> names_in(const std::string& code) {
    const std::string prefix = "bumpshadow_";
    std::set<std::string> names;
    for (std::size_t at = code.find(prefix); at != std::string::npos;) {
        std::size_t end = at;
        while (end < code.size() && (std::isalnum(static_cast<unsigned char>(code[end])) != 0 || code[end] == '_'))
            ++end;
        names.insert(code.substr(at, end - at));
        at = code.find(prefix, end);
    }
    return names;
}

void add_with_needs(const shaders::source& all, int index, std::set<int>& chosen) {
    if (!chosen.insert(index).second) return;
    for (const int need : all.snippets[std::size_t(index)].needs) add_with_needs(all, need, chosen);
}

// Indices of the snippets that a case contains.
std::set<int> chosen_by(const shader_case& one, const shaders::source& snippets) {
    std::set<int> chosen;
    for (const std::string& name : names_in(one.body)) {
        int index = 0;
        const int count = int(snippets.snippets.size());
        while (index < count && snippets.snippets[std::size_t(index)].name != name) ++index;
        if (index == count) throw std::runtime_error(one.group + ", " + one.name + ": there is no snippet " + name);
        add_with_needs(snippets, index, chosen);
    }
    return chosen;
}

}  // namespace

std::string compose(const shader_case& one, const shaders::source& snippets) {
    std::string code = head + one.textures + "layout(binding = 7) buffer Results { " + one.result + " results[]; };\n";
    for (const int index : chosen_by(one, snippets)) code += snippets.snippets[std::size_t(index)].code;
    return code + one.result + " shade(vec2 uv, vec3 light) {\n" + one.body + "}\n" + tail;
}

std::vector<std::string> left_out(std::span<const shader_case> cases, const shaders::source& snippets) {
    std::set<int> chosen;
    for (const shader_case& one : cases) chosen.merge(chosen_by(one, snippets));
    std::vector<std::string> names;
    for (std::size_t i = 0; i < snippets.snippets.size(); ++i)
        if (!chosen.contains(int(i))) names.push_back(snippets.snippets[i].name);
    return names;
}

}  // namespace examples
