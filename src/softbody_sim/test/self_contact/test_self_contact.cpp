#include <gtest/gtest.h>

#include <cmath>
#include <optional>

#include "fixtures/piece_meshes.h"
#include "fixtures/test_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::configWith;
using testing::kFrame;
using testing::pieces;

constexpr double kGravity = 9.81;

/// A stack of boxes on a table, not aligned and with different meshes.
class Stack {
 public:
  Stack(int count, double youngs_modulus_pa, double density_kg_m3, double friction = 0.5)
      : topology_(pieces(boxesOf(count))),
        density_(density_kg_m3),
        simulator_(topology_, {youngs_modulus_pa, 0.2, density_kg_m3, 0.0},
                   configWith({0.0, 0.0, -kGravity}, friction)) {
    table_.obstacles = {Obstacle::plane()};
    table_.obstacles[0].friction = friction;
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  }
  void step() { simulator_.step({}, ++frame_ * kFrame, table_); }
  Simulator& simulator() { return simulator_; }
  Surroundings& table() { return table_; }
  double weight() const {
    return kGravity * density_ * tetVolumes(topology_.rest_vertices, topology_.tets).sum();
  }

 private:
  static std::vector<testing::BoxShape> boxesOf(int count) {
    std::vector<testing::BoxShape> boxes;
    for (int k = 0; k < count; ++k)
      boxes.push_back(
          {{4, 4, 2}, {0.08 - 0.01 * k, 0.08 - 0.012 * k, 0.04}, {0.003 * k, 0.004 * k, 0.0401 * k}});
    return boxes;
  }

  TetTopology topology_;
  double density_;
  Simulator simulator_;
  Surroundings table_;
  Nanoseconds frame_ = 0;
};

/// Largest depth of a vertex in another piece [m].
double penetration(const TetTopology& topology, const Points& x) {
  const auto count = static_cast<Eigen::Index>(topology.tet_pieces.size());
  const auto pieces_of_vertices = vertexPieces(topology.tets, topology.tet_pieces, x.rows());
  double deepest = 0.0;
  for (std::uint32_t p = 0; p <= *std::max_element(topology.tet_pieces.begin(), topology.tet_pieces.end());
       ++p) {
    std::vector<Eigen::Index> rows;
    for (Eigen::Index t = 0; t < count; ++t)
      if (topology.tet_pieces[static_cast<std::size_t>(t)] == p) rows.push_back(t);
    const Tets tets = topology.tets(rows, Eigen::all);
    const TetLocator locator(x, tets);
    const Triangles surface = boundaryTriangles(tets);
    for (Eigen::Index v = 0; v < x.rows(); ++v) {
      const Eigen::Vector3d point = x.row(v);
      if (pieces_of_vertices[static_cast<std::size_t>(v)] == p || !locator.contains(point)) continue;
      double depth = 1.0;
      for (Eigen::Index f = 0; f < surface.rows(); ++f) {
        const Eigen::Vector3d nearest =
            nearestOnTriangle(point, x.row(surface(f, 0)), x.row(surface(f, 1)), x.row(surface(f, 2)));
        depth = std::min(depth, (nearest - point).norm());
      }
      deepest = std::max(deepest, depth);
    }
  }
  return deepest;
}

TEST(SelfContact, StackedPiecesRestAndEachCarriesTheWeightAboveIt) {
  for (const int count : {2, 3}) {
    for (const double youngs_modulus_pa : {5e3, 1e6}) {
      Stack stack(count, youngs_modulus_pa, 60.0);
      int converged = 0;
      for (int frame = 0; frame < 60; ++frame) {
        stack.step();
        converged += stack.simulator().report().converged ? 1 : 0;
      }
      EXPECT_GE(converged, 58);
      const Points before = stack.simulator().state().vertices;
      stack.step();
      EXPECT_LT(testing::largestDistance(before, stack.simulator().state().vertices), 1e-6);
      EXPECT_LT(penetration(stack.simulator().topology(), stack.simulator().state().vertices), 5e-4);
      EXPECT_NEAR(-stack.simulator().reactions().obstacles[0].force.z(), stack.weight(),
                  1e-3 * stack.weight());
    }
  }
}

