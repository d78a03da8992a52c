# A Debian package of the installed tree: `cpack --config build/release/CPackConfig.cmake`.
# dpkg-shlibdeps finds the packages that its libraries need.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME hyperlattice)
set(CPACK_PACKAGE_CONTACT "The Hyperlattice maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "g++, cmake") # for the plugins of users
include(CPack)
