// SPDX-License-Identifier: GPL-3.0-or-later
// Validation of score channels.
#include "mortise/affinity/channel.hpp"

#include <cmath>

#include "mortise/core/errors.hpp"

namespace mortise {

void check_channel(const Channel& channel, const char* who) {
  const std::string where = std::string(who) + ": channel '" + channel.name + "'";
  check_knots(channel.fixed, (where + ", fixed").c_str());
  check_knots(channel.moving, (where + ", moving").c_str());
  if (!channel.fixed_transform || !channel.moving_transform)
    throw InputError(where + ": both radial transforms must be set");
  if (!std::isfinite(channel.weight)) throw InputError(where + ": the weight must be finite");
  if (!(channel.range >= 0.0) || !std::isfinite(channel.range))
    throw InputError(where + ": the range must be >= 0 and finite");
}

}  // namespace mortise
