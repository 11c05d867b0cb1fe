#pragma once

// The producers that take memory or an executor (bakes, packs, reductions, mips, samples), behind one face, for tests
// of what goes wrong.

#include <cstddef>
#include <cstring>
#include <functional>
#include <memory_resource>
#include <span>
#include <string>
#include <vector>

#include <bumpshadow/executor.hpp>
#include <bumpshadow/status.hpp>

#include "support/counting.hpp"

namespace faults {

inline constexpr int usual_width = 3;

// An executor that is chosen while a program runs.
struct any_executor {
    using item = std::function<void(std::size_t)>;
    int width = usual_width;
    std::function<void(std::size_t, const item&)> run = [](std::size_t count, const item& body) {
        for (std::size_t i = 0; i < count; ++i) body(i);
    };

    [[nodiscard]] int concurrency() const { return width; }
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        run(count, [&](std::size_t i) { body(i); });
    }
};

// All that a producer writes.
struct outputs {
    std::vector<float> numbers;
    std::vector<std::byte> bytes;

    [[nodiscard]] bool operator==(const outputs& other) const {
        return numbers.size() == other.numbers.size() && bytes == other.bytes &&
               (numbers.empty() ||
                std::memcmp(numbers.data(), other.numbers.data(), numbers.size() * sizeof(float)) == 0);
    }
};

struct from {
    std::span<std::byte> scratch = {};
    std::pmr::memory_resource* memory = nullptr;
};

struct producer {
    std::string name;
    outputs blank;        // as large as what it writes; floats of -7 and bytes of 77
    std::size_t scratch;  // bytes that its size function states for an executor three wide; 0: takes no span
    std::function<bumpshadow::status(outputs&, const from&, const any_executor&)> run;
    bool memory = true;    // takes any
    bool again = true;     // an item may be run again
    bool by_items = true;  // nothing is written where no item runs
};

[[nodiscard]] std::vector<producer> all_producers();

}  // namespace faults
