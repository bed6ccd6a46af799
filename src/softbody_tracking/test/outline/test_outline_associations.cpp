#include "outline/outline_associations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <opencv2/imgproc.hpp>
#include <random>

#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

constexpr double kFocal = 615.0;                   // [px]
constexpr double kBoxDepth = 0.5;                  // [m] of the box's centre
constexpr double kRimDepth = kBoxDepth - 0.02;     // [m] of the rim, the box's face towards the camera
constexpr double kPixel = kRimDepth / kFocal;      // [m] that one pixel shows there
const Eigen::Vector3d kFlat(0.0, 0.0, kBoxDepth);  // the box as seen from above
const cv::Rect kRightHalf(330, 0, 310, 480);

/// A box seen from above, turned in the image so that its outline crosses the pixels everywhere.
class OutlineAssociationsTest : public ::testing::Test {
 protected:
  OutlineAssociationsTest() { learnColors(); }

  static Eigen::Isometry3d poseAt(const Eigen::Vector3d& position) {
    return Eigen::Translation3d(position) * Eigen::AngleAxisd(0.3, Eigen::Vector3d::UnitZ());
  }
  Points boxAt(const Eigen::Vector3d& position) const {
    return transformed(box_.volume.rest_vertices, poseAt(position));
  }
  Points shiftedBox(double pixels) const { return boxAt(kFlat + Eigen::Vector3d(pixels * kPixel, 0.0, 0.0)); }
  void show(const Eigen::Vector3d& position) { frame_ = renderFrame(box_, boxAt(position), 1); }

  /// The frame of a camera with the same view and more or fewer pixels.
  void resizeFrame(const RgbdFrame& frame, double factor) {
    frame_ = frame;
    cv::resize(frame.color, frame_.color, cv::Size(), factor, factor, cv::INTER_NEAREST);
    cv::resize(frame.depth, frame_.depth, cv::Size(), factor, factor, cv::INTER_NEAREST);
    Pinhole& camera = frame_.camera;
    camera.width = frame_.depth.cols, camera.height = frame_.depth.rows;
    camera.fx *= factor, camera.fy *= factor;
    camera.cx = factor * (camera.cx + 0.5) - 0.5, camera.cy = factor * (camera.cy + 0.5) - 0.5;
  }

  /// From the frame as it is, with the prediction at its true position.
  void learnColors() { learnColors(boxAt(kFlat)); }
  void learnColors(const Points& vertices) {
    surface_ = {model_, frame_.camera, vertices, &memory_};
    colors_.reset();
    learnColorsOf(frame_, surface_, &colors_);
  }

  OutlineAssociations associate(const Points& predicted,
                                const Eigen::Isometry3d& motion = Eigen::Isometry3d::Identity(),
                                double weight = 1.0) {
    surface_ = {model_, frame_.camera, predicted, &memory_};
    return associateOutline(frame_, surface_.image(), sampleOutline(surface_),
                            RigidMotions(surface_.pieceCount(), motion), labelsAt(frame_, surface_, colors_),
                            {weight, meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets)});
  }
  std::vector<Association> associateShifted(double pixels) {
    return associate(shiftedBox(pixels)).associations;
  }

  /// Measured minus true distance across the outline [px], if the prediction is shifted by some pixels.
  static double error(const Association& a, double pixels) {
    return (a.residual() + pixels * kPixel * a.normal.x()) / kPixel;
  }

  static double meanError(const std::vector<Association>& found, double pixels) {
    double sum = 0.0;
    for (const Association& a : found) sum += error(a, pixels);
    return sum / static_cast<double>(found.size());
  }
  static double meanAbsoluteError(const std::vector<Association>& found, double pixels) {
    double sum = 0.0;
    for (const Association& a : found) sum += std::abs(error(a, pixels));
    return sum / static_cast<double>(found.size());
  }
  /// The shift along x that all associations together ask for [px].
  static double pulledBy(const std::vector<Association>& found) {
    double sum = 0.0, weights = 0.0;
    for (const Association& a : found) {
      sum += a.weight * a.normal.x() * a.residual() / kPixel;
      weights += a.weight * a.normal.x() * a.normal.x();
    }
    return sum / weights;
  }
  void expectOnlyTheLeftHalf() {
    for (const double pixels : {4.0, -4.0}) {
      const std::vector<Association> found = associateShifted(pixels);
      EXPECT_GT(found.size(), 50u);
      for (const Association& a : found) EXPECT_LT(frame_.camera.project(a.predicted).x(), kRightHalf.x);
      EXPECT_LT(std::abs(meanError(found, pixels)), 0.3);
    }
  }

  BoxBody box_ = makeBox();
  std::shared_ptr<const SurfaceModel> model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  RgbdFrame frame_ = renderFrame(box_, boxAt(kFlat), 1);
  RasterMemory memory_;
  PredictedSurface surface_{model_, frame_.camera, boxAt(kFlat), &memory_};
  RegionColors colors_;
};

