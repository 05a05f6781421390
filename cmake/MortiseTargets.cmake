# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings, sanitizers and processor flags shared by every target of this build.
add_library(mortise_build_flags INTERFACE)
target_compile_features(mortise_build_flags INTERFACE cxx_std_20)
target_compile_options(
  mortise_build_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                $<$<BOOL:${MORTISE_WERROR}>:-Werror> $<$<BOOL:${MORTISE_NATIVE}>:-march=native>)
if(MORTISE_SANITIZE)
  target_compile_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE} -fno-omit-frame-pointer)
  target_link_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE})
endif()

# One GoogleTest executable per room: mortise_add_room_tests(<room> <source>... [LIBRARIES ...])
function(mortise_add_room_tests room)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  add_executable(mortise_${room}_tests ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(mortise_${room}_tests PRIVATE mortise mortise_build_flags GTest::gmock_main ${ARG_LIBRARIES})
  target_include_directories(mortise_${room}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(
    mortise_${room}_tests PRIVATE MORTISE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MORTISE_PROGRAM="$<TARGET_FILE:mortise_program>")
  gtest_discover_tests(mortise_${room}_tests DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()
if(MORTISE_BUILD_TESTS)
  include(GoogleTest)
endif()