/// Two boxes, the lower one held below; gravity off.
struct Press {
  Press(double youngs_modulus_pa, SolverKind solver)
      : topology(pieces({{{4, 4, 2}, {0.08, 0.08, 0.04}, {0.0, 0.0, 0.0}},
                         {{3, 3, 3}, {0.05, 0.05, 0.05}, {0.013, 0.017, 0.04}}})),
        config(configWith(Eigen::Vector3d::Zero(), 0.3)) {
    config.solver = solver;
    simulator.emplace(topology, Material{youngs_modulus_pa, 0.2, 30.0, 0.1}, config);
    simulator->step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    const Points& rest = topology.rest_vertices;
    held.loads = Points::Zero(rest.rows(), 3);
    std::vector<int> top;
    for (int v = 0; v < rest.rows(); ++v) {
      if (rest(v, 2) < 1e-9) held.pins.push_back({v, rest.row(v)});
      if (rest(v, 2) > 0.0899) top.push_back(v);
    }
    for (const int v : top) held.loads(v, 2) = -1.0 / static_cast<double>(top.size());
  }
  double carried() const {
    double sum = 0.0;
    for (const Wrench& pin : simulator->reactions().pins) sum -= pin.force.z();
    return sum;
  }

  TetTopology topology;
  SimulatorConfig config;
  std::optional<Simulator> simulator;
  Surroundings held;
};

TEST(SelfContact, PiecesPressedTogetherPassTheForceOn) {
  for (const SolverKind solver : {SolverKind::kProjectiveDynamics, SolverKind::kFem}) {
    for (const double youngs_modulus_pa : {5e3, 2e4}) {
      Press press(youngs_modulus_pa, solver);
      int converged = 0, iterations = 0;
      for (int frame = 1; frame <= 60; ++frame) {
        press.simulator->step({}, frame * kFrame, press.held);
        converged += press.simulator->report().converged ? 1 : 0;
        iterations += press.simulator->report().iterations;
      }
      EXPECT_NEAR(press.carried(), 1.0, 0.01);
      EXPECT_LT(penetration(press.topology, press.simulator->state().vertices), 5e-4);
      EXPECT_GE(converged, 55);
    }
  }
}

/// A box on a long plate that is held; gravity is tilted instead of the plate.
class Slope {
 public:
  Slope(double friction, double slope)
      : topology_(pieces({{{15, 4, 1}, {0.45, 0.12, 0.03}, {-0.05, 0.0, -0.03}},
                          {{3, 3, 2}, {0.06, 0.06, 0.03}, {0.0, 0.031, 0.0}}})),
        simulator_(topology_, {2e5, 0.2, 100.0, 0.0}, configWith(gravityOf(slope), friction)) {
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    for (int v = 0; v < topology_.rest_vertices.rows(); ++v)
      if (topology_.rest_vertices(v, 2) < -0.0299) held_.pins.push_back({v, topology_.rest_vertices.row(v)});
  }
  void step() { simulator_.step({}, ++frame_ * kFrame, held_); }
  double slid() const {
    const Points move = simulator_.state().vertices - topology_.rest_vertices;
    return move.bottomRows(4 * 4 * 3).col(0).mean();
  }
  const Simulator& simulator() const { return simulator_; }

 private:
  static Eigen::Vector3d gravityOf(double slope) {
    const double angle = std::atan(slope);
    return kGravity * Eigen::Vector3d(std::sin(angle), 0.0, -std::cos(angle));
  }

  TetTopology topology_;
  Simulator simulator_;
  Surroundings held_;
  Nanoseconds frame_ = 0;
};

TEST(SelfContact, APieceSlidesOnAnotherAsCoulombsLawSays) {
  constexpr int kFrames = 15;
  for (const double friction : {0.0, 0.2, 0.5}) {
    const double slope = 0.15 + friction, angle = std::atan(slope);
    Slope block(friction, slope);
    int converged = 0, iterations = 0;
    for (int frame = 0; frame < kFrames; ++frame) {
      block.step();
      converged += block.simulator().report().converged ? 1 : 0;
      iterations += block.simulator().report().iterations;
    }
    const double acceleration = kGravity * (std::sin(angle) - friction * std::cos(angle)), h = 1e-9 * kFrame;
    const double distance = 0.5 * acceleration * h * h * kFrames * (kFrames + 1);  // of implicit Euler
    EXPECT_NEAR(block.slid(), distance, 0.05 * distance) << friction;
  }
}

TEST(SelfContact, APieceSticksOnAnotherBelowTheSlopeOfFriction) {
  for (const double friction : {0.2, 0.5, 1.0}) {
    Slope block(friction, 0.9 * friction);
    for (int frame = 0; frame < 30; ++frame) block.step();
    EXPECT_LT(std::abs(block.slid()), 5e-4) << friction;
  }
}

