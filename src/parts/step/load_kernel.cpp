// SPDX-License-Identifier: GPL-3.0-or-later
// dlopen of the STEP module, which lies beside the library.
#include "parts/step/load_kernel.hpp"

#include <dlfcn.h>

#include <filesystem>
#include <stdexcept>

namespace mortise {
namespace {

const StepKernel* load() {
  Dl_info here;
  if (dladdr(reinterpret_cast<const void*>(&load_step_kernel), &here) == 0)
    throw std::runtime_error("STEP module: the library's own place is unknown");
  const std::filesystem::path folder = std::filesystem::path(here.dli_fname).parent_path();
  const std::string path = (folder / MORTISE_STEP_MODULE).string();
  void* module = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (module == nullptr) throw std::runtime_error(std::string("STEP module: ") + dlerror());
  void* entry = dlsym(module, kStepKernelEntry);
  if (entry == nullptr) throw std::runtime_error(std::string("STEP module: ") + dlerror());
  return reinterpret_cast<StepKernelEntry>(entry)();
}

}  // namespace

const StepKernel& load_step_kernel() {
  static const StepKernel* kernel = load();
  return *kernel;
}

}  // namespace mortise
