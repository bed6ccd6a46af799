#include <gtest/gtest.h>

#include <numeric>

#include "cutting/blade/blade_outline.h"

namespace softbody {
namespace {

Points rectangle(double width, double height) {
  Points corners(4, 3);
  corners << 0, 0, 0, width, 0, 0, width, height, 0, 0, height, 0;
  return corners;
}

TEST(BladeOutline, SamplesAreAsNearAsAskedForAndBeginAtTheCorners) {
  const Points blade = rectangle(0.15, 0.04);
  const std::vector<int> parts = partsOfSides(blade, 0.007);
  EXPECT_EQ(parts, std::vector<int>({22, 6, 22, 6}));
  const Points samples = sampleOutline(blade, parts);
  ASSERT_EQ(samples.rows(), 56);
  for (Eigen::Index i = 0; i < samples.rows(); ++i)
    EXPECT_LE((samples.row((i + 1) % samples.rows()) - samples.row(i)).norm(), 0.007);
  int first = 0;
  for (Eigen::Index corner = 0; corner < 4; ++corner) {
    EXPECT_EQ(samples.row(first), blade.row(corner));
    first += parts[static_cast<std::size_t>(corner)];
  }
}

TEST(BladeOutline, AHugeBladeHasNoMoreSamplesThanALargeOne) {
  for (const double scale : {10.0, 1e3, 1e9}) {
    const std::vector<int> parts = partsOfSides(rectangle(0.15 * scale, 0.04 * scale), 0.007);
    EXPECT_LE(std::accumulate(parts.begin(), parts.end(), 0), 404) << scale;
    EXPECT_GE(std::accumulate(parts.begin(), parts.end(), 0), 400) << scale;
  }
}

}  // namespace
}  // namespace softbody
