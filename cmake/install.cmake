# Headers and a CMake package, independent of the architecture: share/cmake/bumpshadow.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/bumpshadow)

install(DIRECTORY include/bumpshadow DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(TARGETS bumpshadow EXPORT bumpshadow INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT bumpshadow NAMESPACE bumpshadow:: FILE bumpshadowTargets.cmake DESTINATION ${package_dir})
# By itself, since whoever wants the shaders alone may not have GLM.
install(TARGETS bumpshadow_shaders EXPORT bumpshadow_shaders INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT bumpshadow_shaders NAMESPACE bumpshadow:: FILE bumpshadowShadersTargets.cmake
    DESTINATION ${package_dir})

set(shader_dir ${CMAKE_INSTALL_INCLUDEDIR}/bumpshadow/shader)
configure_package_config_file(cmake/bumpshadowConfig.cmake.in bumpshadowConfig.cmake
    INSTALL_DESTINATION ${package_dir} PATH_VARS shader_dir NO_SET_AND_CHECK_MACRO)
# Before 1.0 a minor version may change the interface.
set(compatibility SameMajorVersion)
if(PROJECT_VERSION_MAJOR EQUAL 0)
    set(compatibility SameMinorVersion)
endif()
write_basic_package_version_file(bumpshadowConfigVersion.cmake COMPATIBILITY ${compatibility} ARCH_INDEPENDENT)
install(FILES "${PROJECT_BINARY_DIR}/bumpshadowConfig.cmake" "${PROJECT_BINARY_DIR}/bumpshadowConfigVersion.cmake"
    DESTINATION ${package_dir})
