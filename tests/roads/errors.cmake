# What cannot work says so in one sentence, first and (with the stop that follows it) alone.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
set(include "${SOURCE}/include")
set(umbrella bumpshadow/bumpshadow.hpp)

# refused(SENTENCE HEADER FLAG...): the compiler's first error.
function(refused sentence header)
    file(WRITE "${WORK}/main.cpp" "#include <${header}>\n")
    run(${COMPILER} "-I${include}" ${ARGN} ${glm_flags} -fsyntax-only "${WORK}/main.cpp")
    string(REGEX MATCHALL "error: [^\n]*" errors "${output}")
    list(LENGTH errors count)
    expect("${header} with ${ARGN}: \"${sentence}\"" count EQUAL 2)
    list(GET errors 0 first)
    string(FIND "${first}" "${sentence}" at)
    expect("${header} with ${ARGN} says first: \"${sentence}\"" NOT at EQUAL -1)
endfunction()

# ---- A standard or a compiler that is too old ----

set(headers ${umbrella} bumpshadow/status.hpp bumpshadow/executor.hpp bumpshadow/encode/bc1.hpp
    bumpshadow/shader/shader.hpp bumpshadow/shader/snippets.hpp)
if(THOROUGH)
    file(GLOB_RECURSE headers RELATIVE "${include}" "${include}/*.hpp")
    list(REMOVE_ITEM headers bumpshadow/version.hpp)  # three macros, for everyone
    list(REMOVE_ITEM headers bumpshadow/encode/stb_blocks.hpp)  # which needs stb
endif()
foreach(header IN LISTS headers)
    refused("bumpshadow needs C++20: compile with -std=c++20 or /std:c++20" ${header} -std=c++17)
endforeach()
# What a compiler that is not here would say, and its version as its number.
file(WRITE "${WORK}/version.cpp" "__clang_major__\n")
run_well("the compiler's number" ${COMPILER} -E -P "${WORK}/version.cpp")
if(output MATCHES "__clang_major__")
    refused("bumpshadow needs GCC 11 or newer" ${umbrella} -std=c++20 -U__GNUC__ -D__GNUC__=10)
else()
    refused("bumpshadow needs Clang 13 or newer" ${umbrella} -std=c++20 -U__clang_major__ -D__clang_major__=12)
endif()
refused("bumpshadow needs GLM without GLM_FORCE_CTOR_INIT where GLM uses SIMD" ${umbrella}
    -std=c++20 -DGLM_FORCE_CTOR_INIT -DGLM_FORCE_INTRINSICS)

# ---- GLM ----

# No headers but ours, and one that config.hpp asks for.
file(WRITE "${WORK}/nothing/version" "")
set(found ${glm_flags})
set(glm_flags)
refused("bumpshadow needs GLM 0.9.9.8 or newer: install it (Debian, Ubuntu: libglm-dev) or add its folder with -I"
    ${umbrella} -std=c++20 -nostdinc "-I${WORK}/nothing" "-DBUMPSHADOW_ASSERT(c)=")
set(glm_flags ${found})
# The one that is here, which says that it is the one before the oldest.
string(REPLACE "|" ";" folders "${GLM_INCLUDE}")
foreach(folder IN LISTS folders ITEMS /usr/include /usr/local/include /opt/homebrew/include)
    if(NOT glm AND EXISTS "${folder}/glm/detail/setup.hpp")
        set(glm "${folder}/glm")
    endif()
endforeach()
file(COPY "${glm}" DESTINATION "${WORK}/old_glm")
set(setup "${WORK}/old_glm/glm/detail/setup.hpp")
file(READ "${setup}" text)
string(REGEX REPLACE "(define GLM_VERSION[ \t]+)[^\n]*" "\\1997" text "${text}")
file(WRITE "${setup}" "${text}")
foreach(header IN LISTS headers)
    file(WRITE "${WORK}/main.cpp" "#include <${header}>\n")
    run_well("what ${header} includes" ${COMPILER} "-I${include}" ${glm_flags} -std=c++20 -M "${WORK}/main.cpp")
    if(output MATCHES "/glm/detail/")
        refused("bumpshadow needs GLM 0.9.9.8 or newer: install a newer one" ${header} -std=c++20 "-I${WORK}/old_glm")
    endif()
endforeach()

# ---- CMake ----

# cmake_refuses(WHAT SENTENCE ARGUMENT...)
function(cmake_refuses what sentence)
    empty_folder("${WORK}/build")
    run(${CMAKE_COMMAND} -B "${WORK}/build" ${build_arguments} -DBUMPSHADOW_BUILD_EXAMPLES=OFF ${ARGN})
    string(REGEX REPLACE "[ \n]+" " " output "${output}")
    string(FIND "${output}" "${sentence}" at)
    expect("${what}: \"${sentence}\"" NOT code EQUAL 0 AND NOT at EQUAL -1)
endfunction()

cmake_refuses("no GLM" "bumpshadow needs GLM 0.9.9.8 or newer: install it (Debian, Ubuntu: libglm-dev"
    -S "${SOURCE}" -DCMAKE_DISABLE_FIND_PACKAGE_glm=ON)
file(WRITE "${WORK}/old_package/glmConfig.cmake" "add_library(glm::glm INTERFACE IMPORTED)\n")
file(WRITE "${WORK}/old_package/glmConfigVersion.cmake" "set(PACKAGE_VERSION 0.9.9.7)\n")
cmake_refuses("an old GLM" "or set glm_DIR to the folder of its glmConfig.cmake. ${WORK}/old_package has 0.9.9.7."
    -S "${SOURCE}" "-Dglm_DIR=${WORK}/old_package")
cmake_refuses("an old GLM of a consumer" "bumpshadow needs GLM 0.9.9.8 or newer: install it" -S "${SOURCE}/tests/consumer"
    "-DCMAKE_PREFIX_PATH=${PREFIX}" "-Dglm_DIR=${WORK}/old_package")
file(WRITE "${WORK}/own_glm/CMakeLists.txt" "cmake_minimum_required(VERSION 3.20)
project(own_glm LANGUAGES CXX)
add_library(own_glm INTERFACE)
add_library(glm::glm ALIAS own_glm)
set(BUMPSHADOW_INSTALL ON)
add_subdirectory(\"${SOURCE}\" bumpshadow)\n")
cmake_refuses("a package that needs a GLM of the same build" "BUMPSHADOW_INSTALL=ON needs an installed GLM"
    -S "${WORK}/own_glm")
cmake_refuses("an unknown choice" "BUMPSHADOW_SIMD is \"fast\" but has to be none, vector, xsimd or empty"
    -S "${SOURCE}" -DBUMPSHADOW_SIMD=fast -DBUMPSHADOW_BUILD_TESTS=OFF)
cmake_refuses("no doctest" "The tests need doctest: install it" -S "${SOURCE}" -DCMAKE_DISABLE_FIND_PACKAGE_doctest=ON)
# CMake's own sentence; no newer CMake than any is here, so that one is asked for.
file(READ "${SOURCE}/CMakeLists.txt" text)
string(REGEX REPLACE "^cmake_minimum_required\\(VERSION 3\\.20\\.\\.\\." "cmake_minimum_required(VERSION 99.0..." newer
    "${text}")
expect("the project asks for CMake 3.20 in its first line" NOT newer STREQUAL text)
string(REGEX REPLACE "\\.\\.\\.3\\.31\\)" ")" newer "${newer}")
file(WRITE "${WORK}/newer/CMakeLists.txt" "${newer}")
cmake_refuses("an old CMake" "CMake 99.0 or higher is required. You are running version" -S "${WORK}/newer")
