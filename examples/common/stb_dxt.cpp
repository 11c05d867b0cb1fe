// The one place where stb_dxt is compiled.
#define STB_DXT_IMPLEMENTATION
#include <bumpshadow/encode/stb_blocks.hpp>
