#pragma once

#include <cstddef>

#if defined(__unix__) || defined(__APPLE__)
#include <sys/mman.h>
#endif

namespace bumpshadow {

// Address space without memory behind it until it is touched, full of zeros; data() is null where there is none.
class reserved {
public:
    explicit reserved(std::size_t bytes) : bytes_(bytes) {
#if defined(__unix__) || defined(__APPLE__)
        if (sizeof(std::size_t) < 8) return;
        void* const place =
            mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
        if (place != MAP_FAILED) data_ = place;
#endif
    }
    ~reserved() {
#if defined(__unix__) || defined(__APPLE__)
        if (data_ != nullptr) munmap(data_, bytes_);
#endif
    }
    reserved(const reserved&) = delete;
    reserved& operator=(const reserved&) = delete;
    [[nodiscard]] void* data() const { return data_; }
    [[nodiscard]] std::size_t bytes() const { return bytes_; }

private:
    std::size_t bytes_;
    void* data_ = nullptr;
};

}  // namespace bumpshadow
