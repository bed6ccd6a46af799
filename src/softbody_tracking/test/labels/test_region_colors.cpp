#include "labels/region_colors.h"

#include <gtest/gtest.h>

#include <memory>

#include "fixtures/labels_at.h"
#include "fixtures/synthetic_scene.h"

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
    frame_.camera = {640, 480, 615.0, 615.0, 320.0, 240.0};
    frame_.color = cv::Mat3b(480, 640, kWall);
    frame_.depth = cv::Mat1f(480, 640, 1.2f);
    frame_.color(body) = kSkin;
    frame_.depth(body) = kNear;
    predict(body);
  }
  /// A thin box before the camera that covers these pixels.
  void predict(const cv::Rect& body) {
    BoxBody box = makeBox();
    const auto corner = [&](const cv::Point& pixel) {
      return frame_.camera.unproject(pixel.x - 0.5, pixel.y - 0.5, kNear);
    };
    const Eigen::Vector3d size(0.2, 0.1, 0.04), first = corner(body.tl()), last = corner(body.br());
    const Eigen::Vector3d scale = (last - first + 0.001 * Eigen::Vector3d::UnitZ()).cwiseQuotient(size);
    Points vertices = box.volume.rest_vertices.rowwise() + 0.5 * size.transpose();
    vertices = (vertices * scale.asDiagonal()).rowwise() + first.transpose();
    body_ = body;
    surface_ = std::make_unique<PredictedSurface>(std::make_shared<SurfaceModel>(box.volume, box.surface),
                                                  frame_.camera, vertices, &memory_);
  }
  void learn(double elapsed_s = kFrameInterval_s) {
    colors_.learn(frame_, surface_->image(), labelsAt(frame_, *surface_, colors_), elapsed_s);
  }
  /// Mean of all sectors.
  double logOdds(const cv::Vec3b& color) const {
    double sum = 0.0;
    for (int sector = 0; sector < Sectors::kCount; ++sector) sum += colors_.logOdds(color, sector);
    return sum / Sectors::kCount;
  }
  /// Number of frames until a colour speaks for the body, at most 100.
  int framesUntilBody(const cv::Vec3b& color) {
    int frames = 0;
    for (; frames < 100 && logOdds(color) < 1.0; ++frames) learn();
    return frames;
  }

  RgbdFrame frame_;
  cv::Rect body_;  ///< where it is predicted
  RasterMemory memory_;
  std::unique_ptr<PredictedSurface> surface_;
  RegionColors colors_;
};

TEST_F(RegionColorsTest, TellTheBodyFromItsSurroundings) {
  for (const cv::Vec3b& color : {kSkin, kWall}) EXPECT_EQ(logOdds(color), 0.0) << "nothing is known";
  EXPECT_FALSE(colors_.learned());
  learn();
  EXPECT_TRUE(colors_.learned());
  EXPECT_GT(logOdds(kSkin), 2.0);
  EXPECT_LT(logOdds(kWall), -2.0);
  EXPECT_NEAR(logOdds(kNeverSeen), 0.0, 1e-6);
}

TEST_F(RegionColorsTest, AColorOfBothSidesSaysNothing) {
  frame_.color.setTo(kSkin);
  learn();
  EXPECT_NEAR(logOdds(kSkin), 0.0, 1e-6);
}

/// The sign follows the shares of a colour, not the sizes of the regions.
TEST_F(RegionColorsTest, TheSidesAreComparedByShares) {
  frame_.color(cv::Rect(200, 150, 50, 120)) = kWall;  // a quarter of the body
  frame_.color(cv::Rect(0, 0, 640, 152)) = kSkin;     // less than a half of the surroundings
  learn();
  EXPECT_GT(logOdds(kSkin), 0.0);
  EXPECT_LT(logOdds(kWall), 0.0);
}

/// A thing like the body, at its depth, lies on its left side.
TEST_F(RegionColorsTest, AThingLikeTheBodySaysNothingOnItsSideAlone) {
  const cv::Rect twin(body_.x - 40, body_.y, 40, body_.height);
  frame_.color(twin) = kSkin;
  frame_.depth(twin) = kNear;
  Labels labels = labelsAt(frame_, *surface_, colors_);
  labels.label.setTo(labels::kBackground, surface_->image().depth(labels.region) <= 0.0f);
  colors_.learn(frame_, surface_->image(), labels, kFrameInterval_s);
  const Sectors sectors(surface_->image().region);
  const int middle = body_.y + body_.height / 2, left = sectors.of(twin.x, middle),
            right = sectors.of(body_.br().x + 20, middle);
  ASSERT_NE(left, right);
  EXPECT_LT(colors_.logOdds(kSkin, left), 0.5);
  EXPECT_GT(colors_.logOdds(kSkin, right), 2.0);
  EXPECT_LT(colors_.depthLogOdds(0.0, kNear, left), colors_.depthLogOdds(0.0, kNear, right));
}

