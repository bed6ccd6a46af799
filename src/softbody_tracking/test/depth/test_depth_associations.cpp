#include <gtest/gtest.h>

#include <memory>
#include <random>

#include "depth/depth_associations.h"
#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {
namespace {

class DepthAssociationsTest : public ::testing::Test {
 protected:
  DepthAssociationsTest()
      : truth_(transformed(box_.volume.rest_vertices, boxPose())),
        frame_(renderFrame(box_, truth_, 1)),
        surface_(model_, frame_.camera, truth_, &memory_) {}

  void predict(const Points& vertices) { surface_ = {model_, frame_.camera, vertices, &memory_}; }

  Labels labels() const { return labelsAt(frame_, surface_, colors_, last_labels_); }
  DepthAssociations associate(int targets = TrackerConfig().max_depth_targets,
                              const Eigen::Isometry3d& motion = Eigen::Isometry3d::Identity(),
                              int pixel_step = 1) {
    return associateDepth(frame_, surface_.image(), sampleSurface(surface_, targets), {motion}, labels(),
                          weight_, pixel_step);
  }

  /// To every pixel's depth.
  void addNoise(double sigma_m) {
    std::mt19937 random(2);
    std::normal_distribution<float> gauss(0.0f, static_cast<float>(sigma_m));
    for (float& z : frame_.depth) z += gauss(random);
  }

  BoxBody box_ = makeBox();
  double edge_ = meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets);
  const DepthWeight weight_ = {TrackerConfig().depth_weight, edge_};
  Points truth_;
  RgbdFrame frame_;
  std::shared_ptr<const SurfaceModel> model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  RasterMemory memory_;
  PredictedSurface surface_;
  RegionColors colors_;
  LabelMemory last_labels_;
};

TEST_F(DepthAssociationsTest, AgreeWhereThePredictionIsTrue) {
  const DepthAssociations found = associate();
  EXPECT_GT(found.associations.size(), 1000u);
  EXPECT_EQ(found.occluded_blocks, 0);
  EXPECT_EQ(found.absent_blocks, 0);
  for (const Association& a : found.associations) {
    EXPECT_LT(std::abs(a.residual()), 1e-6);
    EXPECT_LT((positionOf(a.place, truth_, box_.volume.tets) - a.predicted).norm(), 1e-6);
    EXPECT_LT(a.normal.dot(a.predicted), 0.0) << "visible surface faces the camera";
  }
}

TEST_F(DepthAssociationsTest, MeasureAShiftAlongTheNormals) {
  predict(transformed(truth_, Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.004))));
  for (const Association& a : associate().associations) {
    EXPECT_LT(a.residual(), 0.0) << "the body lies behind its prediction, against the normals";
    EXPECT_NEAR(a.residual(), 0.004 * a.normal.z(), 0.0025);
  }
}

TEST_F(DepthAssociationsTest, AFewPixelsOfABlockSayTheSame) {
  predict(transformed(truth_, Eigen::Isometry3d(Eigen::Translation3d(0.002, 0.0, -0.004))));
  const DepthAssociations all = associate();
  for (const int step : {2, 3, 1000}) {
    const DepthAssociations some =
        associate(TrackerConfig().max_depth_targets, Eigen::Isometry3d::Identity(), step);
    EXPECT_NEAR(static_cast<double>(some.associations.size()), all.associations.size(),
                0.05 * all.associations.size());
    EXPECT_NEAR(rmsResidual(some.associations), rmsResidual(all.associations),
                0.1 * rmsResidual(all.associations));
  }
}

/// A block at the edge of another side shows a ramp; its mean says little about the predicted side.
TEST_F(DepthAssociationsTest, WeighABlockByTheInverseVarianceOfItsDepth) {
  addNoise(0.001);
  const cv::Rect region = surface_.image().region;
  const int right = region.x + 3 * region.width / 4;
  const auto weightRight = [&](const DepthAssociations& found) {
    double weight = 0.0;
    for (const Association& a : found.associations)
      weight += frame_.camera.project(a.predicted).x() > right ? a.weight : 0.0;
    return weight;
  };
  const double even = weightRight(associate());
  std::mt19937 random(3);
  std::normal_distribution<float> gauss(0.0f, 0.004f);
  for (int v = region.y; v < region.br().y; ++v)
    for (int u = right; u < region.br().x; ++u) frame_.depth(v, u) += gauss(random);
  EXPECT_LT(weightRight(associate()), 0.3 * even);
}

