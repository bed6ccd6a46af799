#include "dynamics/load_estimator.h"

#include <gtest/gtest.h>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::kFrame;
using testing::randomPoints;
using testing::vertexTargets;

TEST(LoadEstimator, BalancesOnEveryPiece) {
  std::mt19937 random(4);
  const TetTopology topology = testing::twoBoxes({4, 3, 2}, {0.2, 0.1, 0.04});
  const Eigen::Index count = topology.rest_vertices.rows();
  const Eigen::VectorXd masses = randomPoints(count, 0.5, &random).col(0).array() + 1.0;
  LoadEstimator estimate(topology, masses, 0.3);
  Points loads = Points::Zero(count, 3);
  for (int frame = 0; frame < 3; ++frame)
    estimate.update(randomPoints(count, 1.0, &random), {}, topology.rest_vertices, 1.0 / 30.0, &loads);
  EXPECT_GT(loads.norm(), 0.1);
  const Points forces = masses.asDiagonal() * loads;
  for (const Eigen::Index first : {Eigen::Index(0), count / 2}) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    for (Eigen::Index v = first; v < first + count / 2; ++v) {
      force += forces.row(v).transpose();
      torque += Eigen::Vector3d(topology.rest_vertices.row(v)).cross(Eigen::Vector3d(forces.row(v)));
    }
    EXPECT_LT(force.norm() + torque.norm(), 1e-10 * forces.norm());
  }
}

TEST(LoadEstimator, PiecesDoNotActOnEachOther) {
  const TetTopology topology = testing::twoBoxes({4, 3, 2}, {0.2, 0.1, 0.04});
  const Eigen::Index count = topology.rest_vertices.rows();
  LoadEstimator estimate(topology, Eigen::VectorXd::Ones(count), 0.3);
  Points springs = Points::Zero(count, 3), loads = springs;
  springs.row(0) << 1.0, 2.0, 3.0;
  estimate.update(springs, {}, topology.rest_vertices, 0.0, &loads);
  EXPECT_GT(loads.topRows(count / 2).norm(), 0.0);
  EXPECT_EQ(loads.bottomRows(count / 2).norm(), 0.0);
}

TEST(LoadEstimator, APinnedPieceKeepsNoLoads) {
  const TetTopology topology = testing::twoBoxes({4, 3, 2}, {0.2, 0.1, 0.04});
  const Eigen::Index count = topology.rest_vertices.rows();
  std::mt19937 random(4);
  LoadEstimator estimate(topology, Eigen::VectorXd::Ones(count), 0.3);
  const Points springs = randomPoints(count, 1.0, &random);
  Points loads = Points::Zero(count, 3);
  estimate.update(springs, {}, topology.rest_vertices, 0.1, &loads);
  const double before = loads.topRows(count / 2).norm();
  EXPECT_GT(before, 0.0);
  for (int frame = 0; frame < 3; ++frame)
    estimate.update(springs, {Pin{0}}, topology.rest_vertices, 0.1, &loads);
  EXPECT_NEAR(loads.topRows(count / 2).norm(), std::exp(-1.0) * before, 1e-9 * before);
  EXPECT_GT(loads.bottomRows(count / 2).norm(), 1.5 * before);
}

/// A stretched box that is observed only from above.
class StretchedBox {
 public:
  explicit StretchedBox(double load_fade_s) : simulator_(topology_, Material(), config(load_fade_s)) {
    TargetSet placing;
    placing.reset = true;
    simulator_.step(placing, 0);
  }

  void observe(int frames, bool anything) {
    TargetSet seen;
    if (anything) seen.targets = targets();
    for (int i = 0; i < frames; ++i) simulator_.step(seen, ++frame_ * kFrame);
  }

  Points stretched() const { return topology_.rest_vertices * Eigen::Vector3d(1.1, 0.97, 0.97).asDiagonal(); }

  /// Mean distance of the hidden vertices from a shape [m].
  double hiddenError(const Points& shape) const {
    double sum = 0.0;
    int count = 0;
    for (Eigen::Index v = 0; v < shape.rows(); ++v) {
      if (seenFromAbove(v)) continue;
      sum += (simulator_.state().vertices.row(v) - shape.row(v)).norm();
      ++count;
    }
    return sum / count;
  }

  const Points& rest() const { return topology_.rest_vertices; }
  const Points& vertices() const { return simulator_.state().vertices; }

 private:
  static SimulatorConfig config(double load_fade_s) {
    SimulatorConfig config;
    config.load_fade_s = load_fade_s;
    return config;
  }

  bool seenFromAbove(Eigen::Index v) const { return topology_.rest_vertices(v, 2) > 0.039; }

  std::vector<Target> targets() const {
    std::vector<Target> result;
    const std::vector<Target> all = vertexTargets(topology_, stretched());
    for (std::size_t v = 0; v < all.size(); ++v) {
      if (seenFromAbove(static_cast<Eigen::Index>(v))) result.push_back(all[v]);
    }
    return result;
  }

  TetTopology topology_ = boxTopology({10, 5, 2}, {0.2, 0.1, 0.04});
  Simulator simulator_;
  int frame_ = 0;
};

TEST(LoadEstimator, FindsTheHiddenSideOfABodyThatIsPulledAtItsEnds) {
  StretchedBox without(0.0), with(0.3);
  without.observe(20, true);
  with.observe(20, true);
  EXPECT_LT(with.hiddenError(with.stretched()), 0.6 * without.hiddenError(without.stretched()));
}

TEST(LoadEstimator, AnOccludedBodyReturnsToItsShapeInPlace) {
  StretchedBox box(0.3);
  box.observe(20, true);
  const Eigen::RowVector3d center = box.vertices().colwise().mean();
  box.observe(200, false);
  EXPECT_LT((box.vertices().colwise().mean() - center).norm(), 0.01);
  const Eigen::Isometry3d pose = fitRigid(box.rest(), box.vertices());
  EXPECT_LT((box.vertices() - transformed(box.rest(), pose)).rowwise().norm().maxCoeff(), 1e-3);
}

}  // namespace
}  // namespace softbody
