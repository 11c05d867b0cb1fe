# The consumer with GLM configured in other ways: no warning, and the same numbers. All of them that go together, and
# THOROUGH each by itself.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
file(READ "${PRINTED}" expected)

function(compile)
    set(definitions ${ARGN})
    list(TRANSFORM definitions PREPEND -DGLM_FORCE_)
    run_well("compiling with ${definitions}" ${COMPILER} -std=c++20 -Wall -Wextra -Wpedantic -Wconversion -Wshadow
        -Wdouble-promotion -Werror ${definitions}
        "-I${SOURCE}/include" ${glm_flags} -pthread "${SOURCE}/tests/consumer/main.cpp" -o "${WORK}/program")
    run_well("the consumer with ${definitions}" "${WORK}/program")
    expect("what the consumer prints with ${definitions}, which was\n${expected}" output STREQUAL expected)
    message("passed: ${definitions}")
endfunction()

compile(DEPTH_ZERO_TO_ONE LEFT_HANDED DEFAULT_ALIGNED_GENTYPES INTRINSICS EXPLICIT_CTOR INLINE SIZE_T_LENGTH
    UNRESTRICTED_GENTYPE SINGLE_ONLY SWIZZLE)
if(THOROUGH)
    foreach(macro DEPTH_ZERO_TO_ONE LEFT_HANDED DEFAULT_ALIGNED_GENTYPES INTRINSICS EXPLICIT_CTOR INLINE PURE
        SIZE_T_LENGTH UNRESTRICTED_GENTYPE CTOR_INIT SINGLE_ONLY XYZW_ONLY SWIZZLE PRECISION_MEDIUMP_FLOAT)
        compile(${macro})
    endforeach()
    compile(SWIZZLE INTRINSICS)
    compile(CTOR_INIT DEFAULT_ALIGNED_GENTYPES)
endif()