TEST_F(DepthAssociationsTest, WeighSurfaceByItsAreaHoweverSteeplyItIsSeen) {
  for (const double angle : {0.0, 0.6, 1.1}) {
    const Eigen::Isometry3d turned = boxPose() * Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitY());
    truth_ = transformed(box_.volume.rest_vertices, turned);
    frame_ = renderFrame(box_, truth_, 1);
    predict(truth_);
    double weights = 0.0, area = 0.0;
    for (const Association& a : associate().associations) weights += a.weight * edge_ * edge_;
    for (const auto& triangle : box_.volume.surface.rowwise()) {
      const Eigen::Vector3d a = truth_.row(triangle[0]), b = truth_.row(triangle[1]),
                            c = truth_.row(triangle[2]);
      const Eigen::Vector3d normal = (b - a).cross(c - a);  // twice the area long
      if (normal.dot(a) < 0.0) area += 0.5 * normal.norm();
    }
    EXPECT_NEAR(weights, TrackerConfig().depth_weight * area, 0.07 * area) << "turned by " << angle;
  }
}

/// Sum of the weights, downweighted by the noise of this frame alone.
double totalWeight(DepthAssociations found, double volume_edge_m) {
  DepthNoiseEstimator noise;
  noise.update(found.noise, 1.0);
  downweightByNoise(noise.patchStdDev(volume_edge_m) / volume_edge_m, &found);
  double sum = 0.0;
  for (const Association& a : found.associations) sum += a.weight;
  return sum;
}

TEST_F(DepthAssociationsTest, WeighTheSameSurfaceTheSameWhateverTheNumberOfBlocks) {
  const double fine = 0.25 * edge_;
  for (const double noise_m : {0.0, 0.0005, 0.0013}) {
    frame_ = renderFrame(box_, truth_, 1);
    addNoise(noise_m);
    const double usual = totalWeight(associate(), fine);
    for (const int targets : {300, 3000, 100000}) {
      EXPECT_NEAR(totalWeight(associate(targets), fine) / usual, 1.0, 0.15) << noise_m << " " << targets;
    }
  }
}

TEST_F(DepthAssociationsTest, AreAsNoisyWhateverTheNumberOfBlocks) {
  constexpr double kNoise = 0.002;
  addNoise(kNoise);
  const double density = kNoise * boxPose().translation().z() / frame_.camera.fx;  // of single pixels
  for (const int targets : {100, 300, 1500, 3000, 100000}) {
    EXPECT_NEAR(associate(targets).noise.density, density, 0.13 * density) << targets;
  }
}

/// As of a thin body far away from a stereo camera, which would shake with it.
TEST_F(DepthAssociationsTest, WeighLessWhereDepthIsNoisierThanUsual) {
  const auto weight = [&](double noise_m) {
    frame_ = renderFrame(box_, truth_, 1);
    addNoise(noise_m);
    return totalWeight(associate(), 0.25 * edge_);
  };
  const double usual = weight(0.0);
  EXPECT_NEAR(weight(0.0005), usual, 0.02 * usual) << "patches average over their pixels";
  const double noisy = weight(0.0012), noisier = weight(0.0015);
  EXPECT_LT(noisy, 0.9 * usual);
  EXPECT_NEAR(noisier / noisy, 0.64, 0.06) << "by the square";
}

/// The rigid step leaves out pixels, and does not ask.
TEST_F(DepthAssociationsTest, TellTheNoiseOfWholeBlocksAlone) {
  for (const int targets : {1500, 100000}) {
    EXPECT_GT(associate(targets).noise.count, 500u) << targets;
    EXPECT_EQ(associate(targets, Eigen::Isometry3d::Identity(), 2).noise.count, 0u) << targets;
  }
}

