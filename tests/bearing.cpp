#include <bumpshadow/bearing.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace bumpshadow;

namespace {

// Every function under one roof: calls check(name, bearing, direction, stated maximum error in degrees).
template <class T, class Check>
void for_each_function(const Check& check) {
    using vec = glm::vec<2, T>;
    check(
        "exact", [](vec v) { return exact_bearing(v); }, [](T b) { return exact_direction(b); }, 0.0);
    check(
        "octant", [](vec v) { return octant_bearing(v); }, [](T b) { return octant_direction(b); }, octant_max_error);
    check(
        "diamond", [](vec v) { return diamond_bearing(v); }, [](T b) { return diamond_direction(b); },
        diamond_max_error);
    check(
        "cubic", [](vec v) { return cubic_bearing(v); }, [](T b) { return cubic_direction(b); }, cubic_max_error);
    check(
        "quintic", [](vec v) { return quintic_bearing(v); }, [](T b) { return quintic_direction(b); },
        quintic_max_error);
}

template <class T>
constexpr T tiny = std::numeric_limits<T>::denorm_min();
template <class T>
constexpr T huge = std::numeric_limits<T>::max();

glm::dvec2 at_angle(double turns) {
    const double angle = turns * 2.0 * std::numbers::pi;
    return {std::cos(angle), std::sin(angle)};
}

// Distance on the circle of one turn.
double apart(double a, double b) {
    const double d = std::abs(a - b);
    return d < 0.5 ? d : 1.0 - d;
}

// The published listing, word for word, with its vector as an argument.
float published_listing(glm::vec2 vec) {
    float angle;
    if (vec.x >= vec.y) {
        if (vec.x >= -vec.y) {
            angle = vec.y * (0.25f / 1.414f) + 0.75f + (0.707f * (0.25f / 1.414f));
        } else {
            angle = vec.x * (0.25f / 1.414f) + 0.5f + (0.707f * (0.25f / 1.414f));
        }
    } else {
        if (vec.x >= -vec.y) {
            angle = vec.x * (-0.25f / 1.414f) + 0.0f + (-0.707f * (-0.25f / 1.414f));
        } else {
            angle = vec.y * (-0.25f / 1.414f) + 0.25f + (-0.707f * (-0.25f / 1.414f));
        }
    }
    return angle;
}

}  // namespace

TEST_CASE_TEMPLATE("bearings at multiples of an eighth are exact, and so are their directions", T, float, double) {
    const glm::vec<2, T> corners[8] = {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}};
    for_each_function<T>([&](const std::string& name, auto bearing, auto direction, double) {
        CAPTURE(name);
        for (int i = 0; i < 8; ++i) {
            CAPTURE(i);
            const T turns = T(i) / T(8);
            CHECK(apart(double(bearing(corners[i])), double(turns)) <= std::numeric_limits<T>::epsilon() / 2);
            const glm::vec<2, T> d = direction(turns);
            const T side = i % 2 == 0 ? T(1) : std::sqrt(T(0.5));
            CHECK(d.x == side * corners[i].x);
            CHECK(d.y == side * corners[i].y);
        }
    });
}

TEST_CASE("each bearing function has the maximum error that it states") {
    for_each_function<double>([](const std::string& name, auto bearing, auto, double stated) {
        CAPTURE(name);
        double worst = 0.0;
        for (int i = 0; i < 100000; ++i) {
            const double turns = double(i) / 100000.0;
            worst = std::fmax(worst, apart(bearing(at_angle(turns)), turns));
        }
        if (stated == 0.0)
            CHECK(worst < 1e-15);
        else
            CHECK(worst * 360.0 == doctest::Approx(stated).epsilon(0.01));
    });
    double worst = 0.0;
    for (int i = 0; i < 100000; ++i) {
        const double turns = double(i) / 100000.0;
        worst = std::fmax(worst, apart(double(exact_bearing(glm::vec2(at_angle(turns)))), turns));
    }
    CHECK(worst < 1.5e-7);
}

