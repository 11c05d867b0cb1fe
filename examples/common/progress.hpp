#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <utility>

#include <bumpshadow/executor.hpp>

#ifdef _WIN32
#include <io.h>
#else
#include <unistd.h>
#endif

namespace examples {

[[nodiscard]] inline bool stderr_is_terminal() {
#ifdef _WIN32
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(STDERR_FILENO) != 0;
#endif
}

// An executor that runs items on threads and says on a terminal how much of it is done, once the work has taken
// longer than a moment. Silent in pipes.
class progress {
public:
    progress(bumpshadow::threads run, const char* task, bool shown = stderr_is_terminal())
        : run_(run), task_(task), shown_(shown), next_(now() + 500) {}
    ~progress() {
        if (printed_.load()) std::fputs("\r\033[K", stderr);
    }
    progress(const progress&) = delete;
    progress& operator=(const progress&) = delete;

    [[nodiscard]] int concurrency() const { return run_.concurrency(); }

    template <class Body>
    void operator()(std::size_t count, Body&& body) const {
        if (!shown_) return run_(count, std::forward<Body>(body));
        std::atomic<std::size_t> done{0};
        run_(count, [&](std::size_t i) {
            body(i);
            report(done.fetch_add(1, std::memory_order_relaxed) + 1, count);
        });
    }

private:
    [[nodiscard]] static long long now() {
        using namespace std::chrono;
        return duration_cast<milliseconds>(steady_clock::now().time_since_epoch()).count();
    }

    void report(std::size_t done, std::size_t count) const {
        const long long time = now();
        long long next = next_.load(std::memory_order_relaxed);
        if (time < next || !next_.compare_exchange_strong(next, time + 100)) return;
        printed_.store(true);
        std::fprintf(stderr, "\r%s: %d %%\033[K", task_, int(100.0 * double(done) / double(count)));
    }

    bumpshadow::threads run_;
    const char* task_;
    bool shown_;
    mutable std::atomic<long long> next_;
    mutable std::atomic<bool> printed_{false};
};

}  // namespace examples