/// Such as a bend that the prediction does not have, and that depth is to mend.
TEST_F(DepthAssociationsTest, ABendOtherThanPredictedIsHardlyNoise) {
  constexpr double kRadius = 0.24;
  const double straight = totalWeight(associate(), edge_);
  for (const int axis : {0, 1}) {
    for (const double way : {-1.0, 1.0}) {
      Points bent = box_.volume.rest_vertices;
      for (auto vertex : bent.rowwise()) {
        const double angle = vertex[axis] / kRadius;
        vertex[axis] = (kRadius - way * vertex[2]) * std::sin(angle);
        vertex[2] = way * (kRadius - (kRadius - way * vertex[2]) * std::cos(angle));
      }
      frame_ = renderFrame(box_, transformed(bent, boxPose()), 1);
      for (const int targets : {100, 300, 1500}) {
        const DepthAssociations found = associate(targets);
        ASSERT_GT(rmsResidual(found.associations), 0.001);
        double plain = 0.0;
        for (const Association& a : found.associations) plain += a.weight;
        EXPECT_GT(plain, 0.4 * straight);
        EXPECT_NEAR(totalWeight(found, edge_), plain, 0.1 * plain) << axis << " " << way << " " << targets;
      }
    }
  }
}

/// Pieces in stripes of six blocks, every second one nearer.
TEST_F(DepthAssociationsTest, AStepBetweenPiecesIsNoNoise) {
  addNoise(0.001);
  SurfaceSamples samples = sampleSurface(surface_, 1500);
  for (int row = 0; row < samples.grid.rows; ++row)
    for (int column = 0; column < samples.grid.cols; ++column)
      if (samples.grid(row, column) >= 0) samples.samples[samples.grid(row, column)].piece = column / 6 % 2;
  const RigidMotions motions = {Eigen::Isometry3d::Identity(),
                                Eigen::Isometry3d(Eigen::Translation3d(0.0, 0.0, -0.006))};
  const DepthAssociations found =
      associateDepth(frame_, surface_.image(), samples, motions, labels(), weight_);
  ASSERT_GT(rmsResidual(found.associations), 0.002);
  const double noise = associate().noise.density;
  EXPECT_NEAR(found.noise.density, noise, 0.2 * noise);
}

/// A finger touches one piece, while the larger piece lies farther than predicted.
TEST_F(DepthAssociationsTest, TheMotionOfOnePieceDoesNotOccludeAnother) {
  addNoise(0.001);
  const cv::Rect region = surface_.image().region;
  const cv::Point tip(region.x + 30, region.y + region.height / 2);
  for (int v = -25; v <= 25; ++v)  // its depth has no step
    for (int u = -25; u <= 25; ++u)
      frame_.depth(tip + cv::Point(u, v)) -= 0.0012f * std::max(0.0f, 25.0f - std::hypot(1.0f * u, 1.0f * v));
  SurfaceSamples samples = sampleSurface(surface_, 1500);
  for (auto& sample : samples.samples) sample.piece = sample.center.x < tip.x + region.width / 4 ? 0 : 1;
  const auto occluded = [&](double farther_m) {
    const Eigen::Isometry3d moved(Eigen::Translation3d(0.0, 0.0, -farther_m));
    const RigidMotions motions = {Eigen::Isometry3d::Identity(), moved};
    return associateDepth(frame_, surface_.image(), samples, motions, labels(), weight_).occluded_blocks;
  };
  const int finger = occluded(0.0);
  EXPECT_GT(finger, 5);
  EXPECT_LE(occluded(0.006), finger + 3);
}

TEST_F(DepthAssociationsTest, TellOccludersFromAnAbsentBody) {
  frame_.depth(cv::Rect(0, 0, 320, 480)) -= 0.1f;
  DepthAssociations found = associate();
  EXPECT_GT(found.occluded_blocks, 300);
  EXPECT_EQ(found.absent_blocks, 0);
  frame_.depth.setTo(2.0f);
  found = associate();
  EXPECT_EQ(found.occluded_blocks, 0);
  EXPECT_EQ(found.absent_blocks, found.visible_blocks);
  EXPECT_TRUE(found.associations.empty());
}

TEST_F(DepthAssociationsTest, ForeignColorsAreOccluders) {
  learnColorsOf(frame_, surface_, &colors_);
  EXPECT_EQ(associate().occluded_blocks, 0);
  frame_.color.setTo(frame_.color(10, 10));  // the wall's
  const DepthAssociations found = associate();
  EXPECT_EQ(found.occluded_blocks, found.visible_blocks);
  EXPECT_TRUE(found.associations.empty());
}

