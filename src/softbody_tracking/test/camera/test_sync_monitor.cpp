#include <gtest/gtest.h>

#include "camera/sync_monitor.h"

namespace softbody {
namespace {

constexpr Nanoseconds kMs = 1'000'000, kFramePeriod = 33 * kMs, kAllowed = 15 * kMs;

/// Streams of equal rates. @param depth_late_by of depth, after colour.
SyncMonitor streams(Nanoseconds begin, int frames, Nanoseconds depth_late_by) {
  SyncMonitor monitor(kAllowed);
  for (int k = 0; k < frames; ++k) {
    const Nanoseconds stamp = begin + k * kFramePeriod;
    monitor.noteColor(stamp, stamp);
    monitor.noteDepth(stamp + depth_late_by, stamp);
  }
  return monitor;
}

TEST(SyncMonitor, MeasuresAConstantOffset) {
  for (const Nanoseconds offset : {0 * kMs, 4 * kMs, 14 * kMs}) {
    const SyncMonitor::Offsets offsets = streams(1'000 * kMs, 60, offset).offsets(3'000 * kMs);
    EXPECT_EQ(offsets.colors, 60);
    EXPECT_EQ(offsets.beyond, 0);
    EXPECT_NEAR(offsets.mean_s, 1e-9 * offset, 1e-12);
    EXPECT_NEAR(offsets.worst_s, 1e-9 * offset, 1e-12);
  }
}

TEST(SyncMonitor, MeasuresFromTheNearestDepthImageBeforeOrAfter) {
  const SyncMonitor::Offsets offsets = streams(1'000 * kMs, 60, -4 * kMs).offsets(3'000 * kMs);
  EXPECT_EQ(offsets.colors, 59);  // the newest depth image of all is yet to come
  EXPECT_NEAR(offsets.worst_s, 0.004, 1e-12);
}

TEST(SyncMonitor, CountsColourImagesWithoutAPartner) {
  SyncMonitor monitor(kAllowed);
  for (int k = 0; k < 30; ++k) {
    monitor.noteColor(k * kFramePeriod, k * kFramePeriod);
    if (k % 10 != 5) monitor.noteDepth(k * kFramePeriod, k * kFramePeriod);
  }
  const SyncMonitor::Offsets offsets = monitor.offsets(30 * kFramePeriod);
  EXPECT_EQ(offsets.colors, 30);
  EXPECT_EQ(offsets.beyond, 3);
  EXPECT_NEAR(offsets.worst_s, 0.033, 1e-12);
  EXPECT_NEAR(offsets.mean_s, 0.0033, 1e-12);
}

TEST(SyncMonitor, ForgetsWhatIsOlderThanSomeSeconds) {
  SyncMonitor monitor = streams(0, 60, 10 * kMs);
  for (int k = 0; k < 100; ++k) {
    const Nanoseconds stamp = 2'000 * kMs + k * kFramePeriod;
    monitor.noteColor(stamp, stamp);
    monitor.noteDepth(stamp, stamp);
  }
  EXPECT_EQ(monitor.offsets(2'000 * kMs + 99 * kFramePeriod).worst_s, 0.0);
  EXPECT_EQ(monitor.offsets(60'000 * kMs).colors, 0);
}

TEST(SyncMonitor, StartsAgainWithAClockThatJumpsBack) {
  SyncMonitor monitor = streams(100'000 * kMs, 60, 10 * kMs);
  for (int k = 0; k < 30; ++k) {
    monitor.noteColor(k * kFramePeriod, k * kFramePeriod);
    monitor.noteDepth(k * kFramePeriod, k * kFramePeriod);
  }
  const SyncMonitor::Offsets offsets = monitor.offsets(29 * kFramePeriod);
  EXPECT_EQ(offsets.colors, 30);
  EXPECT_EQ(offsets.worst_s, 0.0);
}

TEST(SyncMonitor, SaysNothingWithOneStream) {
  SyncMonitor monitor(kAllowed);
  EXPECT_EQ(monitor.offsets(0).colors, 0);
  for (int k = 0; k < 30; ++k) monitor.noteColor(k * kFramePeriod, k * kFramePeriod);
  EXPECT_EQ(monitor.offsets(30 * kFramePeriod).colors, 0);
}

TEST(SyncMonitor, KeepsLittleWhenTheClockStandsStill) {
  SyncMonitor monitor(kAllowed);
  for (int k = 0; k < 100'000; ++k) {
    monitor.noteColor(k * kFramePeriod, 0);
    monitor.noteDepth(k * kFramePeriod, 0);
  }
  EXPECT_LE(monitor.offsets(0).colors, 1000);
}

}  // namespace
}  // namespace softbody
