// What is composed for every choice in Godot 3, whose shading language is GLSL ES without a preprocessor and
// structures.

#include <cstddef>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "shader/compile/shaders.hpp"
#include "source.hpp"
#include "support/skip.hpp"
#include "support/tool.hpp"

namespace {

// Draws a rectangle with each shader of the project, so that both Godot and the driver compile it.
constexpr const char* script = R"(extends SceneTree
var frames = 0
func _initialize():
	var file = File.new()
	var number = 0
	while file.open("res://%d.txt" % number, File.READ) == OK:
		var shader = Shader.new()
		print("shader ", number)
		shader.code = file.get_as_text()
		shader.has_param("none")
		var material = ShaderMaterial.new()
		material.shader = shader
		var rectangle = ColorRect.new()
		rectangle.rect_size = Vector2(8, 8)
		rectangle.material = material
		root.add_child(rectangle)
		number += 1
	print("shaders: ", number)
func _idle(_delta):
	frames += 1
	if frames == 3:
		quit()
)";

std::string missing() {
    for (const char* name : {"godot3", "xvfb-run", "xauth", "env"})
        if (tool::find(name).empty()) return std::string("Godot 3 is not asked: no ") + name + " on PATH";
    return {};
}

// All of it in one run; what Godot says.
std::string run(const std::vector<std::string>& codes) {
    const tool::folder folder;
    tool::write(folder / "project.godot", "config_version=4\n");
    tool::write(folder / "main.gd", script);
    for (std::size_t i = 0; i < codes.size(); ++i) tool::write(folder / (std::to_string(i) + ".txt"), codes[i]);
    // A home of its own, where it leaves settings and caches.
    const std::string home = (folder / "").string();
    return tool::run({tool::find("env").string(), "HOME=" + home, "XDG_DATA_HOME=" + home, "XDG_CONFIG_HOME=" + home,
                      "XDG_CACHE_HOME=" + home, tool::find("xvfb-run").string(), "-a", tool::find("godot3").string(),
                      "--path", home, "--audio-driver", "Dummy", "-s", "main.gd"})
        .output;
}

std::string shader(const std::string& functions, const std::string& body) {
    return "shader_type canvas_item;\n" + functions + "void fragment() {\n" + body + "}\n";
}

}  // namespace

TEST_CASE("Godot 3 takes what is composed for every choice") {
    if (const std::string why = missing(); !why.empty()) return skip::because(why);
    std::vector<std::string> codes;
    for (const shaders_under_test::chosen& c : shaders_under_test::every_choice()) {
        const std::string functions = "// " + c.name + '\n' + shaders_under_test::composed(c, false) +
                                      "vec3 three(vec4 v) { return vec3(v.x, v.y, v.z); }\n";
        codes.push_back(shader(functions, "    vec4 value = vec4(UV, 0.25, 0.5);\n    vec4 sum;\n" +
                                              shaders::plain_numbers(shaders_under_test::composed_body(c)) +
                                              "    COLOR = sum;\n"));
    }
    const std::string said = run(codes);
    REQUIRE_MESSAGE(said.find("shaders: " + std::to_string(codes.size())) != std::string::npos, said);
    for (const char* failure : {"SHADER ERROR", "ompilation failed", "Compilation Failed", "LINK FAILED"})
        CHECK_MESSAGE(said.find(failure) == std::string::npos, said);
}

// Silence alone would be worth nothing.
TEST_CASE("Godot 3 says what it does not take") {
    if (const std::string why = missing(); !why.empty()) return skip::because(why);
    for (const char* bad : {"struct pair { float a; };\n", "#define A 1.0\n",
                            "float f(float v) { return v > 0.0 ? 1.0 : v < -1.0 ? 2.0 : 3.0; }\n",
                            "float f(float v) { return v * 1e-30f; }\n"}) {
        const std::string said = run({shader(bad, "    COLOR = vec4(UV, 0.0, 1.0);\n")});
        CHECK_MESSAGE(said.find("SHADER ERROR") != std::string::npos, bad, said);
    }
}
