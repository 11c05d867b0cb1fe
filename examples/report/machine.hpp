#pragma once

#include <string>

namespace examples {

// Name of the processor, or "processor not known".
[[nodiscard]] std::string processor_name();

// Now, in UTC: 2025-01-31T12:00:00Z.
[[nodiscard]] std::string date_text();

}  // namespace examples
