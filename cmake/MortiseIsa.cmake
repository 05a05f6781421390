# SPDX-License-Identifier: GPL-3.0-or-later
# Hot sources compiled once per instruction set, the best one chosen when the program runs.
#
# mortise_add_isa_sources(<target> <source>...) compiles each source three times: for the plain target processor, for
# AVX2 + FMA, and for AVX-512 (elsewhere than on x86-64 the three are alike and only the first is used). Each copy sees
# the macro MORTISE_ISA, a namespace name: isa_baseline, isa_avx2 or isa_avx512. Such a source
#   - puts everything into `namespace mortise::MORTISE_ISA` and offers one constant there, a struct of function pointers;
#   - includes only headers that define types and constants, and calls no inline function or template of others (std::min,
#     Eigen, containers): its out-of-line copy could be the one the linker keeps for the whole library, and would then
#     run AVX-512 on a processor that has none. The test isa.symbols looks for such symbols.
# The caller takes the struct with best_isa() of src/core/isa.hpp; src/fourier/spread_isa.cpp and spreader.cpp are the model.
set(MORTISE_ISA_FLAGS_baseline "")
set(MORTISE_ISA_FLAGS_avx2 "")
set(MORTISE_ISA_FLAGS_avx512 "")
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  # Exactly what best_isa() asks the processor for, hence not -march=x86-64-v3, which has more.
  set(MORTISE_ISA_FLAGS_avx2 -mavx2 -mfma)
  set(MORTISE_ISA_FLAGS_avx512 ${MORTISE_ISA_FLAGS_avx2} -mavx512f -mavx512bw -mavx512cd -mavx512dq -mavx512vl)
endif()

function(mortise_add_isa_sources target)
  foreach(source IN LISTS ARGN)
    cmake_path(ABSOLUTE_PATH source OUTPUT_VARIABLE path)
    cmake_path(GET source STEM stem)
    set_property(GLOBAL APPEND PROPERTY MORTISE_ISA_SOURCES ${stem})
    foreach(level baseline avx2 avx512)
      set(copy ${CMAKE_CURRENT_BINARY_DIR}/isa_${level}/${stem}.cpp)
      file(CONFIGURE OUTPUT ${copy} CONTENT "#define MORTISE_ISA isa_${level}\n#include \"${path}\"\n" @ONLY)
      target_sources(${target} PRIVATE ${copy})
      set_source_files_properties(
        ${copy} TARGET_DIRECTORY ${target}
        PROPERTIES COMPILE_OPTIONS
                   "$<$<NOT:$<CONFIG:Debug>>:-O3>;-ffp-contract=fast;-fno-math-errno;-fno-trapping-math;${MORTISE_ISA_FLAGS_${level}}")
    endforeach()
  endforeach()
endfunction()

# mortise_add_isa_tests(<room> <filter> <source stem>...): the room's tests of that filter once more with the copies for
# lesser processors (where this one cannot do better than one of them, they repeat the ordinary run, which has the best
# copy). The tests named must compare the sources' results with a reference, to the tolerance that stands there.
function(mortise_add_isa_tests room filter)
  foreach(level baseline avx2)
    set(name isa.${room}.${level})
    add_test(NAME ${name} COMMAND mortise_${room}_tests "--gtest_filter=${filter}")
    # GoogleTest passes when a filter matches nothing.
    set_tests_properties(${name} PROPERTIES ENVIRONMENT MORTISE_ISA=${level} TIMEOUT 600
                                            FAIL_REGULAR_EXPRESSION "Running 0 tests")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY MORTISE_ISA_TESTED ${ARGN})
endfunction()

# Stops unless each source of mortise_add_isa_sources is named by mortise_add_isa_tests.
function(mortise_check_isa_tests)
  get_property(sources GLOBAL PROPERTY MORTISE_ISA_SOURCES)
  get_property(tested GLOBAL PROPERTY MORTISE_ISA_TESTED)
  foreach(stem IN LISTS sources)
    if(NOT stem IN_LIST tested)
      message(FATAL_ERROR "${stem}.cpp is compiled once per instruction set, and no mortise_add_isa_tests names it")
    endif()
  endforeach()
endfunction()
