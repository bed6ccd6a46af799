#include "outline/crease_associations.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {
namespace {

/// A tilted box of one colour, with another brightness on each side, and some noise.
class CreaseAssociationsTest : public ::testing::Test {
 protected:
  CreaseAssociationsTest()
      : frame_(renderFrame(box_, truth(), 1)), surface_(model_, frame_.camera, truth(), &memory_) {
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 2.0);
    for (int v = 0; v < frame_.color.rows; ++v) {
      for (int u = 0; u < frame_.color.cols; ++u) {
        const int triangle = surface_.image().triangle(v, u);
        if (triangle < 0) continue;
        const double light = 90.0 + 90.0 * surface_.normal(triangle).dot(Eigen::Vector3d(0.3, 0.5, -0.8));
        const auto gray = cv::saturate_cast<uchar>(light + noise(random));
        frame_.color(v, u) = {gray, gray, gray};
      }
    }
  }

  Points truth() const { return transformed(box_.volume.rest_vertices, boxPose()); }

  Points shifted(const Eigen::Vector3d& shift) const {
    return transformed(truth(), Eigen::Isometry3d(Eigen::Translation3d(shift)));
  }
  std::vector<Association> associate(const Eigen::Vector3d& shift) { return associate(shifted(shift)); }
  std::vector<Association> associate(const Points& predicted) {
    surface_ = {model_, frame_.camera, predicted, &memory_};
    return associateCreases(frame_, surface_, sampleCreases(surface_),
                            RigidMotions(1, Eigen::Isometry3d::Identity()), labelsAt(frame_, surface_),
                            {1.0, meanEdgeLength(box_.volume.rest_vertices, box_.volume.tets)});
  }

  /// Root mean square of what the associations still lack after the true motion [px].
  double errorAfter(const std::vector<Association>& found, const Eigen::Vector3d& shift) const {
    double sum = 0.0;
    for (const Association& a : found) {
      const double error =
          a.normal.dot(a.measured - (a.predicted - shift)) * frame_.camera.fx / a.predicted.z();
      sum += error * error;
    }
    return std::sqrt(sum / static_cast<double>(found.size()));
  }

  BoxBody box_ = makeBox();
  std::shared_ptr<const SurfaceModel> model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  RgbdFrame frame_;
  RasterMemory memory_;
  PredictedSurface surface_;
};

TEST_F(CreaseAssociationsTest, FindTheCreasesToAPartOfAPixel) {
  for (const double millimetres : {0.0, 0.5, -1.0, 2.0, -3.0}) {
    const Eigen::Vector3d shift(0.7e-3 * millimetres, 0.7e-3 * millimetres, 0.0);
    const std::vector<Association> found = associate(shift);
    ASSERT_GT(found.size(), 20u) << millimetres;
    EXPECT_LT(errorAfter(found, shift), 0.6) << millimetres;
  }
}

/// Creases alone do not fix all six directions of a motion, but a motion that fits them brings them together.
TEST_F(CreaseAssociationsTest, AlignWithTheImage) {
  Points predicted = shifted({0.002, -0.0015, 0.0});
  const double before = rmsResidual(associate(predicted));
  for (int step = 0; step < 3; ++step)
    predicted = transformed(predicted, rigidStep(refsTo(associate(predicted))));
  EXPECT_LT(rmsResidual(associate(predicted)), 0.4 * before);
}

TEST_F(CreaseAssociationsTest, WithoutLightThereIsNoCrease) {
  frame_.color.setTo(cv::Vec3b(120, 120, 120));
  EXPECT_TRUE(associate(truth()).empty());
}

/// Texture makes edges of its own, so a crease in it counts for little or nothing.
TEST_F(CreaseAssociationsTest, TextureHidesThem) {
  const auto weightOf = [](const std::vector<Association>& found) {
    double sum = 0.0;
    for (const Association& a : found) sum += a.weight;
    return sum;
  };
  const double plain = weightOf(associate(truth()));
  frame_ = renderFrame(box_, truth(), 1);
  EXPECT_LT(weightOf(associate(truth())), 0.1 * plain);
}

TEST_F(CreaseAssociationsTest, WhatCoversThemSaysNothing) {
  frame_.depth.setTo(0.3f);
  EXPECT_TRUE(associate(truth()).empty());
}

}  // namespace
}  // namespace softbody
