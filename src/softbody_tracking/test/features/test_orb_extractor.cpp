#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <opencv2/imgproc.hpp>

#include "features/orb_extractor.h"

namespace softbody {
namespace {

constexpr int kSide = 240, kMargin = 60;  // [px]; ORB finds nothing near the image's border
const cv::Rect kBody(kMargin, kMargin, kSide, kSide);

cv::Mat3b spottedImage(unsigned seed) {
  cv::Mat3b image(kSide + 2 * kMargin, kSide + 2 * kMargin, cv::Vec3b(60, 60, 60));
  cv::RNG random(seed);
  for (int i = 0; i < 900; ++i) {
    const cv::Point place(kMargin + random.uniform(0, kSide), kMargin + random.uniform(0, kSide));
    cv::circle(image, place, 2, cv::Scalar::all(60 + random.uniform(20, 180)), cv::FILLED);
  }
  return image;
}

cv::Mat1b bodyMask(const cv::Size& size) {
  cv::Mat1b mask(size, 0);
  mask(kBody) = 255;
  return mask;
}

class OrbCorners : public testing::TestWithParam<unsigned> {};

TEST_P(OrbCorners, LieInTheMask) {
  const cv::Mat3b image = spottedImage(GetParam());
  cv::Mat1b mask = bodyMask(image.size());
  const cv::Rect hole(kMargin + 50, kMargin + 80, 60, 40);
  mask(hole) = 0;
  const std::vector<cv::KeyPoint> corners = OrbExtractor().detect(image, mask, kBody);
  EXPECT_GT(corners.size(), 200u);
  for (const cv::KeyPoint& corner : corners) {
    // Keypoints of coarser scales lie between pixels.
    const cv::Point2f inside = corner.pt - cv::Point2f(hole.tl());
    EXPECT_TRUE(kBody.contains(corner.pt));
    EXPECT_FALSE(inside.x > 1 && inside.y > 1 && inside.x < hole.width - 2 && inside.y < hole.height - 2);
  }
}

/// The first half of the list contains half of each scale's keypoints.
TEST_P(OrbCorners, OfEveryScaleTheStrongestComeFirst) {
  const cv::Mat3b image = spottedImage(GetParam());
  const std::vector<cv::KeyPoint> corners = OrbExtractor().detect(image, bodyMask(image.size()), kBody);
  std::map<int, int> all, early;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    ++all[corners[i].octave];
    early[corners[i].octave] += i < corners.size() / 2 ? 1 : 0;
  }
  ASSERT_EQ(all.size(), 4u);
  for (const auto& [octave, count] : all) EXPECT_NEAR(early[octave], 0.5 * count, 1.5) << octave;
}

/// Weak spots on the left half, strong ones on the right.
TEST_P(OrbCorners, TheStrongComeBeforeTheWeak) {
  const cv::Mat3b spots = spottedImage(GetParam());
  cv::Mat3b image = spots.clone();
  const cv::Rect left(0, 0, image.cols / 2, image.rows);
  image(left) = 0.25 * spots(left) + cv::Scalar::all(45);
  const std::vector<cv::KeyPoint> corners = OrbExtractor().detect(image, bodyMask(image.size()), kBody);
  const auto weak = [&](const cv::KeyPoint& corner) { return corner.pt.x < left.width - 10; };
  const auto quarter = static_cast<std::ptrdiff_t>(corners.size() / 4);
  EXPECT_GT(std::count_if(corners.begin(), corners.end(), weak), quarter);
  EXPECT_EQ(std::count_if(corners.begin(), corners.begin() + quarter, weak), 0);
}

/// The descriptor of a corner does not depend on other corners.
TEST_P(OrbCorners, AreDescribedAlikeAloneAndTogether) {
  const cv::Mat3b image = spottedImage(GetParam());
  OrbExtractor orb;
  const std::vector<cv::KeyPoint> corners = orb.detect(image, bodyMask(image.size()), kBody);
  const std::vector<Keypoint> all = orb.describe(image, kBody, corners);
  ASSERT_EQ(all.size(), corners.size());
  for (std::size_t i = 0; i < corners.size(); i += 37) {
    const std::vector<Keypoint> alone = orb.describe(image, kBody, {corners[i]});
    ASSERT_EQ(alone.size(), 1u);
    const auto same = [&](const Keypoint& keypoint) {
      return keypoint.pixel == alone[0].pixel && keypoint.descriptor == alone[0].descriptor;
    };
    EXPECT_TRUE(std::any_of(all.begin(), all.end(), same));
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, OrbCorners, testing::Range(1u, 6u));

TEST(OrbExtractor, FindsNothingWhereNothingIs) {
  OrbExtractor orb;
  const cv::Mat3b plain(200, 200, cv::Vec3b(50, 50, 50));
  EXPECT_TRUE(orb.extract(plain, cv::Mat1b(plain.size(), 255), {0, 0, 200, 200}).empty());
  EXPECT_TRUE(orb.extract(cv::Mat3b(40, 40, cv::Vec3b()), cv::Mat1b(40, 40, 255), {0, 0, 10, 10}).empty());
  EXPECT_TRUE(orb.describe(plain, {0, 0, 200, 200}, {}).empty());
}

}  // namespace
}  // namespace softbody
