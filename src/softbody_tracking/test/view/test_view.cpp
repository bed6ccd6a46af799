#include "view/view.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "view/view_measurements.h"

namespace softbody {
namespace {

bool isSame(const cv::Mat& a, const cv::Mat& b) {
  return a.size() == b.size() && std::equal(a.datastart, a.dataend, b.datastart);
}

class ViewTest : public ::testing::Test {
 protected:
  Points at(const Eigen::Vector3d& shift) const {
    return transformed(box_.volume.rest_vertices, Eigen::Isometry3d(Eigen::Translation3d(shift) * boxPose()));
  }
  View viewOf(const Points& vertices) {
    return render(model_, camera_, vertices, ViewSettings(TrackerConfig()), &memory_);
  }

  BoxBody box_ = makeBox();
  RasterMemory memory_;
  std::shared_ptr<const SurfaceModel> model_ = std::make_shared<SurfaceModel>(box_.volume, box_.surface);
  const Pinhole camera_{640, 480, 615.0, 615.0, 320.0, 240.0};
};

TEST_F(ViewTest, AnotherRenderingDoesNotChangeIt) {
  const Points vertices = at(Eigen::Vector3d::Zero());
  const View held = viewOf(vertices);
  const cv::Mat1f depth = held.surface.image().depth.clone();
  const cv::Mat1i triangle = held.surface.image().triangle.clone();
  const cv::Mat1i grid = held.samples.grid.clone();
  ASSERT_GT(cv::countNonZero(depth), 0);
  for (const double shift : {0.03, -0.05, 0.0}) {
    const View other = viewOf(at({shift, 0.01, 0.0}));
    ASSERT_FALSE(isSame(other.surface.image().depth, depth));
  }
  EXPECT_TRUE(isSame(held.surface.image().depth, depth));
  EXPECT_TRUE(isSame(held.surface.image().triangle, triangle));
  EXPECT_TRUE(isSame(held.samples.grid, grid));
  EXPECT_EQ(held.surface.volumeVertices(), vertices);
}

TEST_F(ViewTest, GivesItsMemoryBack) {
  const Points vertices = at(Eigen::Vector3d::Zero());
  const RasterImage* first = &viewOf(vertices).surface.image();
  View held = viewOf(vertices);
  EXPECT_EQ(&held.surface.image(), first);
  const PredictedSurface copy = moved(held.surface, {Eigen::Isometry3d::Identity()});
  held = viewOf(at({0.02, 0.0, 0.0}));
  EXPECT_NE(&held.surface.image(), first) << "the copy has it";
}

TEST_F(ViewTest, MovingACopyDoesNotChangeIt) {
  const View held = viewOf(at(Eigen::Vector3d::Zero()));
  const cv::Point center = held.samples.samples.front().center;
  const int triangle = held.surface.image().triangle(center);
  const MaterialPoint place = held.surface.materialPoint(triangle, center);
  const Eigen::Vector3d position = held.surface.position(place), shift(0.01, 0.0, 0.02);
  const PredictedSurface there = moved(held.surface, {Eigen::Isometry3d(Eigen::Translation3d(shift))});
  EXPECT_LT((there.position(place) - position - shift).norm(), 1e-12);
  EXPECT_EQ(held.surface.position(place), position);
  EXPECT_EQ(held.surface.triangleAt(position, 0.002), triangle);
  EXPECT_EQ(there.triangleAt(position + shift, 0.002), triangle);
}

TEST_F(ViewTest, HasContoursOnlyWhereTheyAreUsed) {
  TrackerConfig config;
  EXPECT_TRUE(ViewSettings(config).contours);
  config.outline_weight = 0.0;
  EXPECT_FALSE(ViewSettings(config).contours);
  const View view = render(model_, camera_, at(Eigen::Vector3d::Zero()), ViewSettings(config), &memory_);
  EXPECT_FALSE(view.samples.samples.empty());
  EXPECT_TRUE(view.outline.samples.empty());
  EXPECT_TRUE(view.creases.samples.empty());
}

/// Of all measurements only the motions since the rendering are new.
TEST_F(ViewTest, IsMeasuredWhereItWasMoved) {
  const Eigen::Vector3d shift(0.004, -0.003, 0.002);
  const RgbdFrame frame = renderFrame(box_, at(shift), 1);
  const View view = viewOf(at(Eigen::Vector3d::Zero()));
  RegionColors colors;
  learnColorsOf(frame, viewOf(at(shift)).surface, &colors);
  const Labels labels = labelsAt(frame, view.surface, colors);
  const MeasurementWeights weights(TrackerConfig(), box_.volume);
  const auto residual = [&](const Eigen::Vector3d& by) {
    const RigidMotions motions = {Eigen::Isometry3d(Eigen::Translation3d(by))};
    const double depth = rmsResidual(depthOf(frame, view, motions, labels, weights).associations);
    const double contour = rmsResidual(contoursOf(frame, view, motions, labels, weights).associations);
    return std::max(depth, contour);
  };
  EXPECT_LT(residual(shift), 0.5 * residual(Eigen::Vector3d::Zero()));
}

}  // namespace
}  // namespace softbody
