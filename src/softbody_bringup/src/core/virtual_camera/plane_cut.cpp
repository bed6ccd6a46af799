#include "softbody_bringup/virtual_camera/plane_cut.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <stdexcept>

#include "softbody_common/tet_geometry.h"

namespace softbody::virtual_camera {
namespace {

/// The pieces while they are made. Every new vertex exists twice: even on this side, odd beyond.
class Cutter {
 public:
  Cutter(const TriangleMesh& mesh, double place) : mesh_(mesh), place_(place) {
    for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
      if (std::abs(mesh.vertices(i, 0) - place) < 1e-6) {
        throw std::invalid_argument(fmt::format("the cut at x = {} m passes through vertex {}", place, i));
      }
      add(mesh.vertices.row(i), isBeyond(static_cast<int>(i)));
    }
    for (Eigen::Index f = 0; f < mesh.triangles.rows(); ++f) cut(mesh.triangles.row(f));
    if (segments_.empty())
      throw std::invalid_argument(fmt::format("the cut at x = {} m misses the body", place));
    closeSection();
  }

  PlaneCut result() const {
    PlaneCut cut;
    MeshTopology& topology = cut.topology;
    topology.revision = 1;
    topology.rest_vertices.resize(static_cast<Eigen::Index>(vertices_.size()), 3);
    for (std::size_t i = 0; i < vertices_.size(); ++i) {
      topology.rest_vertices.row(static_cast<Eigen::Index>(i)) = vertices_[i];
    }
    topology.triangles.resize(static_cast<Eigen::Index>(triangles_.size()), 3);
    for (std::size_t f = 0; f < triangles_.size(); ++f) {
      topology.triangles.row(static_cast<Eigen::Index>(f)) << triangles_[f][0], triangles_[f][1],
          triangles_[f][2];
    }
    topology.vertex_parents.assign(vertices_.size(), -1);
    std::iota(topology.vertex_parents.begin(), topology.vertex_parents.begin() + mesh_.vertices.rows(), 0);
    topology.bodies = triangleBodies(topology.triangles, static_cast<int>(vertices_.size()));
    topology.cut.assign(triangles_.size(), false);
    std::fill(topology.cut.begin() + static_cast<std::ptrdiff_t>(first_fill_), topology.cut.end(), true);
    cut.beyond = beyond_;
    return cut;
  }

 private:
  bool isBeyond(int vertex) const { return mesh_.vertices(vertex, 0) > place_; }

  int add(const Eigen::RowVector3d& vertex, bool beyond) {
    vertices_.push_back(vertex);
    beyond_.push_back(beyond);
    return static_cast<int>(vertices_.size()) - 1;
  }

  /// The first of the two vertices where an edge meets the plane.
  int crossing(int a, int b) {
    const auto [entry, is_new] = crossings_.try_emplace(std::minmax(a, b), 0);
    if (is_new) {
      const Eigen::RowVector3d p = mesh_.vertices.row(std::min(a, b)), q = mesh_.vertices.row(std::max(a, b));
      Eigen::RowVector3d place = p + (place_ - p.x()) / (q.x() - p.x()) * (q - p);
      place.x() = place_;
      entry->second = add(place, false);
      add(place, true);
    }
    return entry->second;
  }

  void cut(const Eigen::RowVector3i& triangle) {
    for (int k = 0; k < 3; ++k) {
      const int a = triangle[k], b = triangle[(k + 1) % 3], c = triangle[(k + 2) % 3];
      if (isBeyond(b) != isBeyond(c) || isBeyond(a) == isBeyond(b)) continue;
      const int ab = crossing(a, b), ac = crossing(a, c), own = isBeyond(a) ? 1 : 0, other = 1 - own;
      triangles_.push_back({a, ab + own, ac + own});
      triangles_.push_back({ab + other, b, c});
      triangles_.push_back({ab + other, c, ac + other});
      segments_.push_back(own == 0 ? std::array<int, 2>{ac, ab} : std::array<int, 2>{ab, ac});
      return;
    }
    triangles_.push_back({triangle[0], triangle[1], triangle[2]});
  }

  /// Segments run so that the fan over them faces +x, out of the near piece.
  void closeSection() {
    Eigen::RowVector3d middle = Eigen::RowVector3d::Zero();
    for (const auto& [edge, vertex] : crossings_) middle += vertices_[static_cast<std::size_t>(vertex)];
    middle /= static_cast<double>(crossings_.size());
    middle.x() = place_;
    const int center = add(middle, false);
    add(middle, true);
    first_fill_ = triangles_.size();
    for (const auto& [from, to] : segments_) triangles_.push_back({center, from, to});
    for (const auto& [from, to] : segments_) triangles_.push_back({center + 1, to + 1, from + 1});
  }

  const TriangleMesh& mesh_;
  double place_;
  std::vector<Eigen::RowVector3d> vertices_;
  std::vector<bool> beyond_;
  std::vector<std::array<int, 3>> triangles_;
  std::map<std::pair<int, int>, int> crossings_;
  std::vector<std::array<int, 2>> segments_;
  std::size_t first_fill_ = 0;
};

}  // namespace

PlaneCut cutByPlane(const TriangleMesh& mesh, double place) { return Cutter(mesh, place).result(); }

}  // namespace softbody::virtual_camera
