#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "fixtures/tool_scene.h"
#include "tool/expected_markers.h"

namespace softbody {
namespace {

constexpr int kCells = 6;  // of DICT_4X4_50

ToolDescription twoFaces() {
  const Eigen::Isometry3d beside =
      Eigen::Translation3d(0.07, 0.0, -0.01) * Eigen::AngleAxisd(0.6, Eigen::Vector3d::UnitY());
  return {"DICT_4X4_50", {toolMarker(7, 0.04), toolMarker(12, 0.04, beside)}, Points(0, 3), {}};
}

/// Independent errors of place [m] and turn [rad], but the first two of each are correlated.
PoseCovariance covarianceOf(double place_m, double turn_rad) {
  PoseCovariance covariance = PoseCovariance::Zero();
  covariance.diagonal() << Eigen::Vector3d::Constant(place_m * place_m),
      Eigen::Vector3d::Constant(turn_rad * turn_rad);
  covariance(0, 1) = covariance(1, 0) = 0.8 * place_m * place_m;
  covariance(3, 4) = covariance(4, 3) = -0.8 * turn_rad * turn_rad;
  return covariance;
}

/// Without the margin, so that the turns' nonlinearity does not matter.
TEST(ExpectedMarkers, LieInTheRegionInNearlyAllPosesThatArePredicted) {
  const ToolDescription tool = twoFaces();
  const Pinhole camera = toolCamera();
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (const double place_m : {0.0005, 0.002, 0.005}) {
    const Eigen::Isometry3d pose = slanted(0.3, &random);
    const PoseMotion::Prediction predicted{pose, covarianceOf(place_m, 4.0 * place_m)};
    const auto expected = expectedMarkers(tool, kCells, camera, predicted);
    ASSERT_TRUE(expected);
    const PoseCovariance root = predicted.covariance.llt().matrixL();
    int outside = 0;
    constexpr int kPoses = 3000;
    for (int i = 0; i < kPoses; ++i) {
      const Eigen::Isometry3d moved = movedPose(
          pose,
          root * Eigen::Matrix<double, 6, 1>::NullaryExpr([&](Eigen::Index) { return normal(random); }));
      for (const ToolMarker& marker : tool.markers) {
        const Eigen::Matrix<double, 3, 4> corners = moved * markerCorners(marker);
        for (int k = 0; k < 4; ++k) {
          const Eigen::Vector2d p = camera.project(corners.col(k));
          const cv::Point pixel(static_cast<int>(p.x()), static_cast<int>(p.y()));
          outside += expected->region.contains(pixel) ? 0 : 1;
        }
      }
    }
    EXPECT_LT(outside, 8 * kPoses / 1000) << place_m;
  }
}

TEST(ExpectedMarkers, RegionOfACertainPoseIsTheMarkersWithOneCellAround) {
  ToolDescription tool = twoFaces();
  tool.markers.pop_back();
  const auto regionOf = [&](double place_m) {
    return expectedMarkers(tool, kCells, toolCamera(), {facing({0.0, 0.0, 0.5}), covarianceOf(place_m, 0.0)});
  };
  const auto certain = regionOf(0.0), uncertain = regionOf(0.002);
  ASSERT_TRUE(certain && uncertain);
  const double side_px = 0.04 / 0.5 * toolCamera().fx, cell_px = side_px / kCells;
  EXPECT_NEAR(certain->cell_px, cell_px, 0.02 * cell_px);
  EXPECT_NEAR(certain->region.width, side_px + 2.0 * cell_px, 1.0);
  const double sigma_px = 0.002 / 0.5 * toolCamera().fx;
  EXPECT_NEAR(uncertain->region.width - certain->region.width, 2.0 * 3.5 * sigma_px, 2.0);
}

TEST(ExpectedMarkers, AMarkerBesideTheCameraHasNoRegionAndOneOutOfViewAnEmptyOne) {
  const auto at = [](const Eigen::Vector3d& place) {
    return expectedMarkers(twoFaces(), kCells, toolCamera(), {facing(place), covarianceOf(0.001, 0.001)});
  };
  EXPECT_FALSE(at({0.0, 0.0, 0.005}));
  ASSERT_TRUE(at({1.0, 0.0, 0.5}));
  EXPECT_TRUE(at({1.0, 0.0, 0.5})->region.empty());
}

}  // namespace
}  // namespace softbody
