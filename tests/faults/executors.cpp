// Executors that do what they should not, as bumpshadow/executor.hpp says what comes of it.

#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <vector>

#include <doctest/doctest.h>

#include "faults/cases.hpp"
#include "support/shapes.hpp"

using namespace faults;
using bumpshadow::status;

namespace {

outputs made_by(const producer& p, const any_executor& execute) {
    counting memory;
    outputs out = p.blank;
    const status s = p.run(out, {.memory = &memory}, execute);
    CHECK_MESSAGE(bool(s), s.message().c_str());
    CHECK(memory.out == 0);
    return out;
}

any_executor running(std::function<void(std::size_t, const any_executor::item&)> run, int width = usual_width) {
    return {width, std::move(run)};
}

const any_executor last_first = running([](std::size_t count, const any_executor::item& body) {
    for (std::size_t i = count; i-- > 0;) body(i);
});
const any_executor shuffled = running([](std::size_t count, const any_executor::item& body) {
    std::vector<std::size_t> order(count);
    std::iota(order.begin(), order.end(), std::size_t{0});
    shapes::noise random(count);
    for (std::size_t i = count; i > 1; --i) std::swap(order[i - 1], order[std::size_t(random.between(0, int(i) - 1))]);
    for (const std::size_t i : order) body(i);
});
const any_executor three_at_a_time =
    running([](std::size_t count, const any_executor::item& body) { bumpshadow::threads{3}(count, body); });
const any_executor more_than_it_says =
    running([](std::size_t count, const any_executor::item& body) { bumpshadow::threads{8}(count, body); }, 1);
const any_executor of_no_width = running(any_executor{}.run, 0);

const any_executor each_twice = running([](std::size_t count, const any_executor::item& body) {
    for (std::size_t i = 0; i < count; ++i) body(i), body(i);
});
const any_executor all_twice = running([](std::size_t count, const any_executor::item& body) {
    for (std::size_t i = 0; i < 2 * count; ++i) body(i % count);
});

}  // namespace

TEST_CASE("the order of items, and how many run at a time, change no bit of any output") {
    for (const producer& p : all_producers()) {
        CAPTURE(p.name);
        const outputs expected = made_by(p, any_executor{});
        for (const any_executor* execute : {&last_first, &shuffled, &three_at_a_time, &more_than_it_says, &of_no_width})
            CHECK(made_by(p, *execute) == expected);
    }
}

TEST_CASE("items that are run again change nothing, but for mips that keep distributions") {
    for (const producer& p : all_producers()) {
        CAPTURE(p.name);
        const outputs expected = made_by(p, any_executor{});
        for (const any_executor* execute : {&each_twice, &all_twice}) {
            const outputs found = made_by(p, *execute);
            if (p.again) CHECK(found == expected);
        }
    }
}

TEST_CASE("an executor that runs nothing leaves outputs as they were") {
    const any_executor idle = running([](std::size_t, const any_executor::item&) {});
    for (const producer& p : all_producers()) {
        CAPTURE(p.name);
        const outputs found = made_by(p, idle);
        if (p.by_items) CHECK(found == p.blank);
    }
}

#if defined(__cpp_exceptions)

TEST_CASE("an exception of an executor passes through, and scratch goes back") {
    for (const producer& p : all_producers()) {
        CAPTURE(p.name);
        const outputs expected = made_by(p, any_executor{});
        bool thrown = true;
        // Before the first item, then after each of them, counted over all calls of the executor.
        for (std::size_t last = 0; thrown && last < 400; last += last < 4 ? 1 : last / 2) {
            std::size_t done = 0;
            const any_executor throws = running([&](std::size_t count, const any_executor::item& body) {
                for (std::size_t i = 0; i < count; ++i) {
                    if (done++ == last) throw std::runtime_error("executor");
                    body(i);
                }
            });
            counting memory;
            outputs out = p.blank;
            thrown = false;
            try {
                const status s = p.run(out, {.memory = &memory}, throws);
                CHECK(bool(s));
            } catch (const std::runtime_error&) {
                thrown = true;
            }
            CHECK(memory.out == 0);
            if (!thrown) CHECK(out == expected);
        }
        CHECK(made_by(p, any_executor{}) == expected);
    }
}

#endif
