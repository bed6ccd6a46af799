#include "bench/bent_bodies.h"

#include <cmath>
#include <map>
#include <random>

#include "fixtures/test_meshes.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_sim/object/object_model.h"

namespace softbody::bench {
namespace {

constexpr double kYoungsModulus = 2.0e4;  ///< [Pa]
constexpr double kDensity = 30.0;         ///< [kg/m^3]
constexpr double kFrameRate = 30.0;       ///< [Hz]

TetTopology doll() {
  VolumeSettings settings;
  settings.cage_vertices = 150;
  return buildObjectModel(loadObjectDescription(SOFTBODY_CONFIG_DIR "/doll.yaml"), settings).volume;
}

std::vector<Target> hundredTargets(const TetTopology& topology, const Points& positions,
                                   std::mt19937* random) {
  std::vector<Target> targets(100);
  for (Target& target : targets) {
    target.place.tet = static_cast<int>((*random)() % static_cast<unsigned>(topology.tets.rows()));
    target.place.barycentric = {0.4, 0.3, 0.2, 0.1};
    target.position = positionOf(target.place, positions, topology.tets);
  }
  return targets;
}

}  // namespace

TetTopology bodyTopology(const std::string& name) {
  if (name == "sponge") return testing::sponge();
  if (name == "doll") return doll();
  static const std::map<std::string, Eigen::Vector3i> kCells{
      {"1k", {6, 6, 5}}, {"10k", {12, 12, 12}}, {"100k", {25, 26, 26}}};
  return testing::boxTopology(kCells.at(name), {0.2, 0.1, 0.1});
}

Points bent(const Points& rest, double curvature) {
  const Eigen::RowVector3d center = rest.colwise().mean();
  Points x = rest;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    const double angle = curvature * (rest(v, 0) - center.x());
    const double radius = 1.0 / curvature - (rest(v, 2) - center.z());
    x(v, 0) = radius * std::sin(angle);
    x(v, 2) = 1.0 / curvature - radius * std::cos(angle);
  }
  return x;
}

BentBody bentBody(const TetTopology& topology, double poisson_ratio) {
  std::mt19937 random(1);
  BentBody body;
  body.topology = topology;
  body.lame = lameParameters(kYoungsModulus, poisson_ratio);
  const Points& rest = body.topology.rest_vertices;
  body.edge_length = meanEdgeLength(rest, body.topology.tets);
  body.start = bent(rest, 5.0) + testing::randomPoints(rest.rows(), 0.05 * body.edge_length, &random);

  body.potential.inertia = Eigen::VectorXd::Zero(rest.rows());
  const Eigen::VectorXd volumes = tetVolumes(rest, body.topology.tets);
  for (Eigen::Index t = 0; t < volumes.size(); ++t) {
    for (int k = 0; k < 4; ++k) {
      body.potential.inertia[body.topology.tets(t, k)] +=
          0.25 * kDensity * volumes[t] * kFrameRate * kFrameRate;
    }
  }
  body.potential.prediction = body.start;
  body.potential.loads = Points::Zero(rest.rows(), 3);
  body.potential.targets.set(hundredTargets(body.topology, bent(rest, 7.0), &random), body.topology.tets,
                             10.0 * kYoungsModulus * body.edge_length);
  return body;
}

TetMatrix metricOf(const BentBody& body) {
  TetMatrix metric(body.topology.tets, body.start.rows());
  CorotatedElasticity(body.topology.rest_vertices, body.topology.tets, body.lame).addMetric(&metric);
  metric.addToDiagonal(body.potential.inertia);
  body.potential.targets.addMetric(&metric);
  return metric;
}

}  // namespace softbody::bench
