# bumpshadow_options: warnings and instruction set of tests and examples. Never reaches a consumer.
include(CheckCXXCompilerFlag)

add_library(bumpshadow_options INTERFACE)
if(MSVC)
    target_compile_options(bumpshadow_options INTERFACE /W4)
else()
    target_compile_options(bumpshadow_options INTERFACE
        -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion)
    # Wrong about "x" + std::string in GCC 12 and 13 (its bugs 105329 and 105651).
    if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU" AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 14)
        target_compile_options(bumpshadow_options INTERFACE -Wno-restrict)
    endif()
endif()

if(BUMPSHADOW_NATIVE)
    foreach(flag -march=native)
        string(MAKE_C_IDENTIFIER "BUMPSHADOW_HAS${flag}" has_flag)
        check_cxx_compiler_flag(${flag} ${has_flag})
        if(${has_flag})
            target_compile_options(bumpshadow_options INTERFACE ${flag})
        endif()
    endforeach()
endif()
