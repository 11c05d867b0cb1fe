# What is needed of the packages that are headers alone, taken from the machine that compiles: links to their folders,
# since the folder they stand in, /usr/include, has the C library of that machine, too; and a CMake package for each,
# since their own may refuse another size of pointers. Read by the toolchain files, as often as CMake reads those.
set(packages "${CMAKE_BINARY_DIR}/packages")
set(places /usr/local/include /usr/include /opt/homebrew/include)

# header_package(NAME TARGET FOLDER)
function(header_package name target folder)
    foreach(place ${places})
        if(EXISTS "${place}/${folder}" AND NOT EXISTS "${packages}/include/${folder}")
            file(MAKE_DIRECTORY "${packages}/include")
            file(CREATE_LINK "${place}/${folder}" "${packages}/include/${folder}" SYMBOLIC)
        endif()
    endforeach()
    if(target AND EXISTS "${packages}/include/${folder}")
        file(CONFIGURE OUTPUT "${packages}/lib/cmake/${name}/${name}Config.cmake" CONTENT
"if(NOT TARGET ${target})
    add_library(${target} INTERFACE IMPORTED)
    set_target_properties(${target} PROPERTIES INTERFACE_INCLUDE_DIRECTORIES \"${packages}/include\")
endif()
")
    endif()
endfunction()

get_property(in_try_compile GLOBAL PROPERTY IN_TRY_COMPILE)
if(NOT in_try_compile)
    header_package(glm glm::glm glm)
    header_package(doctest doctest::doctest doctest)
    header_package(CLI11 CLI11::CLI11 CLI)
    header_package(nlohmann_json nlohmann_json::nlohmann_json nlohmann)
    header_package(xsimd xsimd xsimd)
    header_package(stb "" stb)
endif()

list(APPEND CMAKE_FIND_ROOT_PATH "${packages}")
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE ONLY)
