#include <gtest/gtest.h>

#include <opencv2/imgproc.hpp>

#include "patches/gray_pyramid.h"

namespace softbody {
namespace {

cv::Mat3b randomImage(const cv::Size& size) {
  cv::Mat3b image(size);
  cv::RNG(7).fill(image, cv::RNG::UNIFORM, 0, 255);
  return image;
}

/// The expected pyramid: the region from a multiple of four on, halved; each pixel with the one below it.
void expectPairs(const GrayPyramid& pyramid, const cv::Mat3b& image, const cv::Rect& region) {
  const cv::Rect wide(cv::Point(region.x / 4 * 4, region.y / 4 * 4), region.br());
  cv::Mat1b gray;
  cv::cvtColor(image(wide), gray, cv::COLOR_BGR2GRAY);
  for (int l = 0; l < GrayPyramid::kLevels; ++l) {
    const RowPairs& pairs = pyramid.level(l);
    ASSERT_EQ(pairs.empty(), gray.rows == 1) << region << l;
    if (!pairs.empty()) {
      ASSERT_EQ(pairs.size(), cv::Size(gray.cols, gray.rows - 1)) << region << l;
    }
    for (int v = 0; v < pairs.rows; ++v) {
      for (int u = 0; u < pairs.cols; ++u)
        ASSERT_EQ(pairs(v, u), cv::Vec2b(gray(v, u), gray(v + 1, u))) << region << l << " " << u << " " << v;
    }
    cv::Mat1b half;
    cv::pyrDown(gray, half);
    gray = half;
  }
  const cv::Point2f first = wide.tl();
  EXPECT_EQ(pyramid.toLevel(first + cv::Point2f(8, 4), 2), cv::Point2f(2, 1));
  EXPECT_EQ(pyramid.toFrame({2, 1}, 2), first + cv::Point2f(8, 4));
}

TEST(GrayPyramid, PairsAreTheRegionsPixelsWithThoseBelow) {
  const cv::Mat3b image = randomImage({123, 77});
  for (const cv::Rect& region :
       {cv::Rect(0, 0, 123, 77), cv::Rect(17, 9, 60, 31), cv::Rect(122, 76, 1, 1), cv::Rect(4, 8, 1, 1),
        cv::Rect(50, 2, 1, 40), cv::Rect(3, 70, 90, 1), cv::Rect(61, 33, 62, 44)}) {
    expectPairs(GrayPyramid(image, region), image, region);
  }
}

TEST(GrayPyramid, FollowsTheImagesSize) {
  for (const cv::Size& size : {cv::Size(40, 30), cv::Size(91, 63), cv::Size(1, 1), cv::Size(33, 50)}) {
    const cv::Mat3b image = randomImage(size);
    const cv::Rect all(cv::Point(), size);
    expectPairs(GrayPyramid(image, all), image, all);
  }
}

TEST(GrayPyramid, IsEmptyWhereTheRegionIs) {
  const GrayPyramid pyramid(randomImage({64, 48}), cv::Rect());
  for (int l = 0; l < GrayPyramid::kLevels; ++l) EXPECT_TRUE(pyramid.level(l).empty());
}

/// Levels are made late, so a copy may make its own.
TEST(GrayPyramid, CopiesAreEqual) {
  const cv::Mat3b image = randomImage({64, 48});
  const cv::Rect all(0, 0, 64, 48);
  const GrayPyramid first(image, all), copy = first;
  expectPairs(copy, image, all);
  expectPairs(first, image, all);
}

}  // namespace
}  // namespace softbody
