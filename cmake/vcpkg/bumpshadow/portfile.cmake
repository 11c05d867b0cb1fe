# An overlay port of the tree that it lies in: vcpkg install bumpshadow --overlay-ports=cmake/vcpkg
# Checked without vcpkg, which needs the network: its functions are played by tests/roads/vcpkg.cmake, and a consumer
# finds what that installs. vcpkg itself has not run it.
get_filename_component(SOURCE_PATH "${CMAKE_CURRENT_LIST_DIR}/../../.." ABSOLUTE)

set(VCPKG_BUILD_TYPE release)  # headers alone

vcpkg_cmake_configure(SOURCE_PATH "${SOURCE_PATH}"
    OPTIONS -DBUMPSHADOW_BUILD_TESTS=OFF -DBUMPSHADOW_BUILD_EXAMPLES=OFF -DBUMPSHADOW_INSTALL=ON)
vcpkg_cmake_install()
vcpkg_cmake_config_fixup(CONFIG_PATH share/cmake/bumpshadow)

# vcpkg's GLM comes without glm.pc, which bumpshadow.pc asks for.
file(REMOVE_RECURSE "${CURRENT_PACKAGES_DIR}/share/pkgconfig" "${CURRENT_PACKAGES_DIR}/share/cmake"
    "${CURRENT_PACKAGES_DIR}/share/doc")
file(INSTALL "${CMAKE_CURRENT_LIST_DIR}/usage" DESTINATION "${CURRENT_PACKAGES_DIR}/share/${PORT}")
vcpkg_install_copyright(FILE_LIST "${SOURCE_PATH}/LICENSE")
