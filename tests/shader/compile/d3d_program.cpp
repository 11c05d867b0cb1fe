// d3d LIBRARY [FILE ENTRY PROFILE]...: compiles HLSL files with d3dcompiler_47.dll or dxcompiler.dll, which are Windows
// libraries; warnings are errors. Prints "FILE PROFILE: compiled, N bytes", or "FILE PROFILE: failed" and what the
// compiler says. Built by the test that runs it, with a compiler for Windows.

#include <windows.h>
// The rest needs the types above.
#include <d3dcompiler.h>
#include <unknwn.h>

#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

namespace {

// ---- dxcapi.h, the part that is needed; compilers for Windows do not all bring it ----

struct dxc_buffer {
    const void* data;
    SIZE_T size;
    UINT encoding;  // 0: UTF-8 unless it says otherwise
};

struct dxc_blob : IUnknown {
    virtual void* STDMETHODCALLTYPE GetBufferPointer() = 0;
    virtual SIZE_T STDMETHODCALLTYPE GetBufferSize() = 0;
};

struct dxc_result : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE GetStatus(HRESULT*) = 0;
    virtual HRESULT STDMETHODCALLTYPE GetResult(dxc_blob**) = 0;
    virtual HRESULT STDMETHODCALLTYPE GetErrorBuffer(dxc_blob**) = 0;
};

struct dxc_compiler : IUnknown {
    virtual HRESULT STDMETHODCALLTYPE Compile(const dxc_buffer*, const wchar_t**, UINT32, IUnknown*, REFIID,
                                              void**) = 0;
};

constexpr GUID compiler_class = {0x73e22d93, 0xe6ce, 0x47f3, {0xb5, 0xbf, 0xf0, 0x66, 0x4f, 0x39, 0xc1, 0xb0}};
constexpr GUID compiler_interface = {0x228b4687, 0x5a6a, 0x4730, {0x90, 0x0c, 0x97, 0x02, 0xb2, 0x20, 0x3f, 0x54}};
constexpr GUID result_interface = {0x58346cda, 0xdde7, 0x4497, {0x94, 0x61, 0x6f, 0x87, 0xaf, 0x5e, 0x06, 0x59}};

// ---- The two compilers ----

bool say(const char* profile, bool good, SIZE_T bytes, const void* messages, SIZE_T length) {
    if (good)
        std::printf(" %s: compiled, %u bytes\n", profile, unsigned(bytes));
    else
        std::printf(" %s: failed\n", profile);
    std::printf("%.*s", int(length), static_cast<const char*>(messages));
    return good;
}

template <class Function>
Function find(HMODULE library, const char* name) {
    return reinterpret_cast<Function>(reinterpret_cast<void*>(GetProcAddress(library, name)));
}

bool compile_fxc(HMODULE library, const std::string& text, const char* entry, const char* profile) {
    const auto compile = find<pD3DCompile>(library, "D3DCompile");
    ID3DBlob *code = nullptr, *messages = nullptr;
    const HRESULT result = compile(text.data(), text.size(), "shader.hlsl", nullptr, nullptr, entry, profile,
                                   D3DCOMPILE_ENABLE_STRICTNESS | D3DCOMPILE_WARNINGS_ARE_ERRORS, 0, &code, &messages);
    return say(profile, SUCCEEDED(result) && code != nullptr, code ? code->GetBufferSize() : 0,
               messages ? messages->GetBufferPointer() : "", messages ? messages->GetBufferSize() : 0);
}

bool compile_dxc(HMODULE library, const std::string& text, const char* entry, const char* profile) {
    using create_function = HRESULT(WINAPI*)(REFCLSID, REFIID, void**);
    const auto create = find<create_function>(library, "DxcCreateInstance");
    dxc_compiler* compiler = nullptr;
    if (FAILED(create(compiler_class, compiler_interface, reinterpret_cast<void**>(&compiler)))) return false;
    const std::wstring wide_entry(entry, entry + std::strlen(entry)),
        wide_profile(profile, profile + std::strlen(profile));
    const wchar_t* arguments[] = {L"-E", wide_entry.c_str(), L"-T", wide_profile.c_str(), L"-WX"};
    const dxc_buffer source = {text.data(), text.size(), 0};
    dxc_result* result = nullptr;
    if (FAILED(compiler->Compile(&source, arguments, 5, nullptr, result_interface, reinterpret_cast<void**>(&result))))
        return false;
    HRESULT status = E_FAIL;
    dxc_blob *code = nullptr, *messages = nullptr;
    result->GetStatus(&status);
    result->GetResult(&code);
    result->GetErrorBuffer(&messages);
    return say(profile, SUCCEEDED(status), code ? code->GetBufferSize() : 0,
               messages ? messages->GetBufferPointer() : "", messages ? messages->GetBufferSize() : 0);
}

std::string text_of(const char* path) {
    std::string text;
    if (std::FILE* const file = std::fopen(path, "rb")) {
        char block[4096];
        for (std::size_t n; (n = std::fread(block, 1, sizeof block, file)) > 0;) text.append(block, n);
        std::fclose(file);
    }
    return text;
}

}  // namespace

int main(int argc, char** argv) {
    if (argc < 3) return 2;
    const HMODULE library = LoadLibraryA(argv[1]);
    if (library == nullptr) {
        std::printf("%s does not load: error %lu\n", argv[1], GetLastError());
        return 2;
    }
    const bool fxc = GetProcAddress(library, "D3DCompile") != nullptr;
    bool good = true;
    for (int i = 2; i + 2 < argc; i += 3) {
        std::printf("%s", argv[i]);
        good &= (fxc ? compile_fxc : compile_dxc)(library, text_of(argv[i]), argv[i + 1], argv[i + 2]);
    }
    return good ? 0 : 1;
}
