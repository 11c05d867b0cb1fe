#pragma once

#include <cstdio>
#include <string_view>

#include <bumpshadow/config.hpp>
#include <bumpshadow/glm.hpp>

namespace bumpshadow {

// Why a call could not be carried out.
enum class error : unsigned char {
    none,            // all is well
    missing,         // a pointer or span that is needed is empty
    not_positive,    // has to be above zero
    not_finite,      // NaN or infinite
    out_of_range,    // outside what is allowed or supported
    too_small,       // a buffer, stride or extent is below what is needed
    mismatch,        // two sizes that have to be equal are not
    not_a_multiple,  // has to be a multiple of the limit
    not_supported,   // this method cannot do what the option asks for
    out_of_memory,   // the memory resource gave nothing
};

// Text of a status: a C string in a fixed buffer, so that reporting an error cannot fail itself.
struct status_text {
    char characters[200];  // ends with a 0

    // The text.
    [[nodiscard]] const char* c_str() const { return characters; }
    // The text without the 0.
    [[nodiscard]] std::string_view view() const { return characters; }
};

// Result of a call that can fail in ways a program has to expect: bad sizes, bad numbers, no memory.
// True when all is well. When it is not, nothing has been written to the outputs unless the function says otherwise.
class [[nodiscard]] status {
public:
    constexpr status() = default;
    // An error. argument: a literal, or text that outlives the status.
    constexpr status(error code, const char* argument, double value = 0.0, double limit = 0.0,
                     glm::ivec2 texel = glm::ivec2(-1))
        : code_(code), argument_(argument), value_(value), limit_(limit), texel_(texel) {}

    // True when all is well.
    [[nodiscard]] constexpr explicit operator bool() const { return code_ == error::none; }
    // What is wrong.
    [[nodiscard]] constexpr error code() const { return code_; }
    // The offending argument by name.
    [[nodiscard]] constexpr const char* argument() const { return argument_; }
    // What it was, in its own unit.
    [[nodiscard]] constexpr double value() const { return value_; }
    // What it should have been, in the same.
    [[nodiscard]] constexpr double limit() const { return limit_; }
    // Where, for errors that have a place in the map; (-1, -1) otherwise.
    [[nodiscard]] constexpr glm::ivec2 texel() const { return texel_; }

    // One line for a person, for example "texel_size.x is -1 but has to be positive".
    [[nodiscard]] status_text message() const {
        status_text text{};
        char place[48] = "";
        if (texel_.x >= 0) std::snprintf(place, sizeof place, " at texel (%d, %d)", texel_.x, texel_.y);
        const auto write = [&](const char* format, auto... values) {
            std::snprintf(text.characters, sizeof text.characters, format, values...);
        };
        switch (code_) {
            case error::none: write("%s", "ok"); break;
            case error::missing: write("%s is missing", argument_); break;
            case error::not_positive: write("%s is %.9g but has to be positive", argument_, value_); break;
            case error::not_finite: write("%s is %g%s but has to be finite", argument_, value_, place); break;
            case error::out_of_range:
                write("%s is %.9g, which is out of range (limit %.9g)", argument_, value_, limit_);
                break;
            case error::too_small: write("%s is %.17g but at least %.17g is needed", argument_, value_, limit_); break;
            case error::mismatch: write("%s is %.17g but has to be %.17g", argument_, value_, limit_); break;
            case error::not_a_multiple:
                write("%s is %.9g but has to be a multiple of %.9g", argument_, value_, limit_);
                break;
            case error::not_supported:
                write("%s is %.9g, which this method does not support", argument_, value_);
                break;
            case error::out_of_memory: write("no memory for %s: %.17g bytes", argument_, value_); break;
        }
        return text;
    }

private:
    error code_ = error::none;
    const char* argument_ = "";
    double value_ = 0.0;
    double limit_ = 0.0;
    glm::ivec2 texel_ = glm::ivec2(-1);
};

}  // namespace bumpshadow
