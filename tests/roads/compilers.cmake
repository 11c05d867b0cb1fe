# The consumer by each compiler of COMPILERS, as C++20 and C++23 and without exceptions and run-time types. THOROUGH: it
# is linked and run, too, and prints the same.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
set(main "${SOURCE}/tests/consumer/main.cpp")
set(warnings -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Werror)

function(compile compiler)
    set(what "${compiler} ${ARGN}")
    if(THOROUGH)
        run_well("${what}" ${compiler} ${ARGN} ${warnings} "-I${SOURCE}/include" ${glm_flags} -pthread "${main}"
            -o "${WORK}/program")
        run_well("the consumer by ${what}" "${WORK}/program")
        file(READ "${PRINTED}" expected)
        expect("what the consumer by ${what} prints, which was\n${expected}" output STREQUAL expected)
    else()
        run_well("${what}" ${compiler} ${ARGN} ${warnings} "-I${SOURCE}/include" ${glm_flags} -fsyntax-only "${main}")
    endif()
    message("passed: ${what}")
endfunction()

string(REPLACE "|" ";" COMPILERS "${COMPILERS}")
foreach(compiler IN LISTS COMPILERS)
    # Clang counts a signed index of such a vector as a conversion, GCC does not.
    compile(${compiler} -std=c++2b -DGLM_FORCE_SIZE_T_LENGTH)
    compile(${compiler} -std=c++20 -fno-exceptions -fno-rtti)
    if(THOROUGH)
        compile(${compiler} -std=c++20)
    endif()
endforeach()
