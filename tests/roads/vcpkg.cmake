# The overlay port without vcpkg: its manifest, and its portfile run with stand-ins for what vcpkg gives it.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
set(port_folder "${SOURCE}/cmake/vcpkg/bumpshadow")

# ---- The manifest, as vcpkg's documentation of vcpkg.json has it ----

file(READ "${port_folder}/vcpkg.json" manifest)
foreach(key name version-semver license description)
    string(JSON type ERROR_VARIABLE error TYPE "${manifest}" ${key})
    expect("${key} is a string: ${error}" type STREQUAL "STRING")
endforeach()
string(JSON name GET "${manifest}" name)
string(JSON version GET "${manifest}" version-semver)
expect("the name is that of the folder" name STREQUAL "bumpshadow")
expect("the version, ${version}, is that of version.hpp, ${VERSION}" version STREQUAL VERSION)
string(JSON count LENGTH "${manifest}" dependencies)
math(EXPR last "${count} - 1")
set(dependencies)
foreach(i RANGE ${last})
    string(JSON type TYPE "${manifest}" dependencies ${i})
    if(type STREQUAL "OBJECT")
        string(JSON host GET "${manifest}" dependencies ${i} host)
        string(JSON dependency GET "${manifest}" dependencies ${i} name)
        expect("${dependency} is for the host" host)
    else()
        string(JSON dependency GET "${manifest}" dependencies ${i})
    endif()
    list(APPEND dependencies ${dependency})
endforeach()
expect_list("the dependencies" dependencies glm vcpkg-cmake vcpkg-cmake-config)

# ---- Stand-ins for the functions of vcpkg-cmake, vcpkg-cmake-config and vcpkg itself ----

function(vcpkg_cmake_configure)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "SOURCE_PATH" "OPTIONS")
    expect("vcpkg_cmake_configure knows ${arg_UNPARSED_ARGUMENTS}" NOT arg_UNPARSED_ARGUMENTS)
    run_well("vcpkg_cmake_configure" ${CMAKE_COMMAND} -S "${arg_SOURCE_PATH}" -B "${WORK}/build" ${build_arguments}
        -DCMAKE_BUILD_TYPE=Release "-DCMAKE_INSTALL_PREFIX=${CURRENT_PACKAGES_DIR}" ${arg_OPTIONS})
endfunction()

function(vcpkg_cmake_install)
    run_well("vcpkg_cmake_install" ${CMAKE_COMMAND} --build "${WORK}/build" --target install)
endfunction()

# Moves the package's files for CMake to share/PORT, which is one level up, and lets them find the prefix from there.
function(vcpkg_cmake_config_fixup)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "CONFIG_PATH" "")
    set(share "${CURRENT_PACKAGES_DIR}/share/${PORT}")
    file(MAKE_DIRECTORY "${CURRENT_PACKAGES_DIR}/share")
    file(RENAME "${CURRENT_PACKAGES_DIR}/${arg_CONFIG_PATH}" "${share}")
    file(GLOB scripts "${share}/*.cmake")
    set(up "get_filename_component(_IMPORT_PREFIX \"\${_IMPORT_PREFIX}\" PATH)")
    foreach(script IN LISTS scripts)
        file(READ "${script}" text)
        string(REPLACE "${up}\n${up}\n${up}" "${up}\n${up}" text "${text}")
        string(REPLACE "\${CMAKE_CURRENT_LIST_DIR}/../../../" "\${CMAKE_CURRENT_LIST_DIR}/../../" text "${text}")
        file(WRITE "${script}" "${text}")
    endforeach()
endfunction()

function(vcpkg_install_copyright)
    cmake_parse_arguments(PARSE_ARGV 0 arg "" "" "FILE_LIST")
    file(INSTALL ${arg_FILE_LIST} DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}" RENAME copyright)
endfunction()

set(PORT bumpshadow)
set(CURRENT_PORT_DIR "${port_folder}")
set(CURRENT_PACKAGES_DIR "${WORK}/packages")
include("${port_folder}/portfile.cmake")

# ---- What it installed, by vcpkg's own rules for packages, and a consumer that finds it ----

file(GLOB top RELATIVE "${CURRENT_PACKAGES_DIR}" "${CURRENT_PACKAGES_DIR}/*")
expect_list("folders of the package" top include share)
file(GLOB_RECURSE share RELATIVE "${CURRENT_PACKAGES_DIR}/share" "${CURRENT_PACKAGES_DIR}/share/*")
list(SORT share)
set(expected bumpshadowConfig.cmake bumpshadowConfigVersion.cmake bumpshadowShadersTargets.cmake
    bumpshadowTargets.cmake copyright usage)
list(TRANSFORM expected PREPEND bumpshadow/)
expect_list("files of the package" share ${expected})
file(RENAME "${CURRENT_PACKAGES_DIR}" "${WORK}/installed")
expect_same_tree("headers" "${PREFIX}/include" "${WORK}/installed/include")
find_by_consumer("${WORK}/installed")