/// A rigid motion of the samples and a new rendering of the moved surface say the same.
TEST_F(DepthAssociationsTest, MoveWithTheirSamples) {
  const Eigen::Isometry3d error =
      Eigen::Translation3d(0.003, -0.002, 0.004) * Eigen::AngleAxisd(0.01, Eigen::Vector3d::UnitZ());
  predict(transformed(truth_, error));
  for (const Association& a : associate(TrackerConfig().max_depth_targets, error.inverse()).associations) {
    EXPECT_LT(std::abs(a.residual()), 4e-4);
    EXPECT_LT((positionOf(a.place, truth_, box_.volume.tets) - a.predicted).norm(), 1e-6);
  }
}

/// A stick whose far end is in front of the body and whose tip touches it, flat or steep [m/px].
TEST_F(DepthAssociationsTest, AnOccluderIsOneDownToItsTipHoweverSteep) {
  const cv::Rect stick = cv::Rect(surface_.image().region.x + surface_.image().region.width / 2, 0, 30, 480);
  const cv::Mat1f without = frame_.depth.clone();
  for (const float slope : {5e-4f, 1e-3f, 1.5e-3f, 2e-3f}) {
    without.copyTo(frame_.depth);
    for (int v = 0; v < 300; ++v) {
      for (int u = stick.x; u < stick.br().x; ++u) {
        if (surface_.image().triangle(v, u) >= 0) frame_.depth(v, u) -= slope * static_cast<float>(300 - v);
      }
    }
    int on_stick = 0;
    for (const Association& a : associate().associations) {
      const Eigen::Vector2d pixel = frame_.camera.project(a.measured);
      on_stick += stick.contains(cv::Point(cvRound(pixel.x()), cvRound(pixel.y()))) && a.residual() > 0.005;
    }
    EXPECT_EQ(on_stick, 0) << slope;
  }
}

/// A tool's handle with the body's colours, nowhere as near as the gate.
TEST_F(DepthAssociationsTest, WhatStandsBeforeTheSurfaceByAStepIsNoPartOfIt) {
  const cv::Rect& region = surface_.image().region;
  const cv::Rect handle(region.x + region.width / 2, region.y + region.height / 3, 24, region.height / 3);
  for (const float before : {0.015f, 0.025f, 0.035f}) {
    cv::Mat1f depth = frame_.depth.clone();
    std::swap(depth, frame_.depth);
    frame_.depth(handle) -= before;
    const DepthAssociations found = associate();
    std::swap(depth, frame_.depth);
    EXPECT_GT(found.occluded_blocks, 10) << before;
    EXPECT_GT(found.associations.size(), 800u) << "the surface beside it stays";
    for (const Association& a : found.associations) EXPECT_LT(std::abs(a.residual()), 0.01) << before;
  }
}

/// It grows in three frames.
TEST_F(DepthAssociationsTest, ABulgeIsThePartOfTheSurfaceThatItIs) {
  constexpr double kHeight = 0.03, kRadiusPx = 90.0;
  const Eigen::Vector2d middle = frame_.camera.project(boxPose().translation());
  learnColorsOf(frame_, surface_, &colors_);
  for (int frame = 0; frame < 3; ++frame) {
    last_labels_ = labels().memory;
    for (int v = 0; v < frame_.depth.rows; ++v) {
      for (int u = 0; u < frame_.depth.cols; ++u) {
        const double away = (Eigen::Vector2d(u, v) - middle).norm() / kRadiusPx;
        if (surface_.image().triangle(v, u) < 0 || away > 1.0) continue;
        frame_.depth(v, u) -= static_cast<float>(kHeight / 3.0 * 0.5 * (1.0 + std::cos(M_PI * away)));
      }
    }
  }
  for (const int targets : {1500, 300, 100, 50}) {
    const DepthAssociations found = associate(targets);
    EXPECT_EQ(found.occluded_blocks, 0) << targets;
    double highest = 0.0;
    for (const Association& a : found.associations) highest = std::max(highest, a.residual());
    EXPECT_GT(highest, 0.02) << targets;
  }
}

TEST_F(DepthAssociationsTest, NoDepthGivesNothing) {
  frame_.depth.setTo(0.0f);
  EXPECT_EQ(associate().visible_blocks, 0);
}

}  // namespace
}  // namespace softbody
