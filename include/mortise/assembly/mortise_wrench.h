/* SPDX-License-Identifier: GPL-3.0-or-later */
/**
 * @file
 * Energy, force and torque of two parts for physics engines: plain C.
 *
 * Make a session once per pair of parts (seconds), ask it for a wrench in every step (microseconds;
 * no allocation, no lock, any number of threads). Functions return 0, or 1 with a message for
 * mortise_last_error(); nothing is thrown and nothing printed.
 */
#ifndef MORTISE_ASSEMBLY_MORTISE_WRENCH_H
#define MORTISE_ASSEMBLY_MORTISE_WRENCH_H

#ifdef __cplusplus
extern "C" {
#endif

/* NOLINTBEGIN(modernize-use-using,readability-identifier-naming): this is C. */

/** A closed triangle mesh, corners counter-clockwise seen from outside; others are refused. */
typedef struct mortise_mesh {
  const double* vertices; /**< 3 per vertex, the part's own frame */
  long vertex_count;
  const int* triangles; /**< 3 indices per triangle */
  long triangle_count;
} mortise_mesh;

/** Zeros mean the defaults in brackets. */
typedef struct mortise_session_options {
  int grid;         /**< nodes along a part's longest side [128] */
  int modes;        /**< retained modes m', more make contact harder [4096] */
  double thickness; /**< skin in which parts attract, length unit [0.15 of the smaller part] */
  double penalty;   /**< p, what overlap costs against what fit gains [3] */
  int threads;      /**< for the making [all cores] */
} mortise_session_options;

/** Where the moving part is: x' = R x + t in the fixed part's frame. */
typedef struct mortise_pose {
  double rotation[4]; /**< unit quaternion w, x, y, z */
  double translation[3];
} mortise_pose;

/** Force is -dE/dt; torque is about the moving part's origin. Both in the fixed part's frame. */
typedef struct mortise_wrench {
  double energy;
  double force[3];
  double torque[3];
} mortise_wrench;

typedef struct mortise_session mortise_session;

/** @param options NULL = all defaults. Free the session with mortise_session_free(). */
int mortise_session_create(const mortise_mesh* fixed, const mortise_mesh* moving,
                           const mortise_session_options* options, mortise_session** session);

/** @param modes only the first so many of the session's; 0 = all */
int mortise_session_wrench(const mortise_session* session, const mortise_pose* pose, int modes,
                           mortise_wrench* wrench);

/** Centre and radius of a ball around the moving part, its own frame. */
int mortise_session_moving_ball(const mortise_session* session, double centre[3], double* radius);

/** NULL is allowed. */
void mortise_session_free(mortise_session* session);

/** Why the last call of this thread failed; "" if none did. Valid until the thread's next call. */
const char* mortise_last_error(void);

/* NOLINTEND(modernize-use-using,readability-identifier-naming) */

#ifdef __cplusplus
}
#endif

#endif
