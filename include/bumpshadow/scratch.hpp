#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <memory_resource>
#include <new>
#include <thread>
#include <type_traits>

#include <bumpshadow/config.hpp>
#include <bumpshadow/horizon_map.hpp>
#include <bumpshadow/sizes.hpp>
#include <bumpshadow/status.hpp>

namespace bumpshadow {

// Every array in a scratch block starts on such a boundary: a cache line, and the widest vector.
inline constexpr std::size_t scratch_alignment = 64;

// Adds up the bytes of a scratch block: one add<T>(count) for each later carve<T>(count), in any order. A sum too large
// for std::size_t becomes the largest there is.
class scratch_layout {
public:
    // Room for an array of count * each values.
    template <class T>
    constexpr scratch_layout& add(std::size_t count, std::size_t each = 1) {
        const std::size_t bytes = saturated_product(saturated_product(count, each), sizeof(T));
        const std::size_t lines = bytes / scratch_alignment + (bytes % scratch_alignment != 0 ? 1 : 0);
        bytes_ = saturated_sum(bytes_, saturated_product(lines, scratch_alignment));
        return *this;
    }
    // Bytes for everything added, wherever the block starts.
    [[nodiscard]] constexpr std::size_t bytes() const { return bytes_; }

private:
    std::size_t bytes_ = scratch_alignment;
};

// The one block of memory a bake takes up front: options.scratch if that is not empty, else from options.memory.
// Memory from the resource goes back to it when the block dies.
class scratch_block {
public:
    scratch_block() = default;
    scratch_block(const scratch_block&) = delete;
    scratch_block& operator=(const scratch_block&) = delete;
    ~scratch_block() {
        if (resource_ != nullptr) resource_->deallocate(block_, size_, scratch_alignment);
    }

    // To be called once. bytes: from a scratch_layout. who: named by the status where the resource has no memory.
    // Errors: too_small for options.scratch, out_of_memory.
    [[nodiscard]] status allocate(const bake_options& options, std::size_t bytes, const char* who) {
        if (!options.scratch.empty()) {
            if (options.scratch.size() < bytes)
                return {error::too_small, "options.scratch", double(options.scratch.size()), double(bytes)};
            block_ = options.scratch.data();
            size_ = options.scratch.size();
        } else {
            std::pmr::memory_resource* resource =
                options.memory != nullptr ? options.memory : std::pmr::get_default_resource();
            // More than any object may have is not asked for: resources round sizes up.
            if (bytes > std::size_t((std::numeric_limits<std::ptrdiff_t>::max)()))
                return {error::out_of_memory, who, double(bytes)};
#if defined(__cpp_exceptions)
            try {
                block_ = resource->allocate(bytes, scratch_alignment);
            } catch (const std::bad_alloc&) {
                block_ = nullptr;
            }
#else
            block_ = resource->allocate(bytes, scratch_alignment);
#endif
            if (block_ == nullptr) return {error::out_of_memory, who, double(bytes)};
            resource_ = resource;
            size_ = bytes;
        }
        next_ = block_;
        left_ = size_;
        return {};
    }

    // The next `count` values, uninitialized, aligned to scratch_alignment.
    template <class T>
    [[nodiscard]] T* carve(std::size_t count) {
        static_assert(std::is_trivially_destructible_v<T>);
        const std::size_t bytes = count * sizeof(T);
        void* const start = std::align(scratch_alignment, bytes, next_, left_);
        BUMPSHADOW_ASSERT(start != nullptr);
        next_ = static_cast<std::byte*>(start) + bytes;
        left_ -= bytes;
        T* const values = static_cast<T*>(start);
        std::uninitialized_default_construct_n(values, count);
        return values;
    }

private:
    void* block_ = nullptr;
    std::size_t size_ = 0;
    void* next_ = nullptr;
    std::size_t left_ = 0;
    std::pmr::memory_resource* resource_ = nullptr;
};

// Lends each running item of an executor one of `count` scratch slots. Lock-free as long as the executor keeps to its
// concurrency(); an executor that runs more items at a time makes the surplus wait, and the result stays the same.
class slot_pool {
public:
    // Slots at the most; what runs beyond waits.
    static constexpr int max_slots = 1024;

    // Slots worth having for an executor's concurrency() and a number of items.
    [[nodiscard]] static constexpr int slots(int concurrency, std::size_t items) {
        int count = concurrency < 1 ? 1 : concurrency;
        if (items < std::size_t(count)) count = items < 1 ? 1 : int(items);
        return count < max_slots ? count : max_slots;
    }

    // count: 1 to max_slots
    explicit slot_pool(int count) : count_(count) { BUMPSHADOW_ASSERT(count >= 1 && count <= max_slots); }

    // Holds a slot for as long as it lives.
    class lease {
    public:
        lease(const lease&) = delete;
        lease& operator=(const lease&) = delete;
        ~lease() { pool_.give_back(index_); }
        // Which slot: 0 to count - 1.
        [[nodiscard]] int index() const { return index_; }

    private:
        friend class slot_pool;
        lease(slot_pool& pool, int index) : pool_(pool), index_(index) {}

        slot_pool& pool_;
        int index_;
    };

    // Takes a free slot, and waits where there is none.
    [[nodiscard]] lease acquire() {
        for (;;) {
            for (int word = 0; word * 64 < count_; ++word) {
                const int bits = count_ - word * 64;
                const std::uint64_t all = bits >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
                std::uint64_t taken = taken_[std::size_t(word)].load(std::memory_order_relaxed);
                while ((taken & all) != all) {
                    const int bit = std::countr_one(taken);
                    if (taken_[std::size_t(word)].compare_exchange_weak(taken, taken | std::uint64_t{1} << bit,
                                                                        std::memory_order_acquire,
                                                                        std::memory_order_relaxed))
                        return lease(*this, word * 64 + bit);
                }
            }
            std::this_thread::yield();
        }
    }

private:
    void give_back(int index) {
        taken_[std::size_t(index / 64)].fetch_and(~(std::uint64_t{1} << (index % 64)), std::memory_order_release);
    }

    std::array<std::atomic<std::uint64_t>, max_slots / 64> taken_{};
    int count_;
};

}  // namespace bumpshadow
