// SPDX-License-Identifier: GPL-3.0-or-later
/// @file
/// The option of a random start: a seed, or "none".
#pragma once

#include <charconv>
#include <cstdint>
#include <string>

#include "mortise/core/errors.hpp"
#include "mortise/runs/option_row.hpp"

namespace mortise {

/// For options with a member `random_start`.
template <class Options>
[[nodiscard]] constexpr TextForm<Options> seed_form() {
  return {[](const Options& o) -> std::string {
            return o.random_start ? std::to_string(*o.random_start) : "none";
          },
          [](Options& o, const std::string& text) {
            o.random_start.reset();
            if (text == "none") return;
            std::uint64_t seed = 0;
            const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), seed);
            if (error != std::errc() || end != text.data() + text.size())
              throw InputError("random_start: expected a whole number >= 0 or none, got " + text);
            o.random_start = seed;
          }};
}

}  // namespace mortise
