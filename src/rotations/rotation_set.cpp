// SPDX-License-Identifier: GPL-3.0-or-later
// One door to every way of making a set of rotations.
#include "mortise/rotations/rotation_set.hpp"

#include <optional>
#include <string>
#include <utility>

#include "mortise/core/errors.hpp"
#include "mortise/rotations/coverage.hpp"
#include "rotations/checks.hpp"
#include "rotations/stored_sets.hpp"

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

RotationSet rotation_set(Eigen::Index count, RotationMethod method, int threads) {
  check_rotation_count(count, "rotation_set");
  if (method == RotationMethod::kAuto || method == RotationMethod::kIcosahedral) {
    if (std::optional<RotationSet> stored = stored_rotation_set(count)) return *std::move(stored);
    if (method == RotationMethod::kIcosahedral) {
      std::string counts;
      for (const Eigen::Index known : stored_rotation_counts())
        counts += (counts.empty() ? "" : ", ") + std::to_string(known);
      throw InputError("rotation_set: method icosahedral makes " + counts + " rotations, got " +
                       std::to_string(count));
    }
  }
  RotationSet set;
  const bool hopf = method == RotationMethod::kHopf;
  set.method = hopf ? RotationMethod::kHopf : RotationMethod::kSuperFibonacci;
  set.quaternions = hopf ? hopf_rotations(count) : super_fibonacci_rotations(count);
  set.covering_radius = covering_radius(set.quaternions, threads);
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
