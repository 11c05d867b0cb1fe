#include "support/gl.hpp"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <initializer_list>

#include "support/gl_functions.hpp"

namespace gl {

namespace {

using bumpshadow::address_mode;
using bumpshadow::const_texture;
using bumpshadow::filter_mode;
using bumpshadow::sampler;
using bumpshadow::texel_format;
using bumpshadow::texture_kind;
using bumpshadow::texture_layout;

functions f;

std::string hexadecimal(unsigned number) {
    char text[16];
    std::snprintf(text, sizeof text, "0x%04x", number);
    return text;
}

std::string text_of(GLenum name) {
    const GLubyte* const text = f.GetString(name);
    return text != nullptr ? reinterpret_cast<const char*>(text) : "";
}

// ---- Formats ----

struct gl_format {
    GLenum internal, format, type;  // format 0: blocks
    const char* es_extension;       // that ES needs for it
};

gl_format format_of(texel_format format) {
    constexpr GLenum dxt1 = 0x83f0;  // COMPRESSED_RGB_S3TC_DXT1_EXT, of an extension on desktops too
    switch (format) {
        case texel_format::r8: return {GL_R8, GL_RED, GL_UNSIGNED_BYTE, nullptr};
        case texel_format::rg8: return {GL_RG8, GL_RG, GL_UNSIGNED_BYTE, nullptr};
        case texel_format::rgba8: return {GL_RGBA8, GL_RGBA, GL_UNSIGNED_BYTE, nullptr};
        case texel_format::r16: return {GL_R16, GL_RED, GL_UNSIGNED_SHORT, "GL_EXT_texture_norm16"};
        case texel_format::rgba16: return {GL_RGBA16, GL_RGBA, GL_UNSIGNED_SHORT, "GL_EXT_texture_norm16"};
        case texel_format::r16f: return {GL_R16F, GL_RED, GL_HALF_FLOAT, nullptr};
        case texel_format::rgba16f: return {GL_RGBA16F, GL_RGBA, GL_HALF_FLOAT, nullptr};
        case texel_format::r32f: return {GL_R32F, GL_RED, GL_FLOAT, nullptr};
        case texel_format::rgba32f: return {GL_RGBA32F, GL_RGBA, GL_FLOAT, nullptr};
        case texel_format::rgb565: return {GL_RGB565, GL_RGB, GL_UNSIGNED_SHORT_5_6_5, nullptr};
        case texel_format::bc1: return {dxt1, 0, 0, "GL_EXT_texture_compression_s3tc"};
        case texel_format::bc4: return {GL_COMPRESSED_RED_RGTC1, 0, 0, "GL_EXT_texture_compression_rgtc"};
    }
    return {};
}

GLenum target_of(texture_kind kind) {
    switch (kind) {
        case texture_kind::flat: return GL_TEXTURE_2D;
        case texture_kind::array: return GL_TEXTURE_2D_ARRAY;
        case texture_kind::cube: return GL_TEXTURE_CUBE_MAP;
        case texture_kind::volume: return GL_TEXTURE_3D;
    }
    return 0;
}

// ---- Textures ----

GLint wrap_of(address_mode mode) {
    return mode == address_mode::repeat  ? GL_REPEAT
           : mode == address_mode::clamp ? GL_CLAMP_TO_EDGE
                                         : GL_MIRRORED_REPEAT;
}

void set_sampler(GLenum target, const sampler& how, bool mips) {
    const bool linear = how.texels == filter_mode::linear, between = how.levels == filter_mode::linear;
    GLint minified = linear ? GL_LINEAR : GL_NEAREST;
    if (mips && linear) minified = between ? GL_LINEAR_MIPMAP_LINEAR : GL_LINEAR_MIPMAP_NEAREST;
    if (mips && !linear) minified = between ? GL_NEAREST_MIPMAP_LINEAR : GL_NEAREST_MIPMAP_NEAREST;
    f.TexParameteri(target, GL_TEXTURE_MIN_FILTER, minified);
    f.TexParameteri(target, GL_TEXTURE_MAG_FILTER, linear ? GL_LINEAR : GL_NEAREST);
    f.TexParameteri(target, GL_TEXTURE_WRAP_S, wrap_of(how.x));
    f.TexParameteri(target, GL_TEXTURE_WRAP_T, wrap_of(how.y));
    f.TexParameteri(target, GL_TEXTURE_WRAP_R, wrap_of(how.z));
}

// One layer of one level; bound to `target`.
void upload_level(GLenum target, const const_texture& t, int layer, int level) {
    const texture_layout& l = t.layout;
    const gl_format format = format_of(l.format);
    const glm::ivec2 extent = l.level_extent(level);
    const int depth = l.level_depth(level);
    const auto bytes = static_cast<GLsizei>(l.slice_bytes(level) * std::size_t(depth));
    const std::byte* const data = t.slice(layer, level);
    const bool deep = l.kind == texture_kind::array || l.kind == texture_kind::volume;
    const GLenum image = l.kind == texture_kind::cube ? GLenum(GL_TEXTURE_CUBE_MAP_POSITIVE_X + layer) : target;
    if (deep && format.format != 0)
        f.TexSubImage3D(target, level, 0, 0, layer, extent.x, extent.y, depth, format.format, format.type, data);
    else if (deep)
        f.CompressedTexSubImage3D(target, level, 0, 0, layer, extent.x, extent.y, depth, format.internal, bytes, data);
    else if (format.format != 0)
        f.TexSubImage2D(image, level, 0, 0, extent.x, extent.y, format.format, format.type, data);
    else
        f.CompressedTexSubImage2D(image, level, 0, 0, extent.x, extent.y, format.internal, bytes, data);
}

GLuint upload(const const_texture& t, const sampler& how) {
    const texture_layout& l = t.layout;
    const GLenum target = target_of(l.kind), internal = format_of(l.format).internal;
    GLuint name = 0;
    f.GenTextures(1, &name);
    f.BindTexture(target, name);
    f.PixelStorei(GL_UNPACK_ALIGNMENT, 1);
    if (l.kind == texture_kind::array || l.kind == texture_kind::volume)
        f.TexStorage3D(target, l.mips, internal, l.extent.x, l.extent.y,
                       l.kind == texture_kind::array ? l.layers : l.depth);
    else
        f.TexStorage2D(target, l.mips, internal, l.extent.x, l.extent.y);
    for (int layer = 0; layer < l.layers; ++layer)
        for (int level = 0; level < l.mips; ++level) upload_level(target, t, layer, level);
    set_sampler(target, how, l.mips > 1);
    return name;
}

// ---- Programs ----

std::string numbered(std::string_view text) {
    std::string result;
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size() - 1);
        result += std::to_string(line) + ": ";
        result += text.substr(0, end + 1);
        text.remove_prefix(end + 1);
    }
    return result;
}