TEST_F(RegionColorsTest, FollowTheLight) {
  learn();
  const cv::Vec3b dark(kSkin[0] / 2, kSkin[1] / 2, kSkin[2] / 2);
  frame_.color(body_) = dark;
  EXPECT_NEAR(logOdds(dark), 0.0, 1e-6);
  EXPECT_LT(framesUntilBody(dark), 10);
  const double before = logOdds(kSkin);
  learn();
  EXPECT_LT(logOdds(kSkin), before) << "what was learned in the old light fades";
}

/// Two fifths of a second in a new light teaches the same at any frame rate.
TEST_F(RegionColorsTest, FollowTheLightInTheSameTimeAtAnyRate) {
  std::vector<double> odds;
  for (const int rate : {15, 30, 60}) {
    colors_.reset();
    show({200, 150, 200, 120});
    learn();
    frame_.color(body_) = kGlove;
    for (int i = 0; i < 2 * rate / 5; ++i) learn(1.0 / rate);
    odds.push_back(logOdds(kSkin));
  }
  EXPECT_NEAR(odds[0], odds[1], 0.15);
  EXPECT_NEAR(odds[2], odds[1], 1e-3);
}

TEST_F(RegionColorsTest, WhatCoversTheBodyIsNotLearned) {
  const cv::Rect glove(180, 180, 80, 60);
  frame_.color(glove) = kGlove;
  frame_.depth(glove) = kNear - 0.05f;
  for (int i = 0; i < 20; ++i) learn();
  EXPECT_LE(logOdds(kGlove), 0.0);
  EXPECT_GT(logOdds(kSkin), 2.0);
}

/// Depth alone would take a hand that touches the body, where the prediction lags behind, for the body.
TEST_F(RegionColorsTest, AHandAtTheDepthOfTheBodyIsNotLearned) {
  const cv::Rect beside(405, 180, 15, 60), over(340, 180, 60, 60);
  frame_.color(beside) = kGlove;
  learn();
  ASSERT_LT(logOdds(kGlove), 0.0);
  show(body_);
  frame_.color(over) = kGlove;
  for (int i = 0; i < 60; ++i) learn();
  EXPECT_LT(logOdds(kGlove), -1.0);
  EXPECT_GT(logOdds(kSkin), 2.0);
}

/// A prediction that is wrong by some pixels still learns the right colours: depth tells the sides apart.
TEST_F(RegionColorsTest, LearnBesideAnInexactPrediction) {
  predict(body_ + cv::Point(8, 0));
  learn();
  EXPECT_GT(logOdds(kSkin), 1.0);
  EXPECT_LT(logOdds(kWall), -2.0);
}

TEST_F(RegionColorsTest, AFewPixelsTeachNothing) {
  show({300, 200, 10, 10});
  learn();
  EXPECT_FALSE(colors_.learned());
  EXPECT_EQ(logOdds(kSkin), 0.0);
}

TEST_F(RegionColorsTest, ResetForgets) {
  learn();
  colors_.reset();
  EXPECT_FALSE(colors_.learned());
  for (const cv::Vec3b& color : {kSkin, kWall}) EXPECT_EQ(logOdds(color), 0.0);
}

/// A few pixels in a thousand are enough. What is only beside or before the body does not belong to it.
TEST_F(RegionColorsTest, RareColorsBelongAndForeignOnesDoNot) {
  const cv::Vec3b button(20, 20, 20);
  frame_.color(cv::Rect(300, 200, 6, 6)) = button;
  frame_.color(cv::Rect(230, 180, 40, 40)) = kGlove;
  frame_.depth(cv::Rect(230, 180, 40, 40)) = kNear - 0.05f;
  for (const cv::Vec3b& color : {kWall, kGlove, button}) EXPECT_TRUE(colors_.belongs(color)) << "not learned";
  learn();
  for (const cv::Vec3b& color : {kSkin, button}) EXPECT_TRUE(colors_.belongs(color)) << color;
  for (const cv::Vec3b& color : {kWall, kGlove, kNeverSeen}) EXPECT_FALSE(colors_.belongs(color)) << color;
}

TEST_F(RegionColorsTest, TheMaskLooksOnlyAtTheRegion) {
  const cv::Rect region(150, 140, 120, 60);  // partly on the body
  EXPECT_EQ(cv::countNonZero(colors_.mask(frame_.color, region)), region.area()) << "not learned";
  learn();
  cv::Mat1b mask = colors_.mask(frame_.color, region);
  EXPECT_EQ(cv::countNonZero(mask), (region & body_).area());
  EXPECT_EQ(cv::countNonZero(mask(region & body_)), (region & body_).area());
  EXPECT_EQ(cv::countNonZero(colors_.mask(frame_.color, {})), 0);
}

/// A body at the border of the image, or one that fills it, breaks nothing.
TEST_F(RegionColorsTest, AnyRegionIsAllowed) {
  for (const cv::Rect& body : {cv::Rect(0, 0, 640, 480), cv::Rect(0, 0, 40, 480), cv::Rect(600, 440, 40, 40),
                               cv::Rect(0, 0, 0, 0)}) {
    show(body);
    learn();
  }
  EXPECT_GE(logOdds(kSkin), 0.0);
}

}  // namespace
}  // namespace softbody
