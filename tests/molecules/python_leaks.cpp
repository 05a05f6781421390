// SPDX-License-Identifier: GPL-3.0-or-later
// Tells LeakSanitizer that the embedded Python is never ended, so what it holds at exit is no leak
// of ours.

extern "C" const char* __lsan_default_suppressions();  // NOLINT: the sanitizer's own name
extern "C" const char* __lsan_default_suppressions() { return "leak:libpython3\nleak:/python3"; }