/// Sub-pixel, and without a dead zone. Single samples are as inexact as a pixel; at corners more.
TEST_F(OutlineAssociationsTest, PullAShiftedOutlineBack) {
  for (const double pixels : {0.0, 0.3, -0.5, 0.7, -1.0, 1.5, -2.0, 3.0, -4.0, 6.0, -6.0}) {
    const std::vector<Association> found = associateShifted(pixels);
    EXPECT_GT(found.size(), 100u);
    EXPECT_LT(std::abs(meanError(found, pixels)), 0.2) << pixels;
    EXPECT_LT(meanAbsoluteError(found, pixels), 0.7) << pixels;
    EXPECT_NEAR(pulledBy(found), -pixels, 0.3);
  }
}

TEST_F(OutlineAssociationsTest, OnlyTheDistanceAcrossTheOutlineCounts) {
  for (const Association& a : associateShifted(8.0)) {
    EXPECT_NEAR(a.normal.norm(), 1.0, 1e-9);
    EXPECT_NEAR(a.normal.dot(a.measured.normalized()), 0.0, 1e-9) << "along its ray nothing counts";
    EXPECT_LT((positionOf(a.place, surface_.volumeVertices(), box_.volume.tets) - a.predicted).norm(), 1e-6);
  }
}

/// Turned, shifted bodies find back.
TEST_F(OutlineAssociationsTest, LeadBackToTheBody) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> shift(-8.0 * kPixel, 8.0 * kPixel), angle(-0.05, 0.05);
  const Points truth = boxAt(kFlat);
  for (int i = 0; i < 5; ++i) {
    const Eigen::Isometry3d error = Eigen::Translation3d(shift(random), shift(random), kBoxDepth) *
                                    Eigen::AngleAxisd(angle(random), Eigen::Vector3d::UnitZ()) *
                                    Eigen::Translation3d(0.0, 0.0, -kBoxDepth);
    Points predicted = transformed(truth, error);
    for (int step = 0; step < 6; ++step) {
      const OutlineAssociations found = associate(predicted);
      predicted = transformed(predicted, rigidStep(refsTo(found.associations)));
    }
    const Points offsets = predicted - truth;
    EXPECT_LT(offsets.leftCols<2>().rowwise().norm().mean(), 0.3 * kPixel);
  }
}

/// Beyond the predicted outline the body goes on, but far behind the edge: a side has come into view. Its far
/// end is not the end of the edge.
TEST_F(OutlineAssociationsTest, AnEdgeIsNotDrawnToTheEndOfAnotherPart) {
  const auto pulled = [&](float farther_m) {
    show(kFlat);
    const cv::Mat1b body = frame_.depth < 1.0f;
    cv::Mat1b grown;
    cv::dilate(body, grown, cv::Mat(), cv::Point(-1, -1), 6);
    const cv::Mat3b color = frame_.color.clone();
    for (int v = 0; v < body.rows; ++v) {
      for (int u = 0; u < body.cols; ++u) {
        if (body(v, u) != 0 || grown(v, u) == 0) continue;
        frame_.color(v, u) = color(240, 320);
        frame_.depth(v, u) = frame_.depth(240, 320) + farther_m;
      }
    }
    return associate(boxAt(kFlat)).associations.size();
  };
  const std::size_t same_surface = pulled(0.0f);
  EXPECT_GT(same_surface, 100u) << "the body is larger than predicted";
  EXPECT_LT(pulled(0.025f), same_surface / 10) << "a side, seen at an angle";
}

TEST_F(OutlineAssociationsTest, MoveWithTheirSamples) {
  const Eigen::Isometry3d error(Eigen::Translation3d(12.0 * kPixel, -7.0 * kPixel, 0.0));
  const OutlineAssociations found = associate(transformed(boxAt(kFlat), error), error.inverse());
  EXPECT_GT(found.associations.size(), 100u);
  EXPECT_LT(meanAbsoluteError(found.associations, 0.0), 0.4);
  EXPECT_LT(found.disagreement, 0.01);
}

/// What stands before the body hides where it ends.
TEST_F(OutlineAssociationsTest, OccludersSayNothing) {
  frame_.depth(kRightHalf) = 0.3f;
  expectOnlyTheLeftHalf();
}

