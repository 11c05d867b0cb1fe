#pragma once

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory_resource>
#include <new>

// Counts what is out, and has nothing left for call `fails`, the first being 0. What it hands out is filled with 0xff:
// floats and doubles that are NaN.
class counting : public std::pmr::memory_resource {
public:
    explicit counting(int fails = -1) : fails_(fails) {}
    std::size_t out = 0, most = 0;
    int calls = 0;

private:
    void* do_allocate(std::size_t bytes, std::size_t alignment) override {
        if (calls++ == fails_) {
#if defined(__cpp_exceptions)
            throw std::bad_alloc();
#else
            return nullptr;
#endif
        }
        void* const block = std::pmr::new_delete_resource()->allocate(bytes, alignment);
        std::memset(block, 0xff, bytes);
        out += bytes;
        most = (std::max)(most, out);
        return block;
    }
    void do_deallocate(void* block, std::size_t bytes, std::size_t alignment) override {
        out -= bytes;
        std::pmr::new_delete_resource()->deallocate(block, bytes, alignment);
    }
    [[nodiscard]] bool do_is_equal(const memory_resource& other) const noexcept override { return this == &other; }

    int fails_;
};