TEST(SelfContact, CollidingPiecesKeepTheirMomentum) {
  const TetTopology topology = pieces({{{3, 3, 3}, {0.05, 0.05, 0.05}, {0.0, 0.0, 0.0}},
                                       {{4, 3, 2}, {0.06, 0.05, 0.03}, {0.07, 0.02, 0.013}}});
  Simulator simulator(topology, {2e4, 0.2, 50.0, 0.0}, configWith(Eigen::Vector3d::Zero(), 0.5));
  simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  Surroundings thrown;
  thrown.loads = Points::Zero(topology.rest_vertices.rows(), 3);
  const Eigen::Index first = 4 * 4 * 4;
  thrown.loads.topRows(first).col(0).setConstant(0.03 / first);
  const auto massCenter = [&] {
    Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
    const Eigen::VectorXd volumes = tetVolumes(topology.rest_vertices, topology.tets);
    for (Eigen::Index t = 0; t < topology.tets.rows(); ++t)
      for (int k = 0; k < 4; ++k)
        sum += 0.25 * volumes[t] * simulator.state().vertices.row(topology.tets(t, k));
    return Eigen::RowVector3d(sum / volumes.sum());
  };
  for (int frame = 1; frame <= 3; ++frame) simulator.step({}, frame * kFrame, thrown);
  Eigen::RowVector3d last = massCenter(), velocity = Eigen::RowVector3d::Zero();
  double deepest = 0.0;
  for (int frame = 4; frame <= 40; ++frame) {
    simulator.step({}, frame * kFrame);
    const Eigen::RowVector3d center = massCenter();
    if (frame == 4) velocity = center - last;
    EXPECT_LT((center - last - velocity).norm(), 2e-3 * velocity.norm());
    last = center;
    deepest = std::max(deepest, penetration(topology, simulator.state().vertices));
  }
  EXPECT_LT(deepest, 5e-4);
  // The second piece was hit.
  EXPECT_GT((simulator.state().vertices - topology.rest_vertices).bottomRows(5 * 4 * 3).col(0).mean(), 5e-3);
}

/// Noise of the camera, or a start in each other, must not blow up.
TEST(SelfContact, PiecesThatStartInEachOtherCalmDown) {
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0.0, 0.0, 0.0), Eigen::Vector3d(0.02, 0.01, 0.02),
                                        Eigen::Vector3d(0.0, 0.0, 0.035)}) {
    const TetTopology topology =
        pieces({{{4, 4, 2}, {0.08, 0.08, 0.04}, {0.0, 0.0, 0.0}}, {{3, 4, 2}, {0.06, 0.08, 0.04}, corner}});
    Simulator simulator(topology, {5e3, 0.2, 50.0, 0.1}, configWith(Eigen::Vector3d::Zero(), 0.3));
    simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
    double fastest = 0.0, move = 0.0;
    for (int frame = 1; frame <= 90; ++frame) {
      const Points before = simulator.state().vertices;
      simulator.step({}, frame * kFrame);
      ASSERT_TRUE(simulator.state().vertices.allFinite());
      move = testing::largestDistance(before, simulator.state().vertices);
      fastest = std::max(fastest, move);
    }
    EXPECT_LT(fastest, 0.01);
    EXPECT_LT(move, 1e-3);
  }
}

/// A body in one piece, and pieces that are apart, are as without it.
TEST(SelfContact, ChangesNothingWhereNothingTouches) {
  for (const TetTopology& topology :
       {testing::sponge(), pieces({{{4, 4, 2}, {0.08, 0.08, 0.04}, {0.0, 0.0, 0.0}},
                                   {{4, 4, 2}, {0.08, 0.08, 0.04}, {0.09, 0.0, 0.0}}})}) {
    std::vector<Points> results;
    for (const bool self_contact : {false, true}) {
      SimulatorConfig config = configWith({0.0, 0.0, -kGravity}, 0.3);
      config.self_contact = self_contact;
      Simulator simulator(topology, {2e4, 0.2, 50.0, 0.1}, config);
      simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
      Surroundings table;
      table.obstacles = {Obstacle::plane()};
      for (int frame = 1; frame <= 10; ++frame) simulator.step({}, frame * kFrame, table);
      results.push_back(simulator.state().vertices);
    }
    EXPECT_EQ(results[0], results[1]);
  }
}

}  // namespace
}  // namespace softbody
