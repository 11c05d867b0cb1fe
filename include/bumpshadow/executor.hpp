#pragma once

#include <atomic>
#include <concepts>
#include <cstddef>
#include <exception>
#include <thread>
#include <utility>
#include <vector>

#include <bumpshadow/config.hpp>

namespace bumpshadow {

// Who runs the independent items of a bake. The library starts no threads of its own accord: a producer calls
//   execute(count, body)    runs body(0) ... body(count - 1) in any order, each once, at most concurrency() at a time,
//                           and returns when all have ended
// The result of a bake does not depend on the executor, bit for bit. Wrap an engine's job system in these two members.
//
// What comes of an executor that does otherwise:
//   an exception    passes through the producer; scratch goes back where it came from, outputs are written in part.
//                   Items that are running have to end before, as they use the scratch
//   an item twice   the same result if one run ends before the other begins, but for make_mips, make_fourier_mips and
//                   draw_emboss onto its own base, which change values in place, and counts in reports. At the same
//                   time both write to the same memory
//   an item never   what it would have written stays as it was, and the status says nothing of it
//   more at a time  than concurrency(): the surplus waits
template <class T>
concept executor = requires(const T& execute, void (*body)(std::size_t)) {
    { execute.concurrency() } -> std::convertible_to<int>;
    execute(std::size_t{1}, body);
};

// Runs items one after the other on the calling thread. The default everywhere.
struct serial {
    // Items at a time: one.
    [[nodiscard]] constexpr int concurrency() const { return 1; }

    // Runs body(0) to body(count - 1) in order.
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        for (std::size_t i = 0; i < count; ++i) body(i);
    }
};

// Runs items on `count` threads, the calling one among them; the others live as long as one call. Where no more threads
// can be had those that could be do the work. A body that throws on one of the others ends the program.
class threads {
public:
    // 0: one for each core the machine reports.
    explicit threads(int count = 0)
        : count_(count > 0 ? count : static_cast<int>(std::thread::hardware_concurrency())) {
        if (count_ < 1) count_ = 1;
    }

    // Threads, at least 1.
    [[nodiscard]] int concurrency() const { return count_; }

    // Runs body(0) to body(count - 1), each once, and returns when all have ended.
    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        std::atomic<std::size_t> next{0};
        const auto work = [&] {
            for (std::size_t i; (i = next.fetch_add(1, std::memory_order_relaxed)) < count;) body(i);
        };
        struct joined {  // by hand: std::jthread is missing in Clang's own library before 20
            std::vector<std::thread> threads;
            ~joined() {
                for (std::thread& helper : threads) helper.join();
            }
        } helpers;
        const std::size_t wanted = count < std::size_t(count_) ? count : std::size_t(count_);
        const auto hire = [&] {
            helpers.threads.reserve(wanted);
            for (std::size_t i = 1; i < wanted; ++i) helpers.threads.emplace_back(work);
        };
#if defined(__cpp_exceptions)
        try {
            hire();
        } catch (const std::exception&) {  // std::system_error, or std::bad_alloc
        }
#else
        hire();
#endif
        work();
    }

private:
    int count_;
};

}  // namespace bumpshadow
