#pragma once

#include <EGL/egl.h>
#include <EGL/eglext.h>
#define GL_GLEXT_PROTOTYPES
#include <GL/glcorearb.h>

// The functions of OpenGL and OpenGL ES that the tests call, looked up at run time: nothing but EGL is linked.
namespace gl {

// clang-format off
#define GL_FUNCTIONS(X) \
    X(ActiveTexture) X(AttachShader) X(BindBufferBase) X(BindFramebuffer) X(BindTexture) X(BindVertexArray)          \
    X(BufferData) X(CheckFramebufferStatus) X(CompileShader) X(CompressedTexSubImage2D) X(CompressedTexSubImage3D)   \
    X(CreateProgram) X(CreateShader) X(DeleteBuffers) X(DeleteFramebuffers) X(DeleteProgram) X(DeleteShader)         \
    X(DeleteTextures) X(DeleteVertexArrays) X(DispatchCompute) X(DrawArrays) X(Enable) X(FramebufferTexture2D)       \
    X(GenBuffers) X(GenFramebuffers) X(GenTextures) X(GenVertexArrays) X(GetError) X(GetIntegerv)                    \
    X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetString) X(GetStringi)               \
    X(GetUniformLocation) X(LinkProgram) X(MapBufferRange) X(MemoryBarrier) X(PixelStorei) X(ReadPixels)             \
    X(ShaderSource) X(TexParameteri) X(TexStorage2D) X(TexStorage3D) X(TexSubImage2D) X(TexSubImage3D) X(Uniform1i)  \
    X(UnmapBuffer) X(UseProgram) X(Viewport)
// clang-format on

struct functions {
#define GL_MEMBER(name) decltype(&::gl##name) name = nullptr;  // NOLINT(bugprone-macro-parentheses): a declaration
    GL_FUNCTIONS(GL_MEMBER)
#undef GL_MEMBER
};

// Fills the set, which serves all contexts of a driver. What is missing; nullptr: nothing.
[[nodiscard]] inline const char* load(functions& f) {
#define GL_LOAD(name)                                                           \
    f.name = reinterpret_cast<decltype(f.name)>(eglGetProcAddress("gl" #name)); \
    if (f.name == nullptr) return "no gl" #name;
    GL_FUNCTIONS(GL_LOAD)
#undef GL_LOAD
    return nullptr;
}

#undef GL_FUNCTIONS

}  // namespace gl