TEST_F(OutlineAssociationsTest, ATrackedBladeSaysNothing) {
  frame_.covered = cv::Mat1b(frame_.depth.size(), static_cast<uchar>(0));
  frame_.covered(kRightHalf) = 255;
  expectOnlyTheLeftHalf();
}

TEST_F(OutlineAssociationsTest, ColorFindsTheEndWithoutDepth) {
  frame_.depth.setTo(0.0f);
  for (const double pixels : {0.3, 3.0, -6.0}) {
    const std::vector<Association> found = associateShifted(pixels);
    EXPECT_GT(found.size(), 100u);
    EXPECT_LT(std::abs(meanError(found, pixels)), 0.2);
  }
}

TEST_F(OutlineAssociationsTest, DepthFindsTheEndOfAGreyBodyBeforeGrey) {
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  learnColors();
  for (const double pixels : {0.3, 3.0, -6.0}) {
    const std::vector<Association> found = associateShifted(pixels);
    EXPECT_GT(found.size(), 100u);
    EXPECT_LT(std::abs(meanError(found, pixels)), 0.2);
  }
}

TEST_F(OutlineAssociationsTest, NeitherColorNorDepthSayNothing) {
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  learnColors();
  frame_.depth.setTo(0.0f);
  const OutlineAssociations found = associate(shiftedBox(6.0));
  EXPECT_TRUE(found.associations.empty());
  EXPECT_EQ(found.disagreement, 0.0) << "what is not seen does not disagree";
}

/// A table of the body's colour goes on from the body without a step.
TEST_F(OutlineAssociationsTest, WhatTheBodyTouchesSaysNothing) {
  frame_.color.setTo(cv::Vec3b(90, 90, 90));
  learnColors();
  frame_.depth.setTo(static_cast<float>(kRimDepth));
  for (const double pixels : {6.0, -6.0}) EXPECT_TRUE(associateShifted(pixels).empty());
}

/// A hand beside the body, at its depth. Its colour was learned with the surroundings.
TEST_F(OutlineAssociationsTest, AHandOfAnotherColorDoesNotPull) {
  const cv::Mat1b body(frame_.depth < 1.0f);
  cv::Mat1b on_hand(body.size(), static_cast<uchar>(0));
  on_hand(kRightHalf & cv::Rect(0, 180, 640, 120)).setTo(255, ~body(kRightHalf & cv::Rect(0, 180, 640, 120)));
  frame_.depth.setTo(static_cast<float>(kRimDepth), on_hand);
  frame_.color.setTo(cv::Vec3b(250, 20, 20), on_hand);
  learnColors();
  EXPECT_LT(meanAbsoluteError(associateShifted(0.0), 0.0), 0.5);
  EXPECT_LT(std::abs(meanError(associateShifted(4.0), 4.0)), 0.3);
}

TEST_F(OutlineAssociationsTest, TheImagesBorderIsNoOutline) {
  const Eigen::Vector3d half_out = kFlat + Eigen::Vector3d(0.2, 0.0, 0.0);
  show(half_out);
  for (const double pixels : {4.0, -4.0}) {
    const auto found = associate(boxAt(half_out + Eigen::Vector3d(pixels * kPixel, 0.0, 0.0))).associations;
    EXPECT_GT(found.size(), 20u);
    for (const Association& a : found) EXPECT_LT(frame_.camera.project(a.predicted).x(), 632.0);
    EXPECT_LT(std::abs(meanError(found, pixels)), 0.3);
  }
}

TEST_F(OutlineAssociationsTest, TellThePieces) {
  box_ = cutBox(box_);
  model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  ASSERT_EQ(model_->pieceCount(), 2u);
  constexpr double kShift = 6.0;  // [px] along x, of one piece
  Points predicted = boxAt(kFlat);
  for (const int v : model_->pieces()[1]) predicted(v, 0) += kShift * kPixel;
  const std::vector<Association> found = associate(predicted).associations;
  std::vector<Association> of_piece[2];
  for (const Association& a : found) of_piece[a.piece].push_back(a);
  for (const auto& associations : of_piece) EXPECT_GT(associations.size(), 20u);
  EXPECT_LT(meanAbsoluteError(of_piece[0], 0.0), 0.7);
  EXPECT_LT(meanAbsoluteError(of_piece[1], kShift), 0.7);
}