TEST_CASE_TEMPLATE("bearings are in [0, 1), continuous and grow with the angle", T, float, double) {
    constexpr int count = 20000;
    const T rounding = std::numeric_limits<T>::epsilon();
    for_each_function<T>([&](const std::string& name, auto bearing, auto, double) {
        CAPTURE(name);
        T last = T(0);
        int falls = 0, jumps = 0, outside = 0;
        for (int i = 0; i < count; ++i) {
            const T b = bearing(glm::vec<2, T>(at_angle(double(i) / count)));
            if (!(b >= T(0) && b < T(1))) ++outside;
            if (b < last - rounding) ++falls;
            if (b > last + T(2.0 / count)) ++jumps;
            last = b;
        }
        CHECK(outside == 0);
        CHECK(falls == 0);
        CHECK(jumps == 0);
        CHECK(last > T(1.0 - 2.0 / count));
    });
}

TEST_CASE_TEMPLATE("a bearing never rounds up to 1", T, float, double) {
    for_each_function<T>([](const std::string& name, auto bearing, auto, double) {
        CAPTURE(name);
        for (T y = T(-1); y != T(0); y *= T(0.5)) {
            const T b = bearing(glm::vec<2, T>(1, y));
            CHECK(b >= T(0));
            CHECK(b < T(1));
            if (y > T(-0.5) && y < T(-1e-30)) CHECK(b > T(0.9));
        }
    });
}

TEST_CASE_TEMPLATE("a bearing does not depend on the length and is defined for every finite vector", T, float, double) {
    for_each_function<T>([](const std::string& name, auto bearing, auto direction, double) {
        CAPTURE(name);
        using vec = glm::vec<2, T>;
        for (const T x : {T(0), -T(0)})
            for (const T y : {T(0), -T(0)}) CHECK(bearing(vec(x, y)) == T(0));
        for (const T scale : {tiny<T>, std::numeric_limits<T>::min(), T(1e-30), T(3), T(1e30), huge<T>}) {
            CAPTURE(scale);
            CHECK(bearing(vec(scale, scale)) == T(0.125));
            CHECK(bearing(vec(scale, T(-0.0))) == T(0));
            CHECK(bearing(vec(T(-0.0), scale)) == T(0.25));
            CHECK(bearing(vec(-scale, T(-0.0))) == T(0.5));
            CHECK(bearing(vec(T(-0.0), -scale)) == T(0.75));
        }
        for (const T scale : {T(1e-30), T(1e30)})
            for (int i = 0; i < 64; ++i) {
                const vec v(at_angle(double(i) / 64.0));
                CHECK(apart(double(bearing(v)), double(bearing(v * scale))) <= 2 * std::numeric_limits<T>::epsilon());
            }
        for (const T b : {T(-0.0), -tiny<T>, T(-3.25), T(7.125)}) {
            const vec d = direction(b);
            CHECK(d.x * d.x + d.y * d.y == doctest::Approx(1.0));
        }
    });
}

TEST_CASE_TEMPLATE("the inverses return the unit vector of a bearing", T, float, double) {
    const double rounding = 4.0 * double(std::numeric_limits<T>::epsilon());
    for_each_function<T>([&](const std::string& name, auto bearing, auto direction, double) {
        CAPTURE(name);
        double worst_bearing = 0.0, worst_length = 0.0;
        for (int i = 0; i < 20011; ++i) {
            const T b = T(i) / T(20011);
            const glm::vec<2, T> d = direction(b);
            worst_bearing = std::fmax(worst_bearing, apart(double(bearing(d)), double(b)));
            worst_length = std::fmax(worst_length, std::abs(std::hypot(double(d.x), double(d.y)) - 1.0));
        }
        CHECK(worst_bearing <= rounding);
        CHECK(worst_length <= rounding);
    });
}

TEST_CASE("the octant function at its published phase is the published listing") {
    for (int i = 0; i < 3600; ++i) {
        const glm::vec2 v(at_angle(double(i) / 3600.0));
        const float expected = published_listing(v);
        // The listing's rounded constants are off by up to 1.6e-4.
        CHECK(apart(double(octant_bearing(v, float(octant_published_phase))), double(expected)) < 2e-4);
    }
    CHECK(published_listing({0.7071f, 0.7071f}) > 1.0f);
    CHECK(octant_bearing(glm::vec2(0.7071f, 0.7071f), float(octant_published_phase)) == 0.0f);
    CHECK(octant_bearing(glm::vec2(5.0f, 0.0f), float(octant_published_phase)) == 0.875f);
    const glm::dvec2 d = octant_direction(0.5, octant_published_phase);
    CHECK(d.x == -std::sqrt(0.5));
    CHECK(d.y == -std::sqrt(0.5));
}

