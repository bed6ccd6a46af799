#include <gtest/gtest.h>

#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

TEST(RosTime, EveryStampHasADistanceFromEveryOther) {
  const ros::Time first(0, 1), last(4294967295U, 999999999U);
  EXPECT_THROW(last - first, std::runtime_error) << "the reason for these functions";
  EXPECT_NEAR(secondsBetween(first, last), 4294967296.0, 1e-3);
  EXPECT_NEAR(secondsBetween(last, first), -4294967296.0, 1e-3);
  EXPECT_DOUBLE_EQ(secondsBetween(ros::Time(10, 500000000), ros::Time(12, 0)), 1.5);
}

TEST(RosTime, WhatIsBeyondTheRangeOfAMessageBecomesItsEnd) {
  EXPECT_EQ(toNanoseconds(toTime(kLatestTime)), kLatestTime);
  EXPECT_EQ(toTime(kLatestTime + 5'000'000'000), toTime(kLatestTime));
  EXPECT_EQ(toTime(-1), ros::Time(0, 0));
  ros::Time unnormalized;
  unnormalized.sec = unnormalized.nsec = 4294967295U;
  EXPECT_EQ(toNanoseconds(unnormalized), kLatestTime);
  EXPECT_GT(toDuration(kLatestTime).toSec(), 2e9);
  EXPECT_LT(toDuration(-kLatestTime).toSec(), -2e9);
  EXPECT_DOUBLE_EQ(toDuration(-1'500'000'000).toSec(), -1.5);
}

}  // namespace
}  // namespace softbody
