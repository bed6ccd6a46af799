#include "softbody_tracking/known/followed_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

#include "fixtures/synthetic_scene.h"

namespace softbody {
namespace {

constexpr Nanoseconds kInterval = 33'333'333;

MeshTopology topology(std::uint32_t revision = 0) {
  MeshTopology result = makeBox().surface;
  result.revision = revision;
  return result;
}

/// @param x of the body's middle [m].
MeshState stateAt(double x, Nanoseconds stamp, std::uint32_t revision = 0) {
  MeshState state;
  state.revision = revision;
  state.observed = stamp;
  state.vertices = topology().rest_vertices.rowwise() + Eigen::RowVector3d(x, 0.0, 0.6);
  return state;
}

double middleAt(const FollowedSurface& surface, Nanoseconds stamp) {
  return surface.at(stamp, Eigen::Isometry3d::Identity())->surface.vertices.col(0).mean();
}

TEST(FollowedSurface, GoesOnAsItMoved) {
  FollowedSurface surface("doll");
  surface.setTopology(topology());
  for (int i = 0; i < 4; ++i) surface.addState(stateAt(0.01 * i, i * kInterval));
  EXPECT_NEAR(middleAt(surface, 4 * kInterval), 0.04, 1e-9);
  EXPECT_NEAR(surface.at(4 * kInterval, Eigen::Isometry3d::Identity())->deviation_m, 0.0, 1e-9);
}

TEST(FollowedSurface, ItsDeviationIsHowFarItWasOff) {
  FollowedSurface surface("doll");
  surface.setTopology(topology());
  for (int i = 0; i < 3; ++i) surface.addState(stateAt(0.01 * i, i * kInterval));
  MeshState stopped = stateAt(0.02, 3 * kInterval);
  stopped.standard_deviation.assign(static_cast<std::size_t>(stopped.vertices.rows()), 0.001f);
  surface.addState(stopped);
  EXPECT_NEAR(surface.at(4 * kInterval, Eigen::Isometry3d::Identity())->deviation_m, std::hypot(0.01, 0.001),
              1e-6);
}

TEST(FollowedSurface, IsInTheCamerasFrame) {
  FollowedSurface surface("doll");
  surface.setTopology(topology());
  surface.addState(stateAt(0.0, 0));
  const Eigen::Isometry3d pose(Eigen::Translation3d(0.0, 0.2, 0.0));
  EXPECT_NEAR(surface.at(0, pose)->surface.vertices.col(1).mean(), 0.2, 1e-9);
}

TEST(FollowedSurface, AStateWaitsForItsTopology) {
  FollowedSurface surface("doll");
  surface.addState(stateAt(0.0, 0));
  EXPECT_FALSE(surface.at(0, Eigen::Isometry3d::Identity()));
  surface.setTopology(topology());
  EXPECT_TRUE(surface.at(0, Eigen::Isometry3d::Identity()));
  surface.addState(stateAt(0.0, kInterval, 1));
  EXPECT_FALSE(surface.at(kInterval, Eigen::Isometry3d::Identity()));
  surface.setTopology(topology(1));
  EXPECT_TRUE(surface.at(kInterval, Eigen::Isometry3d::Identity()));
}

TEST(FollowedSurface, AnOldStateSaysNothing) {
  FollowedSurface surface("doll");
  surface.setTopology(topology());
  surface.addState(stateAt(0.0, 0));
  EXPECT_TRUE(surface.at(400'000'000, Eigen::Isometry3d::Identity()));
  EXPECT_FALSE(surface.at(600'000'000, Eigen::Isometry3d::Identity()));
  surface.forgetStates();
  EXPECT_FALSE(surface.hasState());
}

TEST(FollowedSurface, WhatDoesNotFitIsRefusedAndTheLastOneStays) {
  FollowedSurface surface("doll");
  surface.setTopology(topology());
  surface.addState(stateAt(0.0, 0));
  MeshTopology broken = topology();
  broken.triangles(3, 1) = -1;
  EXPECT_THROW(surface.setTopology(broken), std::invalid_argument);
  MeshState shorter = stateAt(0.5, kInterval);
  shorter.vertices.conservativeResize(5, 3);
  EXPECT_THROW(surface.addState(shorter), std::invalid_argument);
  EXPECT_NEAR(middleAt(surface, 0), 0.0, 1e-9);
}

}  // namespace
}  // namespace softbody
