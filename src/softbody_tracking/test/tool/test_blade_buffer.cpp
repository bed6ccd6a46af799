#include "blade/blade_buffer.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

constexpr Nanoseconds kMillisecond = 1'000'000;
constexpr Nanoseconds kBladePeriod = 33 * kMillisecond;

/// Reports blades and tf while frames are taken.
struct Tool {
  std::size_t frame(Nanoseconds now) { return updateMask(now).expired; }
  BladeBuffer::Rejected updateMask(Nanoseconds now) {
    const auto look_up = [&](const ReportedBlade& blade) -> std::optional<Eigen::Isometry3d> {
      ++asked;
      if (blade.stamp > tf) return std::nullopt;
      newest = std::max(newest, blade.stamp);
      return Eigen::Isometry3d::Identity();
    };
    return buffer.updateMask(now, look_up, &mask);
  }
  void blade(Nanoseconds stamp) { buffer.add({stamp, "tool", Points::Zero(3, 3)}); }

  BladeBuffer buffer;
  ToolMask mask;
  Nanoseconds tf = 0;       ///< knows poses up to here
  Nanoseconds newest = -1;  ///< blade with a pose
  int asked = 0;            ///< number of pose look-ups
};

TEST(BladeBuffer, ABladeThatNeverGetsAPoseIsCountedOnce) {
  Tool tool;
  tool.blade(1);
  std::size_t expired = 0;
  for (Nanoseconds now = 1; now < 10'000 * kMillisecond; now += kBladePeriod) {
    expired += tool.frame(now);
    EXPECT_EQ(expired, now > ToolMask::kBladeValidity + 1 ? 1u : 0u) << now;
  }
}

TEST(BladeBuffer, ABladeWhosePoseComesAFrameLaterIsNotCounted) {
  Tool tool;
  for (Nanoseconds k = 0; k < 300; ++k) {
    if (k % 2 == 0) tool.blade(k * kBladePeriod);
    EXPECT_EQ(tool.frame(k * kBladePeriod), 0u) << k;
    tool.tf = k * kBladePeriod;
  }
  EXPECT_EQ(tool.newest, 298 * kBladePeriod);
}

TEST(BladeBuffer, BladesOfAFastToolWaitForTheirPoses) {
  constexpr Nanoseconds kBlade = 5 * kMillisecond, kLate = 150 * kMillisecond;
  Tool tool;
  for (Nanoseconds now = 0; now < 3000 * kMillisecond; now += kBlade) {
    tool.blade(now);
    tool.tf = now - kLate;
    if (now % (6 * kBlade) != 0) continue;
    EXPECT_EQ(tool.frame(now), 0u) << now;
    if (now >= kLate) {
      EXPECT_EQ(tool.newest, now - kLate);
    }
  }
}

TEST(BladeBuffer, WithoutFramesTheNewestThousandBladesAreKept) {
  Tool tool;
  tool.tf = -1;
  for (Nanoseconds k = 0; k < 1500; ++k) tool.blade(k * kMillisecond);
  EXPECT_EQ(tool.frame(499 * kMillisecond - ToolMask::kBladeValidity), 0u);
  EXPECT_EQ(tool.asked, 0) << "the blades up to 499 ms should be gone";
  EXPECT_EQ(tool.frame(10'000 * kMillisecond), 1000u);
}

TEST(BladeBuffer, ClearRemovesAllBlades) {
  Tool tool;
  tool.tf = 100 * kBladePeriod;
  for (Nanoseconds k = 0; k < 100; ++k) tool.blade(k * kBladePeriod);
  tool.buffer.clear();
  for (Nanoseconds k = 0; k < 100; ++k) EXPECT_EQ(tool.frame(k * kBladePeriod), 0u);
  EXPECT_EQ(tool.asked, 0);
}

TEST(BladeBuffer, ReportsBladesFromAClockThatIsAhead) {
  for (Nanoseconds lead : {0 * kBladePeriod, 3 * kBladePeriod, 40 * kBladePeriod, 5000 * kBladePeriod}) {
    Tool tool;
    for (Nanoseconds frame = 0; frame < 3000 * kBladePeriod; frame += kBladePeriod) {
      tool.blade(frame + lead);
      // As soon as the frames reach the first blade, one blade is usable, although it is late.
      const bool none_counts = lead - frame > ToolMask::kBladeValidity;
      const Nanoseconds expected = none_counts && frame > 1000 * kMillisecond ? lead : 0;
      ASSERT_EQ(tool.updateMask(frame).lead, expected) << "lead " << lead << ", frame " << frame;
    }
  }
}

TEST(BladeBuffer, ClearRestartsTheTimeThatBladesAreAhead) {
  Tool tool;
  for (Nanoseconds k = 0; k < 300; ++k) {
    tool.blade(3000 * kBladePeriod);
    EXPECT_EQ(tool.updateMask(k * kBladePeriod).lead, 0);
    if (k % 15 == 0) tool.buffer.clear();
  }
}

/// A frame that waits for its segmentation mask comes after later blades.
TEST(BladeBuffer, MasksTheBladeNearestInTimeToTheFrame) {
  constexpr Nanoseconds kWaited = 100 * kMillisecond;
  Points blade(4, 3);
  blade << -0.03, -0.01, 0.5, 0.03, -0.01, 0.5, 0.03, 0.01, 0.5, -0.03, 0.01, 0.5;
  BladeBuffer buffer;
  ToolMask mask;
  const auto look_up = [](const ReportedBlade&) { return Eigen::Isometry3d::Identity(); };
  const auto covered = [&](Nanoseconds stamp, int u) {
    const RgbdFrame frame{stamp, Pinhole{160, 120, 150.0, 150.0, 79.5, 59.5},
                          cv::Mat3b(120, 160, cv::Vec3b(90, 90, 90)), cv::Mat1f(120, 160, 0.5f)};
    EXPECT_EQ(buffer.updateMask(stamp, look_up, &mask).expired, 0u);
    return mask.withoutBlade(frame).depth(60, u) == 0.0f;
  };
  const Points beside = blade.rowwise() + Eigen::RowVector3d(0.1, 0.0, 0.0);
  for (Nanoseconds k = 0; k < 30; ++k) {
    buffer.add({k * kBladePeriod, "tool", k < 15 ? blade : beside});
    const Nanoseconds frame = k * kBladePeriod - kWaited;
    if (frame < 0) continue;
    const bool right = frame + kBladePeriod / 2 >= 15 * kBladePeriod;
    EXPECT_EQ(covered(frame, 80), !right) << k;
    EXPECT_EQ(covered(frame, 110), right) << k;
  }
}

}  // namespace
}  // namespace softbody
