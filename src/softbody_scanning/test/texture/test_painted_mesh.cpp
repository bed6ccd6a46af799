#include "texture/painted_mesh.h"

#include <gtest/gtest.h>

#include "fixtures/painted_ball.h"
#include "softbody_common/statistics/random.h"
#include "texture/diffused_colors.h"
#include "texture/pixel_color.h"

namespace softbody::scanning {
namespace {

/// Colour of a place in the picture.
cv::Vec3f painted(const PaintedMesh& mesh, int triangle, const Eigen::Vector3d& weights) {
  const Eigen::RowVector3d uv = weights.transpose() * mesh.texture_coordinates.middleRows<3>(3 * triangle);
  return colorAt(mesh.picture, uv.x() * mesh.picture.cols - 0.5, (1.0 - uv.y()) * mesh.picture.rows - 0.5);
}

Eigen::Vector3d someWeights(int triangle, int sample) {
  const std::uint64_t h = hash(static_cast<std::uint64_t>(triangle), static_cast<std::uint64_t>(sample));
  const double root = std::sqrt(unit(h)), share = unit(hash(h));
  return {1.0 - root, root * (1.0 - share), root * share};
}

/// Calls visit(triangle, place, colour) for places of all triangles.
template <typename Visit>
void forEachPlace(const PaintedMesh& mesh, const Visit& visit) {
  for (int t = 0; t < mesh.mesh.triangles.rows(); ++t) {
    for (int sample = 0; sample < 4; ++sample) {
      const Eigen::Vector3d weights = someWeights(t, sample);
      Eigen::Vector3d place = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k)
        place += weights[k] * mesh.mesh.vertices.row(mesh.mesh.triangles(t, k)).transpose();
      visit(t, place, painted(mesh, t, weights));
    }
  }
}

/// Mean of |difference| from the true colour where the ball was seen, in steps of 255.
double meanError(const PaintedMesh& mesh) {
  double sum = 0.0, count = 0.0;
  forEachPlace(mesh, [&](int t, const Eigen::Vector3d& place, const cv::Vec3f& color) {
    if (mesh.frame[static_cast<std::size_t>(t)] < 0) return;
    sum += cv::norm(color - ballColor(place), cv::NORM_L1) / 3.0;
    count += 1.0;
  });
  return sum / count;
}

double reddest(const PaintedMesh& mesh) {
  double most = -255.0;
  forEachPlace(mesh, [&](int, const Eigen::Vector3d&, const cv::Vec3f& color) {
    most = std::max(most, static_cast<double>(color[2] - color[1]));
  });
  return most;
}

constexpr double kTexel_m = (kCameraDistance - kBallRadius) / 400.0;
constexpr double kGradient = 2.0 * M_PI / kWave_m * kAmplitude;  // steps of 255 per metre

TEST(PaintedMesh, ShowsTheTrueColours) {
  const TriangleMesh mesh = ballMesh();
  const PaintedMesh painted = paintMesh(mesh, walkAround(mesh), {});
  EXPECT_LT(meanError(painted), 0.25 * kTexel_m * kGradient);
  EXPECT_EQ(painted.texture_coordinates.rows(), 3 * mesh.triangles.rows());
  EXPECT_GE(painted.texture_coordinates.minCoeff(), 0.0);
  EXPECT_LE(painted.texture_coordinates.maxCoeff(), 1.0);
}

TEST(PaintedMesh, ExposuresAndDarkCornersLeaveNoSteps) {
  const TriangleMesh mesh = ballMesh();
  const PaintedMesh painted = paintMesh(mesh, walkAround(mesh, {0.8, 1.2, 1.0, 0.9, 1.1}), {});
  // The mean of the logarithms is -0.009.
  EXPECT_LT(meanError(painted), 0.25 * kTexel_m * kGradient + 0.02 * 110.0);
}

TEST(PaintedMesh, AHandBeforeTheBallLeavesNoRed) {
  const TriangleMesh mesh = ballMesh();
  std::vector<KeyFrame> frames = walkAround(mesh);
  const double without = reddest(paintMesh(mesh, frames, {}));
  ASSERT_LT(without, 0.0);
  std::vector<KeyFrame> only_color = walkAround(mesh);
  for (const std::size_t f : {2, 8, 15, 21})
    cv::Mat3b(only_color[f].color, cv::Rect(150, 0, 25, 240)).setTo(cv::Vec3b(20, 20, 220));
  EXPECT_LT(reddest(paintMesh(mesh, only_color, {})), 5.0);
  for (KeyFrame& frame : frames) {  // in every frame, and nearer
    const cv::Rect hand(170, 0, 60, 240);
    cv::Mat3b(frame.color, hand).setTo(cv::Vec3b(20, 20, 220));
    cv::Mat1f(frame.depth, hand).setTo(0.25f);
  }
  EXPECT_LT(reddest(paintMesh(mesh, frames, {})), 5.0);
}

TEST(PaintedMesh, WhatNoFrameSawTakesTheColoursAround) {
  const TriangleMesh mesh = ballMesh();
  const PaintedMesh painted = paintMesh(mesh, walkAround(mesh), {});
  std::size_t unseen = 0;
  forEachPlace(painted, [&](int t, const Eigen::Vector3d& place, const cv::Vec3f& color) {
    if (painted.frame[static_cast<std::size_t>(t)] >= 0) return;
    ++unseen;
    EXPECT_LT(place.z(), 0.0);
    for (int k = 0; k < 3; ++k) {
      EXPECT_GT(color[k], 35.0f);
      EXPECT_LT(color[k], 175.0f);
    }
  });
  EXPECT_GT(unseen, 100u);
}

TEST(PaintedMesh, ASmallPictureHasLargerTexels) {
  const TriangleMesh mesh = ballMesh();
  const PaintedMesh painted = paintMesh(mesh, walkAround(mesh), {0.006, 256});
  EXPECT_LE(std::max(painted.picture.cols, painted.picture.rows), 256);
  EXPECT_LT(meanError(painted), kTexel_m * kGradient);
}

TEST(PaintedMesh, SaysIfNoFrameSeesTheObject) {
  const TriangleMesh mesh = ballMesh();
  std::vector<KeyFrame> frames = walkAround(mesh);
  for (KeyFrame& frame : frames) frame.depth.setTo(0.1f);
  EXPECT_THROW(paintMesh(mesh, frames, {}), std::invalid_argument);
  EXPECT_THROW(paintMesh(mesh, {}, {}), std::invalid_argument);
}

TEST(DiffusedColors, AreMeansOfTheirNeighbours) {
  const TriangleMesh mesh = ballMesh(8, 10);
  const auto vertices = static_cast<std::size_t>(mesh.vertices.rows());
  std::vector<bool> known(vertices, false);
  Points colors = Points::Zero(mesh.vertices.rows(), 3);
  for (std::size_t v = 0; v < vertices; v += 5) {
    known[v] = true;
    colors.row(static_cast<Eigen::Index>(v)) << static_cast<double>(v), 50.0, 100.0;
  }
  diffuseColors(mesh.triangles, known, &colors);
  EXPECT_LT((colors.col(1).array() - 50.0).abs().maxCoeff(), 1e-6);
  for (std::size_t v = 0; v < vertices; ++v) {
    if (known[v]) continue;
    double sum = 0.0, count = 0.0;
    for (const auto& t : mesh.triangles.rowwise()) {
      for (int k = 0; k < 3; ++k) {
        if (t[k] != static_cast<int>(v)) continue;
        sum += colors(t[(k + 1) % 3], 0) + colors(t[(k + 2) % 3], 0);
        count += 2.0;
      }
    }
    EXPECT_NEAR(colors(static_cast<Eigen::Index>(v), 0), sum / count, 1e-3);
  }
}

}  // namespace
}  // namespace softbody::scanning
