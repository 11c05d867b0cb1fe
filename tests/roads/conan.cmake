# The Conan recipe without Conan: its methods, run by conan_recipe.py, install what the others do.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
run_well("the recipe" ${PYTHON} "${CMAKE_CURRENT_LIST_DIR}/conan_recipe.py" "${SOURCE}/cmake/conan/conanfile.py"
    "${WORK}" "${VERSION}" ${CMAKE_COMMAND} ${build_arguments})
set(package "${WORK}/package")
expect("the license lies where Conan looks" EXISTS "${package}/licenses/LICENSE")
file(REMOVE_RECURSE "${package}/licenses")
file(COPY "${PREFIX}/" DESTINATION "${WORK}/expected")
file(REMOVE_RECURSE "${WORK}/expected/share/doc")
expect_same_tree("what Conan installs" "${WORK}/expected" "${package}")
find_by_consumer("${package}")
