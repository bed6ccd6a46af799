#include "core/cutting/edge_crossings.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <tuple>

namespace softbody {
namespace {

/// Two parallel planes with the patch between them, the closer the more planar the patch is.
class Slab {
 public:
  explicit Slab(const TriangleMesh& patch) {
    for (Eigen::Index f = 0; f < patch.triangles.rows(); ++f) {
      const Eigen::Vector3d p = patch.vertices.row(patch.triangles(f, 0));
      const Eigen::Vector3d q = patch.vertices.row(patch.triangles(f, 1));
      const Eigen::Vector3d r = patch.vertices.row(patch.triangles(f, 2));
      normal_ += (q - p).cross(r - p);
    }
    const Eigen::VectorXd heights = patch.vertices * normal_;
    if (heights.size() == 0) return;
    low_ = heights.minCoeff();
    high_ = heights.maxCoeff();
    const double margin = 1e-9 * (std::abs(low_) + std::abs(high_));
    low_ -= margin;
    high_ += margin;
  }

  /// Per point -1 below the slab, 1 above, 0 between the planes.
  std::vector<signed char> sidesOf(const Points& points) const {
    const Eigen::VectorXd heights = points * normal_;
    std::vector<signed char> sides(static_cast<std::size_t>(heights.size()));
    for (std::size_t v = 0; v < sides.size(); ++v) {
      const double height = heights[static_cast<Eigen::Index>(v)];
      sides[v] = static_cast<signed char>(height > high_ ? 1 : height < low_ ? -1 : 0);
    }
    return sides;
  }

 private:
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  double low_ = std::numeric_limits<double>::infinity(), high_ = -low_;
};

/// The edges that reach into the slab and have no end on the cut, each once.
std::vector<EdgeCrossing> candidates(const Tets& tets, const std::vector<bool>& on_cut,
                                     const std::vector<signed char>& sides) {
  std::vector<EdgeCrossing> edges;
  for (int t = 0; t < static_cast<int>(tets.rows()); ++t) {
    for (int i = 0; i < 4; ++i) {
      for (int j = i + 1; j < 4; ++j) {
        const auto [a, b] = std::minmax(tets(t, i), tets(t, j));
        const auto u = static_cast<std::size_t>(a), v = static_cast<std::size_t>(b);
        const bool on_one_side = sides[u] != 0 && sides[u] == sides[v];
        if (!on_one_side && !on_cut[u] && !on_cut[v]) edges.push_back({a, b, t, 0.0});
      }
    }
  }
  std::sort(edges.begin(), edges.end(), [](const EdgeCrossing& x, const EdgeCrossing& y) {
    return std::tie(x.a, x.b, x.tet) < std::tie(y.a, y.b, y.tet);
  });
  const auto same = [](const EdgeCrossing& x, const EdgeCrossing& y) { return x.a == y.a && x.b == y.b; };
  edges.erase(std::unique(edges.begin(), edges.end(), same), edges.end());
  return edges;
}

}  // namespace

std::vector<EdgeCrossing> edgeCrossings(const Points& vertices, const Tets& tets,
                                        const std::vector<bool>& on_cut, const PatchIntersector& patch) {
  std::vector<EdgeCrossing> edges = candidates(tets, on_cut, Slab(patch.mesh()).sidesOf(vertices));
  const auto misses = [&](EdgeCrossing& edge) {
    const std::vector<PatchHit> hits = patch.hits(vertices.row(edge.a), vertices.row(edge.b));
    if (hits.size() % 2 == 0) return true;
    edge.t = hits[hits.size() / 2].t;
    return false;
  };
  edges.erase(std::remove_if(edges.begin(), edges.end(), misses), edges.end());
  const auto squaredLength = [&vertices](const EdgeCrossing& e) {
    return (vertices.row(e.a) - vertices.row(e.b)).squaredNorm();
  };
  std::stable_sort(edges.begin(), edges.end(), [&](const EdgeCrossing& x, const EdgeCrossing& y) {
    return squaredLength(x) > squaredLength(y);
  });
  return edges;
}

}  // namespace softbody
