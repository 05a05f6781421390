// SPDX-License-Identifier: GPL-3.0-or-later
// Validation of knot sets.
#include "mortise/core/knots.hpp"

#include <string>

#include "mortise/core/errors.hpp"

namespace mortise {

void check_knots(const Knots& knots, const char* who) {
  const std::string where = std::string(who) + ": ";
  if (knots.size() == 0) throw InputError(where + "expected at least one knot, got none");
  if (knots.weights.size() != knots.size())
    throw InputError(where + "expected one weight per knot, got " +
                     std::to_string(knots.weights.size()) + " weights for " +
                     std::to_string(knots.size()) + " knots");
  if (!knots.points.allFinite() || !knots.weights.allFinite())
    throw InputError(where + "a knot's coordinate, radius or weight is not finite");
  if (!(knots.points.row(3).minCoeff() > 0.0))
    throw InputError(where + "radii must be > 0, got " +
                     std::to_string(knots.points.row(3).minCoeff()));
}

}  // namespace mortise
