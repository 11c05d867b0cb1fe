#include "everything_reversed.hpp"

using check_output = bumpshadow::status (*)(const bumpshadow::horizon_map&, glm::ivec2, std::size_t);

check_output second_check_output() { return &bumpshadow::check_output; }
const float* second_no_horizon() { return &bumpshadow::no_horizon; }
