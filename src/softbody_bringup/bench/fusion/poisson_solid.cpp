#include "bench/fusion/poisson_solid.h"

#define CGAL_EIGEN3_ENABLED
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Poisson_reconstruction_function.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace softbody::scanning {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using PointAndNormal = std::pair<Kernel::Point_3, Kernel::Vector_3>;
using Poisson = CGAL::Poisson_reconstruction_function<Kernel>;

Kernel::Point_3 pointOf(const Eigen::Vector3d& p) { return {p.x(), p.y(), p.z()}; }

/// Median slope of the function across the surface [1/m].
double slopeOf(const Poisson& function, const OrientedPoints& points, double step_m) {
  std::vector<double> slopes;
  for (Eigen::Index i = 0; i < points.positions.rows(); i += 10) {
    const Eigen::Vector3d step = step_m * points.normals.row(i), p = points.positions.row(i);
    slopes.push_back((function(pointOf(p + step)) - function(pointOf(p - step))) / (2.0 * step_m));
  }
  const auto middle = slopes.begin() + static_cast<std::ptrdiff_t>(slopes.size() / 2);
  std::nth_element(slopes.begin(), middle, slopes.end());
  return *middle;
}

}  // namespace

DistanceGrid poissonSolid(const OrientedPoints& points, const FusionBox& box) {
  std::vector<PointAndNormal> pairs;
  for (Eigen::Index i = 0; i < points.positions.rows(); ++i) {
    const Eigen::Vector3d n = points.normals.row(i);
    pairs.emplace_back(pointOf(points.positions.row(i)), Kernel::Vector_3(n.x(), n.y(), n.z()));
  }
  Poisson function(pairs.begin(), pairs.end(), CGAL::First_of_pair_property_map<PointAndNormal>(),
                   CGAL::Second_of_pair_property_map<PointAndNormal>());
  if (!function.compute_implicit_function()) throw std::runtime_error("Poisson's equation cannot be solved");
  const double slope = slopeOf(function, points, box.voxel_m);
  DistanceGrid grid{box, ((box.box.sizes() / box.voxel_m).array().floor().cast<int>() + 1).matrix(), {}};
  grid.distances.resize(static_cast<std::size_t>(grid.size.x()) * grid.size.y() * grid.size.z());
  for (int z = 0; z < grid.size.z(); ++z)
    for (int y = 0; y < grid.size.y(); ++y)
      for (int x = 0; x < grid.size.x(); ++x) {
        const Eigen::Vector3i i(x, y, z);
        const bool border = (i.array() == 0).any() || (i.array() == grid.size.array() - 1).any();
        const double distance = border ? box.reach_m : function(pointOf(grid.place(i))) / slope;
        grid.at(i) = static_cast<float>(std::clamp(distance, -box.reach_m, box.reach_m));
      }
  return grid;
}

}  // namespace softbody::scanning
