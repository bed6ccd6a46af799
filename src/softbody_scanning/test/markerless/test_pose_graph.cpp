#include <gtest/gtest.h>

#include "fixtures/seen_scene.h"
#include "markerless/pose_graph.h"

namespace softbody::scanning {
namespace {

constexpr int kFrames = 40;

/// Poses on a circle, relative to the first one.
std::vector<Eigen::Isometry3d> trueWay() {
  std::vector<Eigen::Isometry3d> poses = walkAround(kFrames, 0.5);
  const Eigen::Isometry3d first = poses.front();
  for (Eigen::Isometry3d& pose : poses) pose = pose * first.inverse();
  return poses;
}

Vector6 noise(std::mt19937* random, double std) {
  std::normal_distribution<double> normal(0.0, std);
  Vector6 x;
  for (double& value : x) value = normal(*random);
  return x;
}

/// Measurements of neighbours; the last ones see the first ones again.
std::vector<PoseEdge> measured(const std::vector<Eigen::Isometry3d>& truth, double std,
                               std::mt19937* random) {
  std::vector<PoseEdge> edges;
  for (int step = 1; step <= 3; ++step)
    for (int a = 0; a < kFrames; ++a) {
      const int b = (a + step) % kFrames;
      edges.push_back({a, b, smallMotion(noise(random, std)) * truth[b] * truth[a].inverse(),
                       PoseCovariance(PoseCovariance::Identity() * 1e-6)});
    }
  return edges;
}

/// Poses that drift.
std::vector<Eigen::Isometry3d> drifting(const std::vector<Eigen::Isometry3d>& truth) {
  std::vector<Eigen::Isometry3d> poses;
  for (int i = 0; i < kFrames; ++i) poses.push_back(smallMotion(Vector6::Constant(5e-4 * i)) * truth[i]);
  return poses;
}

TEST(PoseGraph, closesTheLoopExactlyWithoutNoise) {
  std::mt19937 random(1);
  const auto truth = trueWay();
  auto poses = drifting(truth);
  adjustPoses(measured(truth, 0.0, &random), &poses);
  for (int i = 0; i < kFrames; ++i) EXPECT_LT(motionVector(poses[i] * truth[i].inverse()).norm(), 1e-6) << i;
}

TEST(PoseGraph, tellsHowSureItIs) {
  const auto truth = trueWay();
  double squared = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    std::mt19937 random(seed);
    auto poses = drifting(truth);
    const auto covariances = adjustPoses(measured(truth, 1e-3, &random), &poses);
    for (int i = 1; i < kFrames; ++i) {
      const Vector6 error = motionVector(poses[i] * truth[i].inverse());
      squared += error.dot(covariances[i].inverse() * error) / 6.0;
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squared / count), 1.0, 0.3);
}

TEST(PoseGraph, aWrongLoopDoesNotBendTheWay) {
  std::mt19937 random(1);
  const auto truth = trueWay();
  auto poses = truth;
  auto edges = measured(truth, 0.0, &random);
  edges.push_back(
      {0, kFrames / 2, Eigen::Isometry3d::Identity(), PoseCovariance(PoseCovariance::Identity() * 1e-6)});
  adjustPoses(edges, &poses);
  for (int i = 0; i < kFrames; ++i) EXPECT_LT(motionVector(poses[i] * truth[i].inverse()).norm(), 2e-3) << i;
}

}  // namespace
}  // namespace softbody::scanning
