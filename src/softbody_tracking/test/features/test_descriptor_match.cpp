#include <gtest/gtest.h>

#include "features/descriptor_match.h"

namespace softbody {
namespace {

std::vector<Keypoint> keypointsAt(const std::vector<cv::Point2f>& pixels) {
  std::vector<Keypoint> keypoints(pixels.size());
  for (std::size_t k = 0; k < pixels.size(); ++k) keypoints[k].pixel = pixels[k];
  return keypoints;
}

TEST(DescriptorMatch, TakesTheNearestThatHasNoRivalElsewhere) {
  const std::vector<Keypoint> apart = keypointsAt({{10.0f, 10.0f}, {50.0f, 10.0f}, {90.0f, 10.0f}});
  EXPECT_EQ(clearlyNearest({{60, 0}, {20, 2}, {24, 1}}, apart), 1);
  EXPECT_EQ(clearlyNearest({{60, 0}, {20, 2}, {23, 1}}, apart), -1) << "nearly as near";
  EXPECT_EQ(clearlyNearest({{kMaxHammingDistance + 1, 0}}, apart), -1) << "too far";
  EXPECT_EQ(clearlyNearest({}, apart), -1);
}

TEST(DescriptorMatch, KeypointsOfOnePlaceAreNoRivals) {
  const std::vector<Keypoint> close = keypointsAt({{10.0f, 10.0f}, {12.0f, 12.0f}});
  EXPECT_EQ(clearlyNearest({{20, 0}, {20, 1}}, close), 0);
  const std::vector<Keypoint> apart = keypointsAt({{10.0f, 10.0f}, {12.0f, 13.0f}});
  EXPECT_EQ(clearlyNearest({{20, 0}, {20, 1}}, apart), -1);
}

}  // namespace
}  // namespace softbody
