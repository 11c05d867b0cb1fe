#include "everything.hpp"

using check_output = bumpshadow::status (*)(const bumpshadow::horizon_map&, glm::ivec2, std::size_t);

check_output second_check_output();
const float* second_no_horizon();

// Both translation units have to see the same function and the same constant.
int main() {
    const check_output first = &bumpshadow::check_output;
    return first == second_check_output() && &bumpshadow::no_horizon == second_no_horizon() ? 0 : 1;
}
