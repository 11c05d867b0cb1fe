#pragma once

#include <chrono>
#include <string>

namespace examples {

// A progress bar with the time left, on a terminal only. Parts of the work are weighed by estimates of their seconds;
// what has been done says by how much the estimates are off.
class progress_bar {
public:
    progress_bar(double seconds, bool shown);
    ~progress_bar() { clear(); }
    progress_bar(const progress_bar&) = delete;
    progress_bar& operator=(const progress_bar&) = delete;

    // The next part is estimated to take this long, in this many steps.
    void begin(const std::string& name, double seconds, int steps);
    void step(const std::string& what);
    void end();
    void clear();

private:
    using clock = std::chrono::steady_clock;

    const double all_;
    const bool shown_;
    const clock::time_point start_ = clock::now();
    clock::time_point next_ = start_;
    std::string name_;
    double done_ = 0.0, part_ = 0.0;  // estimated seconds
    int steps_ = 1, taken_ = 0;
    bool printed_ = false;
};

// Ctrl-C. From now on the first one is only noted; the second ends the program at once, and removes what is half
// written. Where the caller has it ignored, it stays so.
void catch_interrupt();
[[nodiscard]] bool is_interrupted();

}  // namespace examples
