#include <gtest/gtest.h>

#include "fixtures/solid_fixtures.h"
#include "solid/free_motion.h"
#include "solid/held_solid.h"

namespace softbody::virtual_camera {
namespace {

constexpr double kLength = 0.2, kThick = 0.04, kDensity = 60.0;

/// A beam that is clamped at its left end, bent a little by a load on all nodes, and let go.
struct Beam {
  HexSolid solid = HexSolid(fillWithCells(box({kLength, kThick, kThick}), Eigen::Vector3d(0.01, 0.02, 0.02)),
                            StableNeoHookean(kModulus_pa, 0.0));
  FreeMotion motion;
  Eigen::Index tip = 0;

  explicit Beam(double damping_1_s) {
    const Points& nodes = solid.grid().nodes;
    motion.start = solid.rest();
    motion.density = kDensity;
    motion.loads = Eigen::VectorXd::Zero(solid.unknowns());
    motion.damping_1_s = damping_1_s;
    Eigen::VectorXd load = motion.loads;
    for (Eigen::Index i = 0; i < nodes.rows(); ++i) {
      motion.held.push_back(nodes(i, 0) < -0.5 * kLength + 1e-6);
      load[3 * i + 2] = 1e4 * 0.01 * solid.nodalVolumes()[i];
    }
    motion.start = heldShape(solid, solid.rest(), motion.held, load);
    nodes.col(0).maxCoeff(&tip);
  }

  std::vector<double> tipOver(double interval_s, int intervals) const {
    std::vector<double> deflections;
    for (const Eigen::VectorXd& nodes : moveFreely(solid, motion, interval_s, intervals))
      deflections.push_back(nodes[3 * tip + 2] - solid.grid().nodes(tip, 2));
    return deflections;
  }
};

TEST(FreeMotion, ABeamSwingsAtTheFrequencyOfTheory) {
  constexpr double kInterval = 1e-3;
  const std::vector<double> tip = Beam(0.0).tipOver(kInterval, 1500);
  std::vector<double> rises;  // times at which it passes the rest shape upwards
  for (std::size_t i = 1; i < tip.size(); ++i) {
    if (tip[i - 1] < 0.0 && tip[i] >= 0.0)
      rises.push_back(kInterval * (static_cast<double>(i) - tip[i] / (tip[i] - tip[i - 1])));
  }
  ASSERT_GT(rises.size(), 3u);
  const double frequency = (static_cast<double>(rises.size()) - 1.0) / (rises.back() - rises.front());
  // Euler and Bernoulli; a beam five times as long as thick is slower because of shear and rotation.
  const double inertia = std::pow(kThick, 4) / 12.0, line = kDensity * kThick * kThick;
  const double slender =
      1.8751 * 1.8751 / (2.0 * 3.14159265 * kLength * kLength) * std::sqrt(kModulus_pa * inertia / line);
  EXPECT_LT(frequency, 1.01 * slender);
  EXPECT_GT(frequency, 0.92 * slender);
}

TEST(FreeMotion, WithoutDampingNoSwingIsLost) {
  const std::vector<double> tip = Beam(0.0).tipOver(2e-3, 1000);
  const auto largest = [&](std::size_t from, std::size_t to) {
    return *std::max_element(tip.begin() + static_cast<std::ptrdiff_t>(from),
                             tip.begin() + static_cast<std::ptrdiff_t>(to));
  };
  EXPECT_NEAR(largest(700, 1000), largest(50, 350), 0.02 * largest(50, 350));
}

TEST(FreeMotion, DampingTakesTheSwingAtItsRate) {
  constexpr double kDamping = 3.0;  // [1/s]; amplitudes fall at half of it
  const std::vector<double> tip = Beam(kDamping).tipOver(1e-3, 1500), free = Beam(0.0).tipOver(1e-3, 1500);
  const auto largest = [](const std::vector<double>& values, std::size_t from) {
    return *std::max_element(values.begin() + static_cast<std::ptrdiff_t>(from),
                             values.begin() + static_cast<std::ptrdiff_t>(from) + 300);
  };
  const double kept = largest(tip, 1200) / largest(tip, 200) * largest(free, 200) / largest(free, 1200);
  EXPECT_NEAR(std::log(kept), -0.5 * kDamping, 0.25);
}

TEST(FreeMotion, HeldNodesStayAndTheEndIsTheStaticShape) {
  Beam beam(30.0);
  beam.motion.start = beam.solid.rest();
  const Eigen::VectorXd volumes = beam.solid.nodalVolumes();
  for (Eigen::Index i = 0; i < volumes.size(); ++i)
    beam.motion.loads[3 * i + 2] = -9.81 * kDensity * volumes[i];
  const Eigen::VectorXd still = heldShape(beam.solid, beam.solid.rest(), beam.motion.held, beam.motion.loads);
  const Eigen::VectorXd last = moveFreely(beam.solid, beam.motion, 0.1, 15).back();
  EXPECT_LT((last - still).cwiseAbs().maxCoeff(), 1e-5);
  for (std::size_t i = 0; i < beam.motion.held.size(); ++i) {
    const auto first = 3 * static_cast<Eigen::Index>(i);
    if (beam.motion.held[i]) {
      EXPECT_EQ(last.segment<3>(first), beam.motion.start.segment<3>(first));
    }
  }
}

}  // namespace
}  // namespace softbody::virtual_camera
