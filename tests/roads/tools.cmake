# What the scripts beside this file have in common. Each is run as cmake -D NAME=VALUE... -P SCRIPT with
#   SOURCE the project, WORK a folder of its own, GENERATOR, COMPILER, GLM_DIR, GLM_INCLUDE; VERSION of
#   the project; PREFIX where the package is installed; PRINTED what the consumer prints; THOROUGH to take longer.
cmake_minimum_required(VERSION 3.20)

# run(COMMAND...): sets `code` and `output` (both streams).
macro(run)
    execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
endmacro()

function(fail text)
    message(FATAL_ERROR "${text}")
endfunction()

# run_well(WHAT COMMAND...): as run(), and the command has to succeed.
macro(run_well what)
    run(${ARGN})
    if(NOT code EQUAL 0)
        fail("${what} failed (${code}):\n${output}")
    endif()
endmacro()

# expect(WHAT CONDITION...), as for if()
macro(expect what)
    if(${ARGN})
    else()
        fail("wrong: ${what}\n${output}")
    endif()
endmacro()

# expect_list(WHAT VARIABLE ITEM...): the list has these items.
function(expect_list what variable)
    if(NOT "${${variable}}" STREQUAL "${ARGN}")
        fail("wrong: ${what}: ${${variable}}\nnot ${ARGN}")
    endif()
endfunction()

function(empty_folder folder)
    file(REMOVE_RECURSE "${folder}")
    file(MAKE_DIRECTORY "${folder}")
endfunction()

# tree(FOLDER OUT): the files of a folder, each with a hash of what is in it.
function(tree folder out)
    file(GLOB_RECURSE files LIST_DIRECTORIES false RELATIVE "${folder}" "${folder}/*")
    list(SORT files)
    set(lines)
    foreach(file IN LISTS files)
        file(SHA256 "${folder}/${file}" hash)
        list(APPEND lines "${file} ${hash}")
    endforeach()
    set(${out} "${lines}" PARENT_SCOPE)
endfunction()

# expect_same_tree(WHAT A B)
function(expect_same_tree what a b)
    tree("${a}" in_a)
    tree("${b}" in_b)
    set(only_a ${in_a})
    set(only_b ${in_b})
    list(LENGTH in_a count)
    list(REMOVE_ITEM only_a ${in_b} none)
    list(REMOVE_ITEM only_b ${in_a} none)
    if(only_a OR only_b OR count LESS 10)
        list(JOIN only_a "\n" only_a)
        list(JOIN only_b "\n" only_b)
        fail("${what}: ${count} files; only in ${a}:\n${only_a}\nonly in ${b}:\n${only_b}")
    endif()
endfunction()

set(build_arguments -G "${GENERATOR}" "-DCMAKE_CXX_COMPILER=${COMPILER}" "-Dglm_DIR=${GLM_DIR}")
string(REPLACE "|" ";" glm_flags "${GLM_INCLUDE}")
list(TRANSFORM glm_flags PREPEND -I)

# build_consumer(FOLDER ARGUMENT...): builds tests/consumer there and runs it; sets `printed` to what it says.
macro(build_consumer folder)
    run_well("configuring a consumer" ${CMAKE_COMMAND} -S "${SOURCE}/tests/consumer" -B "${folder}" ${build_arguments}
        ${ARGN})
    set(configured "${output}")
    run_well("building a consumer" ${CMAKE_COMMAND} --build "${folder}")
    file(GLOB_RECURSE programs "${folder}/consumer" "${folder}/consumer.exe")
    list(FILTER programs EXCLUDE REGEX "/CMakeFiles/")
    run_well("a consumer" ${programs})
    set(printed "${output}")
endmacro()

# find_by_consumer(PREFIX): a consumer is configured with what is installed there; with THOROUGH it is built and run, too.
macro(find_by_consumer prefix)
    file(REMOVE_RECURSE "${WORK}/consumer")
    if(THOROUGH)
        build_consumer("${WORK}/consumer" "-DCMAKE_PREFIX_PATH=${prefix}")
        file(READ "${PRINTED}" expected)
        expect("what the consumer prints, which was\n${expected}" printed STREQUAL expected)
    else()
        run_well("configuring a consumer" ${CMAKE_COMMAND} -S "${SOURCE}/tests/consumer" -B "${WORK}/consumer"
            ${build_arguments} "-DCMAKE_PREFIX_PATH=${prefix}")
    endif()
    file(STRINGS "${WORK}/consumer/CMakeCache.txt" found REGEX "^bumpshadow_DIR:")
    expect("the package that is found, ${found}, lies in ${prefix}" found MATCHES "=${prefix}/")
endmacro()
