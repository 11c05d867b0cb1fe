#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include <glm/ext/vector_double3.hpp>

#include <bumpshadow/plan/recipe.hpp>
#include <bumpshadow/plan/scene.hpp>

namespace examples {

// A scene with the memory of its lights.
struct planned_scene {
    std::vector<glm::dvec3> lights, positions;
    bumpshadow::scene limits;  // without lights

    [[nodiscard]] bumpshadow::scene view() const {
        bumpshadow::scene s = limits;
        s.lights = lights;
        s.positions = positions;
        return s;
    }
};

// What a scene's file may say, for --help.
extern const char* const scene_help;

// A scene from JSON, whose format scene_help tells. `name` is that of the file. Throws failure, in one line that names
// the key and its value, where the text is no JSON, a key is unknown or twice there, a value is of the wrong type, a
// list is empty, or the scene contradicts itself.
[[nodiscard]] planned_scene scene_of(const std::string& text, const std::string& name);
[[nodiscard]] planned_scene read_scene(const std::filesystem::path& path);

// A recipe as a JSON object and back, exactly. Infinite numbers are null. recipe_of takes what json_of writes: every
// key, and no other. Throws failure as scene_of does.
[[nodiscard]] std::string json_of(const bumpshadow::recipe& r);
[[nodiscard]] bumpshadow::recipe recipe_of(const std::string& text, const std::string& name);
[[nodiscard]] bumpshadow::recipe read_recipe(const std::filesystem::path& path);

}  // namespace examples
