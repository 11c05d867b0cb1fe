#include "common/report_text.hpp"

#include <algorithm>
#include <cstddef>

#include <bumpshadow/config.hpp>
#include <bumpshadow/simd.hpp>
#include <bumpshadow/version.hpp>

namespace examples {
namespace {

constexpr const char* compiler =
#if defined(__clang__)
    "Clang " __clang_version__;
#elif defined(__GNUC__)
    "GCC " __VERSION__;
#else
    "another compiler";
#endif

constexpr const char* instructions =
#if defined(__AVX512F__)
    "AVX-512";
#elif defined(__AVX2__) && defined(__FMA__)
    "AVX2 and FMA";
#elif defined(__AVX__)
    "AVX";
#elif defined(__SSE2__)
        "SSE2";
#else
        "the target's default";
#endif

constexpr bool optimized =
#if defined(__OPTIMIZE__) || defined(NDEBUG)
    true;
#else
    false;
#endif

constexpr const char* simd_mode[] = {"plain loops", "vector extensions", "xsimd"};

}  // namespace

std::string quoted(const std::string& text) {
    std::string result = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\')
            result += {'\\', c};
        else if (static_cast<unsigned char>(c) < 0x20)
            result += format("\\u%04x", c);
        else
            result += c;
    }
    return result + '"';
}

std::string escaped(std::string_view text) {
    std::string out;
    for (const char c : text) {
        if (c == '&')
            out += "&amp;";
        else if (c == '<')
            out += "&lt;";
        else if (c == '>')
            out += "&gt;";
        else if (c == '"')
            out += "&quot;";
        else
            out += c;
    }
    return out;
}

std::string lined_up(const std::vector<std::vector<std::string>>& rows) {
    std::vector<std::size_t> widths(rows.front().size());
    for (const auto& row : rows)
        for (std::size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    std::string result;
    for (std::size_t r = 0; r < rows.size(); ++r) {
        for (std::size_t i = 0; i < widths.size(); ++i) {
            const std::string space(widths[i] - rows[r][i].size(), ' ');
            result += i == 0 ? "| " : " | ";
            result += i == 0 ? rows[r][i] + space : space + rows[r][i];
        }
        result += " |\n";
        if (r != 0) continue;
        for (std::size_t i = 0; i < widths.size(); ++i) {
            result += i == 0 ? "| " : " | ";
            result += std::string(widths[i] - (i == 0 ? 0 : 1), '-');
            result += i == 0 ? "" : ":";
        }
        result += " |\n";
    }
    return result;
}

std::string build_json() {
    return "{\"version\":" +
           quoted(format("%d.%d.%d", BUMPSHADOW_VERSION_MAJOR, BUMPSHADOW_VERSION_MINOR, BUMPSHADOW_VERSION_PATCH)) +
           ",\"compiler\":" + quoted(compiler) + ",\"instructions\":" + quoted(instructions) +
           ",\"simd\":" + quoted(simd_mode[BUMPSHADOW_SIMD]) +
           format(",\"simd_width\":%d,\"native\":%s,\"optimized\":%s", bumpshadow::simd::width,
                  EXAMPLES_NATIVE ? "true" : "false", optimized ? "true" : "false");
}

std::string build_text() {
    return format(
        "bumpshadow %d.%d.%d, %s, %s, %s of %d floats%s%s", BUMPSHADOW_VERSION_MAJOR, BUMPSHADOW_VERSION_MINOR,
        BUMPSHADOW_VERSION_PATCH, compiler, instructions, simd_mode[BUMPSHADOW_SIMD], bumpshadow::simd::width,
        EXAMPLES_NATIVE ? ", built for this machine (native)" : ", not native", optimized ? "" : ", NOT OPTIMIZED");
}

}  // namespace examples
