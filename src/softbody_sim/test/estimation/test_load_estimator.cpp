#include "estimation/load_estimator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <random>

#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::boxTopology;
using testing::kFrame;
using testing::randomPoints;
using testing::vertexTargets;

/// Two boxes, each of half of the vertices, and what estimates their loads.
struct TwoBoxes {
  const TetTopology topology = testing::twoBoxes({4, 3, 2}, {0.2, 0.1, 0.04});
  const Eigen::Index count = topology.rest_vertices.rows();
  const Eigen::VectorXd masses = Eigen::VectorXd::Constant(count, 1e-3);
  const TetMaterials materials = tetMaterials(topology, Material(), 0.7, std::nullopt);
  LoadEstimator estimator{topology, materials, masses, {0.3, 4000.0}};
  LoadEstimate loads{Points::Zero(count, 3)};

  /// Targets that are off by up to 5 mm. @param first, @param last vertices.
  std::vector<Target> targets(Eigen::Index first, Eigen::Index last, std::mt19937* random) const {
    const std::vector<Target> all =
        vertexTargets(topology, topology.rest_vertices + randomPoints(count, 0.005, random));
    return {all.begin() + first, all.begin() + last};
  }
  void update(const std::vector<Target>& targets, const std::vector<Pin>& pins = {}) {
    estimator.update(targets, pins, topology.rest_vertices, Points::Zero(count, 3), 0.1, &loads);
  }
  double first() const { return loads.per_mass.topRows(count / 2).norm(); }
  double second() const { return loads.per_mass.bottomRows(count / 2).norm(); }
};

TEST(LoadEstimator, BalancesOnEveryPiece) {
  std::mt19937 random(4);
  TwoBoxes boxes;
  for (int frame = 0; frame < 3; ++frame) boxes.update(boxes.targets(0, boxes.count, &random));
  const Points forces = boxes.masses.asDiagonal() * boxes.loads.per_mass;
  EXPECT_GT(forces.norm(), 1e-3);
  for (const Eigen::Index first : {Eigen::Index(0), boxes.count / 2}) {
    Eigen::Vector3d force = Eigen::Vector3d::Zero(), torque = Eigen::Vector3d::Zero();
    for (Eigen::Index v = first; v < first + boxes.count / 2; ++v) {
      force += forces.row(v).transpose();
      torque += Eigen::Vector3d(boxes.topology.rest_vertices.row(v)).cross(Eigen::Vector3d(forces.row(v)));
    }
    EXPECT_LT(force.norm() + torque.norm(), 1e-10 * forces.norm());
  }
}

TEST(LoadEstimator, PiecesDoNotActOnEachOther) {
  std::mt19937 random(4);
  TwoBoxes boxes;
  boxes.update(boxes.targets(0, boxes.count / 2, &random));
  EXPECT_GT(boxes.first(), 0.0);
  EXPECT_LT(boxes.second(), 1e-9 * boxes.first());
}

TEST(LoadEstimator, LoadsOfAPinnedPieceFade) {
  std::mt19937 random(4);
  TwoBoxes boxes;
  const std::vector<Target> targets = boxes.targets(0, boxes.count, &random);
  boxes.update(targets);
  const double before = boxes.first();
  EXPECT_GT(before, 0.0);
  for (int frame = 0; frame < 3; ++frame) boxes.update(targets, {Pin{0}});
  EXPECT_NEAR(boxes.first(), std::exp(-1.0) * before, 1e-6 * before);
}

TEST(LoadEstimator, DoesNothingInTheFirstStepAfterAnEdit) {
  std::mt19937 random(4);
  TwoBoxes boxes;
  boxes.loads.edited = true;
  boxes.update(boxes.targets(0, boxes.count, &random));
  EXPECT_EQ(boxes.first(), 0.0);
  boxes.update(boxes.targets(0, boxes.count, &random));
  EXPECT_GT(boxes.first(), 0.0);
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

  void setMaterial(const Material& material) { simulator_.setMaterial(material); }

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

/// The loads of a stiff body would tear a soft one apart.
TEST(LoadEstimator, LoadsAreForgottenWithTheMaterial) {
  StretchedBox box(0.3);
  box.observe(20, true);
  Material soft;
  soft.youngs_modulus_pa *= 0.01;
  box.setMaterial(soft);
  box.observe(1, true);
  EXPECT_LT(box.hiddenError(box.stretched()), 0.005);
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
