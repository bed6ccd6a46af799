#include "labels/labeling.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/labelled_box.h"

namespace softbody {
namespace {

const Eigen::Isometry3d kStill = Eigen::Isometry3d::Identity();
const cv::Vec3b kHandColor(250, 20, 20);
constexpr double kMostWrong = 0.02;  // share of the labelled pixels

/// A part of the covered pixels, from its top left corner; everything relative to them.
cv::Rect partOf(const LabelledBox& box, double x, double y, double width, double height) {
  const cv::Rect& all = box.covered();
  return {all.x + cvRound(x * all.width), all.y + cvRound(y * all.height), cvRound(width * all.width),
          cvRound(height * all.height)};
}
/// On the body.
cv::Rect middleOf(const LabelledBox& box) { return partOf(box, 0.4, 0.35, 0.25, 0.3); }
/// Of that, without the cells at its edge.
cv::Rect innerOf(const LabelledBox& box) { return partOf(box, 0.45, 0.42, 0.15, 0.16); }
/// From the middle to beyond the body's edge.
cv::Rect sideOf(const LabelledBox& box) { return partOf(box, 0.5, 0.3, 0.53, 0.4); }

double occluderShare(const Labels& labels, const cv::Rect& pixels) {
  return LabelledBox::share(labels, pixels, labels::kOccluder);
}

template <typename Check>
void atEveryDistanceAndSize(Check check) {
  for (const double distance_m : {0.4, 1.5}) {
    for (const double pixels : {0.5, 1.0}) {
      SCOPED_TRACE(testing::Message() << distance_m << " m, " << 640 * pixels << " px");
      check(LabelledBox(distance_m, pixels));
    }
  }
}

TEST(Labeling, ATruePredictionGivesTheTruth) {
  atEveryDistanceAndSize([](LabelledBox box) {
    EXPECT_LT(box.shareWrong(box.label(kStill)), kMostWrong);
    for (const float before : {0.015f, 0.03f, 0.1f, 0.2f}) {
      box.show(kStill);
      box.cover(sideOf(box), box.nearest() - before, kHandColor);
      EXPECT_LT(box.shareWrong(box.label(kStill)), kMostWrong) << "hand " << before;
      box.show(kStill);
      box.coverLikeBody(middleOf(box), before);
      EXPECT_LT(box.shareWrong(box.label(kStill)), kMostWrong) << "of the body's colour " << before;
    }
  });
}

TEST(Labeling, ABodyBesideItsPredictionIsStillTheBody) {
  atEveryDistanceAndSize([](LabelledBox box) {
    for (int direction = 0; direction < 6; ++direction) {
      const double by = direction < 3 ? 0.003 : -0.003;
      const Labels labels =
          box.label(Eigen::Isometry3d(Eigen::Translation3d(by * Eigen::Vector3d::Unit(direction % 3))));
      EXPECT_LT(box.shareWrong(labels), kMostWrong) << direction;
      EXPECT_LT(occluderShare(labels, labels.region), 0.001) << direction;
    }
  });
}

/// Motions of about 3 mm and 2 degrees. A steep side then differs by more than a centimetre in depth.
TEST(Labeling, WithoutAnOccluderInSightNothingBecomesOne) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Eigen::Vector3d(uniform(random), uniform(random), uniform(random)); };
  atEveryDistanceAndSize([&](LabelledBox box) {
    for (int i = 0; i < 30; ++i) {
      const Eigen::Vector3d shift = 0.003 * vector();
      const Eigen::AngleAxisd turn(0.03 * uniform(random), vector().normalized());
      const Labels labels = box.label(Eigen::Translation3d(shift) * turn);
      EXPECT_LT(occluderShare(labels, labels.region), 0.003) << i;
    }
  });
}

TEST(Labeling, WhatStandsBeforeTheBodyByAStepIsAnOccluder) {
  atEveryDistanceAndSize([](LabelledBox box) {
    for (const bool like_body : {true, false}) {
      box.show(kStill);
      box.coverLikeBody(middleOf(box), 0.015f);
      if (!like_body) box.frame().color(middleOf(box)) = kHandColor;
      EXPECT_EQ(occluderShare(box.label(kStill), innerOf(box)), 1.0) << like_body;
    }
  });
}

