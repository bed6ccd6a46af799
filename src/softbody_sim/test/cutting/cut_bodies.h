#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "../test_meshes.h"
#include "core/cutting/cut_patch.h"
#include "softbody_common/tet_geometry.h"

namespace softbody::testing {

inline TetTopology topologyOf(const TetMesh& mesh) {
  TetTopology topology;
  topology.rest_vertices = mesh.vertices;
  topology.tets = mesh.tets;
  topology.surface = boundaryTriangles(mesh.tets);
  const auto count = static_cast<int>(mesh.vertices.rows());
  for (int v = 0; v < count; ++v) topology.vertex_parents.push_back(v);
  topology.bodies = tetBodies(mesh.tets, count);
  return topology;
}

/// A ring of square section, radius 60 mm: a box of cells bent until its ends meet.
inline TetTopology torus() {
  constexpr int kAround = 24;
  const TetTopology box = boxTopology({kAround, 2, 2}, {2.0 * M_PI, 0.04, 0.04});
  const int count = static_cast<int>(box.rest_vertices.rows()) / (kAround + 1) * kAround;
  TetMesh mesh;
  mesh.tets = box.tets.unaryExpr([count](int v) { return v % count; });
  mesh.vertices.resize(count, 3);
  for (int v = 0; v < count; ++v) {
    const Eigen::Vector3d p = box.rest_vertices.row(v);
    mesh.vertices.row(v) << (0.06 + p.y()) * std::cos(p.x()), (0.06 + p.y()) * std::sin(p.x()), p.z();
  }
  const Eigen::VectorXd volumes = tetVolumes(mesh.vertices, mesh.tets);
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    if (volumes[t] < 0.0) std::swap(mesh.tets(t, 2), mesh.tets(t, 3));
  }
  return topologyOf(mesh);
}

/// A square of half-width `reach` round the centre.
inline CutPatch planePatch(const Eigen::Vector3d& center, const Eigen::Vector3d& normal, double reach) {
  const Eigen::Vector3d u = reach * normal.unitOrthogonal(), v = normal.normalized().cross(u);
  Points before(2, 3), now(2, 3);
  before << (center - u - v).transpose(), (center - u + v).transpose();
  now << (center + u - v).transpose(), (center + u + v).transpose();
  return ruledPatch(before, now);
}

/// Seeded cuts of a body: through anywhere, and through its vertices, edges and faces on purpose.
class RandomCuts {
 public:
  RandomCuts(const TetTopology& body, unsigned seed) : body_(body), random_(seed) {
    low_ = body.rest_vertices.colwise().minCoeff();
    high_ = body.rest_vertices.colwise().maxCoeff();
  }

  double size() const { return (high_ - low_).norm(); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  Eigen::Vector3d direction() {
    std::normal_distribution<double> normal;
    return Eigen::Vector3d(normal(random_), normal(random_), normal(random_)).normalized();
  }

  Eigen::Vector3d point() {
    return {uniform(low_[0], high_[0]), uniform(low_[1], high_[1]), uniform(low_[2], high_[2])};
  }

  /// A plane through the whole body, by turns through anywhere, a vertex, an edge, a tet's face, a grazed
  /// vertex of the bounding box.
  struct Plane {
    Eigen::Vector3d point, normal;
  };
  Plane plane() {
    const Eigen::RowVector4i tet = body_.tets.row(static_cast<Eigen::Index>(random_() % body_.tets.rows()));
    const Eigen::Vector3d a = body_.rest_vertices.row(tet[0]), b = body_.rest_vertices.row(tet[1]),
                          c = body_.rest_vertices.row(tet[2]);
    switch (turn_++ % 5) {
      case 0:
        return {point(), direction()};
      case 1:
        return {a, direction()};
      case 2:
        return {a, (b - a).cross(direction()).normalized()};
      case 3:
        return {a, (b - a).cross(c - a).normalized()};
      default:
        return grazing();
    }
  }
  CutPatch planeCut() {
    const Plane cut = plane();
    return planePatch(cut.point, cut.normal, 2.0 * size());
  }

  /// What a straight edge sweeps that bends and turns on its way, in `steps` steps; it may end in the body.
  std::vector<CutPatch> sweep(int steps) {
    const Eigen::Vector3d start = point() - 0.5 * size() * direction();
    const Eigen::Vector3d along = direction(), turn = 0.3 * direction();
    Eigen::Vector3d way = (point() - start).normalized() * uniform(0.3, 1.5) * size() / steps, at = start;
    Eigen::Vector3d edge = way.cross(along).normalized() * uniform(0.2, 1.0) * size();
    std::vector<CutPatch> patches;
    for (int k = 0; k < steps; ++k) {
      const Eigen::AngleAxisd bend(turn.norm() / steps, turn.normalized());
      const Eigen::Vector3d next = at + way, next_edge = bend * edge;
      Points before(2, 3), now(2, 3);
      before << (at - edge).transpose(), (at + edge).transpose();
      now << (next - next_edge).transpose(), (next + next_edge).transpose();
      patches.push_back(ruledPatch(before, now));
      at = next;
      edge = next_edge;
      way = bend * way;
    }
    return patches;
  }

 private:
  /// Past the outermost vertex in some direction by at most a hundredth of the size, either way.
  Plane grazing() {
    const Eigen::Vector3d normal = direction();
    Eigen::Index outermost = 0;
    (body_.rest_vertices * normal).maxCoeff(&outermost);
    const Eigen::Vector3d corner = body_.rest_vertices.row(outermost);
    return {corner + uniform(-0.01, 0.01) * size() * normal, normal};
  }

  const TetTopology& body_;
  std::mt19937 random_;
  Eigen::RowVector3d low_, high_;
  unsigned turn_ = 0;
};

}  // namespace softbody::testing
