#include <bumpshadow/measure/time.hpp>

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

// No time is compared with another: how long something takes here is nobody's promise.

TEST_CASE("median") {
    const auto median = [](std::vector<double> values) { return measure_detail::median_of(values); };
    CHECK(median({3.0}) == 3.0);
    CHECK(median({5.0, 1.0}) == 3.0);
    CHECK(median({9.0, 1.0, 2.0}) == 2.0);
    CHECK(median({9.0, 1.0, 2.0, 4.0}) == 3.0);
}

TEST_CASE("a body is run once more than it is timed") {
    for (const int repeats : {1, 2, 7, most_repeats}) {
        int runs = 0;
        const time_figures t = measure_time(repeats, [&] { ++runs; });
        CHECK(runs == repeats + 1);
        CHECK(t.repeats == repeats);
        CHECK(t.least <= t.median);
        CHECK(t.median <= t.most);
        CHECK(t.least >= 0.0);
    }
    int runs = 0;
    CHECK(measure_time(0, [&] { ++runs; }).repeats == 1);
    CHECK(measure_time(-3, [&] { ++runs; }).repeats == 1);
    CHECK(measure_time(most_repeats + 1, [&] { ++runs; }).repeats == most_repeats);
}

TEST_CASE("two bodies take turns") {
    std::string order;
    const time_ratio t = measure_time_ratio(
        3, [&] { order += 'a'; }, [&] { order += 'b'; });
    CHECK(order == "ababbaab");
    CHECK(t.first.repeats == 3);
    CHECK(t.second.repeats == 3);
    CHECK(t.ratio > 0.0);
}