/// Without the frame before, what comes close may be the body. What has its colour is taken for it earlier.
TEST(Labeling, AnOccluderStaysOneWhenItComesClose) {
  for (const bool like_body : {true, false}) {
    LabelledBox box(0.4);
    const auto cover = [&](float before_m) {
      box.show(kStill);
      box.coverLikeBody(middleOf(box), before_m);
      if (!like_body) box.frame().color(middleOf(box)) = kHandColor;
    };
    cover(0.015f);
    const Labels before = box.label(kStill);
    cover(like_body ? 0.007f : 0.005f);
    const Labels close = box.label(kStill, before.memory);
    EXPECT_EQ(occluderShare(close, innerOf(box)), 1.0);
    EXPECT_LT(box.shareWrong(close), kMostWrong) << "the surface beside it stays";
    EXPECT_LT(occluderShare(box.label(kStill), innerOf(box)), 0.05);
  }
}

TEST(Labeling, TheBodyStaysTheBodyWhereAnOccluderWas) {
  LabelledBox box;
  const cv::Rect pixels = middleOf(box);
  box.coverLikeBody(pixels, 0.025f);
  const Labels before = box.label(kStill);
  box.show(kStill);
  EXPECT_LT(occluderShare(box.label(kStill, before.memory), pixels), 0.001);
}

TEST(Labeling, ACoveredMaskIsAnOccluder) {
  LabelledBox box;
  const cv::Rect pixels = middleOf(box);
  box.frame().covered = cv::Mat1b(box.frame().depth.size(), static_cast<uchar>(0));
  box.frame().covered(pixels) = 255;
  EXPECT_EQ(occluderShare(box.label(kStill), pixels), 1.0) << "at the body's depth and of its colour";
  box.frame().depth(pixels) = 0.0f;
  EXPECT_EQ(occluderShare(box.label(kStill), pixels), 1.0) << "without depth";
}

/// A foreign colour is one of the surroundings. A colour that was never seen says nothing: depth decides.
TEST(Labeling, AForeignColorAtTheBodysDepthIsAnOccluder) {
  LabelledBox box;
  const cv::Rect pixels = middleOf(box);
  box.frame().color(pixels) = box.frame().color(0, 0);
  EXPECT_EQ(occluderShare(box.label(kStill), innerOf(box)), 1.0);
  box.frame().color(pixels) = kHandColor;
  EXPECT_LT(occluderShare(box.label(kStill), pixels), 0.05);
}

/// A bulge of 3 cm without a step anywhere. What appears at once is not the body; what grows is.
TEST(Labeling, ABulgeThatGrowsIsTheBody) {
  constexpr double kHeight = 0.03, kRadiusPx = 90.0;
  LabelledBox box;
  const cv::Point middle = (box.covered().tl() + box.covered().br()) / 2;
  const auto occludedAfter = [&](int frames) {
    box.show(kStill);
    const cv::Mat1f flat = box.frame().depth.clone();
    Labels labels = box.label(kStill);
    for (int frame = 1; frame <= frames; ++frame) {
      for (int v = 0; v < flat.rows; ++v) {
        for (int u = 0; u < flat.cols; ++u) {
          const double away = cv::norm(cv::Point(u, v) - middle) / kRadiusPx;
          if (box.truth()(v, u) != labels::kBody || away > 1.0) continue;
          const double height = kHeight * frame / frames * 0.5 * (1.0 + std::cos(M_PI * away));
          box.frame().depth(v, u) = flat(v, u) - static_cast<float>(height);
        }
      }
      labels = box.label(kStill, labels.memory);
    }
    return occluderShare(labels, box.covered());
  };
  EXPECT_GT(occludedAfter(1), 0.1);
  for (const int frames : {3, 6, 20}) EXPECT_LT(occludedAfter(frames), 0.001) << frames;
}

TEST(Labeling, NothingIsKnownWhereNothingIsMeasuredOrPredicted) {
  LabelledBox box;
  const cv::Rect pixels = middleOf(box);
  box.frame().depth(pixels) = 0.0f;
  const Labels labels = box.label(kStill);
  EXPECT_EQ(LabelledBox::share(labels, innerOf(box), labels::kUnknown), 1.0);
  EXPECT_EQ(LabelledBox::share(labels, pixels, labels::kUnknown) +
                LabelledBox::share(labels, pixels, labels::kBody),
            1.0)
      << "few missing pixels are as those around";
  EXPECT_GT(labels.logOddsAt((pixels.tl() + pixels.br()) / 2), 0.5f) << "by colour";
  EXPECT_EQ(labels.at({0, 0}), labels::kUnknown);
  EXPECT_EQ(labels.at({-1, 700}), labels::kUnknown);
  EXPECT_EQ(labels.logOddsAt({0, 0}), 0.0f);
  const Labels out_of_sight = box.label(Eigen::Isometry3d(Eigen::Translation3d(9.0, 0.0, 0.0)));
  EXPECT_TRUE(out_of_sight.region.empty());
  EXPECT_EQ(out_of_sight.at({320, 240}), labels::kUnknown);
}

}  // namespace
}  // namespace softbody
