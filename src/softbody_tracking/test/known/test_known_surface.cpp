#include "softbody_tracking/known/known_surface.h"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <stdexcept>

#include "agreement/confinement.h"
#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"

namespace softbody {
namespace {

constexpr float kWall = 1.2f;  // [m]

/// A box of 200 x 100 x 40 mm.
TriangleMesh boxAt(const Eigen::Isometry3d& pose) {
  const BoxBody box = makeBox();
  return {transformed(box.surface.rest_vertices, pose), box.surface.triangles};
}

Eigen::Isometry3d at(double x, double y, double z) {
  return Eigen::Isometry3d(Eigen::Translation3d(x, y, z));
}

Eigen::Isometry3d randomPose(std::mt19937* random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  Eigen::Isometry3d pose = at(0.1 * unit(*random), 0.05 * unit(*random), 0.6 + 0.1 * unit(*random));
  pose.rotate(Eigen::AngleAxisd(M_PI * unit(*random),
                                Eigen::Vector3d(unit(*random), unit(*random), 1.0).normalized()));
  return pose;
}

/// Before a wall.
RgbdFrame frameOf(const std::vector<TriangleMesh>& meshes) {
  RgbdFrame frame;
  frame.camera = {320, 240, 307.5, 307.5, 160.0, 120.0};
  frame.color = cv::Mat3b(240, 320, cv::Vec3b(128, 128, 128));
  frame.depth = cv::Mat1f(240, 320, kWall);
  for (const TriangleMesh& mesh : meshes) {
    RasterImage image;
    rasterize(frame.camera, mesh.vertices, mesh.triangles, &image);
    cv::Mat nearer = (image.depth > 0.0f) & (image.depth < frame.depth);
    image.depth.copyTo(frame.depth, nearer);
  }
  return frame;
}

cv::Mat1b shownPixels(const RgbdFrame& frame, const TriangleMesh& mesh) {
  RasterImage image;
  rasterize(frame.camera, mesh.vertices, mesh.triangles, &image);
  return (image.depth > 0.0f) & (cv::abs(image.depth - frame.depth) < 1e-6f);
}

TEST(KnownSurface, ItsPixelsAreKnownAndNoOthers) {
  std::mt19937 random(5);
  for (int i = 0; i < 20; ++i) {
    const TriangleMesh known = boxAt(randomPose(&random));
    const RgbdFrame frame = withKnownSurfaces(frameOf({known}), {{"box", known, 0.0}});
    const cv::Mat1b shown = shownPixels(frame, known), marked = frame.known > 0.0f;
    EXPECT_EQ(cv::countNonZero(shown & ~marked), 0);
    EXPECT_EQ(cv::countNonZero(marked & (frame.depth >= kWall)), 0);
    EXPECT_GT(cv::countNonZero(shown), 1000);
  }
}

TEST(KnownSurface, WhatIsBeforeOrBehindItIsNotKnown) {
  const TriangleMesh box = boxAt(at(0.0, 0.0, 0.6));
  const TriangleMesh hand = boxAt(at(0.05, 0.0, 0.5));
  const RgbdFrame before = withKnownSurfaces(frameOf({box, hand}), {{"box", box, 0.0}});
  EXPECT_EQ(cv::countNonZero((before.known > 0.0f) & shownPixels(before, hand)), 0);
  EXPECT_GT(cv::countNonZero(before.known > 0.0f), 1000);
  const RgbdFrame gone = withKnownSurfaces(frameOf({}), {{"box", box, 0.0}});
  EXPECT_TRUE(gone.known.empty() || cv::countNonZero(gone.known > 0.0f) == 0);
}

TEST(KnownSurface, AnUncertainPlaceIsMarkedWider) {
  const TriangleMesh box = boxAt(at(0.0, 0.0, 0.6)), moved = boxAt(at(0.0, 0.0, 0.62));
  const auto known = [&](double deviation_m) {
    return cv::countNonZero(withKnownSurfaces(frameOf({box}), {{"box", moved, deviation_m}}).known > 0.0f);
  };
  EXPECT_EQ(known(0.0), 0);
  EXPECT_GT(known(0.01), 1000);
}

TEST(KnownSurface, WhereNothingIsMeasuredTheRenderedSurfaceIsKnown) {
  const TriangleMesh box = boxAt(at(0.0, 0.0, 0.6));
  RgbdFrame frame = frameOf({box});
  const cv::Mat1b shown = shownPixels(frame, box);
  frame.depth.setTo(0.0f);
  EXPECT_EQ(cv::countNonZero((withKnownSurfaces(frame, {{"box", box, 0.0}}).known > 0.0f) != shown), 0);
}

TEST(KnownSurface, ASearchDoesNotSeeIt) {
  const TriangleMesh known = boxAt(at(0.0, 0.0, 0.6));
  const RgbdFrame frame = withKnownSurfaces(frameOf({known}), {{"box", known, 0.0}});
  const RgbdFrame searched = withoutKnownDepth(frame);
  EXPECT_EQ(cv::countNonZero((searched.depth > 0.0f) & (frame.known > 0.0f)), 0);
  EXPECT_EQ(cv::countNonZero(frame.depth != frameOf({known}).depth), 0) << "the frame itself keeps its depth";
  const TriangleMesh body = boxAt(Eigen::Isometry3d::Identity());
  EXPECT_GT(confinement(frame, body, at(0.0, 0.0, 0.6)), 0.9);
  EXPECT_LT(confinement(searched, body, at(0.0, 0.0, 0.6)), 0.1) << "nothing of it is seen";
}

TEST(KnownSurface, ATriangleWithoutItsVertexIsRefused) {
  TriangleMesh broken = boxAt(at(0.0, 0.0, 0.6));
  broken.triangles(0, 0) = 100000;
  EXPECT_THROW(withKnownSurfaces(frameOf({}), {{"box", broken, 0.0}}), std::invalid_argument);
}

/// A predicted body, and a box of the same look that reaches over a part of it.
class LabelsOfKnown : public ::testing::Test {
 protected:
  Labels labels(double z_of_other) {
    const BoxBody box = makeBox();
    const TriangleMesh body = boxAt(at(0.0, 0.0, 0.6));
    other_ = boxAt(at(0.12, 0.0, z_of_other));
    frame_ = withKnownSurfaces(frameOf({body, other_}), {{"other", other_, 0.0}});
    const PredictedSurface surface(std::make_shared<SurfaceModel>(box.volume, box.surface), frame_.camera,
                                   transformed(box.volume.rest_vertices, at(0.0, 0.0, 0.6)), &memory_);
    return labelsAt(frame_, surface);
  }
  /// Labels at the other box's pixels that are not `expected`.
  int wrong(const Labels& labels, std::uint8_t expected) const {
    const cv::Mat1b shown = shownPixels(frame_, other_);
    return cv::countNonZero(shown(labels.region) & (labels.label != expected));
  }

  TriangleMesh other_;
  RgbdFrame frame_;
  RasterMemory memory_;
};

TEST_F(LabelsOfKnown, BeforeTheBodyItIsAnOccluder) { EXPECT_EQ(wrong(labels(0.595), labels::kOccluder), 0); }

/// Depth agrees with both surfaces within the noise.
TEST_F(LabelsOfKnown, ABodyThatLiesOnItIsTheBody) {
  const Labels shown = labels(0.604);
  const cv::Mat1b of_body = shownPixels(frame_, boxAt(at(0.0, 0.0, 0.6)))(shown.region);
  const int all = cv::countNonZero(of_body),
            wrong = cv::countNonZero(of_body & (shown.label != labels::kBody));
  EXPECT_LT(wrong, 0.02 * all);
}

TEST_F(LabelsOfKnown, BehindTheBodyItIsBackground) { EXPECT_EQ(wrong(labels(0.65), labels::kBackground), 0); }

}  // namespace
}  // namespace softbody
