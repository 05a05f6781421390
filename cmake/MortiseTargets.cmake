# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings, sanitizers and processor flags shared by every target of this build.
add_library(mortise_build_flags INTERFACE)
target_compile_features(mortise_build_flags INTERFACE cxx_std_20)
# No -Wshadow where sources are joined: it would blame a local name for another file's.
target_compile_options(
  mortise_build_flags INTERFACE -Wall -Wextra -Wpedantic $<$<NOT:$<BOOL:${CMAKE_UNITY_BUILD}>>:-Wshadow> -Wconversion
                                -Wno-sign-conversion
                                $<$<BOOL:${MORTISE_WERROR}>:-Werror> $<$<BOOL:${MORTISE_NATIVE}>:-march=native>)
if(MORTISE_SANITIZE)
  target_compile_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE} -fno-sanitize-recover=all
                                                       -fno-omit-frame-pointer)
  target_link_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE})
endif()

# One GoogleTest executable per room: mortise_add_room_tests(<room> <source>... [LIBRARIES ...])
# A suite whose name contains "Slow" gets the label `slow`: .ci/run leaves it out of the sanitized run.
function(mortise_add_room_tests room)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  add_executable(mortise_${room}_tests ${ARG_UNPARSED_ARGUMENTS})
  target_link_libraries(mortise_${room}_tests PRIVATE mortise mortise_build_flags GTest::gmock_main ${ARG_LIBRARIES})
  target_include_directories(mortise_${room}_tests PRIVATE ${PROJECT_SOURCE_DIR}/tests ${PROJECT_SOURCE_DIR}/src)
  target_compile_definitions(
    mortise_${room}_tests PRIVATE MORTISE_SOURCE_DIR="${PROJECT_SOURCE_DIR}" MORTISE_PROGRAM="$<TARGET_FILE:mortise_program>")
  # PRE_TEST: listed when ctest starts, so that a build never runs what it has just linked.
  gtest_discover_tests(
    mortise_${room}_tests DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 TEST_FILTER "-*Slow*.*" PROPERTIES TIMEOUT 300)
  gtest_discover_tests(
    mortise_${room}_tests DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 60 TEST_FILTER "*Slow*.*"
    TEST_LIST mortise_${room}_slow_tests PROPERTIES TIMEOUT 1200 LABELS slow)
endfunction()
if(MORTISE_BUILD_TESTS)
  include(GoogleTest)
endif()
