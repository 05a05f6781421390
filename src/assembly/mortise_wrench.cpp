// SPDX-License-Identifier: GPL-3.0-or-later
// The C interface: everything C++ throws becomes a code and a message.
#include "mortise/assembly/mortise_wrench.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <string>

#include "mortise/assembly/assembly_session.hpp"
#include "mortise/assembly/part_field.hpp"
#include "mortise/core/errors.hpp"
#include "mortise/parts/mesh_solid.hpp"

struct mortise_session {
  mortise::AssemblySession session;
};

namespace {

std::string& last_error() {
  static thread_local std::string message;
  return message;
}

template <class Body>
int guarded(const Body& body) {
  try {
    last_error().clear();
    body();
    return 0;
  } catch (const std::exception& error) {
    last_error() = error.what();
  } catch (...) {
    last_error() = "unknown error";
  }
  return 1;
}

// Relative to the first vertex, so that little is lost far from the origin.
double signed_volume(const mortise::TriangleMesh& mesh) {
  const Eigen::Matrix3Xd v = mesh.vertices.colwise() - mesh.vertices.col(mesh.triangles(0, 0));
  double sum = 0.0;
  for (Eigen::Index t = 0; t < mesh.size(); ++t)
    sum += v.col(mesh.triangles(0, t))
               .dot(v.col(mesh.triangles(1, t)).cross(v.col(mesh.triangles(2, t))));
  return sum / 6.0;
}

mortise::MeshSolid solid(const mortise_mesh* mesh, const char* name, int threads) {
  if (mesh == nullptr || mesh->vertices == nullptr || mesh->triangles == nullptr ||
      mesh->vertex_count < 0 || mesh->triangle_count < 0)
    throw mortise::InputError(std::string("mortise_session_create: no ") + name + " mesh");
  mortise::TriangleMesh copy;
  copy.vertices = Eigen::Map<const Eigen::Matrix3Xd>(mesh->vertices, 3,
                                                     static_cast<Eigen::Index>(mesh->vertex_count));
  copy.triangles = Eigen::Map<const Eigen::Matrix3Xi>(
      mesh->triangles, 3, static_cast<Eigen::Index>(mesh->triangle_count));
  mortise::MeshSolid result(std::move(copy), {.threads = threads});
  if (!result.closed())
    throw mortise::InputError(std::string("mortise_session_create: the ") + name +
                              " mesh is open; expected one without open edges");
  const double volume = signed_volume(result.mesh());
  if (!(volume > 0.0))
    throw mortise::InputError(std::string("mortise_session_create: the ") + name +
                              " mesh has the volume " + std::to_string(volume) +
                              "; expected triangles that run counter-clockwise seen from outside");
  return result;
}

}  // namespace

int mortise_session_create(const mortise_mesh* fixed, const mortise_mesh* moving,
                           const mortise_session_options* options, mortise_session** session) {
  return guarded([&] {
    if (session == nullptr)
      throw mortise::InputError("mortise_session_create: no place for the session");
    *session = nullptr;
    const mortise_session_options none = {};
    const mortise_session_options& asked = options != nullptr ? *options : none;
    mortise::PartFieldOptions field;
    mortise::AssemblyOptions assembly;
    field.threads = assembly.threads = asked.threads;
    if (asked.grid != 0) field.grid = asked.grid;
    if (asked.thickness != 0.0) field.thickness = asked.thickness;
    if (asked.penalty != 0.0) field.penalty = asked.penalty;
    if (asked.modes != 0) assembly.modes = asked.modes;
    const mortise::MeshSolid first = solid(fixed, "fixed", asked.threads),
                             second = solid(moving, "moving", asked.threads);
    if (field.thickness == 0.0)  // anything else out of range is refused below
      field.thickness =
          std::min(mortise::default_thickness(first), mortise::default_thickness(second));
    *session = new mortise_session{
        mortise::AssemblySession(mortise::double_skin_field(first, field),
                                 mortise::double_skin_field(second, field), assembly)};
  });
}

int mortise_session_wrench(const mortise_session* session, const mortise_pose* pose, int modes,
                           mortise_wrench* wrench) {
  return guarded([&] {
    if (session == nullptr || pose == nullptr || wrench == nullptr)
      throw mortise::InputError("mortise_session_wrench: session, pose and wrench must be given");
    mortise::RigidMotion motion;
    motion.rotation = Eigen::Quaterniond(pose->rotation[0], pose->rotation[1], pose->rotation[2],
                                         pose->rotation[3]);
    motion.translation = Eigen::Map<const Eigen::Vector3d>(pose->translation);
    mortise::check_motion(motion, "mortise_session_wrench");
    const mortise::Wrench felt = session->session.wrench(motion, modes);
    wrench->energy = felt.energy;
    for (int d = 0; d < 3; ++d) {
      wrench->force[d] = felt.force[d];
      wrench->torque[d] = felt.torque[d];
    }
  });
}

int mortise_session_moving_ball(const mortise_session* session, double centre[3], double* radius) {
  return guarded([&] {
    if (session == nullptr || centre == nullptr || radius == nullptr)
      throw mortise::InputError("mortise_session_moving_ball: all arguments must be given");
    for (int d = 0; d < 3; ++d) centre[d] = session->session.moving_centre()[d];
    *radius = session->session.moving_radius();
  });
}

void mortise_session_free(mortise_session* session) { delete session; }

const char* mortise_last_error(void) { return last_error().c_str(); }
