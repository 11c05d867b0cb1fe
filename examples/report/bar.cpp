#include "report/bar.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>

namespace examples {
namespace {

volatile std::sig_atomic_t interrupts = 0;
void (*at_second)(int) = SIG_DFL;

extern "C" void note_interrupt(int signal) {
    interrupts = 1;
    std::signal(signal, at_second);
}

}  // namespace

void catch_interrupt() {
    const auto previous = std::signal(SIGINT, note_interrupt);
    if (previous == SIG_IGN) std::signal(SIGINT, SIG_IGN);
    if (previous != SIG_ERR && previous != note_interrupt) at_second = previous;
}

bool is_interrupted() { return interrupts != 0; }

progress_bar::progress_bar(double seconds, bool shown) : all_(std::max(seconds, 1e-3)), shown_(shown) {}

void progress_bar::begin(const std::string& name, double seconds, int steps) {
    name_ = name;
    part_ = seconds;
    steps_ = std::max(steps, 1);
    taken_ = 0;
    step("");
}

void progress_bar::end() {
    done_ += part_;
    part_ = 0.0;
}

void progress_bar::step(const std::string& what) {
    // A step is called before what it stands for.
    const double done = done_ + part_ * std::min(double(std::max(taken_++ - 1, 0)) / steps_, 1.0);
    const clock::time_point now = clock::now();
    if (!shown_ || now < next_) return;
    next_ = now + std::chrono::milliseconds(100);
    const double passed = std::chrono::duration<double>(now - start_).count();
    // The estimates count for as much as ten seconds of experience.
    const double pace = (passed + 10.0) / (done + 10.0);
    const int left = int(std::max(all_ - done, 0.0) * pace + 0.5);
    constexpr int width = 24;
    const double part = std::clamp(done / all_, 0.0, 1.0);
    std::string bar(std::size_t(part * width), '#');
    bar.resize(width, '.');
    std::string text = name_;
    if (!what.empty()) text.append(": ").append(what);
    // Wider than a terminal, the line would stay instead of being replaced.
    constexpr std::size_t room = 36;
    if (text.size() > room) text.resize(room);
    std::fprintf(stderr, "\r[%s] %3d %%, %d:%02d left  %s\033[K", bar.c_str(), int(100.0 * part), left / 60, left % 60,
                 text.c_str());
    printed_ = true;
}

void progress_bar::clear() {
    if (printed_) std::fputs("\r\033[K", stderr);
    printed_ = false;
}

}  // namespace examples