/// A side that is seen at a grazing angle: its depth grows by more than a step from pixel to pixel.
TEST_F(OutlineAssociationsTest, ASteepSideIsNoEndOfTheBody) {
  box_ = makeBox(6, 6, 6);
  for (Points* vertices : {&box_.volume.rest_vertices, &box_.surface.rest_vertices})
    *vertices *= Eigen::Vector3d(0.5, 1.0, 2.5).asDiagonal();
  model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  const Points truth = transformed(box_.volume.rest_vertices, boxPose());
  frame_ = renderFrame(box_, truth, 1);
  learnColors(truth);
  const OutlineAssociations found = associate(truth);
  EXPECT_LT(found.disagreement, 0.04);
  EXPECT_LT(meanAbsoluteError(found.associations, 0.0), 0.7);
}

/// A limb of 10 px before the rim of a trunk is gone from where it was predicted: behind its other side the
/// trunk ends, which says nothing of the limb.
TEST_F(OutlineAssociationsTest, WhatIsBeyondALimbIsNotTheLimb) {
  const BoxBody trunk = box_;
  const Eigen::Index count = trunk.volume.rest_vertices.rows();
  Points& vertices = box_.volume.rest_vertices;
  vertices.conservativeResize(2 * count, 3);
  vertices.bottomRows(count) = trunk.volume.rest_vertices * Eigen::Vector3d(0.035, 0.6, 0.2).asDiagonal();
  vertices.bottomRows(count).rowwise() += Eigen::RowVector3d(0.0835, 0.0, -0.1);
  const auto both = [&](const auto& once) {
    auto twice = once;
    twice.conservativeResize(2 * once.rows(), Eigen::NoChange);
    twice.bottomRows(once.rows()) = once.array() + static_cast<int>(count);
    return twice;
  };
  box_.volume.tets = both(trunk.volume.tets);
  box_.volume.surface = box_.surface.triangles = both(trunk.volume.surface);
  box_.surface.rest_vertices = vertices;
  model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  ASSERT_EQ(model_->pieceCount(), 2u);
  Points moved = boxAt(kFlat);
  moved.bottomRows(count).rowwise() += Eigen::RowVector3d(0.06, 0.0, 0.0);
  frame_ = renderFrame(box_, moved, 1);
  colors_.reset();
  for (const Association& a : associate(boxAt(kFlat)).associations) EXPECT_NE(a.piece, 1u);
}

TEST_F(OutlineAssociationsTest, WeightsFollowTheParameterAndTheEvidence) {
  const auto total = [&](double weight) {
    double sum = 0.0;
    const Eigen::Isometry3d still = Eigen::Isometry3d::Identity();
    for (const Association& a : associate(shiftedBox(3.0), still, weight).associations) sum += a.weight;
    return sum;
  };
  const double once = total(1.0);
  EXPECT_GT(once, 0.0);
  EXPECT_NEAR(total(2.0), 2.0 * once, 1e-9);
  EXPECT_EQ(total(0.0), 0.0);
  colors_.reset();
  EXPECT_LT(total(1.0), 0.5 * once) << "depth alone is ragged";
}

/// The area that a shift leaves on one side and covers on the other, as far as the image is sure of it.
TEST_F(OutlineAssociationsTest, DisagreementIsTheAreaBetweenTheOutlines) {
  const double height = 0.1 * std::cos(0.3) + 0.2 * std::sin(0.3), area = 0.2 * 0.1;  // [m], [m^2]
  for (const double pixels : {0.0, 0.5, -0.5}) EXPECT_LT(associate(shiftedBox(pixels)).disagreement, 0.01);
  for (const double pixels : {4.0, 6.0, 10.0}) {
    const double share = associate(shiftedBox(pixels)).disagreement * area / (2.0 * height * pixels * kPixel);
    EXPECT_LT(share, 1.1) << pixels;
    EXPECT_GT(share, pixels < 10.0 ? 0.5 : 0.9) << pixels;
  }
}

TEST_F(OutlineAssociationsTest, AMeshOfTheWrongSizeDisagreesInSmallAndLargeImages) {
  const RgbdFrame usual = frame_;
  for (const double scale : {1.3, 1.15, 1.0 / 1.3}) {
    const Points predicted = transformed(scale * box_.volume.rest_vertices, poseAt(kFlat));
    resizeFrame(usual, 1.0);
    const double disagreement = associate(predicted).disagreement;
    EXPECT_GT(disagreement, 0.12) << scale;
    for (const double size : {0.75, 2.0, 3.0}) {
      resizeFrame(usual, size);
      learnColors();
      EXPECT_NEAR(associate(predicted).disagreement / disagreement, 1.0, 0.12) << scale << ", image " << size;
    }
  }
}

}  // namespace
}  // namespace softbody
