# What a project that is added must not do to the one that adds it.

macro(note_what_is_there)
    get_cmake_property(variables_before VARIABLES)
    foreach(variable IN LISTS variables_before)
        set(before_${variable} "${${variable}}")
    endforeach()
endmacro()

# look_for_leaks(FOLDER): of the project that was added since.
macro(look_for_leaks folder)
    get_cmake_property(variables_after VARIABLES)
    foreach(variable IN LISTS variables_after)
        # Its own, those of what it needs, and those that every add_subdirectory, loop or FetchContent sets.
        if(variable MATCHES "^_?(BUMPSHADOW|bumpshadow|glm|Threads|THREADS|CMAKE_THREAD|CMAKE_HAVE|CMAKE_HP|CMAKE_USE|CMAKE_MATCH|CMAKE_PROJECT_VERSION|FIND_PACKAGE)(_|$)"
           OR variable MATCHES "^(before_|FETCHCONTENT|FetchContent|_FetchContent|CMAKE_CURRENT_|ARG[CNV]|_?__|_ARG|GIT_|Git_)"
           OR variable MATCHES "^(variables_before|variables_after|variable|folder|CMAKE_REQUIRED_QUIET)$")
            continue()
        endif()
        if(NOT variable IN_LIST variables_before)
            message(SEND_ERROR "The variable ${variable} leaks: ${${variable}}")
        elseif(NOT "${before_${variable}}" STREQUAL "${${variable}}")
            message(SEND_ERROR "The variable ${variable} was \"${before_${variable}}\", now \"${${variable}}\".")
        endif()
    endforeach()

    get_property(made DIRECTORY "${folder}" PROPERTY BUILDSYSTEM_TARGETS)
    get_property(tests DIRECTORY "${folder}" PROPERTY TESTS)
    get_property(folders DIRECTORY "${folder}" PROPERTY SUBDIRECTORIES)
    list(REMOVE_ITEM made bumpshadow bumpshadow_shaders)
    if(made OR tests OR folders)
        message(SEND_ERROR "Leaks: targets ${made}, tests ${tests}, folders ${folders}.")
    endif()
    foreach(property COMPILE_OPTIONS COMPILE_DEFINITIONS LINK_OPTIONS PRECOMPILE_HEADERS SOURCES)
        get_property(value TARGET bumpshadow PROPERTY INTERFACE_${property})
        if(value)
            message(SEND_ERROR "${property} leaks: ${value}")
        endif()
    endforeach()
    if(EXISTS "${CMAKE_BINARY_DIR}/CPackConfig.cmake")
        message(SEND_ERROR "CPack leaks.")
    endif()
endmacro()
