#include <gtest/gtest.h>

#include "softbody_tracking/stream_monitor.h"

namespace softbody {
namespace {

const StreamTopics kTopics{StreamTopic{"/cam/color", 1}, StreamTopic{"/cam/info", 1},
                           StreamTopic{"/cam/depth", 0}};
constexpr Nanoseconds kTolerance = 15'000'000, kPeriod = 33'333'333;

bool says(const StreamMonitor& monitor, const std::string& words) {
  return monitor.complaint(kTopics).find(words) != std::string::npos;
}

TEST(StreamMonitor, NamesExactlyTheSilentTopics) {
  const Stream streams[] = {Stream::kColor, Stream::kColorInfo, Stream::kDepth};
  for (int arriving = 0; arriving < 7; ++arriving) {
    StreamMonitor monitor(kTolerance);
    for (int s = 0; s < 3; ++s) {
      if ((arriving >> s & 1) != 0) monitor.arrived(streams[s], 1000);
    }
    for (int s = 0; s < 3; ++s)
      EXPECT_EQ(says(monitor, kTopics[s].name), (arriving >> s & 1) == 0) << arriving;
  }
}

TEST(StreamMonitor, TellsAbsentPublishersFromSilentOnes) {
  const StreamMonitor monitor(kTolerance);
  EXPECT_TRUE(says(monitor, "/cam/depth (nobody publishes it)"));
  EXPECT_TRUE(says(monitor, "/cam/color (publishers: 1, but silent)"));
}

TEST(StreamMonitor, TellsImagesWithoutAStampFromNone) {
  StreamMonitor monitor(kTolerance);
  monitor.unstamped(Stream::kColor);
  EXPECT_TRUE(says(monitor, "/cam/color (its images have no stamp)"));
  EXPECT_TRUE(says(monitor, "/cam/info (publishers: 1, but silent)"));
  monitor.completed();
  EXPECT_TRUE(says(monitor, "/cam/color (publishers: 1, but silent)"));
}

TEST(StreamMonitor, MeasuresHowFarStampsAreApart) {
  StreamMonitor monitor(kTolerance);
  for (int k = 0; k < 100; ++k) {
    monitor.arrived(Stream::kColor, k * kPeriod);
    monitor.arrived(Stream::kColorInfo, k * kPeriod);
    monitor.arrived(Stream::kDepth, k * kPeriod + 16'000'000);
  }
  EXPECT_TRUE(says(monitor, "differ by 16.0 ms"));
  EXPECT_TRUE(says(monitor, "tolerance is 15.0 ms"));
}

TEST(StreamMonitor, ARefusalIsGivenUntilAFrameIsComplete) {
  StreamMonitor monitor(kTolerance);
  for (const Stream stream : {Stream::kColor, Stream::kColorInfo, Stream::kDepth}) monitor.arrived(stream, 5);
  monitor.refused("sizes differ");
  EXPECT_TRUE(says(monitor, "sizes differ"));
  monitor.completed();
  EXPECT_FALSE(says(monitor, "sizes differ"));
}

}  // namespace
}  // namespace softbody
