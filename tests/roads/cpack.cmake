# The packages that CPack makes: the source as an archive, and a .deb.
include("${CMAKE_CURRENT_LIST_DIR}/tools.cmake")
empty_folder("${WORK}")
get_filename_component(bin "${CMAKE_COMMAND}" DIRECTORY)
set(cpack "${bin}/cpack")
set(name bumpshadow-${VERSION})

# pack(ARGUMENT...): in the top folder of a copy, which gets what CPack leaves there, and that is not source.
set(tree "${WORK}/tree")
foreach(part .ci .gitignore .clang-format CMakeLists.txt CMakePresets.json LICENSE README.md cmake examples include tests)
    if(EXISTS "${SOURCE}/${part}")
        file(COPY "${SOURCE}/${part}" DESTINATION "${tree}")
    endif()
endforeach()
run_well("configuring a copy" ${CMAKE_COMMAND} -S "${tree}" -B "${tree}/build/install" ${build_arguments}
    -DBUMPSHADOW_BUILD_TESTS=OFF -DBUMPSHADOW_BUILD_EXAMPLES=OFF)
function(pack)
    run_well("cpack ${ARGN}" "${cpack}" ${ARGN} WORKING_DIRECTORY "${tree}")
endfunction()
if(DPKG_DEB)
    pack(-G DEB --config build/install/CPackConfig.cmake)
endif()
pack(--config build/install/CPackSourceConfig.cmake)

# ---- The source: what is there is what git would take, and the package that it makes is the same ----

file(MAKE_DIRECTORY "${WORK}/unpacked")
file(ARCHIVE_EXTRACT INPUT "${tree}/${name}.tar.gz" DESTINATION "${WORK}/unpacked")
file(GLOB top RELATIVE "${WORK}/unpacked" "${WORK}/unpacked/*")
expect("the archive has one folder: ${top}" top STREQUAL name)
file(GLOB top RELATIVE "${WORK}/unpacked/${name}" "${WORK}/unpacked/${name}/*")
list(FILTER top EXCLUDE REGEX "^\\.")
list(SORT top)
expect_list("top level of the archive" top
    CMakeLists.txt CMakePresets.json LICENSE README.md cmake examples include tests)
foreach(folder cmake examples include tests)
    expect_same_tree("${folder} of the archive" "${SOURCE}/${folder}" "${WORK}/unpacked/${name}/${folder}")
endforeach()
run_well("configuring the unpacked source" ${CMAKE_COMMAND} -S "${WORK}/unpacked/${name}" -B "${WORK}/build"
    ${build_arguments} -DBUMPSHADOW_BUILD_TESTS=OFF -DBUMPSHADOW_BUILD_EXAMPLES=OFF)
run_well("installing the unpacked source" ${CMAKE_COMMAND} --install "${WORK}/build" --prefix "${WORK}/prefix")
expect_same_tree("what the unpacked source installs" "${PREFIX}" "${WORK}/prefix")
find_by_consumer("${WORK}/prefix")

# ---- The .deb ----

if(NOT DPKG_DEB)
    message("left out: the .deb, as there is no dpkg-deb here")
    return()
endif()
set(package "${tree}/libbumpshadow-dev_${VERSION}_all.deb")
foreach(field "Package=libbumpshadow-dev" "Version=${VERSION}" "Architecture=all" "Section=libdevel" "Priority=optional"
    "Depends=libglm-dev (>= 0.9.9.8)")
    string(REGEX MATCH "^[^=]*" key "${field}")
    run_well("dpkg-deb --field" ${DPKG_DEB} --field "${package}" ${key})
    expect("${field}" "${key}=${output}" STREQUAL "${field}\n")
endforeach()
run_well("dpkg-deb --field" ${DPKG_DEB} --field "${package}" Maintainer Description)
expect("someone maintains it, and it is described" output MATCHES "Maintainer: [^\n]+\n.*Description: [^\n]+\n [^\n]+")
run_well("dpkg-deb --contents" ${DPKG_DEB} --contents "${package}")
# Folders drwxr-xr-x, files -rw-r--r--, all of them root's.
string(REGEX REPLACE "(drwxr-xr-x|-rw-r--r--) root/root [^\n]*\n" "" output "${output}")
expect("owners and modes" NOT output)
run_well("dpkg-deb --extract" ${DPKG_DEB} --extract "${package}" "${WORK}/deb")
set(copyright "${WORK}/deb/usr/share/doc/libbumpshadow-dev")
expect("its license lies where Debian looks" EXISTS "${copyright}/copyright")
file(REMOVE_RECURSE "${copyright}")
expect_same_tree("what the .deb installs" "${PREFIX}" "${WORK}/deb/usr")
find_by_consumer("${WORK}/deb/usr")
