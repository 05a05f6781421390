/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The C interface's header compiles as C99. */
#include "mortise/assembly/mortise_wrench.h"

int mortise_c_header_check(const mortise_session* session, const mortise_pose* pose);
int mortise_c_header_check(const mortise_session* session, const mortise_pose* pose) {
  mortise_wrench wrench;
  return mortise_session_wrench(session, pose, 0, &wrench);
}
