#include "bench/peers/cgal_triangulation.h"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <utility>

namespace softbody::bench {

std::size_t cgalTriangulation(const std::vector<Eigen::Vector2d>& points,
                              const std::vector<std::array<int, 2>>& constraints) {
  using Triangulation =
      CGAL::Constrained_Delaunay_triangulation_2<CGAL::Exact_predicates_inexact_constructions_kernel>;
  std::vector<Triangulation::Point> places;
  places.reserve(points.size());
  for (const Eigen::Vector2d& p : points) places.emplace_back(p.x(), p.y());
  std::vector<std::pair<std::size_t, std::size_t>> ends;
  ends.reserve(constraints.size());
  for (const auto& [start, end] : constraints) ends.emplace_back(start, end);
  Triangulation triangulation;
  triangulation.insert_constraints(places.begin(), places.end(), ends.begin(), ends.end());
  return triangulation.number_of_faces();
}

}  // namespace softbody::bench
