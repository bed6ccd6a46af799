#include "labels/region_colors.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

const cv::Vec3b kSkin(40, 90, 150), kWall(200, 190, 60), kGlove(90, 30, 220), kNeverSeen(10, 250, 10);
constexpr float kNear = 0.5f;  // [m]
constexpr double kFrameInterval_s = 1.0 / 30.0;

/// A body in front of a wall, and its exact prediction.
class RegionColorsTest : public ::testing::Test {
 protected:
  RegionColorsTest() { show({200, 150, 200, 120}); }

  void show(const cv::Rect& body) {
    frame_.color = cv::Mat3b(480, 640, kWall);
    frame_.depth = cv::Mat1f(480, 640, 1.2f);
    rendered_.depth = cv::Mat1f(480, 640, 0.0f);
    rendered_.triangle = cv::Mat1i(480, 640, -1);
    frame_.color(body) = kSkin;
    frame_.depth(body) = kNear;
    rendered_.depth(body) = kNear;
    rendered_.triangle(body) = 0;
    rendered_.region = body;
  }
  /// Number of frames until a colour speaks for the body, at most 100.
  int framesUntilBody(const cv::Vec3b& color) {
    int frames = 0;
    for (; frames < 100 && colors_.logOdds(color) < 1.0; ++frames)
      colors_.learn(frame_, rendered_, kFrameInterval_s);
    return frames;
  }

  RgbdFrame frame_;
  RasterImage rendered_;
  RegionColors colors_;
};

TEST_F(RegionColorsTest, TellTheBodyFromItsSurroundings) {
  for (const cv::Vec3b& color : {kSkin, kWall}) EXPECT_EQ(colors_.logOdds(color), 0.0) << "nothing is known";
  EXPECT_FALSE(colors_.learned());
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_TRUE(colors_.learned());
  EXPECT_GT(colors_.logOdds(kSkin), 2.0);
  EXPECT_LT(colors_.logOdds(kWall), -2.0);
  EXPECT_NEAR(colors_.logOdds(kNeverSeen), 0.0, 1e-6);
}

TEST_F(RegionColorsTest, AColorOfBothSidesSaysNothing) {
  frame_.color.setTo(kSkin);
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_NEAR(colors_.logOdds(kSkin), 0.0, 1e-6);
}

/// The sign follows the shares of a colour, not the sizes of the regions.
TEST_F(RegionColorsTest, TheSidesAreComparedByShares) {
  frame_.color(cv::Rect(200, 150, 50, 120)) = kWall;  // a quarter of the body
  frame_.color(cv::Rect(0, 0, 640, 152)) = kSkin;     // less than a half of the surroundings
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_GT(colors_.logOdds(kSkin), 0.0);
  EXPECT_LT(colors_.logOdds(kWall), 0.0);
}

TEST_F(RegionColorsTest, FollowTheLight) {
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  const cv::Vec3b dark(kSkin[0] / 2, kSkin[1] / 2, kSkin[2] / 2);
  frame_.color(rendered_.region) = dark;
  EXPECT_NEAR(colors_.logOdds(dark), 0.0, 1e-6);
  EXPECT_LT(framesUntilBody(dark), 10);
  const double before = colors_.logOdds(kSkin);
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_LT(colors_.logOdds(kSkin), before) << "what was learned in the old light fades";
}

/// Two fifths of a second in a new light teaches the same at any frame rate.
TEST_F(RegionColorsTest, FollowTheLightInTheSameTimeAtAnyRate) {
  std::vector<double> odds;
  for (const int rate : {15, 30, 60}) {
    colors_.reset();
    show({200, 150, 200, 120});
    colors_.learn(frame_, rendered_, kFrameInterval_s);
    frame_.color(rendered_.region) = kGlove;
    for (int i = 0; i < 2 * rate / 5; ++i) colors_.learn(frame_, rendered_, 1.0 / rate);
    odds.push_back(colors_.logOdds(kSkin));
  }
  EXPECT_NEAR(odds[0], odds[1], 0.15);
  EXPECT_NEAR(odds[2], odds[1], 1e-3);
}

TEST_F(RegionColorsTest, WhatCoversTheBodyIsNotLearned) {
  const cv::Rect glove(180, 180, 80, 60);
  frame_.color(glove) = kGlove;
  frame_.depth(glove) = kNear - 0.05f;
  for (int i = 0; i < 20; ++i) colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_LE(colors_.logOdds(kGlove), 0.0);
  EXPECT_GT(colors_.logOdds(kSkin), 2.0);
}

/// Depth alone would take a hand that touches the body, where the prediction lags behind, for the body.
TEST_F(RegionColorsTest, AHandAtTheDepthOfTheBodyIsNotLearned) {
  const cv::Rect beside(405, 180, 15, 60), over(340, 180, 60, 60);
  frame_.color(beside) = kGlove;
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  ASSERT_LT(colors_.logOdds(kGlove), 0.0);
  show(rendered_.region);
  frame_.color(over) = kGlove;
  for (int i = 0; i < 60; ++i) colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_LT(colors_.logOdds(kGlove), -1.0);
  EXPECT_GT(colors_.logOdds(kSkin), 2.0);
}

/// A prediction that is wrong by some pixels still learns the right colours: depth tells the sides apart.
TEST_F(RegionColorsTest, LearnBesideAnInexactPrediction) {
  const cv::Rect predicted = rendered_.region + cv::Point(8, 0);
  rendered_.depth.setTo(0.0f);
  rendered_.depth(predicted) = kNear;
  rendered_.triangle.setTo(-1);
  rendered_.triangle(predicted) = 0;
  rendered_.region = predicted;
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_GT(colors_.logOdds(kSkin), 1.0);
  EXPECT_LT(colors_.logOdds(kWall), -2.0);
}

TEST_F(RegionColorsTest, AFewPixelsTeachNothing) {
  show({300, 200, 10, 10});
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  EXPECT_FALSE(colors_.learned());
  EXPECT_EQ(colors_.logOdds(kSkin), 0.0);
}

TEST_F(RegionColorsTest, ResetForgets) {
  colors_.learn(frame_, rendered_, kFrameInterval_s);
  colors_.reset();
  EXPECT_FALSE(colors_.learned());
  for (const cv::Vec3b& color : {kSkin, kWall}) EXPECT_EQ(colors_.logOdds(color), 0.0);
}

/// A body at the border of the image, or one that fills it, breaks nothing.
TEST_F(RegionColorsTest, AnyRegionIsAllowed) {
  for (const cv::Rect& body : {cv::Rect(0, 0, 640, 480), cv::Rect(0, 0, 40, 480), cv::Rect(600, 440, 40, 40),
                               cv::Rect(0, 0, 0, 0)}) {
    show(body);
    colors_.learn(frame_, rendered_, kFrameInterval_s);
  }
  EXPECT_GE(colors_.logOdds(kSkin), 0.0);
}

}  // namespace
}  // namespace softbody
