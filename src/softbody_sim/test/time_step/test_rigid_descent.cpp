#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"
#include "time_step/rigid_descent.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::twoBoxes;

const Eigen::Vector3i kCells(6, 3, 2);
const Eigen::Vector3d kSize(0.2, 0.1, 0.04);

/// Targets that fix only the distance along a direction, as depth does, at the centre of every tet.
std::vector<Target> planeTargets(const TetTopology& topology, const Points& truth) {
  std::vector<Target> targets;
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) {
    Target target;
    target.place = {t, Eigen::Vector4d::Constant(0.25)};
    target.position = positionOf(target.place, truth, topology.tets);
    target.normal = Eigen::Vector3d::Unit(t % 3);
    targets.push_back(target);
  }
  return targets;
}

IncrementalPotential potentialOf(const TetTopology& topology, const Points& x,
                                 const std::vector<Target>& targets) {
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::Constant(x.rows(), 1e-6);
  potential.prediction = x;
  potential.loads = Points::Zero(x.rows(), 3);
  potential.targets.set(targets, topology.tets, 1000.0);
  return potential;
}

/// The metric of projective dynamics needs many iterations for this; one Gauss-Newton step does not.
TEST(RigidDescent, MovesABodyAlongItsSurfaceToItsTargets) {
  const TetTopology topology = boxTopology(kCells, kSize);
  const Points& start = topology.rest_vertices;
  const Eigen::Isometry3d motion = Eigen::Translation3d(0.01, -0.004, 0.002) *
                                   Eigen::AngleAxisd(0.02, Eigen::Vector3d(1.0, -2.0, 0.5).normalized());
  const Points truth = transformed(start, motion);
  const IncrementalPotential potential = potentialOf(topology, start, planeTargets(topology, truth));
  RigidDescent descent(topology);
  Points x = start;
  for (int i = 0; i < 3; ++i) descent.descend(potential, x, &x);
  EXPECT_LT((x - truth).rowwise().norm().maxCoeff(), 1e-5);
}

TEST(RigidDescent, PiecesMoveOnTheirOwn) {
  const TetTopology topology = twoBoxes(kCells, kSize);
  const Points& start = topology.rest_vertices;
  const Eigen::Index half = start.rows() / 2;
  Points truth = start;
  truth.topRows(half).col(0).array() += 0.01;
  truth.bottomRows(half).col(1).array() -= 0.02;
  RigidDescent descent(topology);
  Points x = start;
  descent.descend(potentialOf(topology, start, planeTargets(topology, truth)), x, &x);
  EXPECT_LT((x - truth).rowwise().norm().maxCoeff(), 1e-6);
}

/// Not short of it, where the contact does not act yet.
TEST(RigidDescent, AFallingBodyComesToRestOnThePlaneInOneStep) {
  const TetTopology topology = boxTopology(kCells, kSize);
  constexpr double kGap = 1e-3, kStiffness = 1e6, kInertia = 10.0, kFall = 0.02;
  IncrementalPotential potential;
  potential.inertia = Eigen::VectorXd::Constant(topology.rest_vertices.rows(), kInertia);
  potential.prediction = topology.rest_vertices;
  potential.prediction.col(2).array() -= kFall;
  potential.loads = Points::Zero(topology.rest_vertices.rows(), 3);
  double springs = 0.0;
  for (int t = 0; t < static_cast<int>(topology.tets.rows()); ++t) {
    for (int k = 0; k < 4; ++k) {
      const Eigen::RowVector3d vertex = topology.rest_vertices.row(topology.tets(t, k));
      if (vertex.z() > 1e-9) continue;
      potential.targets.addOneSided({t, Eigen::Vector4d::Unit(k)}, topology.tets,
                                    {vertex.x(), vertex.y(), -kGap}, Eigen::Vector3d::UnitZ(), kStiffness);
      springs += kStiffness;
    }
  }
  Points x = topology.rest_vertices;
  RigidDescent descent(topology);
  EXPECT_TRUE(descent.descend(potential, potential.prediction, &x));
  const double inertia = potential.inertia.sum(), depth = inertia * (kFall - kGap) / (inertia + springs);
  EXPECT_NEAR((x - topology.rest_vertices).col(2).mean(), -kGap - depth, 0.1 * depth);
}

TEST(RigidDescent, NeverRaisesThePotential) {
  std::mt19937 random(5);
  const TetTopology topology = boxTopology(kCells, kSize);
  RigidDescent descent(topology);
  for (int i = 0; i < 20; ++i) {
    const Points start =
        topology.rest_vertices + testing::randomPoints(topology.rest_vertices.rows(), 0.02, &random);
    const Points truth = topology.rest_vertices + testing::randomPoints(start.rows(), 0.2, &random);
    const IncrementalPotential potential = potentialOf(topology, start, planeTargets(topology, truth));
    Points x = start, gradient(start.rows(), 3);
    const double before = potential.evaluate(x, &gradient);
    descent.descend(potential, x, &x);
    EXPECT_LE(potential.evaluate(x, &gradient), before);
    EXPECT_TRUE(x.allFinite());
  }
}

}  // namespace
}  // namespace softbody
