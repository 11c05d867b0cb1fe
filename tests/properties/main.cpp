// Looks for heights, directions and options that break what has to hold for all of them, and shrinks what it finds.
// RC_PARAMS in the environment sets how many cases are tried and the seed, which is printed. Exit code 1 where
// something did not hold.

#include <cstdio>

#include "properties/maps.hpp"

int main() {
    using namespace properties;
    int broken = 0;
    for (bool (*const check)() : {check_heights, check_symmetry, check_regions, check_steps}) {
        broken += check() ? 0 : 1;
        std::fflush(stdout);
    }
    return broken == 0 ? 0 : 1;
}
