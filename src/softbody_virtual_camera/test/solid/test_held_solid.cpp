#include <gtest/gtest.h>

#include "fixtures/solid_fixtures.h"
#include "solid/held_solid.h"
#include "solid/key_states.h"

namespace softbody::virtual_camera {
namespace {

/// Nodes at both ends along x.
std::vector<bool> endsOf(const HexSolid& solid, double half_m) {
  std::vector<bool> ends;
  for (Eigen::Index i = 0; i < solid.grid().nodes.rows(); ++i)
    ends.push_back(std::abs(solid.grid().nodes(i, 0)) > half_m);
  return ends;
}

/// The force on the end at positive x.
Eigen::Vector3d pullAt(const HexSolid& solid, const Eigen::VectorXd& nodes) {
  const Points forces = asPoints(holdingForces(solid, nodes));
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < forces.rows(); ++i) {
    if (solid.grid().nodes(i, 0) > 0.0) sum += forces.row(i).transpose();
  }
  return sum;
}

TEST(HeldSolid, AUniformDeformationOfTheBoundaryIsOneOfTheWholeBody) {
  Eigen::Matrix3d F;
  F << 1.1, 0.1, 0.0, -0.05, 0.95, 0.1, 0.0, 0.05, 1.05;
  const HexSolid solid = solidOf(bar(), 0.02);
  std::vector<bool> boundary;
  for (Eigen::Index i = 0; i < solid.grid().nodes.rows(); ++i) {
    const Eigen::Array3d share =
        solid.grid().nodes.row(i).transpose().array() / Eigen::Array3d(0.1, 0.05, 0.02);
    boundary.push_back(share.abs().maxCoeff() > 1.0 - 1e-9);
  }
  const Eigen::VectorXd expected = deformed(solid, F);
  Eigen::VectorXd start = expected;
  for (std::size_t i = 0; i < boundary.size(); ++i) {
    if (!boundary[i]) start.segment<3>(3 * static_cast<Eigen::Index>(i)).array() += 2e-3;
  }
  EXPECT_LT((heldShape(solid, start, boundary) - expected).cwiseAbs().maxCoeff(), 1e-9);
}

TEST(HeldSolid, APulledBarFollowsHookesLaw) {
  constexpr double kStrain = 1e-3;
  const HexSolid solid = solidOf(bar(), 0.02);
  // A free bar would become thinner at once; so the ends may do so, too.
  Eigen::Matrix3d F =
      Eigen::Vector3d(1.0 + kStrain, 1.0 - kPoissonRatio * kStrain, 1.0 - kPoissonRatio * kStrain)
          .asDiagonal();
  const Eigen::VectorXd shape = heldShape(solid, deformed(solid, F), endsOf(solid, 0.0999));
  EXPECT_LT((shape - deformed(solid, F)).cwiseAbs().maxCoeff(), 1e-6);
  const double expected = kModulus_pa * kStrain * 0.1 * 0.04;
  EXPECT_NEAR(pullAt(solid, shape).x(), expected, 3e-3 * expected);
}

TEST(HeldSolid, TheVolumeChangesAsPoissonsRatioSays) {
  constexpr double kStrain = 0.02;
  for (const double poisson_ratio : {0.0, 0.2, 0.4}) {
    const HexSolid solid = solidOf(box({0.2, 0.02, 0.02}), 0.01, poisson_ratio);
    Eigen::VectorXd start = solid.rest();
    for (Eigen::Index x = 0; x < start.size(); x += 3) start[x] *= 1.0 + kStrain;
    const Points shape = asPoints(heldShape(solid, start, endsOf(solid, 0.0999)));
    // Far from the ends, which are held as they are.
    double width = 0.0;
    for (Eigen::Index i = 0; i < shape.rows(); ++i) {
      if (std::abs(solid.grid().nodes(i, 0)) < 1e-9) width = std::max(width, shape(i, 1));
    }
    EXPECT_NEAR(width / 0.01, 1.0 - poisson_ratio * kStrain, 0.04 * kStrain) << poisson_ratio;
  }
}

TEST(HeldSolid, ABentBeamIsAsStiffAsTheorySays) {
  constexpr double kAside = 1e-3, kLength = 0.2, kWidth = 0.04;  // [m]
  const HexSolid solid = solidOf(box({kLength, kWidth, kWidth}), 0.01, 0.0);
  Eigen::VectorXd start = solid.rest();
  for (Eigen::Index i = 0; i < start.size(); i += 3) {
    if (start[i] > 0.0999) start[i + 2] += kAside;
  }
  const Eigen::VectorXd shape = heldShape(solid, start, endsOf(solid, 0.0999));
  // Both ends keep their direction: bending and shear of a Timoshenko beam.
  const double inertia = std::pow(kWidth, 4) / 12.0, shear = 0.5 * kModulus_pa * kWidth * kWidth * 5.0 / 6.0;
  const double expected = kAside / (std::pow(kLength, 3) / (12.0 * kModulus_pa * inertia) + kLength / shear);
  EXPECT_NEAR(pullAt(solid, shape).z(), expected, 0.05 * expected);
}

/// The weight of a density on all nodes, along -z.
Eigen::VectorXd weightOn(const HexSolid& solid, double density) {
  Eigen::VectorXd weight = Eigen::VectorXd::Zero(solid.unknowns());
  for (Eigen::Index i = 0; i < solid.grid().nodes.rows(); ++i)
    weight[3 * i + 2] = -9.81 * density * solid.nodalVolumes()[i];
  return weight;
}

std::vector<bool> leftEndOf(const HexSolid& solid, double half_m) {
  std::vector<bool> held = endsOf(solid, half_m);
  for (std::size_t i = 0; i < held.size(); ++i)
    held[i] = held[i] && solid.grid().nodes(static_cast<Eigen::Index>(i), 0) < 0.0;
  return held;
}

TEST(HeldSolid, AClampedBeamSagsAsTheorySays) {
  constexpr double kLength = 0.2, kWidth = 0.02, kDensity = 2.0;
  const HexSolid solid = solidOf(box({kLength, kWidth, kWidth}), 0.005, 0.0);
  const Points shape =
      asPoints(heldShape(solid, solid.rest(), leftEndOf(solid, 0.0999), weightOn(solid, kDensity)));
  // Euler and Bernoulli, and Timoshenko's share of shear.
  const double load = 9.81 * kDensity * kWidth * kWidth, inertia = std::pow(kWidth, 4) / 12.0;
  const double shear = 0.5 * kModulus_pa * kWidth * kWidth * 5.0 / 6.0;
  const double expected =
      load * std::pow(kLength, 4) / (8.0 * kModulus_pa * inertia) + load * kLength * kLength / (2.0 * shear);
  double tip = 0.0;
  for (Eigen::Index i = 0; i < shape.rows(); ++i) tip = std::max(tip, solid.grid().nodes(i, 2) - shape(i, 2));
  EXPECT_NEAR(tip, expected, 0.05 * expected);
  EXPECT_LT(tip, 0.05 * kLength);
}

TEST(HeldSolid, WhatHoldsABodyCarriesItsWeight) {
  const HexSolid solid = solidOf(bar(), 0.02);
  const std::vector<bool> held = leftEndOf(solid, 0.0999);
  const Eigen::VectorXd weight = weightOn(solid, 200.0);
  const Eigen::VectorXd shape = heldShape(solid, solid.rest(), held, weight);
  const Points forces = asPoints(holdingForces(solid, shape) - weight);
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (Eigen::Index i = 0; i < forces.rows(); ++i) {
    if (held[static_cast<std::size_t>(i)]) {
      sum += forces.row(i).transpose();
    } else {
      EXPECT_LT(forces.row(i).norm(), 1e-6);
    }
  }
  EXPECT_LT((sum - 9.81 * 200.0 * 8e-4 * Eigen::Vector3d::UnitZ()).norm(), 1e-5);
}

TEST(KeyStates, PassThroughTheStatesAndRepeatAParabola) {
  std::vector<Points> states;
  for (const double t : {0.0, 1.0, 2.0, 3.0, 4.0}) states.push_back(Points::Constant(2, 3, t * t));
  const KeyStates keys(10.0, 14.0, states);
  for (const auto& [time, value] : {std::pair(9.0, 0.0), std::pair(10.0, 0.0), std::pair(12.0, 4.0),
                                    std::pair(12.5, 6.25), std::pair(14.0, 16.0), std::pair(15.0, 16.0)})
    EXPECT_NEAR(keys.at(time)(1, 2), value, 1e-12) << time;
}

}  // namespace
}  // namespace softbody::virtual_camera
