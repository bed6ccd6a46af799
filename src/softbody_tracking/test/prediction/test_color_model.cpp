#include <gtest/gtest.h>

#include "prediction/color_model.h"

namespace softbody {
namespace {

const cv::Vec3b kFur(30, 80, 140), kBrightFur(45, 105, 175), kSleeve(220, 160, 120);

/// The left half has the body's colours, the right half is a sleeve.
cv::Mat3b twoHalves() {
  cv::Mat3b image(100, 100, kSleeve);
  image.colRange(0, 25).setTo(kFur);
  image.colRange(25, 50).setTo(kBrightFur);
  return image;
}

cv::Mat1b leftHalf() {
  cv::Mat1b mask(100, 100, static_cast<uchar>(0));
  mask.colRange(0, 50).setTo(255);
  return mask;
}

TEST(ColorModel, KnowsTheBodysColorsFromOthers) {
  ColorModel model;
  model.learn(twoHalves(), leftHalf());
  ASSERT_TRUE(model.learned());
  const cv::Mat1b mask = model.mask(twoHalves(), cv::Rect(0, 0, 100, 100));
  EXPECT_EQ(cv::countNonZero(mask.colRange(2, 48)), 46 * 100);
  EXPECT_EQ(cv::countNonZero(mask.colRange(52, 98)), 0);
}

TEST(ColorModel, ToleratesShade) {
  ColorModel model;
  model.learn(twoHalves(), leftHalf());
  cv::Mat3b shaded;
  twoHalves().convertTo(shaded, -1, 0.85);
  EXPECT_GT(cv::countNonZero(model.mask(shaded, cv::Rect(0, 0, 100, 100)).colRange(2, 48)), 45 * 100);
}

TEST(ColorModel, LooksOnlyAtTheRegion) {
  ColorModel model;
  model.learn(twoHalves(), leftHalf());
  const cv::Rect region(10, 10, 20, 20);
  cv::Mat1b mask = model.mask(twoHalves(), region);
  EXPECT_GT(cv::countNonZero(mask(region)), 0);
  mask(region).setTo(0);
  EXPECT_EQ(cv::countNonZero(mask), 0);
  EXPECT_EQ(cv::countNonZero(model.mask(twoHalves(), cv::Rect())), 0);
}

TEST(ColorModel, LetsEverythingPassUntilItHasSeenEnough) {
  ColorModel model;
  cv::Mat1b few(100, 100, static_cast<uchar>(0));
  few.rowRange(0, 1).setTo(255);
  model.learn(twoHalves(), few);
  EXPECT_FALSE(model.learned());
  EXPECT_EQ(cv::countNonZero(model.mask(twoHalves(), cv::Rect(0, 0, 100, 100))), 100 * 100);
  model.learn(twoHalves(), leftHalf());
  model.reset();
  EXPECT_FALSE(model.learned());
}

}  // namespace
}  // namespace softbody
