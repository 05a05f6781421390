// SPDX-License-Identifier: GPL-3.0-or-later
// The page without its data, a resource of the library.
#pragma once

#include <string_view>

namespace mortise::detail {

// HTML with @title@ and @data@ where these go; empty in a build without the page.
[[nodiscard]] std::string_view page_template() noexcept;

}  // namespace mortise::detail
