#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace examples {

// printf into a string of at most 399 characters.
template <class... Values>
std::string format(const char* pattern, Values... values) {
    char text[400];
    std::snprintf(text, sizeof text, pattern, values...);
    return text;
}

// A JSON string.
[[nodiscard]] std::string quoted(const std::string& text);

// Text as HTML, also between quotes.
[[nodiscard]] std::string escaped(std::string_view text);

// A Markdown table with its columns lined up; the first column is text, the others are numbers.
[[nodiscard]] std::string lined_up(const std::vector<std::vector<std::string>>& rows);

// How the programs were built, in one line.
[[nodiscard]] std::string build_text();

// The same as the beginning of a JSON object, which is left open.
[[nodiscard]] std::string build_json();

}  // namespace examples
