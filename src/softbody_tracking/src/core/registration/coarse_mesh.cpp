#include "registration/coarse_mesh.h"

#include <Eigen/Dense>
#include <map>
#include <tuple>
#include <vector>

namespace softbody {
namespace {

// Smallest share of the surface area that clustering may leave: of the coarse mesh, less would not look like
// the body; the fine mesh has its outline up to a pixel.
constexpr double kSmallestArea = 0.25, kSmallestFineArea = 0.95;
// Cells along the diameter of the coarse mesh, which is rendered more than a hundred times for each place.
constexpr double kCoarseCells = 25.0;
// The same of the fine mesh: two pixels of the large image each if the body is half as wide as it.
constexpr double kFineCells = 80.0;
// Samples of the picture along the diameter: a pixel each if the body is half as wide as the image.
constexpr double kPictureSamples = 160.0;

TriangleMesh clusteredOnce(const TriangleMesh& mesh, double cell_m) {
  std::map<std::tuple<int, int, int>, int> cells;
  std::vector<Eigen::Vector3d> sums;
  std::vector<int> counts, cluster(static_cast<std::size_t>(mesh.vertices.rows()));
  for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
    const Eigen::Vector3d p = mesh.vertices.row(v);
    const Eigen::Vector3i cell = (p / cell_m).array().floor().cast<int>();
    const auto [place, is_new] =
        cells.try_emplace({cell.x(), cell.y(), cell.z()}, static_cast<int>(sums.size()));
    if (is_new) sums.emplace_back(Eigen::Vector3d::Zero()), counts.push_back(0);
    cluster[v] = place->second;
    sums[place->second] += p;
    ++counts[place->second];
  }
  TriangleMesh result;
  result.vertices.resize(static_cast<Eigen::Index>(sums.size()), 3);
  for (std::size_t c = 0; c < sums.size(); ++c)
    result.vertices.row(static_cast<Eigen::Index>(c)) = sums[c] / counts[c];
  std::vector<Eigen::Vector3i> triangles;
  for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) {
    const Eigen::Vector3i t(cluster[mesh.triangles(f, 0)], cluster[mesh.triangles(f, 1)],
                            cluster[mesh.triangles(f, 2)]);
    if (t.x() != t.y() && t.y() != t.z() && t.z() != t.x()) triangles.push_back(t);
  }
  result.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t f = 0; f < triangles.size(); ++f)
    result.triangles.row(static_cast<Eigen::Index>(f)) = triangles[f];
  return result;
}

double area(const TriangleMesh& mesh) {
  double twice = 0.0;
  for (const auto& triangle : mesh.triangles.rowwise()) {
    const Eigen::Vector3d a = mesh.vertices.row(triangle[0]), b = mesh.vertices.row(triangle[1]),
                          c = mesh.vertices.row(triangle[2]);
    twice += (b - a).cross(c - a).norm();
  }
  return 0.5 * twice;
}

}  // namespace

TriangleMesh clustered(const TriangleMesh& mesh, double cell_m, double smallest_area) {
  TriangleMesh coarse = clusteredOnce(mesh, cell_m);
  // A thread that lies in one row of cells would lose all its triangles.
  while (area(coarse) < smallest_area * area(mesh)) coarse = clusteredOnce(mesh, cell_m *= 0.5);
  return coarse;
}

SearchMeshes makeSearchMeshes(const TriangleMesh& rest_surface) {
  SearchMeshes meshes;
  meshes.full = rest_surface;
  const Eigen::Vector3d size =
      rest_surface.vertices.colwise().maxCoeff() - rest_surface.vertices.colwise().minCoeff();
  meshes.diameter_m = size.norm();
  meshes.fine = clustered(rest_surface, meshes.diameter_m / kFineCells, kSmallestFineArea);
  meshes.coarse = clustered(meshes.fine, meshes.diameter_m / kCoarseCells, kSmallestArea);
  return meshes;
}

SearchMeshes makeSearchMeshes(const MeshTopology& surface, const cv::Mat3b& picture) {
  SearchMeshes meshes = makeSearchMeshes({surface.rest_vertices, surface.triangles});
  meshes.picture =
      BakedPicture(picture, meshes.full, surface.texture_coordinates, meshes.diameter_m / kPictureSamples);
  return meshes;
}

}  // namespace softbody
