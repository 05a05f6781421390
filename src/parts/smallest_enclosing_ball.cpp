// SPDX-License-Identifier: GPL-3.0-or-later
// The smallest ball around balls, by CGAL.
#include "parts/smallest_enclosing_ball.hpp"

#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>

#include <algorithm>
#include <vector>

namespace mortise::parts {

Eigen::Vector4d smallest_enclosing_ball(const Eigen::Matrix4Xd& balls) {
  using Kernel = CGAL::Simple_cartesian<double>;
  using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<Kernel, double>;
  if (balls.cols() == 1) return balls.col(0);
  std::vector<Traits::Sphere> spheres;
  for (Eigen::Index i = 0; i < balls.cols(); ++i)
    spheres.emplace_back(Kernel::Point_3(balls(0, i), balls(1, i), balls(2, i)), balls(3, i));
  CGAL::Min_sphere_of_spheres_d<Traits> smallest(spheres.begin(), spheres.end());
  Eigen::Vector4d result;
  std::copy_n(smallest.center_cartesian_begin(), 3, result.data());
  result[3] = 0.0;
  for (Eigen::Index i = 0; i < balls.cols(); ++i)
    result[3] = std::max(result[3], (balls.col(i) - result).head<3>().norm() + balls(3, i));
  return result;
}

}  // namespace mortise::parts
