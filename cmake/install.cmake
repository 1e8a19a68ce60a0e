# SPDX-FileCopyrightText: 2026 The motex authors
# SPDX-License-Identifier: MIT
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
get_property(modules GLOBAL PROPERTY MOTEX_MODULES)
list(TRANSFORM modules PREPEND motex_ OUTPUT_VARIABLE targets)
install(TARGETS ${targets} EXPORT motex-targets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(DIRECTORY src/motex DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING PATTERN "*.h")
install(EXPORT motex-targets NAMESPACE motex:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/motex)
configure_package_config_file(cmake/motex-config.cmake.in motex-config.cmake
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/motex)
write_basic_package_version_file(motex-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/motex-config.cmake ${CMAKE_CURRENT_BINARY_DIR}/motex-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/motex)
