#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <limits>
#include <span>

// What the fuzz targets share. A target is one function,
//   extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size);
// that libFuzzer, or replay.cpp, calls with many inputs.
namespace fuzz {

// Ends the program where something does not hold: what libFuzzer takes for a finding.
inline void require(bool holds, const char* what) {
    if (holds) return;
    std::fprintf(stderr, "does not hold: %s\n", what);
    std::abort();
}

// The bytes of an input, taken from its front as numbers; zeros follow its end.
class input {
public:
    input(const std::uint8_t* bytes, std::size_t size) : rest_(bytes, size) {}

    template <class T>
    [[nodiscard]] T bits() {
        T value{};
        const std::size_t count = rest_.size() < sizeof(T) ? rest_.size() : sizeof(T);
        if (count > 0) std::memcpy(&value, rest_.data(), count);
        rest_ = rest_.subspan(count);
        return value;
    }
    [[nodiscard]] int byte() { return bits<std::uint8_t>(); }
    // 0 to count - 1
    [[nodiscard]] int below(int count) { return byte() % count; }
    [[nodiscard]] bool flag() { return (byte() & 1) != 0; }
    template <class T, std::size_t Count>
    [[nodiscard]] T one_of(const T (&values)[Count]) {
        return values[below(int(Count))];
    }

    // Any number at all, the usual ones more often.
    template <class T>
    [[nodiscard]] T number() {
        using limits = std::numeric_limits<T>;
        constexpr T hard[] = {T(0),
                              -T(0),
                              limits::denorm_min(),
                              -limits::denorm_min(),
                              limits::min(),
                              limits::max(),
                              limits::lowest(),
                              limits::infinity(),
                              -limits::infinity(),
                              limits::quiet_NaN(),
                              limits::epsilon(),
                              T(1e-30),
                              T(1e30),
                              T(-1e30),
                              T(1e7),
                              T(1e-7)};
        const int kind = byte();
        if (kind < 96) return T(kind) / T(8);
        if (kind < 160) return T(bits<std::int8_t>());
        if (kind < 192) return T(bits<std::int16_t>()) / T(256);
        if (kind < 224) return hard[std::size_t(kind) % std::size(hard)];
        return bits<T>();
    }

    [[nodiscard]] bool empty() const { return rest_.empty(); }
    [[nodiscard]] std::span<const std::uint8_t> rest() const { return rest_; }

private:
    std::span<const std::uint8_t> rest_;
};

}  // namespace fuzz
