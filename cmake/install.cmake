# Headers, a CMake package and a file for pkg-config, independent of the architecture: include and share.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_target_property(glm_of_this_build glm::glm ALIASED_TARGET)
if(glm_of_this_build)
    message(FATAL_ERROR "BUMPSHADOW_INSTALL=ON needs an installed GLM, since the package that it makes finds one: "
        "glm::glm is a target of this build. Set it to OFF or install GLM.")
endif()

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/bumpshadow)

install(DIRECTORY include/bumpshadow DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

# ---- CMake ----

install(TARGETS bumpshadow EXPORT bumpshadow INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT bumpshadow NAMESPACE bumpshadow:: FILE bumpshadowTargets.cmake DESTINATION ${package_dir})
# By itself, since whoever wants the shaders alone may not have GLM.
install(TARGETS bumpshadow_shaders EXPORT bumpshadow_shaders INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT bumpshadow_shaders NAMESPACE bumpshadow:: FILE bumpshadowShadersTargets.cmake
    DESTINATION ${package_dir})

set(shader_dir ${CMAKE_INSTALL_INCLUDEDIR}/bumpshadow/shader)
configure_package_config_file(cmake/bumpshadowConfig.cmake.in bumpshadowConfig.cmake
    INSTALL_DESTINATION ${package_dir} PATH_VARS shader_dir
    NO_SET_AND_CHECK_MACRO NO_CHECK_REQUIRED_COMPONENTS_MACRO)
# Before 1.0 a minor version may change the interface.
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
endif()
write_basic_package_version_file(bumpshadowConfigVersion.cmake COMPATIBILITY ${compatibility} ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/bumpshadowConfig.cmake" "${PROJECT_BINARY_DIR}/bumpshadowConfigVersion.cmake"
    DESTINATION ${package_dir})

# ---- pkg-config ----

# From the file itself, so that the folder can be moved.
set(pkgconfig_dir ${CMAKE_INSTALL_DATADIR}/pkgconfig)
file(RELATIVE_PATH prefix_from_pkgconfig "/prefix/${pkgconfig_dir}" "/prefix")
string(REGEX REPLACE "/$" "" prefix_from_pkgconfig "${prefix_from_pkgconfig}")
set(pc_includedir "\${prefix}/${CMAKE_INSTALL_INCLUDEDIR}")
if(IS_ABSOLUTE "${CMAKE_INSTALL_INCLUDEDIR}")
    set(pc_includedir "${CMAKE_INSTALL_INCLUDEDIR}")
endif()
configure_file(cmake/bumpshadow.pc.in bumpshadow.pc @ONLY)
install(FILES "${PROJECT_BINARY_DIR}/bumpshadow.pc" DESTINATION ${pkgconfig_dir})

# ---- Packages: `cpack -G DEB`, and `cpack --config CPackSourceConfig.cmake` for the source ----

if(NOT PROJECT_IS_TOP_LEVEL)
    return()
endif()
set(CPACK_PACKAGE_CONTACT "The bumpshadow authors")  # who publishes: cpack -D "CPACK_PACKAGE_CONTACT=Name <address>"
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "horizon maps from height maps, header-only C++20")
set(CPACK_PACKAGE_DESCRIPTION "${PROJECT_NAME}: bumps that cast shadows on the surface they are drawn on.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_VERBATIM_VARIABLES ON)

set(CPACK_GENERATOR DEB)
set(CPACK_DEBIAN_PACKAGE_NAME libbumpshadow-dev)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "libglm-dev (>= 0.9.9.8)")
set(CPACK_DEBIAN_PACKAGE_SECTION libdevel)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/deb.cmake")

set(CPACK_SOURCE_GENERATOR TGZ)
set(CPACK_SOURCE_PACKAGE_FILE_NAME bumpshadow-${PROJECT_VERSION})
# What git ignores, and git's own; the folder of the project itself may have any name.
string(REGEX REPLACE "([][+.*()^$?|\\])" "\\\\\\1" source_dir "${PROJECT_SOURCE_DIR}")
set(CPACK_SOURCE_IGNORE_FILES)
foreach(ignored build/ _CPack_Packages/ [^/]*\\.\(deb|tar\\.gz\)$ \\.git\(/|$\) \\.cache/ node_modules/
    package\(-lock\)?\\.json$ CMakeUserPresets\\.json$ compile_commands\\.json$)
    list(APPEND CPACK_SOURCE_IGNORE_FILES "^${source_dir}/${ignored}")
endforeach()
include(CPack)
