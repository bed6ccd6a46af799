#include <gtest/gtest.h>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "paper/frame_features.h"

namespace softbody::evaluation {
namespace {

constexpr double kFocal = 500.0;
// A corner of the coarsest level has a place to a pixel of it, in both directions.
const double kCoarsest_px = std::sqrt(2.0) * std::pow(1.2, 3);

/// A textured plane at a distance of 1 m. @param shift of its texture [px].
RgbdFrame plane(const cv::Point& shift) {
  RgbdFrame frame;
  frame.camera = {320, 240, kFocal, kFocal, 160.0, 120.0};
  cv::Mat1b texture(400, 400);
  cv::theRNG().state = 5;
  cv::randu(texture, 0, 255);
  cv::GaussianBlur(texture, texture, {}, 2.0);
  cv::normalize(texture, texture, 0, 255, cv::NORM_MINMAX);
  cv::cvtColor(texture(cv::Rect(cv::Point(50, 50) - shift, cv::Size(320, 240))), frame.color,
               cv::COLOR_GRAY2BGR);
  frame.depth = cv::Mat1f(240, 320, 1.0f);
  return frame;
}

TEST(FrameFeatures, FollowTheTextureFromFrameToFrame) {
  const RgbdFrame first = plane({});
  FrameFeatures features(200, first, first.depth);
  ASSERT_EQ(features.all().size(), 200u);
  for (const int step : {1, 2, 3}) {
    const std::vector<TrackedFeature> found = features.follow(plane({10 * step, -5 * step}));
    ASSERT_GT(found.size(), features.all().size() / 2);
    for (const TrackedFeature& feature : found) {
      const Eigen::Vector3d moved(10 * step / kFocal, -5 * step / kFocal, 0.0);
      ASSERT_LT((feature.position - feature.reference - moved).norm(), kCoarsest_px / kFocal);
    }
  }
}

TEST(FrameFeatures, LieOnTheBodyOnly) {
  const RgbdFrame first = plane({});
  cv::Mat1f body = first.depth.clone();
  body.colRange(160, 320) = 0.0f;
  const FrameFeatures features(200, first, body);
  ASSERT_GT(features.all().size(), 50u);
  for (const TrackedFeature& feature : features.all()) EXPECT_LT(feature.pixel.x(), 160.0);
}

TEST(FrameFeatures, LeaveOutWhatMovesOtherwiseThanItsNeighbours) {
  const RgbdFrame first = plane({});
  FrameFeatures features(200, first, first.depth);
  RgbdFrame next = plane({});
  const cv::Rect patch(140, 100, 40, 40);
  plane({20, 0}).color(patch).copyTo(next.color(patch));
  const std::vector<TrackedFeature> found = features.follow(next);
  ASSERT_GT(found.size(), 100u);
  for (const TrackedFeature& feature : found)
    EXPECT_LT((feature.position - feature.reference).norm(), 0.012) << feature.pixel.transpose();
}

}  // namespace
}  // namespace softbody::evaluation
