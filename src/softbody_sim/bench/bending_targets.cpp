#include "bench/bending_targets.h"

#include <cmath>
#include <random>

#include "bench/bent_bodies.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"

namespace softbody::bench {
namespace {

constexpr int kTargets = 1500;
constexpr double kDepthNoise_m = 5e-4;

/// Corners of a surface triangle, one per row.
Eigen::Matrix3d cornersOf(const TetTopology& body, const Points& x, Eigen::Index f) {
  Eigen::Matrix3d corners;
  for (int k = 0; k < 3; ++k) corners.row(k) = x.row(body.surface(f, k));
  return corners;
}

/// Outward normal with twice the area as length [m^2].
Eigen::Vector3d areaVector(const Eigen::Matrix3d& corners) {
  const Eigen::Vector3d a = corners.row(1) - corners.row(0), b = corners.row(2) - corners.row(0);
  return a.cross(b);
}

/// Targets at random points of the upward-facing surface, for vertices x [m].
std::vector<Target> depthTargets(const TetTopology& body, const TetLocator& locator, const Points& x,
                                 std::mt19937* random) {
  std::vector<double> areas;
  double visible = 0.0;
  for (Eigen::Index f = 0; f < body.surface.rows(); ++f) {
    const Eigen::Vector3d area = areaVector(cornersOf(body, x, f));
    areas.push_back(area.z() > 0.3 * area.norm() ? 0.5 * area.norm() : 0.0);
    visible += areas.back();
  }
  std::discrete_distribution<Eigen::Index> triangle(areas.begin(), areas.end());
  std::exponential_distribution<double> share;
  std::normal_distribution<double> noise(0.0, kDepthNoise_m);
  const double edge = meanEdgeLength(body.rest_vertices, body.tets);
  std::vector<Target> targets(kTargets);
  for (Target& target : targets) {
    const Eigen::Index f = triangle(*random);
    Eigen::RowVector3d shares(share(*random), share(*random), share(*random));
    shares /= shares.sum();
    target.place = locator.locate((shares * cornersOf(body, body.rest_vertices, f)).transpose());
    target.normal = areaVector(cornersOf(body, x, f)).normalized();
    target.position = (shares * cornersOf(body, x, f)).transpose() + noise(*random) * target.normal;
    target.weight = visible / (kTargets * edge * edge);  // proportional to area, like depth targets
  }
  return targets;
}

}  // namespace

std::vector<TargetSet> bendingTargets(const TetTopology& body, int frames) {
  const TetLocator locator(body.rest_vertices, body.tets);
  std::mt19937 random(4);
  std::vector<TargetSet> sets(static_cast<std::size_t>(frames));
  for (int frame = 0; frame < frames; ++frame) {
    const double curvature = 1e-6 + 7.0 * std::sin(2.0 * M_PI * frame / frames);
    sets[static_cast<std::size_t>(frame)].targets =
        depthTargets(body, locator, bent(body.rest_vertices, curvature), &random);
  }
  sets[0].reset = true;
  return sets;
}

}  // namespace softbody::bench
