# All public headers in pseudo-random orders, the same ones every time: seeds FIRST to LAST.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
file(GLOB_RECURSE headers RELATIVE "${SOURCE}/include" "${SOURCE}/include/*.hpp")
list(REMOVE_ITEM headers bumpshadow/encode/stb_blocks.hpp)  # which needs stb
foreach(seed RANGE ${FIRST} ${LAST})
    set(keyed)
    foreach(header IN LISTS headers)
        string(SHA256 key "${seed} ${header}")
        list(APPEND keyed "${key} ${header}")
    endforeach()
    list(SORT keyed)
    list(TRANSFORM keyed REPLACE "^[^ ]+ (.*)$" "#include <\\1>\n" OUTPUT_VARIABLE includes)
    list(JOIN includes "" text)
    file(WRITE "${WORK}/order_${seed}.cpp" "${text}")
    run_well("the order of seed ${seed}, ${WORK}/order_${seed}.cpp," ${COMPILER} -std=c++20 -Wall -Wextra -Werror
        "-I${SOURCE}/include" ${glm_flags} -fsyntax-only "${WORK}/order_${seed}.cpp")
    message("passed: seed ${seed}")
endforeach()
