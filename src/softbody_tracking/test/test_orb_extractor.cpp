#include <gtest/gtest.h>

#include <array>
#include <opencv2/imgproc.hpp>

#include "core/orb_extractor.h"

namespace softbody {
namespace {

constexpr int kSide = 240, kMargin = 60;  // [px]; ORB finds nothing near the image's border
const cv::Rect kBody(kMargin, kMargin, kSide, kSide);

/// Spots all over a body; those of its upper left quarter stand out most.
cv::Mat3b spottedImage(unsigned seed) {
  cv::Mat3b image(kSide + 2 * kMargin, kSide + 2 * kMargin, cv::Vec3b(60, 60, 60));
  cv::RNG random(seed);
  for (int i = 0; i < 900; ++i) {
    const cv::Point place(kMargin + random.uniform(0, kSide), kMargin + random.uniform(0, kSide));
    const bool strong = place.x < kMargin + kSide / 2 && place.y < kMargin + kSide / 2;
    cv::circle(image, place, 2, cv::Scalar::all(60 + random.uniform(20, 40) + (strong ? 140 : 0)),
               cv::FILLED);
  }
  return image;
}

cv::Mat1b bodyMask(const cv::Size& size) {
  cv::Mat1b mask(size, 0);
  mask(kBody) = 255;
  return mask;
}

class OrbExtractorSpread : public testing::TestWithParam<unsigned> {};

TEST_P(OrbExtractorSpread, FewFeaturesLieAllOverTheBody) {
  const cv::Mat3b image = spottedImage(GetParam());
  const auto keypoints = OrbExtractor(40).extract(image, bodyMask(image.size()), kBody);
  ASSERT_EQ(keypoints.size(), 40u);
  std::array<int, 4> quarters{};
  for (const Keypoint& keypoint : keypoints) {
    const cv::Point quarter = (cv::Point(keypoint.pixel) - kBody.tl()) / (kSide / 2);
    ++quarters.at(static_cast<std::size_t>(2 * quarter.y + quarter.x));
  }
  for (const int count : quarters) EXPECT_GE(count, 3);
}

TEST_P(OrbExtractorSpread, AllAreTakenWhereNoMoreAreThanWanted) {
  const cv::Mat3b image = spottedImage(GetParam());
  const cv::Mat1b mask = bodyMask(image.size());
  const auto many = OrbExtractor(3000).extract(image, mask, kBody),
             more = OrbExtractor(3500).extract(image, mask, kBody);
  EXPECT_GT(many.size(), 200u);
  EXPECT_EQ(many.size(), more.size());
}

/// Where a body shows few features at more than one scale, all that are wanted come nevertheless.
TEST_P(OrbExtractorSpread, AsManyAreTakenAsAreWanted) {
  const cv::Mat3b image = spottedImage(GetParam());
  const cv::Mat1b mask = bodyMask(image.size());
  const std::size_t all = OrbExtractor(3000).extract(image, mask, kBody).size();
  const int most = static_cast<int>(all) - 1;
  EXPECT_EQ(OrbExtractor(most).extract(image, mask, kBody).size(), all - 1);
}

INSTANTIATE_TEST_SUITE_P(Seeds, OrbExtractorSpread, testing::Range(1u, 6u));

}  // namespace
}  // namespace softbody
