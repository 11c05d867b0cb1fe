// Memory that runs out at every allocation there is, and scratch that is just enough or one byte too small.

#include <cstddef>
#include <memory_resource>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include <bumpshadow/plan.hpp>

#include "faults/cases.hpp"
#include "support/shapes.hpp"

using namespace faults;
using bumpshadow::error;
using bumpshadow::status;

namespace {

// For as long as it lives, nothing can be had but from a resource that a producer was given.
class no_default {
public:
    no_default() : before_(std::pmr::set_default_resource(std::pmr::null_memory_resource())) {}
    ~no_default() { std::pmr::set_default_resource(before_); }
    no_default(const no_default&) = delete;
    no_default& operator=(const no_default&) = delete;

private:
    std::pmr::memory_resource* before_;
};

// Gives a call no memory, then memory for one allocation, for two, until it does well: how often it did not.
template <class Run>
int failures_before_success(const Run& run) {
    const no_default nothing_else;
    for (int failed = 0;; ++failed) {
        CAPTURE(failed);
        REQUIRE(failed < 10000);
        counting memory(failed);
        const status s = run(memory);
        CHECK(memory.out == 0);
        if (s) return failed;
        CHECK(s.code() == error::out_of_memory);
    }
}

}  // namespace

TEST_CASE("memory that runs out at any allocation is a status; nothing leaks and nothing is written") {
    const any_executor execute;
    for (const producer& p : all_producers()) {
        CAPTURE(p.name);
        const int failed = failures_before_success([&](counting& memory) {
            outputs out = p.blank;
            const status s = p.run(out, {.memory = &memory}, execute);
            if (!s) {
                CHECK(s.value() > 0.0);
                CHECK(out == p.blank);
            }
            return s;
        });
        // One block up front, as scratch.hpp says.
        CHECK(failed == (p.memory ? 1 : 0));
    }
}

// It takes memory again and again: of each call that it makes, one after the other.
TEST_CASE("a plan whose memory runs out at any allocation is a status; nothing leaks and the recipe stays") {
    const glm::ivec2 extent(24, 20);
    shapes::noise random(5);
    const auto field =
        shapes::sampled<float>(extent, [&](double x, double) { return (x > 9.0 ? 3.0 : 0.0) + random.uniform(); });
    const int failed = failures_before_success([&](counting& memory) {
        bumpshadow::recipe recipe;
        recipe.steps = 777;
        const status s = bumpshadow::plan(field.view(), bumpshadow::scene{}, recipe, {.memory = &memory});
        CHECK((recipe.steps == 777) == !s);
        if (!s) CHECK(recipe.lines == 0);
        return s;
    });
    MESSAGE(failed, " allocations");
    CHECK(failed > 0);
}

TEST_CASE("scratch of the stated size is enough, and one byte less is refused by name; nothing is written") {
    const any_executor execute;
    for (const producer& p : all_producers()) {
        if (p.scratch == 0) continue;
        CAPTURE(p.name);
        counting memory;
        outputs expected = p.blank;
        REQUIRE(bool(p.run(expected, {.memory = &memory}, execute)));
        CHECK_FALSE(expected == p.blank);

        const no_default nothing_else;
        std::vector<std::byte> storage(p.scratch + 1, std::byte(0xff));
        const auto with = [&](std::span<std::byte> scratch, const outputs& result) {
            outputs out = p.blank;
            const status s = p.run(out, {.scratch = scratch}, execute);
            CHECK(out == result);
            return s;
        };
        for (const std::size_t start : {0u, 1u}) {
            const status s = with(std::span(storage).subspan(start, p.scratch), expected);
            CHECK_MESSAGE(bool(s), s.message().c_str());
        }
        const status least = with(std::span(storage).first(1), p.blank);
        CHECK(least.code() == error::too_small);
        // Some sizes are stated for the worst of several calls.
        const auto needed = std::size_t(least.limit());
        REQUIRE(needed > 1);
        CHECK(needed <= p.scratch);
        CHECK(bool(with(std::span(storage).first(needed), expected)));
        const status s = with(std::span(storage).first(needed - 1), p.blank);
        CHECK(s.code() == error::too_small);
        CHECK(std::string(s.argument()) == "options.scratch");
        CHECK(s.value() == double(needed - 1));
        CHECK(s.limit() == double(needed));
    }
}
