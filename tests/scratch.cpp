#include <bumpshadow/scratch.hpp>

#include <atomic>
#include <cstdint>
#include <thread>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/executor.hpp>

#include "support/counting.hpp"

using namespace bumpshadow;

namespace {

bool aligned(const void* p) { return reinterpret_cast<std::uintptr_t>(p) % scratch_alignment == 0; }

}  // namespace

TEST_CASE("a scratch block comes from the resource in one piece and goes back") {
    counting memory;
    bake_options options;
    options.memory = &memory;
    {
        scratch_block block;
        REQUIRE(bool(block.allocate(options, scratch_layout{}.add<float>(3).add<char>(1).bytes(), "test")));
        float* const a = block.carve<float>(3);
        char* const b = block.carve<char>(1);
        CHECK(aligned(a));
        CHECK(aligned(b));
        CHECK(reinterpret_cast<char*>(a + 3) <= b);
        CHECK(memory.out > 0);
    }
    CHECK(memory.calls == 1);
    CHECK(memory.out == 0);
}

TEST_CASE("a scratch block reports that memory ran out") {
    counting memory(0);
    bake_options options;
    options.memory = &memory;
    scratch_block block;
    const status s = block.allocate(options, 101, "test");
    CHECK(s.code() == error::out_of_memory);
    CHECK(s.value() == 101.0);
}

TEST_CASE("a span of the size that the layout reports suffices wherever it starts") {
    std::vector<std::byte> storage(1024);
    const std::size_t bytes = scratch_layout{}.add<double>(5).add<float>(17).bytes();
    for (std::size_t start = 0; start < 64; ++start) {
        bake_options options;
        options.scratch = std::span(storage).subspan(start, bytes);
        scratch_block block;
        REQUIRE(bool(block.allocate(options, bytes, "test")));
        const double* const a = block.carve<double>(5);
        const float* const b = block.carve<float>(17);
        CHECK(aligned(a));
        CHECK(aligned(b));
        CHECK(reinterpret_cast<const std::byte*>(b + 17) <= storage.data() + start + bytes);
    }
    bake_options options;
    options.scratch = std::span(storage).first(bytes - 1);
    scratch_block block;
    CHECK(block.allocate(options, bytes, "test").code() == error::too_small);
}

TEST_CASE("no two running items share a slot, even when more run than there are slots") {
    for (const int count : {1, 3, 70}) {
        slot_pool pool(count);
        std::vector<std::atomic<int>> users(static_cast<std::size_t>(count));
        std::atomic<bool> clash{false};
        threads{8}(2000, [&](std::size_t) {
            const auto lease = pool.acquire();
            if (lease.index() < 0 || lease.index() >= count) clash = true;
            std::atomic<int>& user = users[std::size_t(lease.index())];
            if (user.fetch_add(1) != 0) clash = true;
            std::this_thread::yield();
            user.fetch_sub(1);
        });
        CHECK_FALSE(clash);
    }
}
