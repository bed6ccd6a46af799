#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "fixtures/piece_meshes.h"
#include "softbody_sim/dynamics/simulator.h"

namespace softbody {
namespace {

using testing::configWith;
using testing::kFrame;
using testing::pieces;

/// Largest depth of a vertex in tets of the same body that are not its own [m].
double overlap(const TetTopology& topology, const Points& x) {
  double deepest = 0.0;
  for (Eigen::Index v = 0; v < x.rows(); ++v) {
    for (Eigen::Index t = 0; t < topology.tets.rows(); ++t) {
      if ((topology.tets.row(t).array() == v).any()) continue;
      const Eigen::Vector4i tet = topology.tets.row(t);
      if (barycentricCoordinates(x.row(v), x, tet).minCoeff() <= 0.0) continue;
      double depth = 1.0;
      for (Eigen::Index f = 0; f < topology.surface.rows(); ++f) {
        if ((topology.surface.row(f).array() == v).any()) continue;
        const Eigen::Vector3d nearest =
            nearestOnTriangle(x.row(v), x.row(topology.surface(f, 0)), x.row(topology.surface(f, 1)),
                              x.row(topology.surface(f, 2)));
        depth = std::min(depth, (nearest - x.row(v).transpose()).norm());
      }
      deepest = std::max(deepest, depth);
    }
  }
  return deepest;
}

/// A strip whose ends are pinned and moved over each other: its halves must not pass through each other.
TEST(SelfContact, AFoldedStripLiesOnItself) {
  const TetTopology topology = pieces({{{24, 3, 1}, {0.24, 0.03, 0.01}, {0.0, 0.0, 0.0}}});
  const Points& rest = topology.rest_vertices;
  Simulator simulator(topology, {2e4, 0.2, 100.0, 0.1}, configWith({0.0, 0.0, -9.81}, 0.3));
  simulator.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  Surroundings hands;
  hands.obstacles = {Obstacle::plane()};
  const auto move = [&](double angle, double down) {  // of the right end, about the middle
    hands.pins.clear();
    for (int v = 0; v < rest.rows(); ++v) {
      if (rest(v, 0) < 1e-9) hands.pins.push_back({v, rest.row(v)});
      if (rest(v, 0) < 0.24 - 1e-9) continue;
      const Eigen::Vector3d center(0.12, 0.0, 0.005), arm = rest.row(v).transpose() - center;
      hands.pins.push_back(
          {v, center + Eigen::AngleAxisd(-angle, Eigen::Vector3d::UnitY()) * arm +
                  Eigen::Vector3d(0.0, 0.0, 0.03 * std::sin(angle) + 0.03 * angle / M_PI - down)});
    }
  };
  double deepest = 0.0;
  int converged = 0;
  for (int frame = 1; frame <= 90; ++frame) {
    move(M_PI * std::min(1.0, frame / 45.0), 0.022 * std::clamp((frame - 45) / 20.0, 0.0, 1.0));
    simulator.step({}, frame * kFrame, hands);
    converged += simulator.report().converged ? 1 : 0;
    deepest = std::max(deepest, overlap(topology, simulator.state().vertices));
  }
  EXPECT_LT(deepest, 5e-4);
}

/// A box with a slit from above in its middle, half as deep as the box; its faces lie on each other.
TetTopology slitBox(std::vector<std::pair<int, int>>* pairs) {
  TetTopology body = testing::boxTopology({8, 4, 4}, {0.16, 0.06, 0.06});
  const Eigen::Index count = body.rest_vertices.rows();
  std::map<int, int> right;
  for (int v = 0; v < count; ++v) {
    if (std::abs(body.rest_vertices(v, 0) - 0.08) > 1e-9 || body.rest_vertices(v, 2) < 0.031) continue;
    right[v] = static_cast<int>(count + static_cast<Eigen::Index>(right.size()));
    pairs->emplace_back(v, right[v]);
  }
  const Points before = body.rest_vertices;
  body.rest_vertices.conservativeResize(count + static_cast<Eigen::Index>(right.size()), 3);
  for (const auto& [left, copy] : right) body.rest_vertices.row(copy) = before.row(left);
  for (Eigen::Index t = 0; t < body.tets.rows(); ++t) {
    double x = 0.0;
    for (int k = 0; k < 4; ++k) x += 0.25 * before(body.tets(t, k), 0);
    for (int k = 0; k < 4 && x > 0.08; ++k) {
      const auto copy = right.find(body.tets(t, k));
      if (copy != right.end()) body.tets(t, k) = copy->second;
    }
  }
  body.surface = boundaryTriangles(body.tets);
  body.tet_pieces = tetPieces(body.tets, static_cast<int>(body.rest_vertices.rows()));
  return body;
}

/// A box with a slit whose ends are turned about its middle: above 0 the slit opens, below it is pressed.
class Slit {
 public:
  Slit() : simulator_(body_, {2e4, 0.2, 50.0, 0.1}, configWith(Eigen::Vector3d::Zero(), 0.3)) {
    simulator_.step(testing::placing(Eigen::Isometry3d::Identity()), 0);
  }
  void step(double angle) {
    const Points& rest = body_.rest_vertices;
    const Eigen::Vector3d center(0.08, 0.0, 0.015);
    Surroundings hands;
    for (int v = 0; v < rest.rows(); ++v) {
      if (rest(v, 0) > 1e-9 && rest(v, 0) < 0.16 - 1e-9) continue;
      const Eigen::AngleAxisd turn(rest(v, 0) < 0.08 ? -angle : angle, Eigen::Vector3d::UnitY());
      hands.pins.push_back({v, center + turn * (rest.row(v).transpose() - center)});
    }
    simulator_.step({}, ++frame_ * kFrame, hands);
    moment_ = 0.0;
    for (std::size_t k = 0; k < hands.pins.size(); ++k) {
      const int v = hands.pins[k].vertex;
      if (rest(v, 0) < 1e-9) moment_ += simulator_.reactions().pins[k].force.x() * (rest(v, 2) - 0.03);
    }
  }
  /// Smallest and largest distance of the faces [m].
  std::pair<double, double> gaps() const {
    std::pair<double, double> range(1.0, -1.0);
    for (const auto& [left, right] : pairs_) {
      const double gap = simulator_.state().vertices(right, 0) - simulator_.state().vertices(left, 0);
      range = {std::min(range.first, gap), std::max(range.second, gap)};
    }
    return range;
  }
  double moment() const { return moment_; }  ///< at the left end [N m]

 private:
  std::vector<std::pair<int, int>> pairs_;
  const TetTopology body_ = slitBox(&pairs_);
  Simulator simulator_;
  Nanoseconds frame_ = 0;
  double moment_ = 0.0;
};

TEST(SelfContact, ASlitOpensAndClosesAndCarriesPressure) {
  Slit slit;
  for (int k = 1; k <= 20; ++k) slit.step(0.2 * k / 20.0);
  EXPECT_GT(slit.gaps().second, 0.01);
  const double open_stiffness = slit.moment() / 0.2;
  for (int k = 19; k >= -20; --k) slit.step(0.2 * std::max(k, 0) / 20.0);
  EXPECT_LT(slit.gaps().second, 5e-4);
  EXPECT_GT(slit.gaps().first, -5e-4);
  for (int k = 1; k <= 30; ++k) slit.step(-0.1 * std::min(k, 20) / 20.0);
  EXPECT_GT(slit.gaps().first, -5e-4);
  EXPECT_GT(slit.moment() / -0.1, 1.4 * open_stiffness);
}

}  // namespace
}  // namespace softbody
