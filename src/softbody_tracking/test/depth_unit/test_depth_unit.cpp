#include <gtest/gtest.h>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_tracking/depth_unit/depth_unit.h"

namespace softbody {
namespace {

const BoxBody kBox = makeBox();

/// The box in depth images with this unit, which the camera does not tell.
CameraImages imagesIn(double unit_m) {
  const RgbdFrame frame = renderFrame(kBox, transformed(kBox.surface.rest_vertices, boxPose()), 1);
  CameraImages images;
  images.color = frame.color;
  images.rectified = frame.camera;
  images.stamp = frame.stamp;
  frame.depth.convertTo(images.depth, CV_16U, 1.0 / unit_m);
  return images;
}

std::optional<double> unitFor(const CameraImages& images) {
  CameraIngest ingest{CameraIngestConfig()};
  return depthUnitThatFits(images, &ingest, TrackerConfig(), kBox.volume, kBox.surface);
}

TEST(DepthUnit, TheUnitInWhichTheBodyHasItsSizeIsFound) {
  for (const double unit_m : {0.00025, 0.01}) EXPECT_EQ(unitFor(imagesIn(unit_m)), unit_m) << unit_m;
}

TEST(DepthUnit, NoUnitFitsABodyOfAnotherShape) {
  CameraImages images = imagesIn(0.001);
  images.depth.setTo(0, images.depth < 1100);
  EXPECT_FALSE(unitFor(images));
}

TEST(DepthUnit, ThePresentUnitIsNotNamed) { EXPECT_FALSE(unitFor(imagesIn(0.001))); }

}  // namespace
}  // namespace softbody
