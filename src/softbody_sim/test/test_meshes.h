#pragma once

#include <Eigen/Geometry>
#include <random>

#include "softbody_common/rigid_fit.h"
#include "softbody_common/tet_geometry.h"
#include "softbody_common/tet_locator.h"
#include "softbody_common/types.h"

namespace softbody::testing {

/// A box of cells, each split into six tets around a diagonal, its lowest corner at the origin.
inline TetTopology boxTopology(const Eigen::Vector3i& cells, const Eigen::Vector3d& size) {
  const Eigen::Vector3i n = cells + Eigen::Vector3i::Ones();
  const auto index = [&n](int x, int y, int z) { return (x * n.y() + y) * n.z() + z; };
  TetTopology topology;
  topology.rest_vertices.resize(n.prod(), 3);
  for (int x = 0; x < n.x(); ++x) {
    for (int y = 0; y < n.y(); ++y) {
      for (int z = 0; z < n.z(); ++z) {
        topology.rest_vertices.row(index(x, y, z)) =
            Eigen::Array3d(x, y, z) * size.array() / cells.cast<double>().array();
      }
    }
  }
  constexpr int kOrders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  topology.tets.resize(6 * cells.prod(), 4);
  Eigen::Index t = 0;
  for (int x = 0; x < cells.x(); ++x) {
    for (int y = 0; y < cells.y(); ++y) {
      for (int z = 0; z < cells.z(); ++z) {
        for (int k = 0; k < 6; ++k, ++t) {
          Eigen::Vector3i corner(x, y, z);
          for (int step = 0; step < 4; ++step) {
            topology.tets(t, step) = index(corner.x(), corner.y(), corner.z());
            if (step < 3) ++corner[kOrders[k][step]];
          }
          if (k >= 3) std::swap(topology.tets(t, 2), topology.tets(t, 3));
        }
      }
    }
  }
  topology.surface = boundaryTriangles(topology.tets);
  for (int v = 0; v < n.prod(); ++v) topology.vertex_parents.push_back(v);
  topology.bodies = tetBodies(topology.tets, n.prod());
  return topology;
}

/// Vertices and tets of two such boxes, the second one's after the first one's and 0.3 m along x.
inline TetTopology twoBoxes(const Eigen::Vector3i& cells, const Eigen::Vector3d& size) {
  TetTopology both = boxTopology(cells, size);
  const Eigen::Index count = both.rest_vertices.rows(), tets = both.tets.rows();
  both.rest_vertices.conservativeResize(2 * count, 3);
  both.rest_vertices.bottomRows(count) =
      both.rest_vertices.topRows(count).rowwise() + Eigen::RowVector3d(0.3, 0.0, 0.0);
  both.tets.conservativeResize(2 * tets, 4);
  both.tets.bottomRows(tets) = both.tets.topRows(tets).array() + static_cast<int>(count);
  return both;
}

/// The paper's sponge: 132 vertices, 300 tets.
inline TetTopology sponge() { return boxTopology({10, 5, 1}, {0.2, 0.1, 0.03}); }

inline Points randomPoints(Eigen::Index count, double scale, std::mt19937* random) {
  std::uniform_real_distribution<double> uniform(-scale, scale);
  return Points::NullaryExpr(count, 3, [&] { return uniform(*random); });
}

inline Eigen::Isometry3d somePose() {
  return Eigen::Translation3d(0.04, -0.02, 0.5) *
         Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, 2.0, -0.5).normalized());
}

/// The body placed anew, without a target.
inline TargetSet placing(const Eigen::Isometry3d& pose) {
  TargetSet targets;
  targets.reset = true;
  targets.body_pose = pose;
  return targets;
}

inline double largestDistance(const Points& a, const Points& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

/// Every vertex held by a target of its own at the given positions.
inline std::vector<Target> vertexTargets(const TetTopology& topology, const Points& positions) {
  std::vector<Target> targets(static_cast<std::size_t>(positions.rows()));
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    for (int k = 0; k < 4; ++k) {
      Target& target = targets[static_cast<std::size_t>(topology.tets(t, k))];
      target.place = {static_cast<int>(t), Eigen::Vector4d::Unit(k)};
      target.position = positions.row(topology.tets(t, k));
    }
  }
  return targets;
}

}  // namespace softbody::testing
