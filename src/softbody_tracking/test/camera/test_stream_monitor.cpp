#include <test_support/gtest.h>

#include "camera/stream_monitor.h"

namespace softbody {
namespace {

const StreamTopics kTopics{StreamTopic{"/cam/color", 1}, StreamTopic{"/cam/info", 1},
                           StreamTopic{"/cam/depth", 0}};
constexpr Nanoseconds kPairTolerance = 15'000'000, kPeriod = 33'333'333, kSilence = 2'000'000'000;

bool says(const StreamMonitor& monitor, const std::string& words, Nanoseconds now = 0) {
  return monitor.diagnosis(kTopics, now).find(words) != std::string::npos;
}

TEST(StreamMonitor, NamesExactlyTheSilentTopics) {
  const Stream streams[] = {Stream::kColor, Stream::kColorInfo, Stream::kDepth};
  for (int arriving = 0; arriving < 7; ++arriving) {
    StreamMonitor monitor(kPairTolerance, kSilence);
    for (int s = 0; s < 3; ++s) {
      if ((arriving >> s & 1) != 0) monitor.noteArrival(streams[s], 1000, 0);
    }
    for (int s = 0; s < 3; ++s)
      EXPECT_EQ(says(monitor, kTopics[s].name), (arriving >> s & 1) == 0) << arriving;
  }
}

TEST(StreamMonitor, TellsAbsentPublishersFromSilentOnes) {
  const StreamMonitor monitor(kPairTolerance, kSilence);
  EXPECT_TRUE(says(monitor, "/cam/depth (nobody publishes it)"));
  EXPECT_TRUE(says(monitor, "/cam/color (publishers: 1, but silent)"));
}

TEST(StreamMonitor, TellsImagesWithoutAStampFromNone) {
  StreamMonitor monitor(kPairTolerance, kSilence);
  monitor.noteUnstamped(Stream::kColor);
  EXPECT_TRUE(says(monitor, "/cam/color (the stamp of its images is 0)"));
  EXPECT_TRUE(says(monitor, "/cam/info (publishers: 1, but silent)"));
  monitor.noteFrame();
  EXPECT_TRUE(says(monitor, "/cam/color (publishers: 1, but silent)"));
}

TEST(StreamMonitor, MeasuresHowFarStampsAreApart) {
  StreamMonitor monitor(kPairTolerance, kSilence);
  for (int k = 0; k < 100; ++k) {
    monitor.noteArrival(Stream::kColor, k * kPeriod, k * kPeriod);
    monitor.noteArrival(Stream::kColorInfo, k * kPeriod, k * kPeriod);
    monitor.noteArrival(Stream::kDepth, k * kPeriod + 16'000'000, k * kPeriod);
  }
  EXPECT_TRUE(says(monitor, "differ by 16.0 ms", 100 * kPeriod));
  EXPECT_TRUE(says(monitor, "tolerance is 15.0 ms", 100 * kPeriod));
}

/// Depth is silent when colour, which was, comes back.
TEST(StreamMonitor, WhatCameLongAgoIsSilentNow) {
  constexpr Nanoseconds kLater = 100'000'000'000;
  StreamMonitor monitor(kPairTolerance, kSilence);
  for (const Stream stream : {Stream::kColorInfo, Stream::kDepth}) monitor.noteArrival(stream, 0, 0);
  monitor.noteArrival(Stream::kColor, kLater, kLater);
  EXPECT_TRUE(says(monitor, "no usable message on /cam/depth", kLater)) << monitor.diagnosis(kTopics, kLater);
  monitor.noteArrival(Stream::kDepth, 0, kLater);
  EXPECT_TRUE(says(monitor, "differ by 100000.0 ms", kLater)) << "another clock";
}

TEST(StreamMonitor, OneCameraInfoIsEnough) {
  StreamMonitor monitor(kPairTolerance, kSilence);
  monitor.noteArrival(Stream::kColorInfo, 0, 0);
  monitor.noteFrame();
  EXPECT_FALSE(says(monitor, "/cam/info", 10 * kSilence));
  EXPECT_TRUE(says(monitor, "/cam/color", 10 * kSilence));
}

TEST(StreamMonitor, KnowsWhatEverCame) {
  StreamMonitor monitor(kPairTolerance, kSilence);
  monitor.noteArrival(Stream::kColor, 0, 0);
  monitor.noteUnstamped(Stream::kDepth);
  monitor.noteFrame();
  EXPECT_TRUE(monitor.hasArrived(Stream::kColor));
  EXPECT_TRUE(monitor.hasArrived(Stream::kDepth));
  EXPECT_FALSE(monitor.hasArrived(Stream::kColorInfo));
}

TEST(StreamMonitor, ARefusalIsGivenUntilAFrameIsComplete) {
  StreamMonitor monitor(kPairTolerance, kSilence);
  for (const Stream stream : {Stream::kColor, Stream::kColorInfo, Stream::kDepth})
    monitor.noteArrival(stream, 5, 0);
  monitor.noteRefusal("sizes differ");
  EXPECT_TRUE(says(monitor, "sizes differ"));
  monitor.noteFrame();
  EXPECT_FALSE(says(monitor, "sizes differ"));
}

}  // namespace
}  // namespace softbody