// All GL names that a run makes, gone with it.
struct resources {
    GLuint program = 0, frame = 0, vertices = 0;
    std::vector<GLuint> shaders, textures, buffers;

    resources() = default;
    resources(const resources&) = delete;
    resources& operator=(const resources&) = delete;
    ~resources() {
        f.UseProgram(0);
        f.DeleteProgram(program);
        for (const GLuint shader : shaders) f.DeleteShader(shader);
        f.DeleteFramebuffers(1, &frame);
        f.DeleteVertexArrays(1, &vertices);
        f.DeleteTextures(GLsizei(textures.size()), textures.data());
        f.DeleteBuffers(GLsizei(buffers.size()), buffers.data());
    }
};

struct stage {
    GLenum type;
    std::string_view text;
};

// Compiles, links and uses. Returns the compiler's or linker's words; empty: fine.
std::string build(resources& r, std::initializer_list<stage> stages) {
    std::string log(16384, '\0');
    GLint good = 0;
    GLsizei length = 0;
    r.program = f.CreateProgram();
    for (const auto& [type, text] : stages) {
        const GLuint shader = f.CreateShader(type);
        r.shaders.push_back(shader);
        const char* const characters = text.data();
        const auto size = static_cast<GLint>(text.size());
        f.ShaderSource(shader, 1, &characters, &size);
        f.CompileShader(shader);
        f.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
        if (good == 0) {
            f.GetShaderInfoLog(shader, GLsizei(log.size()), &length, log.data());
            return log.substr(0, std::size_t(length)) + numbered(text);
        }
        f.AttachShader(r.program, shader);
    }
    f.LinkProgram(r.program);
    f.GetProgramiv(r.program, GL_LINK_STATUS, &good);
    if (good == 0) {
        f.GetProgramInfoLog(r.program, GLsizei(log.size()), &length, log.data());
        return "link: " + log.substr(0, std::size_t(length));
    }
    f.UseProgram(r.program);
    return {};
}

// Sets the sampler NAME and those that spirv-cross makes of an HLSL texture NAME: one for reads with each
// OTHER_sampler, one for reads without a sampler. False: the program reads none of them.
bool set_unit(GLuint program, const std::string& name, std::span<const bound_texture> others, GLint unit) {
    const std::string combined = "SPIRV_Cross_Combined" + name;
    std::vector<std::string> candidates = {name, combined + "SPIRV_Cross_DummySampler"};
    for (const bound_texture& other : others) candidates.push_back(combined + other.name + "_sampler");
    bool read = false;
    for (const std::string& candidate : candidates) {
        const GLint location = f.GetUniformLocation(program, candidate.c_str());
        if (location < 0) continue;
        f.Uniform1i(location, unit);
        read = true;
    }
    return read;
}

