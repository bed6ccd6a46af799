#include <gtest/gtest.h>

#include <cmath>

#include "softbody_evaluation/measures/absences.h"

namespace softbody::evaluation {
namespace {

/// 10 s at 30 Hz, followed with an error of 1 mm, hidden from 4 s to 6 s; then 5 mm until `recovered`.
std::vector<FrameOcclusion> sequence(double recovered) {
  std::vector<FrameOcclusion> frames(300);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const double t = static_cast<double>(i) / 30.0;
    const bool hidden = t >= 4.0 && t < 6.0;
    frames[i].time_s = t;
    frames[i].covered_share = hidden ? 0.4 : 0.1;
    frames[i].mean_error = t < 4.0 || t >= recovered - 1e-9 ? 1e-3 : 5e-3;
    if (hidden) frames[i].covered_errors = {2e-3f, 4e-3f};
  }
  return frames;
}

TEST(Absences, TheTimeUntilTheErrorIsBackIsTheRecovery) {
  for (const double after : {0.0, 0.1, 0.5, 2.0}) {
    const std::vector<Absence> all = absences(sequence(6.0 + after));
    ASSERT_EQ(all.size(), 1u);
    EXPECT_NEAR(all[0].begin_s, 4.0, 1e-9);
    EXPECT_NEAR(all[0].end_s, 6.0, 1e-9);
    EXPECT_NEAR(all[0].covered_share, 0.4, 1e-12);
    EXPECT_NEAR(all[0].covered.mean, 3e-3, 1e-9);
    EXPECT_NEAR(all[0].normal, 1e-3, 1e-9);
    ASSERT_TRUE(all[0].recovery_s);
    EXPECT_NEAR(*all[0].recovery_s, after, 1.0 / 30.0);
    EXPECT_EQ(all[0].recovery_to_before_s, all[0].recovery_s);
  }
}

/// A body that bends while it is hidden is followed less well than one at rest before, whoever hides it.
TEST(Absences, WhereTheErrorOfAnUnhiddenBodyIsKnownItIsTheNormalOne) {
  std::vector<FrameOcclusion> frames = sequence(6.5);
  for (FrameOcclusion& frame : frames) {
    if (frame.time_s >= 6.5) frame.mean_error = 3e-3;
  }
  EXPECT_FALSE(absences(frames).front().recovery_s);
  for (FrameOcclusion& frame : frames) frame.unhidden_error = frame.time_s < 4.0 ? 1e-3 : 2.6e-3;
  const Absence absence = absences(frames).front();
  EXPECT_NEAR(*absence.recovery_s, 0.5, 1.0 / 30.0);
  EXPECT_EQ(absence.normal, 2.6e-3);
  EXPECT_FALSE(absence.recovery_to_before_s) << "3 mm were never normal before";
  for (FrameOcclusion& frame : frames) frame.unhidden_error = 2.4e-3;
  EXPECT_FALSE(absences(frames).front().recovery_s) << "3.0 mm are more than 1.2 times 2.4 mm";
}

TEST(Absences, WhoNeverRecoversHasNoTimeAndAnUnansweredFrameIsNoRecovery) {
  EXPECT_FALSE(absences(sequence(99.0)).front().recovery_s);
  std::vector<FrameOcclusion> frames = sequence(6.0);
  for (std::size_t i = 180; i < 210; ++i) frames[i].mean_error = INFINITY;
  EXPECT_NEAR(*absences(frames).front().recovery_s, 1.0, 1.0 / 30.0);
}

TEST(Absences, AMomentOfSmallErrorIsNoRecovery) {
  std::vector<FrameOcclusion> frames = sequence(7.0);
  frames[185].mean_error = frames[186].mean_error = 1e-3;
  EXPECT_NEAR(*absences(frames).front().recovery_s, 1.0, 1.0 / 30.0);
}

TEST(Absences, ShortOnesAndBodiesThatStayInViewHaveNone) {
  std::vector<FrameOcclusion> frames = sequence(6.0);
  for (FrameOcclusion& frame : frames) frame.covered_share = 0.2;
  EXPECT_TRUE(absences(frames).empty());
  for (std::size_t i = 100; i < 103; ++i) frames[i].covered_share = 1.0;
  EXPECT_TRUE(absences(frames).empty());
  EXPECT_TRUE(absences({}).empty());
}

TEST(Absences, OneThatLastsToTheEndIsNotRecoveredFrom) {
  std::vector<FrameOcclusion> frames = sequence(6.0);
  frames.resize(170);
  const std::vector<Absence> all = absences(frames);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_FALSE(all[0].recovery_s);
}

}  // namespace
}  // namespace softbody::evaluation
