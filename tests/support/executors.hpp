#pragma once

#include <cstddef>

#include <bumpshadow/executor.hpp>

// Executors that do what the library allows and what none of its own do.
namespace executors {

// Runs the last item first.
struct backwards {
    [[nodiscard]] int concurrency() const { return 1; }
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        for (std::size_t i = count; i-- > 0;) body(i);
    }
};

// Says that it runs one item at a time and runs eight, last ones first.
struct unruly {
    [[nodiscard]] int concurrency() const { return 1; }
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        bumpshadow::threads{8}(count, [&](std::size_t i) { body(count - 1 - i); });
    }
};

}  // namespace executors
