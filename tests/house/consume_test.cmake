# SPDX-License-Identifier: GPL-3.0-or-later
# Installs into an empty prefix, moves it, builds tests/consume against it and runs its programs, of C++ and of C, and the installed one.
cmake_minimum_required(VERSION 3.25)

function(run expected_output)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT status EQUAL 0 OR NOT output MATCHES "${expected_output}")
    list(JOIN ARGN " " command)
    message(FATAL_ERROR "${command}\nexit status ${status}, expected 0 and output matching '${expected_output}', got:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK_DIR})
run("" ${CMAKE_COMMAND} --install ${BUILD_DIR} --prefix ${WORK_DIR}/first)
file(RENAME ${WORK_DIR}/first ${WORK_DIR}/moved)  # nothing in it may remember where it was installed
run("" ${CMAKE_COMMAND} -S ${SOURCE_DIR} -B ${WORK_DIR}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${CXX_COMPILER} -D CMAKE_C_COMPILER=${C_COMPILER}
    -D CMAKE_PREFIX_PATH=${WORK_DIR}/moved -D CMAKE_BUILD_TYPE=Release)
run("" ${CMAKE_COMMAND} --build ${WORK_DIR}/build)
run("mortise ${VERSION}: angle 90" ${WORK_DIR}/build/consumer)
run("ball [0-9.]+ energy" ${WORK_DIR}/build/wrench)
run("mortise ${VERSION}" ${WORK_DIR}/moved/${BINDIR}/mortise --version)