// Textures that the program does not read are left out: the compiler drops their names.
std::string bind(const context& gl, resources& r, std::span<const bound_texture> textures) {
    GLint unit = 0;
    for (const auto& [name, texture, how] : textures) {
        if (const auto s = bumpshadow::check(texture); !s) return name + ": " + s.message().c_str();
        if (!gl.supports(texture.layout, how)) return name + ": the driver has no such textures";
        if (!set_unit(r.program, name, textures, unit)) continue;
        f.ActiveTexture(GLenum(GL_TEXTURE0 + unit++));
        r.textures.push_back(upload(texture, how));
    }
    return {};
}

std::string last_error() {
    const GLenum error = f.GetError();
    return error == GL_NO_ERROR ? std::string() : "GL error " + hexadecimal(error);
}

}  // namespace

context::context(api which) : which_(which) {
    const char* const why = create();
    if (why != nullptr) error_ = std::string(why) + ", EGL error " + hexadecimal(unsigned(eglGetError()));
}

const char* context::create() {
    display_ = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
    if (display_ == EGL_NO_DISPLAY) return "no display without surfaces";
    if (eglInitialize(display_, nullptr, nullptr) == EGL_FALSE) return "eglInitialize failed";
    const bool es = which_ == api::es;
    eglBindAPI(es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    const EGLint wanted[] = {EGL_SURFACE_TYPE, 0, EGL_RENDERABLE_TYPE, es ? EGL_OPENGL_ES3_BIT : EGL_OPENGL_BIT,
                             EGL_NONE};
    EGLConfig config = EGL_NO_CONFIG_KHR;
    EGLint count = 0;
    eglChooseConfig(display_, wanted, &config, 1, &count);
    const EGLint version_es[] = {EGL_CONTEXT_MAJOR_VERSION, 3, EGL_CONTEXT_MINOR_VERSION, 1, EGL_NONE};
    const EGLint version_desktop[] = {
        EGL_CONTEXT_MAJOR_VERSION,           4,       EGL_CONTEXT_MINOR_VERSION, 5, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    context_ = eglCreateContext(display_, count > 0 ? config : EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT,
                                es ? version_es : version_desktop);
    if (context_ == EGL_NO_CONTEXT) return es ? "no OpenGL ES 3.1" : "no OpenGL 4.5 core";
    make_current();
    if (eglGetCurrentContext() != context_) return "no context without a surface";
    if (const char* const missing = load(f)) return missing;
    GLint extensions = 0;
    f.GetIntegerv(GL_NUM_EXTENSIONS, &extensions);
    for (GLint i = 0; i < extensions; ++i)
        extensions_.emplace_back(reinterpret_cast<const char*>(f.GetStringi(GL_EXTENSIONS, GLuint(i))));
    if (!es) f.Enable(GL_TEXTURE_CUBE_MAP_SEAMLESS);
    return nullptr;
}

context::~context() {
    if (context_ == nullptr) return;
    eglBindAPI(which_ == api::es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    eglDestroyContext(display_, context_);
}

void context::make_current() const {
    eglBindAPI(which_ == api::es ? EGL_OPENGL_ES_API : EGL_OPENGL_API);
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_);
}

std::string context::description() const {
    make_current();
    return text_of(GL_VERSION) + ", " + text_of(GL_RENDERER);
}

bool context::has_extension(std::string_view name) const {
    return std::find(extensions_.begin(), extensions_.end(), name) != extensions_.end();
}

bool context::supports(const texture_layout& layout, const sampler& how) const {
    const bool es = which_ == api::es, blocks = bumpshadow::traits_of(layout.format).block > 1;
    if (blocks && layout.kind == texture_kind::volume) return false;
    if (layout.format == texel_format::bc1 && !has_extension("GL_EXT_texture_compression_s3tc")) return false;
    const char* const extension = format_of(layout.format).es_extension;
    if (es && extension != nullptr && !has_extension(extension)) return false;
    const bool wide = layout.format == texel_format::r32f || layout.format == texel_format::rgba32f;
    const bool filtered = how.texels == filter_mode::linear || how.levels == filter_mode::linear;
    return !(es && wide && filtered) || has_extension("GL_OES_texture_float_linear");
}

image run_fragment(const context& gl, std::string_view shader, glm::ivec2 extent,
                   std::span<const bound_texture> textures) {
    gl.make_current();
    const std::string version(shader.substr(0, shader.find('\n') + 1));
    if (!version.starts_with("#version")) return {"the shader does not begin with #version", {}};
    const std::string vertex = version +
                               "void main() {\n"
                               "    vec2 corner = vec2(float((gl_VertexID << 1) & 2), float(gl_VertexID & 2));\n"
                               "    gl_Position = vec4(corner * 2.0 - 1.0, 0.0, 1.0);\n"
                               "}\n";
    resources r;
    image result;
    result.error = build(r, {{GL_VERTEX_SHADER, vertex}, {GL_FRAGMENT_SHADER, shader}});
    if (result.error.empty()) result.error = bind(gl, r, textures);
    if (!result.error.empty()) return result;

    // The last unit is the least likely to be one that the shader reads.
    GLint units = 0;
    f.GetIntegerv(GL_MAX_TEXTURE_IMAGE_UNITS, &units);
    f.ActiveTexture(GLenum(GL_TEXTURE0 + units - 1));
    GLuint target = 0;
    f.GenTextures(1, &target);
    r.textures.push_back(target);
    f.BindTexture(GL_TEXTURE_2D, target);
    f.TexStorage2D(GL_TEXTURE_2D, 1, GL_RGBA32UI, extent.x, extent.y);
    f.GenFramebuffers(1, &r.frame);
    f.BindFramebuffer(GL_FRAMEBUFFER, r.frame);
    f.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, target, 0);
    if (f.CheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
        return {"the framebuffer is not complete", {}};
    f.GenVertexArrays(1, &r.vertices);
    f.BindVertexArray(r.vertices);
    f.Viewport(0, 0, extent.x, extent.y);
    f.DrawArrays(GL_TRIANGLES, 0, 3);

    static_assert(sizeof(glm::vec4) == 16);
    result.values.resize(std::size_t(extent.x) * std::size_t(extent.y));
    f.ReadPixels(0, 0, extent.x, extent.y, GL_RGBA_INTEGER, GL_UNSIGNED_INT, result.values.data());
    result.error = last_error();
    return result;
}

namespace {

// Storage buffers at bindings 0, 1 ... and uniform blocks likewise.
void bind(resources& r, std::span<const bound_buffer> buffers) {
    GLuint bindings[2] = {};
    r.buffers.resize(buffers.size());
    f.GenBuffers(GLsizei(buffers.size()), r.buffers.data());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const GLenum target = buffers[i].constant ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
        f.BindBufferBase(target, bindings[buffers[i].constant ? 1 : 0]++, r.buffers[i]);
        f.BufferData(target, GLsizeiptr(buffers[i].bytes.size()), buffers[i].bytes.data(), GL_DYNAMIC_COPY);
    }
}

std::string read_back(const resources& r, std::span<const bound_buffer> buffers) {
    f.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    GLuint binding = 0;
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        if (buffers[i].constant) continue;
        f.BindBufferBase(GL_SHADER_STORAGE_BUFFER, binding++, r.buffers[i]);
        const std::span<std::byte> bytes = buffers[i].bytes;
        const void* const mapped =
            f.MapBufferRange(GL_SHADER_STORAGE_BUFFER, 0, GLsizeiptr(bytes.size()), GL_MAP_READ_BIT);
        if (mapped == nullptr) return "a buffer cannot be read: " + last_error();
        std::copy_n(static_cast<const std::byte*>(mapped), bytes.size(), bytes.data());
        f.UnmapBuffer(GL_SHADER_STORAGE_BUFFER);
    }
    return last_error();
}

}  // namespace

