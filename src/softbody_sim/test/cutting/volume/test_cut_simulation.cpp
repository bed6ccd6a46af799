#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "cutting/fixtures/visual_sponge.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33'000'000;

Cut throughTheMiddle(std::uint32_t revision = 1) {
  return {revision, 1, CutKind::kCut, testing::planePatch({0.093, 0.05, 0.015}, {1.0, 0.1, 0.0}, 1.0)};
}

TargetSet atRest(const Simulator& simulator) {
  TargetSet targets;
  targets.revision = simulator.topology().revision;
  targets.reset = true;
  targets.body_pose = testing::somePose();
  return targets;
}

/// A simulator that follows the tets of a body.
struct CutSimulator {
  explicit CutSimulator(const SimulatorConfig& config = {})
      : simulator(testing::sponge(), Material(), config),
        body(testing::sponge(), {}, testing::followedBy(&simulator)) {}

  bool apply(const Cut& cut) {
    std::string reason;
    return body.apply(cut, {}, &reason);
  }

  Simulator simulator;
  CuttableBody body;
};

/// Bent, and still moving, without loads that would go on acting.
std::unique_ptr<CutSimulator> swinging() {
  SimulatorConfig config;
  config.load_fade_s = 0.0;
  auto body = std::make_unique<CutSimulator>(config);
  Simulator& simulator = body->simulator;
  TargetSet targets = atRest(simulator);
  simulator.step(targets, kFrame);
  const TetTopology& topology = simulator.topology();
  Points bent = topology.rest_vertices;
  for (auto v : bent.rowwise()) v.z() += 3.0 * (v.x() - 0.1) * (v.x() - 0.1);
  targets.reset = false;
  targets.targets = testing::vertexTargets(topology, transformed(bent, testing::somePose()));
  simulator.step(targets, 2 * kFrame);
  return body;
}

std::vector<int> verticesOfPiece(const TetTopology& topology, std::uint32_t piece) {
  std::vector<int> vertices;
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    if (topology.tet_pieces[static_cast<std::size_t>(t)] != piece) continue;
    for (const int v : topology.tets.row(t)) vertices.push_back(v);
  }
  return vertices;
}

/// Mean over the material of a piece.
Eigen::Vector3d meanOfPiece(const TetTopology& topology, std::uint32_t piece, const Points& values) {
  const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  double all = 0.0;
  for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
    if (topology.tet_pieces[static_cast<std::size_t>(t)] != piece) continue;
    all += volumes[t];
    for (const int v : topology.tets.row(t)) sum += 0.25 * volumes[t] * values.row(v).transpose();
  }
  return sum / all;
}

TEST(CutSimulation, NothingJumpsAtACutNorWhenItIsTakenBack) {
  const std::unique_ptr<CutSimulator> body = swinging();
  Simulator& simulator = body->simulator;
  const TetTopology uncut = simulator.topology();
  const MeshState before = simulator.state();
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  const TetTopology cut = simulator.topology();
  EXPECT_EQ(cut.revision, 1u);
  EXPECT_EQ(simulator.state().revision, 1u);
  EXPECT_EQ(simulator.state().vertices.topRows(before.vertices.rows()), before.vertices);
  const std::vector<MaterialPoint> places = bindPoints(cut.rest_vertices, uncut.rest_vertices, uncut.tets);
  EXPECT_LT(
      (simulator.state().vertices - applyBinding(places, before.vertices, uncut.tets)).cwiseAbs().maxCoeff(),
      1e-6);
  ASSERT_TRUE(body->apply({2, 1, CutKind::kUndo, {}}));
  EXPECT_EQ(simulator.topology().rest_vertices, uncut.rest_vertices);
  EXPECT_EQ(simulator.topology().tets, uncut.tets);
  EXPECT_EQ(simulator.state().vertices, before.vertices);
  EXPECT_EQ(simulator.state().confidence, before.confidence);
}

TEST(CutSimulation, MotionGoesOn) {
  const std::unique_ptr<CutSimulator> one = swinging(), other = swinging();
  Simulator &cut = one->simulator, &whole = other->simulator;
  ASSERT_TRUE(one->apply(throughTheMiddle()));
  const Points start = whole.state().vertices;
  TargetSet none;
  whole.step(none, 3 * kFrame);
  none.revision = 1;
  cut.step(none, 3 * kFrame);
  const Eigen::RowVector3d way = (whole.state().vertices - start).colwise().mean();
  const Eigen::RowVector3d cut_way = (cut.state().vertices.topRows(start.rows()) - start).colwise().mean();
  EXPECT_GT(way.norm(), 1e-3);
  EXPECT_LT((way - cut_way).norm(), 0.25 * way.norm());  // each half turns on its own
}

