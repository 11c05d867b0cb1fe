# Installs the package as the README says, for the other scripts, and looks at what is there.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")

run_well("configuring" ${CMAKE_COMMAND} -S "${SOURCE}" -B "${WORK}/build" ${build_arguments}
    -DBUMPSHADOW_BUILD_TESTS=OFF -DBUMPSHADOW_BUILD_EXAMPLES=OFF)
run_well("installing" ${CMAKE_COMMAND} --install "${WORK}/build" --prefix "${PREFIX}")

file(GLOB_RECURSE headers RELATIVE "${SOURCE}/include" "${SOURCE}/include/*")
file(GLOB_RECURSE installed RELATIVE "${PREFIX}" "${PREFIX}/*")
list(TRANSFORM headers PREPEND include/)
set(others share/cmake/bumpshadow/bumpshadowConfig.cmake share/cmake/bumpshadow/bumpshadowConfigVersion.cmake
    share/cmake/bumpshadow/bumpshadowShadersTargets.cmake share/cmake/bumpshadow/bumpshadowTargets.cmake
    share/doc/bumpshadow/LICENSE share/pkgconfig/bumpshadow.pc)
list(SORT installed)
set(expected ${headers} ${others})
list(SORT expected)
expect_list("what is installed" installed ${expected})

# Nothing that is installed knows where it was made or first lay.
foreach(file IN LISTS others)
    file(READ "${PREFIX}/${file}" text)
    foreach(folder "${SOURCE}" "${WORK}" "${PREFIX}")
        string(FIND "${text}" "${folder}" at)
        expect("${file} names ${folder}" at EQUAL -1)
    endforeach()
endforeach()
