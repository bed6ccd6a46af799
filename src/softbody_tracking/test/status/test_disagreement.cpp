#include "status/disagreement.h"

#include <gtest/gtest.h>

#include <random>

#include "fixtures/labelled_box.h"

namespace softbody {
namespace {

using Kind = Disagreement::Kind;
constexpr double kPixel = 0.5 / 615.0;  // [m] that one pixel shows
const Eigen::Isometry3d kStill = Eigen::Isometry3d::Identity();

Eigen::Isometry3d shifted(const Eigen::Vector3d& by) { return Eigen::Isometry3d(Eigen::Translation3d(by)); }

/// A motion in the camera's frame as one in the box's frame.
Eigen::Isometry3d seenAs(const Eigen::Isometry3d& motion) { return boxPose().inverse() * motion * boxPose(); }

/// A box whose labels are exact.
class DisagreementTest : public ::testing::Test {
 protected:
  Disagreement largest(const Eigen::Isometry3d& predicted, const std::vector<float>& deviations = {}) {
    const PredictedSurface surface = box_.surfaceAt(predicted);
    Labels labels;
    labels.region = cv::Rect({}, box_.truth().size());
    labels.label = box_.truth();
    return largestDisagreement({labels, surface, box_.frame().depth, 1.0, deviations});
  }

  std::vector<float> deviations(float each_m) {
    return std::vector<float>(static_cast<std::size_t>(box_.boxAt(kStill).rows()), each_m);
  }

  LabelledBox box_;
};

TEST_F(DisagreementTest, NothingDisagreesWithTheTruth) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> angle(-0.5, 0.5);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Isometry3d pose(Eigen::AngleAxisd(angle(generator), Eigen::Vector3d::UnitX()) *
                                 Eigen::AngleAxisd(angle(generator), Eigen::Vector3d::UnitZ()));
    box_.show(pose);
    EXPECT_LT(largest(pose).error_m, 0.003) << i;
  }
}

/// A body beside its prediction is off by the width of what shows between them; widths are some percent off.
TEST_F(DisagreementTest, IsAtMostTheErrorAndNearlyAll) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> angle(-M_PI, M_PI);
  for (const double off_m : {0.01, 0.02, 0.03}) {
    for (int i = 0; i < 10; ++i) {
      const double direction = angle(generator);
      const Eigen::Vector3d by(off_m * std::cos(direction), off_m * std::sin(direction), 0.0);
      const Disagreement found = largest(seenAs(shifted(by)));
      EXPECT_LT(found.error_m, 1.15 * off_m + 2.0 * kPixel) << by.transpose();
      EXPECT_GT(found.error_m, 0.5 * off_m) << by.transpose();
    }
  }
}

TEST_F(DisagreementTest, NamesTheSideWithoutTheBody) {
  const Disagreement found = largest(seenAs(shifted({0.03, 0.0, 0.0})), deviations(0.02f));
  EXPECT_EQ(found.kind, Kind::kBackground);
  EXPECT_EQ(found.side, "right");
}

TEST_F(DisagreementTest, SeesTheBodyBehindItsPrediction) {
  const Disagreement found = largest(seenAs(shifted({0.0, 0.0, -0.015})));
  EXPECT_EQ(found.kind, Kind::kBehind);
  EXPECT_NEAR(found.error_m, 0.015, 0.004) << "less where the surface is inclined";
}

/// Something before the body is no error, and what it hides is not known.
TEST_F(DisagreementTest, AnOccluderSaysNothing) {
  const double before = largest(kStill).error_m;
  cv::Rect half = box_.covered();
  half.width /= 2;
  box_.cover(half, box_.nearest() - 0.05f, {30, 60, 200});
  EXPECT_LE(largest(kStill).error_m, before + 2.0 * kPixel);
  EXPECT_LE(largest(seenAs(shifted({-0.02, 0.0, 0.0}))).error_m, 0.02 + 2.0 * kPixel);
}

/// What shows beyond the outline may be something like the body, or within what the state expects.
TEST_F(DisagreementTest, WhatShowsBeyondMustBeSignificant) {
  const Eigen::Isometry3d small = seenAs(shifted({0.0, 0.0, 0.1}));
  const Disagreement found = largest(small);
  EXPECT_EQ(found.kind, Kind::kBeyond);
  EXPECT_GT(found.error_m, 0.005);
  EXPECT_LT(largest(small, deviations(0.02f)).error_m, found.error_m);
}

TEST_F(DisagreementTest, TheBoundIsThatOfHalfOfTheShownPlaces) {
  const TetTopology volume = makeBox().volume;
  std::vector<Association> shown(5);
  for (Association& association : shown) association.place = {0, {0.25, 0.25, 0.25, 0.25}};
  EXPECT_EQ(medianBound(shown, volume, {}), 0.0);
  const double bound_m = medianBound(shown, volume, deviations(0.01f));
  EXPECT_NEAR(bound_m, 0.0144, 0.0001);
  // Of the distances in space with this deviation 90 % are within.
  std::mt19937 generator(3);
  std::normal_distribution<double> each(0.0, 0.01 / std::sqrt(3.0));
  int within = 0;
  for (int i = 0; i < 20000; ++i)
    within += std::hypot(each(generator), each(generator), each(generator)) <= bound_m ? 1 : 0;
  EXPECT_NEAR(within / 20000.0, 0.9, 0.01);
}

TEST(MeanDisagreement, OneFrameIsNotEnough) {
  MeanDisagreement mean;
  Nanoseconds stamp = 0;
  const auto after = [&](double error_m) {
    return mean.add({Kind::kBehind, error_m, "left"}, stamp += 33'333'333).error_m;
  };
  EXPECT_EQ(after(0.002), 0.002) << "the first frame counts alone";
  EXPECT_LT(after(0.02), 0.01);
  for (int i = 0; i < 15; ++i) after(0.02);
  EXPECT_NEAR(after(0.02), 0.02, 0.001);
  EXPECT_GT(after(0.0), 0.01) << "nor is one right frame";
  mean.reset();
  EXPECT_EQ(after(0.001), 0.001);
}

}  // namespace
}  // namespace softbody
