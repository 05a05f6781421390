// SPDX-License-Identifier: GPL-3.0-or-later
// The page's bytes, put here by the assembler: a string literal of this size takes compilers
// seconds.
#include "report/page_resource.hpp"

#ifdef MORTISE_REPORT_PAGE
// clang-format off
__asm__(
    ".section .rodata\n"
    ".balign 16\n"
    ".hidden mortise_report_page\n"
    ".global mortise_report_page\n"
    "mortise_report_page:\n"
    ".incbin \"" MORTISE_REPORT_PAGE "\"\n"
    ".hidden mortise_report_page_end\n"
    ".global mortise_report_page_end\n"
    "mortise_report_page_end:\n"
    ".byte 0\n"
    ".text\n");
// clang-format on

extern "C" {
__attribute__((visibility("hidden"))) extern const char kPage[] __asm__("mortise_report_page");
__attribute__((visibility("hidden"))) extern const char kPageEnd[] __asm__(
    "mortise_report_page_end");
}

namespace mortise::detail {

std::string_view page_template() noexcept {
  return {kPage, static_cast<std::size_t>(kPageEnd - kPage)};
}

}  // namespace mortise::detail
#else
namespace mortise::detail {

std::string_view page_template() noexcept { return {}; }

}  // namespace mortise::detail
#endif
