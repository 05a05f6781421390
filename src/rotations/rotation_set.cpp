// SPDX-License-Identifier: GPL-3.0-or-later
// One door to every way of making a set of rotations.
#include "mortise/rotations/rotation_set.hpp"

#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {
namespace {

struct MethodName {
  RotationMethod method;
  const char* name;
};

constexpr MethodName kMethodNames[] = {{RotationMethod::kAuto, "auto"},
                                       {RotationMethod::kSuperFibonacci, "super-fibonacci"},
                                       {RotationMethod::kHopf, "hopf"},
                                       {RotationMethod::kIcosahedral, "icosahedral"}};

}  // namespace

RotationSet rotation_set(Eigen::Index count, RotationMethod method, int) {
  RotationSet set;
  set.method = method == RotationMethod::kAuto ? RotationMethod::kSuperFibonacci : method;
  if (set.method != RotationMethod::kSuperFibonacci)
    throw InputError("rotation_set: method " + rotation_method_name(method) + " is not there yet");
  set.quaternions = super_fibonacci_rotations(count);
  return set;
}

std::string rotation_method_name(RotationMethod method) {
  for (const MethodName& entry : kMethodNames)
    if (entry.method == method) return entry.name;
  throw InputError("rotation_method_name: no such method");
}

RotationMethod rotation_method(const std::string& name) {
  std::string known;
  for (const MethodName& entry : kMethodNames) {
    if (name == entry.name) return entry.method;
    known += std::string(known.empty() ? "" : ", ") + entry.name;
  }
  throw InputError("rotation_method: expected one of " + known + ", got " + name);
}

}  // namespace mortise
