#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <glm/ext/vector_float4.hpp>
#include <glm/ext/vector_int2.hpp>
#include <glm/ext/vector_int3.hpp>

#include <bumpshadow/reference/sampler.hpp>
#include <bumpshadow/texture.hpp>

// Runs shaders off screen: OpenGL and OpenGL ES through EGL without a window or surface (Mesa).
namespace gl {

enum class api : unsigned char { desktop, es };

// A context of OpenGL 4.5 core or OpenGL ES 3.1 or newer. Current in this thread from construction until another one is
// constructed or used.
class context {
public:
    explicit context(api which);
    ~context();
    context(const context&) = delete;
    context& operator=(const context&) = delete;

    // Why there is no context; empty: there is one.
    [[nodiscard]] const std::string& error() const { return error_; }
    // Version and renderer.
    [[nodiscard]] std::string description() const;
    // False where the driver has no such textures, or does not filter them. ES has r16 and rgba16 by an extension only;
    // no API has volumes of blocks.
    [[nodiscard]] bool supports(const bumpshadow::texture_layout& layout, const bumpshadow::sampler& how) const;

    void make_current() const;

private:
    [[nodiscard]] const char* create();
    [[nodiscard]] bool has_extension(std::string_view name) const;

    api which_;
    std::string error_;
    void* display_ = nullptr;
    void* context_ = nullptr;
    std::vector<std::string> extensions_;
};

// A texture with all its mip levels, and how it is sampled; how.weights is the driver's affair. Cubes are seamless.
struct bound_texture {
    std::string name;  // of the sampler in the shader, or of the HLSL texture that spirv-cross made it from
    bumpshadow::const_texture texture;
    bumpshadow::sampler how;
};

struct image {
    std::string error;              // from compiler, linker or GL; empty: the values are good
    std::vector<glm::vec4> values;  // row by row
};

// Runs a fragment shader, complete with its #version, once for every pixel: gl_FragCoord is (x + 0.5, y + 0.5). Its one
// output is a uvec4 of floatBitsToUint, since every API draws to integers and only some draw to float.
[[nodiscard]] image run_fragment(const context& gl, std::string_view shader, glm::ivec2 extent,
                                 std::span<const bound_texture> textures = {});

struct bound_buffer {
    std::span<std::byte> bytes;  // read back after the run, if not constant
    bool constant = false;       // a uniform block, not a storage buffer
};

// Runs a compute shader. Storage buffers are at bindings 0, 1 ... in their order, uniform blocks likewise.
// Returns what went wrong; empty: nothing.
[[nodiscard]] std::string run_compute(const context& gl, std::string_view shader, glm::ivec3 groups,
                                      std::span<const bound_buffer> buffers,
                                      std::span<const bound_texture> textures = {});

struct dispatch {
    std::span<const std::byte> constants;  // of a uniform block
    glm::ivec3 groups{1};
};

// Runs one compute shader again and again, with a barrier between.
[[nodiscard]] std::string run_dispatches(const context& gl, std::string_view shader,
                                         std::span<const dispatch> dispatches, int constants_binding,
                                         std::span<const bound_buffer> buffers);

}  // namespace gl
