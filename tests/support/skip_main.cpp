#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include "support/skip.hpp"

int main(int argc, char** argv) {
    const int result = doctest::Context(argc, argv).run();
    return result == 0 && skip::any() ? skip::exit_code : result;
}
