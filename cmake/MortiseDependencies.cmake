# SPDX-License-Identifier: GPL-3.0-or-later
# Every library Mortise stands on, found once. The Debian packages are listed in scripts/packages.txt.
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(Threads REQUIRED)
find_package(TBB REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
find_package(OpenSSL 3 REQUIRED COMPONENTS Crypto)
find_package(Boost 1.74 REQUIRED COMPONENTS iostreams)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
# Meshes; header only. Kernels are exact where they must be (GMP, MPFR).
set(CGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE ON)
find_package(CGAL 5.5 REQUIRED)
find_package(meshoptimizer REQUIRED CONFIG)  # simplifies large parts for the report page
find_package(OpenCASCADE REQUIRED CONFIG)  # its version file accepts no range
set(MORTISE_OCCT_TOOLKITS TKSTEP TKSTEPBase TKXSBase TKMesh TKTopAlgo TKBRep TKG3d TKMath TKernel)
# OpenMM's readers are Python: use Debian's interpreter, not whatever stands first on the PATH.
if(NOT DEFINED Python_EXECUTABLE)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.9 REQUIRED COMPONENTS Interpreter Development.Embed)
set(PYBIND11_NOPYTHON ON)
find_package(pybind11 REQUIRED)
find_package(PkgConfig REQUIRED)
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3 fftw3f)
if(MORTISE_BUILD_TESTS)
  find_package(GTest REQUIRED)
endif()
if(MORTISE_BUILD_BENCH)
  find_package(benchmark REQUIRED)
endif()
