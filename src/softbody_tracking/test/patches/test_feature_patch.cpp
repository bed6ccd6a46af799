#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>
#include <random>
#include <vector>

#include "patches/feature_patch.h"
#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

/// Smooth random texture.
cv::Mat3b texture() {
  cv::Mat3b noise(200, 200);
  cv::RNG random(7);
  random.fill(noise, cv::RNG::UNIFORM, 0, 255);
  cv::Mat3b smooth;
  cv::GaussianBlur(noise, smooth, cv::Size(), 2.5);
  cv::Mat3b strong;
  smooth.convertTo(strong, -1, 3.0, -255.0);
  return strong;
}

GrayPyramid pyramidOf(const cv::Mat3b& image) { return {image, cv::Rect(cv::Point(), image.size())}; }

/// The texture under an affine map about a pixel, with another brightness and contrast.
cv::Mat3b warped(const cv::Matx22f& A, const cv::Point2f& from, const cv::Point2f& to) {
  const cv::Matx23f map(A(0, 0), A(0, 1), to.x - A(0, 0) * from.x - A(0, 1) * from.y,  //
                        A(1, 0), A(1, 1), to.y - A(1, 0) * from.x - A(1, 1) * from.y);
  cv::Mat3b image, result;
  cv::warpAffine(texture(), image, map, cv::Size(200, 200), cv::INTER_CUBIC, cv::BORDER_REFLECT);
  image.convertTo(result, -1, 0.7, 30.0);
  return result;
}

TEST(FeaturePatch, FindsItselfToAFractionOfAPixelUnderAnyWarpAndLight) {
  const GrayPyramid reference = pyramidOf(texture());
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  int found = 0, tried = 0;
  for (int trial = 0; trial < 200; ++trial) {
    const cv::Point2f pixel(100.0f + 40.0f * uniform(random), 100.0f + 40.0f * uniform(random));
    FeaturePatch patch;
    if (!patch.learn(reference, pixel)) continue;
    const cv::Matx22f A(1.0f + 0.15f * uniform(random), 0.15f * uniform(random), 0.15f * uniform(random),
                        1.0f + 0.15f * uniform(random));
    const cv::Point2f to(100.3f, 99.6f);
    const GrayPyramid image = pyramidOf(warped(A, pixel, to));
    Eigen::Matrix2f warp;
    warp << A(0, 0), A(0, 1), A(1, 0), A(1, 1);
    const cv::Point2f start = to + cv::Point2f(3.0f * uniform(random), 3.0f * uniform(random));
    const FeaturePatch::Alignment alignment = patch.align(image, warp, start, GrayPyramid::kLevels - 1);
    ++tried;
    if (alignment.correlation > 0.9f && cv::norm(alignment.pixel - to) < 0.15) ++found;
  }
  ASSERT_GT(tried, 100);
  EXPECT_GT(found, 0.9 * tried);
}

/// The warp is never exactly as predicted, so the steps shrink slowly.
TEST(FeaturePatch, StopsWhereItHardlyMovesOn) {
  const GrayPyramid image = pyramidOf(texture());
  std::mt19937 random(3);
  std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
  std::vector<double> left;
  for (int trial = 0; trial < 400; ++trial) {
    const cv::Point2f pixel(100.0f + 60.0f * uniform(random), 100.0f + 60.0f * uniform(random));
    FeaturePatch patch;
    if (!patch.learn(image, pixel)) continue;
    Eigen::Matrix2f warp;
    warp << 1.0f + 0.1f * uniform(random), 0.1f * uniform(random), 0.1f * uniform(random),
        1.0f + 0.1f * uniform(random);
    const cv::Point2f start = pixel + cv::Point2f(uniform(random), uniform(random));
    const FeaturePatch::Alignment once = patch.align(image, warp, start, 0);
    cv::Point2f last = once.pixel;
    for (int i = 0; i < 20; ++i) last = patch.align(image, warp, last, 0).pixel;
    left.push_back(cv::norm(last - once.pixel));
  }
  ASSERT_GT(left.size(), 200u);
  EXPECT_LT(median(&left), 0.008);
}

TEST(FeaturePatch, LearnsNothingFromBlankPixelsEdgesOrTheBorder) {
  FeaturePatch patch;
  EXPECT_FALSE(patch.learn(pyramidOf(cv::Mat3b(100, 100, cv::Vec3b(90, 90, 90))), {50, 50}));
  cv::Mat3b edge(100, 100, cv::Vec3b(40, 40, 40));
  edge.colRange(50, 100).setTo(cv::Vec3b(200, 200, 200));
  EXPECT_FALSE(patch.learn(pyramidOf(edge), {50, 50})) << "an edge does not fix the position along it";
  EXPECT_FALSE(patch.learn(pyramidOf(texture()), {2, 100}));
  EXPECT_FALSE(patch.learn(GrayPyramid(), {2, 100}));
}

TEST(FeaturePatch, DoesNotCorrelateWithWhatItIsNot) {
  FeaturePatch patch;
  ASSERT_TRUE(patch.learn(pyramidOf(texture()), {100, 100}));
  cv::Mat3b other;
  cv::rotate(texture(), other, cv::ROTATE_180);
  const auto alignment = patch.align(pyramidOf(other), Eigen::Matrix2f::Identity(), {60, 60}, 0);
  EXPECT_LT(alignment.correlation, 0.75f);
  EXPECT_EQ(patch.align(pyramidOf(texture()), Eigen::Matrix2f::Identity(), {-30, 500}, 2).correlation, -1.0f);
}

}  // namespace
}  // namespace softbody
