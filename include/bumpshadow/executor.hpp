#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <thread>
#include <utility>
#include <vector>

namespace bumpshadow {

// Who runs the independent items of a bake. The library starts no threads of its own accord: a producer calls
//   execute(count, body)    runs body(0) ... body(count - 1) in any order, each once, at most concurrency() at a time,
//                           and returns when all have ended
// The result of a bake does not depend on the executor, bit for bit. Wrap an engine's job system in these two members.
template <class T>
concept executor = requires(const T& execute, void (*body)(std::size_t)) {
    { execute.concurrency() } -> std::convertible_to<int>;
    execute(std::size_t{1}, body);
};

// Runs items one after the other on the calling thread. The default everywhere.
struct serial {
    [[nodiscard]] constexpr int concurrency() const { return 1; }

    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        for (std::size_t i = 0; i < count; ++i) body(i);
    }
};

// Runs items on `count` threads, the calling one among them; the others live as long as one call.
class threads {
public:
    // 0: one for each core the machine reports.
    explicit threads(int count = 0)
        : count_(count > 0 ? count : static_cast<int>(std::thread::hardware_concurrency())) {
        if (count_ < 1) count_ = 1;
    }

    [[nodiscard]] int concurrency() const { return count_; }

    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) body(i);
        };
        std::vector<std::jthread> helpers;
        const std::size_t wanted = count < std::size_t(count_) ? count : std::size_t(count_);
        helpers.reserve(wanted);
        for (std::size_t i = 1; i < wanted; ++i) helpers.emplace_back(work);
        work();
    }

private:
    int count_;
};

}  // namespace bumpshadow
