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
