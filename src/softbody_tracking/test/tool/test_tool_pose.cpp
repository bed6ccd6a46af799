#include <gtest/gtest.h>

#include "fixtures/tool_scene.h"
#include "tool/pose_motion.h"
#include "tool/tool_pose.h"

namespace softbody {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

Vector6 randomMove(double position_m, double rotation_rad, std::mt19937* random) {
  std::normal_distribution<double> normal;
  Vector6 move;
  for (int k = 0; k < 6; ++k) move(k) = (k < 3 ? position_m : rotation_rad) * normal(*random);
  return move;
}

MarkerMeasurement exactMeasurement(const ToolMarker& marker, const Eigen::Isometry3d& T) {
  MarkerMeasurement measurement;
  measurement.marker = &marker;
  const Eigen::Matrix<double, 3, 4> corners = T * markerCorners(marker);
  for (int k = 0; k < 4; ++k) measurement.corners.col(k) = toolCamera().project(corners.col(k));
  for (int i = 0; i < 25; ++i) {
    const Eigen::Vector3d place((i % 5 - 2) * 0.1 * marker.size_m, (i / 5 - 2) * 0.1 * marker.size_m, 0.0);
    measurement.depth_points.push_back(T * (marker.T_tool_marker * place));
  }
  return measurement;
}

TEST(ToolPose, RefinementFindsTheExactPoseFromAStartNearby) {
  std::mt19937 random(1);
  for (int i = 0; i < 50; ++i) {
    const ToolMarker marker =
        toolMarker(1, 0.05, movedPose(Eigen::Isometry3d::Identity(), randomMove(0.03, 0.5, &random)));
    const Eigen::Isometry3d truth = slanted(0.6, &random) * marker.T_tool_marker.inverse();
    const MarkerMeasurement measurement = exactMeasurement(marker, truth);
    const PoseEstimate estimate =
        refinePose({&measurement}, toolCamera(), movedPose(truth, randomMove(0.01, 0.1, &random)), {});
    EXPECT_LT(poseDifference(truth, estimate.T_camera_tool).norm(), 1e-5);
    EXPECT_LT(estimate.cost, 1e-6);
    EXPECT_NEAR(depthOffset({&measurement}, estimate.T_camera_tool), 0.0, 1e-6);
  }
}

TEST(ToolPose, PlanarPosesHoldTheTruthAndFitTheCorners) {
  std::mt19937 random(2);
  for (int i = 0; i < 50; ++i) {
    const ToolMarker marker = toolMarker(1, 0.05);
    const Eigen::Isometry3d truth = slanted(0.7, &random);
    const MarkerMeasurement measurement = exactMeasurement(marker, truth);
    const auto poses = planarPoses(measurement, toolCamera());
    ASSERT_GE(poses.size(), 1u);
    EXPECT_LT(poseDifference(truth, poses[0]).norm(), 1e-3);
    EXPECT_LT(reprojectionRms(measurement, toolCamera(), poses[0]), 0.02);
  }
}

/// The covariance against the spread of estimates from corners and depths with the noise that it assumes.
TEST(ToolPose, CovarianceIsTheSpreadOfEstimates) {
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  ToolTrackerConfig config;
  config.depth_independent_samples = 25;  // the depths here are independent
  const ToolMarker marker = toolMarker(1, 0.05);
  const Eigen::Isometry3d truth = slanted(0.6, &random);
  Eigen::Matrix<double, 6, 6> spread = Eigen::Matrix<double, 6, 6>::Zero(), claimed = spread;
  constexpr int kTrials = 400;
  for (int i = 0; i < kTrials; ++i) {
    MarkerMeasurement measurement = exactMeasurement(marker, truth);
    for (int k = 0; k < 8; ++k) measurement.corners(k % 2, k / 2) += config.corner_std_px * normal(random);
    for (Eigen::Vector3d& p : measurement.depth_points)
      p *= 1.0 + config.depth_std_1_m * p.z() * normal(random);
    const PoseEstimate estimate = refinePose({&measurement}, toolCamera(), truth, config);
    const Vector6 e = poseDifference(truth, estimate.T_camera_tool);
    spread += e * e.transpose() / kTrials;
    claimed += estimate.covariance / kTrials;
  }
  for (int k = 0; k < 6; ++k) {
    EXPECT_LT(spread(k, k), 1.5 * claimed(k, k)) << k;
    EXPECT_GT(spread(k, k), 0.5 * claimed(k, k)) << k;
  }
}

TEST(PoseMotion, MovesAndDifferencesAreInverse) {
  std::mt19937 random(4);
  for (int i = 0; i < 100; ++i) {
    const Eigen::Isometry3d from = slanted(1.0, &random);
    const Vector6 move = randomMove(0.1, 0.5, &random);
    EXPECT_LT((poseDifference(from, movedPose(from, move)) - move).norm(), 1e-9);
  }
}

TEST(PoseMotion, LearnsAConstantVelocityAndIsLessSureOfLaterTimes) {
  Vector6 velocity;
  velocity << 0.2, -0.1, 0.05, 0.5, -1.0, 0.3;
  const Eigen::Isometry3d start = facing({0.0, 0.0, 0.5});
  const PoseCovariance covariance = 1e-8 * PoseCovariance::Identity();
  PoseMotion motion(start, covariance, 0);
  for (int i = 1; i <= 20; ++i)
    motion.update(movedPose(start, 0.03 * i * velocity), covariance, i * 30'000'000LL);
  double spread = 0.0;
  for (int i = 21; i < 26; ++i) {
    const PoseMotion::Prediction predicted = motion.predict(i * 30'000'000LL);
    EXPECT_LT(poseDifference(movedPose(start, 0.03 * i * velocity), predicted.pose).norm(), 2e-3);
    EXPECT_GT(predicted.covariance.trace(), spread);
    spread = predicted.covariance.trace();
  }
}

}  // namespace
}  // namespace softbody
