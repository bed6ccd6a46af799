#include <gtest/gtest.h>

#include "fixtures/labelled_box.h"
#include "status/disagreement.h"

namespace softbody {
namespace {

TEST(ImageScale, DoesNotChangeWhenTheBodyIsHidden) {
  LabelledBox box;
  const Eigen::Isometry3d there = Eigen::Isometry3d::Identity();
  EXPECT_NEAR(imageScale(box.label(there), box.surfaceAt(there)), 1.0, 0.03);
  cv::Rect half = box.covered();
  half.width /= 2;
  box.cover(half, 0.6f * box.nearest(), {40, 200, 40});
  EXPECT_NEAR(imageScale(box.label(there), box.surfaceAt(there)), 1.0, 0.03);
}

}  // namespace
}  // namespace softbody
