# Run by CPack before it packs a .deb: what a Debian package has besides the files that are installed.
if(CPACK_GENERATOR STREQUAL "DEB")
    configure_file("${CPACK_RESOURCE_FILE_LICENSE}"
        "${CPACK_TEMPORARY_INSTALL_DIRECTORY}/usr/share/doc/${CPACK_DEBIAN_PACKAGE_NAME}/copyright" COPYONLY)
endif()
