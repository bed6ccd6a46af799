#include "shells/shell_union.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/corefinement.h>
#include <CGAL/Polygon_mesh_processing/intersection.h>

#include <iterator>

#include "surface_mesh/cgal_mesh.h"

namespace softbody {
namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;
using Surface = CGAL::Surface_mesh<Point>;

}  // namespace

std::vector<std::pair<std::size_t, std::size_t>> crossingPairs(const std::vector<TriangleMesh>& surfaces) {
  std::vector<Surface> meshes;
  std::vector<std::size_t> numbers;
  for (std::size_t s = 0; s < surfaces.size(); ++s) {
    std::optional<Surface> mesh = toCgal<Point>(surfaces[s]);
    if (!mesh) continue;
    meshes.push_back(std::move(*mesh));
    numbers.push_back(s);
  }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  processing::intersecting_meshes(meshes, std::back_inserter(pairs));
  for (auto& [a, b] : pairs) a = numbers[a], b = numbers[b];
  return pairs;
}

std::optional<TriangleMesh> unionOf(const TriangleMesh& a, const TriangleMesh& b) try {
  std::optional<Surface> left = toCgal<Point>(a), right = toCgal<Point>(b);
  if (!left || !right || processing::does_self_intersect(*left) || processing::does_self_intersect(*right))
    return std::nullopt;
  Surface both;
  if (!processing::corefine_and_compute_union(*left, *right, both)) return std::nullopt;
  return fromCgal(std::move(both));
} catch (const std::exception&) {  // CGAL's precondition of a closed, outward surface
  return std::nullopt;
}

}  // namespace softbody
