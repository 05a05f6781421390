/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A C program on the installed C interface: two boxes, their force beside the energy's slope, and an open mesh's message. */
#include <math.h>
#include <mortise/assembly/mortise_wrench.h>
#include <stdio.h>
#include <string.h>

/* Corner c of a box has bits x, y, z; two triangles a side, counter-clockwise from outside. */
static const int kTriangles[36] = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};

static mortise_mesh box(double* vertices, double half) {
  mortise_mesh mesh;
  int corner, axis;
  for (corner = 0; corner < 8; ++corner)
    for (axis = 0; axis < 3; ++axis)
      vertices[3 * corner + axis] = ((corner >> axis) & 1) != 0 ? half : -half;
  mesh.vertices = vertices;
  mesh.vertex_count = 8;
  mesh.triangles = kTriangles;
  mesh.triangle_count = 12;
  return mesh;
}

static int failed(const char* what) {
  fprintf(stderr, "%s: %s\n", what, mortise_last_error());
  return 1;
}

int main(void) {
  const double height = 1.45, step = 1e-3; /* the boxes overlap by 0.05 */
  double vertices[24], small_vertices[24], centre[3], radius, slope;
  mortise_mesh fixed = box(vertices, 1.0), moving = box(small_vertices, 0.5);
  mortise_mesh open = moving;
  mortise_session_options options;
  mortise_session* session = NULL;
  mortise_pose pose = {{1.0, 0.0, 0.0, 0.0}, {0.1, 0.2, 0.0}};
  mortise_wrench here, above, below;

  memset(&options, 0, sizeof options);
  options.grid = 32;
  options.thickness = 0.25;
  open.triangle_count = 11;
  if (mortise_session_create(&fixed, &open, &options, &session) == 0) return 1;
  if (strstr(mortise_last_error(), "open") == NULL) return failed("message of an open mesh");

  if (mortise_session_create(&fixed, &moving, &options, &session) != 0) return failed("create");
  if (mortise_session_moving_ball(session, centre, &radius) != 0) return failed("ball");
  pose.translation[2] = height;
  if (mortise_session_wrench(session, &pose, 0, &here) != 0) return failed("wrench");
  pose.translation[2] = height + step;
  if (mortise_session_wrench(session, &pose, 0, &above) != 0) return failed("wrench");
  pose.translation[2] = height - step;
  if (mortise_session_wrench(session, &pose, 0, &below) != 0) return failed("wrench");
  mortise_session_free(session);

  slope = (above.energy - below.energy) / (2.0 * step);
  printf("ball %.4f energy %.6f force %.6f slope %.6f\n", radius, here.energy, here.force[2], slope);
  /* The ball holds the corners, sqrt(3)/2 away, and the skin. The central difference errs by step^2, single
     precision by 1e-6 / step. */
  return radius >= 0.866 && here.force[2] != 0.0 &&
                 fabs(here.force[2] + slope) <= 0.01 * fabs(here.force[2])
             ? 0
             : 1;
}
