# `cmake --install` gives find_package(pomona) and pkg-config; tests/install checks both.
include(CMakePackageConfigHelpers)
install(TARGETS pomona EXPORT pomona-targets)
install(DIRECTORY include/pomona DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(EXPORT pomona-targets NAMESPACE pomona:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pomona)
configure_package_config_file(cmake/pomona-config.cmake.in pomona-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pomona)
write_basic_package_version_file(pomona-config-version.cmake COMPATIBILITY SameMinorVersion)
# The prefix as seen from the .pc file, so that `cmake --install --prefix` may choose another one.
file(RELATIVE_PATH POMONA_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
string(REGEX REPLACE "/$" "" POMONA_PREFIX_FROM_PC ${POMONA_PREFIX_FROM_PC})
configure_file(cmake/pomona.pc.in pomona.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/pomona-config.cmake ${PROJECT_BINARY_DIR}/pomona-config-version.cmake
        ${PROJECT_SOURCE_DIR}/cmake/PomonaPlugin.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/pomona)
install(FILES ${PROJECT_BINARY_DIR}/pomona.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
