# SPDX-License-Identifier: GPL-3.0-or-later
# Installs the library, its headers and the program, and exports mortise::mortise.
include(CMakePackageConfigHelpers)
install(TARGETS mortise EXPORT mortise-targets)
install(TARGETS mortise_step LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS mortise_program)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/mortise ${PROJECT_BINARY_DIR}/include/mortise
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} FILES_MATCHING REGEX "\\.(h|hpp)$")
install(EXPORT mortise-targets NAMESPACE mortise:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mortise)
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/mortise-config.cmake.in ${PROJECT_BINARY_DIR}/mortise-config.cmake
                              INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mortise)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/mortise-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/mortise-config.cmake ${PROJECT_BINARY_DIR}/mortise-config-version.cmake
        DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/mortise)
