# SPDX-License-Identifier: GPL-3.0-or-later
# Warnings, sanitizers and processor flags shared by every target of this build.
add_library(mortise_build_flags INTERFACE)
target_compile_features(mortise_build_flags INTERFACE cxx_std_20)
target_compile_options(
  mortise_build_flags INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                $<$<BOOL:${MORTISE_WERROR}>:-Werror> $<$<BOOL:${MORTISE_NATIVE}>:-march=native>)
if(MORTISE_JOINED AND CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc 12 warns of anonymous namespaces in every file that another one includes, as joining does, and is wrong about
  # text + text inlined into larger functions (its bug 105651).
  target_compile_options(mortise_build_flags INTERFACE -Wno-subobject-linkage -Wno-restrict)
endif()
if(MORTISE_SANITIZE)
  target_compile_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE} -fno-sanitize-recover=all
                                                       -fno-omit-frame-pointer)
  target_link_options(mortise_build_flags INTERFACE -fsanitize=${MORTISE_SANITIZE})
endif()

# mortise_join(<target>): with MORTISE_JOINED, compiles the target's sources in joined batches, each of one folder, so that
# headers are read and templates instantiated once a batch. Call it when all sources are listed. Sources with compile
# options of their own stay alone.
function(mortise_join target)
  if(NOT MORTISE_JOINED)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  get_target_property(directory ${target} SOURCE_DIR)
  list(FILTER sources EXCLUDE REGEX "^\\$<")  # another target's objects
  foreach(source IN LISTS sources)
    cmake_path(ABSOLUTE_PATH source BASE_DIRECTORY ${directory} OUTPUT_VARIABLE path)
    cmake_path(GET path PARENT_PATH folder)
    cmake_path(RELATIVE_PATH folder BASE_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_VARIABLE folder)
    string(MAKE_C_IDENTIFIER "${folder}" group)
    if(NOT DEFINED count_${group})
      set(count_${group} 0)
    endif()
    math(EXPR batch "${count_${group}} / ${MORTISE_JOINED_SIZE}")
    math(EXPR count_${group} "${count_${group}} + 1")
    set_source_files_properties(${path} TARGET_DIRECTORY ${target} PROPERTIES UNITY_GROUP ${group}_${batch})
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# One GoogleTest executable per room: mortise_add_room_tests(<room> <source>... [LIBRARIES ...])
# A suite whose name contains "Slow" gets the label `slow`: .ci/run leaves it out of the sanitized run.
function(mortise_add_room_tests room)
  cmake_parse_arguments(ARG "" "" "LIBRARIES" ${ARGN})
  add_executable(mortise_${room}_tests ${ARG_UNPARSED_ARGUMENTS})
  add_dependencies(mortise_tests mortise_${room}_tests)
  mortise_join(mortise_${room}_tests)
  target_link_libraries(mortise_${room}_tests PRIVATE mortise mortise_build_flags GTest::gmock_main ${ARG_LIBRARIES})
  # Their slow references run once; what is to be fast is in the library.
  target_compile_options(mortise_${room}_tests PRIVATE $<$<NOT:$<CONFIG:Debug>>:-O1>)
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
