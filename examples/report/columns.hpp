#pragma once

#include <array>
#include <span>
#include <string>

#include "report/record.hpp"

namespace examples {

// What a number can be compared with.
enum class column_kind {
    setup,  // no result: what was measured
    count,  // follows from the set-up, the same everywhere
    time,   // absolute: of this machine, not comparable with another's
    ratio,  // of two measurements in one run
    error,  // against the truth
};

struct column_info {
    const char* name;
    const char* heading;  // of a table
    const char* unit;     // empty: a plain number
    column_kind kind;
    const char* meaning;
};

// The one place that names, units and meanings come from. Indexed by column.
[[nodiscard]] const column_info& about(column c);

[[nodiscard]] const char* word_of(column_kind kind);

// The columns of a record that hold text.
struct text_column {
    const char* name;
    std::string record::*member;
    const char* meaning;
};
[[nodiscard]] std::span<const text_column> text_columns();

// For tables: three or four digits. A record without the value gives an empty text.
[[nodiscard]] std::string text_of(const record& r, column c);

// For files: six digits, "inf" for no limit.
[[nodiscard]] std::string number_of(const record& r, column c);

// With the unit, for a table.
[[nodiscard]] std::string heading_of(column c);

}  // namespace examples
