#pragma once

#include <cstdio>
#include <string_view>

// Tests of what a machine may lack. A program in which something was skipped and nothing failed returns exit_code,
// which CTest reports as skipped.
namespace skip {

constexpr int exit_code = 77;

[[nodiscard]] inline bool& any() {
    static bool value = false;
    return value;
}

// Says so and notes it.
inline void because(std::string_view why) {
    std::printf("skipped: %.*s\n", int(why.size()), why.data());
    any() = true;
}

}  // namespace skip