TEST(CutSimulation, PiecesMoveOnTheirOwn) {
  const auto body = std::make_unique<CutSimulator>();
  Simulator& simulator = body->simulator;
  simulator.step(atRest(simulator), kFrame);
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  const TetTopology& topology = simulator.topology();
  const std::vector<int> moved = verticesOfPiece(topology, 0), still = verticesOfPiece(topology, 1);
  ASSERT_FALSE(still.empty());
  const Points before = simulator.state().vertices;
  Points goal = before;
  for (const int v : moved) goal.row(v) = before.row(v) + Eigen::RowVector3d(0.0, 0.0, 0.05);
  TargetSet targets;
  targets.revision = 1;
  for (const Target& target : testing::vertexTargets(topology, goal)) {
    if (topology.tet_pieces[static_cast<std::size_t>(target.place.tet)] == 0)
      targets.targets.push_back(target);
  }
  for (int k = 2; k < 12; ++k) simulator.step(targets, k * kFrame);
  EXPECT_LT((simulator.state().vertices(moved, Eigen::all) - goal(moved, Eigen::all)).cwiseAbs().maxCoeff(),
            2e-3);
  EXPECT_LT((simulator.state().vertices(still, Eigen::all) - before(still, Eigen::all)).cwiseAbs().maxCoeff(),
            1e-6);
}

/// Estimated loads of a body pulled at both ends are balanced over the whole body, not over its halves.
TEST(CutSimulation, PiecesOfAStretchedBodyDoNotFlyApart) {
  const auto body = std::make_unique<CutSimulator>();
  Simulator& simulator = body->simulator;
  simulator.step(atRest(simulator), kFrame);
  const TetTopology uncut = simulator.topology();
  Points stretched = uncut.rest_vertices;
  stretched.col(0) *= 1.2;
  TargetSet targets;
  targets.targets = testing::vertexTargets(uncut, transformed(stretched, testing::somePose()));
  for (int k = 2; k < 22; ++k) simulator.step(targets, k * kFrame);
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  const Points before = simulator.state().vertices;
  TargetSet none;
  none.revision = 1;
  for (int k = 22; k < 32; ++k) simulator.step(none, k * kFrame);
  const Points way = simulator.state().vertices - before;
  for (const std::uint32_t piece : {0u, 1u})
    EXPECT_LT(meanOfPiece(simulator.topology(), piece, way).norm(), 1e-4) << "piece " << piece;
}

TEST(CutSimulation, APieceThatIsNoLongerSeenComesToRest) {
  const auto body = std::make_unique<CutSimulator>();
  Simulator& simulator = body->simulator;
  simulator.step(atRest(simulator), kFrame);
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  const TetTopology& topology = simulator.topology();
  const std::vector<int> hidden = verticesOfPiece(topology, 1);
  TargetSet targets;
  targets.revision = 1;
  Points goal = simulator.state().vertices;
  for (int k = 2; k < 8; ++k) {  // at 0.3 m/s
    goal.col(2).array() += 0.01;
    targets.targets = testing::vertexTargets(topology, goal);
    simulator.step(targets, k * kFrame);
  }
  const Points before = simulator.state().vertices;
  std::vector<Target>& seen = targets.targets;
  const auto is_hidden = [&](const Target& target) {
    return topology.tet_pieces[static_cast<std::size_t>(target.place.tet)] == 1;
  };
  seen.erase(std::remove_if(seen.begin(), seen.end(), is_hidden), seen.end());
  for (int k = 8; k < 38; ++k) simulator.step(targets, k * kFrame);
  const double way = (simulator.state().vertices - before)(hidden, 2).mean();
  EXPECT_GT(way, 0.005);
  EXPECT_LT(way, 0.04);  // with the damping of the material only: 0.09 m
}

TEST(CutSimulation, TargetsOfTheRevisionBeforeAreStillUnderstood) {
  const auto body = std::make_unique<CutSimulator>();
  Simulator& simulator = body->simulator;
  simulator.step(atRest(simulator), kFrame);
  const TetTopology uncut = simulator.topology();
  const Points goal =
      transformed(uncut.rest_vertices, Eigen::Translation3d(0.02, 0.0, 0.01) * testing::somePose());
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  TargetSet late;
  late.revision = 0;
  late.targets = testing::vertexTargets(uncut, goal);
  for (int k = 2; k < 12; ++k) simulator.step(late, k * kFrame);
  EXPECT_LT((simulator.state().vertices.topRows(goal.rows()) - goal).cwiseAbs().maxCoeff(), 2e-3);
  for (std::uint32_t revision = 2; revision < 12; ++revision) {
    const CutKind kind = revision % 2 == 0 ? CutKind::kUndo : CutKind::kRedo;
    ASSERT_TRUE(body->apply({revision, 1, kind, {}}));
  }
  EXPECT_THROW(simulator.step(late, 12 * kFrame), std::invalid_argument);
}

TEST(CutSimulation, AResetBeginsUncutAndEditsOfOtherTetsAreRefused) {
  const std::unique_ptr<CutSimulator> body = swinging();
  Simulator& simulator = body->simulator;
  ASSERT_TRUE(body->apply(throughTheMiddle()));
  std::string reason;
  CuttableBody other(testing::sponge(), {}, testing::followedBy(&simulator));
  EXPECT_THROW(other.apply(throughTheMiddle(), {}, &reason), std::invalid_argument);
  EXPECT_EQ(simulator.topology().revision, 1u);
  simulator.reset();
  EXPECT_EQ(simulator.topology().revision, 0u);
  EXPECT_EQ(simulator.topology().tets, testing::sponge().tets);
  EXPECT_FALSE(simulator.placed());
  simulator.step(atRest(simulator), kFrame);
}

}  // namespace
}  // namespace softbody