TEST_CASE("the octant function moves the slices between the eighths") {
    // Unit vector at 22.5 degrees: sin(22.5) * sqrt(2) / 8 of a turn is 24.35 degrees; 1/16 turn has sin = sqrt(2) / 4.
    CHECK(octant_bearing(at_angle(1.0 / 16.0)) * 360.0 == doctest::Approx(24.354).epsilon(1e-4));
    CHECK(octant_direction(1.0 / 16.0).y == doctest::Approx(std::sqrt(2.0) / 4.0));
}

TEST_CASE("unit vectors of directions of any length") {
    constexpr double most = std::numeric_limits<double>::max(), least = std::numeric_limits<double>::denorm_min();
    for (const double length : {most, 1e308, 1e160, 1.0, 1e-160, 1e-308, least}) {
        CAPTURE(length);
        for (const glm::dvec2 d : {glm::dvec2(1.0, 0.0), {0.0, -1.0}, {-1.0, 1.0}, {1.0, 1.0}}) {
            const glm::dvec2 unit = unit_direction(length * d), expected = d / std::hypot(d.x, d.y);
            CHECK(std::abs(unit.x - expected.x) <= 1e-15);
            CHECK(std::abs(unit.y - expected.y) <= 1e-15);
        }
    }
    const glm::dvec2 unit = unit_direction({3e307, -4e307});
    CHECK(std::abs(unit.x - 0.6) <= 1e-15);
    CHECK(std::abs(unit.y + 0.8) <= 1e-15);
}

TEST_CASE("directions of slices are exact mirror images of each other") {
    const auto octant = [](double b) { return octant_direction(b); };
    for (const int n : {1, 2, 3, 5, 7, 8, 12, 16, 20, 24, 49, 96})
        for (const bool half : {false, true})
            for (const bool true_angles : {true, false}) {
                CAPTURE(n);
                CAPTURE(half);
                const double phase = half ? 0.5 / n : 0.0;
                std::vector<glm::dvec2> d(static_cast<std::size_t>(n));
                if (true_angles)
                    fill_directions(d, phase);
                else
                    fill_directions(d, phase, octant);
                const auto at = [&](int i) { return d[std::size_t(((i % n) + n) % n)]; };
                for (int i = 0; i < n; ++i) {
                    const double b = phase + double(i) / n;
                    const glm::dvec2 expected = true_angles ? at_angle(b) : octant_direction(b);
                    CHECK(std::abs(at(i).x - expected.x) < 1e-14);
                    CHECK(std::abs(at(i).y - expected.y) < 1e-14);
                    const glm::dvec2 across_x = at(half ? -1 - i : -i);
                    CHECK(at(i).x == across_x.x);
                    CHECK(at(i).y == -across_x.y);
                    if (n % 4 != 0) continue;
                    const glm::dvec2 turned = at(i + n / 4);
                    CHECK(at(i).x == turned.y);
                    CHECK(at(i).y == -turned.x);
                    const glm::dvec2 across_diagonal = at(n / 4 - i - (half ? 1 : 0));
                    CHECK(at(i).x == across_diagonal.y);
                    CHECK(at(i).y == across_diagonal.x);
                }
            }
}

TEST_CASE("directions at any phase") {
    std::vector<glm::dvec2> d(5);
    fill_directions(d, -1.87);
    for (int i = 0; i < 5; ++i) {
        CHECK(std::abs(d[std::size_t(i)].x - at_angle(0.13 + 0.2 * i).x) < 1e-14);
        CHECK(std::abs(d[std::size_t(i)].y - at_angle(0.13 + 0.2 * i).y) < 1e-14);
    }
    fill_directions(std::span<glm::dvec2>{});
}