std::string run_compute(const context& gl, std::string_view shader, glm::ivec3 groups,
                        std::span<const bound_buffer> buffers, std::span<const bound_texture> textures) {
    gl.make_current();
    resources r;
    std::string error = build(r, {{GL_COMPUTE_SHADER, shader}});
    if (error.empty()) error = bind(gl, r, textures);
    if (!error.empty()) return error;
    bind(r, buffers);
    f.DispatchCompute(GLuint(groups.x), GLuint(groups.y), GLuint(groups.z));
    return read_back(r, buffers);
}

std::string run_dispatches(const context& gl, std::string_view shader, std::span<const dispatch> dispatches,
                           int constants_binding, std::span<const bound_buffer> buffers) {
    gl.make_current();
    resources r;
    if (std::string error = build(r, {{GL_COMPUTE_SHADER, shader}}); !error.empty()) return error;
    bind(r, buffers);
    f.GenBuffers(1, &r.buffers.emplace_back());
    f.BindBufferBase(GL_UNIFORM_BUFFER, GLuint(constants_binding), r.buffers.back());
    for (const dispatch& d : dispatches) {
        f.BufferData(GL_UNIFORM_BUFFER, GLsizeiptr(d.constants.size()), d.constants.data(), GL_STREAM_DRAW);
        f.DispatchCompute(GLuint(d.groups.x), GLuint(d.groups.y), GLuint(d.groups.z));
        f.MemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    }
    return read_back(r, buffers);
}

}  // namespace gl
