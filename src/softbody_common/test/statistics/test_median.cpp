#include <gtest/gtest.h>

#include "softbody_common/statistics/median.h"

namespace softbody {
namespace {

TEST(MedianOf, HalfOfTheValuesAreBelow) {
  EXPECT_EQ(medianOf<double>({3.0}), 3.0);
  EXPECT_EQ(medianOf<double>({5.0, 1.0, 4.0, 100.0, -7.0}), 4.0);
  EXPECT_EQ(medianOf<double>({2.0, 1.0}), 2.0);
  EXPECT_EQ(medianOf<double>({}), 0.0);
}

}  // namespace
}  // namespace softbody
