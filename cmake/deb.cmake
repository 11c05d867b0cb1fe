# Run by CPack before it packs a .deb: what a Debian package has besides the files that are installed, and modes that do
# not depend on who packs.
if(CPACK_GENERATOR STREQUAL "DEB")
    configure_file("${CPACK_RESOURCE_FILE_LICENSE}"
        "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/${CPACK_DEBIAN_PACKAGE_NAME}/copyright" COPYONLY)
    file(CHMOD_RECURSE "${CPACK_TEMPORARY_INSTALL_DIRECTORY}"
        FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ
        DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
endif()
