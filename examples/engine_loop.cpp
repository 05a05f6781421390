// SPDX-License-Identifier: GPL-3.0-or-later
// A physics engine's loop in small: a peg above a hole, let go, is drawn in. Prints time, height
// and energy; exits with 0 if the peg has found its seat.
#include <cmath>
#include <cstdio>

#include "mortise_client.hpp"

namespace {

using mortise_client::Body;
using mortise_client::Guidance;
using mortise_client::Mesh;

// Two triangles per side of a box, seen from outside unless `inward`.
void add_box(Mesh& mesh, const double (&low)[3], const double (&high)[3], bool open_top,
             bool inward) {
  const int first = static_cast<int>(mesh.vertices.size() / 3);
  for (int corner = 0; corner < 8; ++corner)
    for (int d = 0; d < 3; ++d) mesh.vertices.push_back((corner >> d & 1) != 0 ? high[d] : low[d]);
  const int sides[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  for (int s = 0; s < 6; ++s) {
    if (open_top && s == 1) continue;
    const int* c = sides[s];
    const int triangles[2][3] = {{c[0], c[1], c[2]}, {c[0], c[2], c[3]}};
    for (const auto& t : triangles)
      for (int k = 0; k < 3; ++k) mesh.triangles.push_back(first + t[inward ? 2 - k : k]);
  }
}

// The rim that joins the tops of block and hole: corners 4 to 7 of both boxes.
void add_rim(Mesh& mesh) {
  const int ring[4] = {4, 5, 7, 6};
  for (int s = 0; s < 4; ++s) {
    const int a = ring[s], b = ring[(s + 1) % 4], c = 8 + b, d = 8 + a;
    for (const int v : {a, b, c, a, c, d}) mesh.triangles.push_back(v);
  }
}

}  // namespace

int main() {
  Mesh block, peg;
  add_box(block, {-2.0, -1.6, -2.0}, {2.0, 1.6, 2.0}, true, false);
  add_box(block, {-1.0, -0.8, 0.0}, {1.0, 0.8, 2.0}, true, true);
  add_rim(block);
  // The peg's file has its origin far off its middle, as files do.
  constexpr double kOff[3] = {3.0, -2.0, 5.0};
  add_box(peg, {kOff[0] - 1.0, kOff[1] - 0.8, kOff[2] - 1.0},
          {kOff[0] + 1.0, kOff[1] + 0.8, kOff[2] + 1.0}, false, false);

  mortise_session_options options = {};
  options.grid = 64;
  options.thickness = 0.3;
  const Guidance guidance(block, peg, options);

  Body body;
  body.radius = guidance.radius();
  body.centre = guidance.centre();
  body.stiffness = 20.0;
  body.pose = {{std::cos(0.04), 0.0, 0.0, std::sin(0.04)}, {0.0, 0.0, 0.0}};
  constexpr double kStart[3] = {0.05, -0.04, 1.25};
  for (int d = 0; d < 3; ++d) body.pose.translation[d] = kStart[d] - body.arm()[d];
  const auto place = [&](int d) { return body.pose.translation[d] + body.arm()[d]; };
  constexpr double kStep = 1e-3;  // 1 kHz
  for (int i = 0; i <= 4000; ++i) {
    const mortise_wrench wrench = guidance.wrench(body.pose);
    if (i % 400 == 0)
      std::printf("%5.2f s  height %8.4f  energy %9.4f\n", i * kStep, place(2), wrench.energy);
    body.step(wrench, kStep);
  }
  const bool seated =
      std::abs(place(2) - 1.0) < 0.1 && std::abs(place(0)) < 0.05 && std::abs(place(1)) < 0.05;
  std::printf(seated ? "seated\n" : "not seated\n");
  return seated ? 0 : 1;
}
