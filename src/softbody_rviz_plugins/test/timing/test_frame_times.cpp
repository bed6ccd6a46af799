#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "timing/frame_times.h"
#include "timing/status_words.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33'333'333;

TEST(FrameTimes, barsAreMeansOfTheLastSecond) {
  FrameTimes times;
  for (int frame = 0; frame < 90; ++frame)
    times.add("simulator", frame * kFrame,
              {{"Soft-body Simulation", frame < 30  ? 100.0
                                        : frame % 2 ? 3.0
                                                    : 5.0}});
  const auto bars = times.bars();
  ASSERT_EQ(bars.size(), 1u);
  EXPECT_EQ(bars[0].node, "simulator");
  EXPECT_NEAR(bars[0].milliseconds, 4.0, 0.1);
  EXPECT_EQ(bars[0].largest, 5.0);
}

TEST(FrameTimes, initialisationAndLatencyAreNoBars) {
  FrameTimes times;
  EXPECT_FALSE(times.latency());
  times.add("surface", kFrame,
            {{"Resolution Enhancement", 1.0},
             {"Resolution Enhancement", 900.0, true},
             {"camera-to-mesh latency", 40.0}});
  ASSERT_EQ(times.bars().size(), 1u);
  EXPECT_EQ(times.bars()[0].largest, 1.0);
  EXPECT_EQ(times.latency(), 40.0);
}

TEST(FrameTimes, thePeriodIsOfOneNode) {
  FrameTimes times;
  EXPECT_FALSE(times.framePeriod());
  for (int frame = 0; frame < 30; ++frame) {
    times.add("camera_ingest", frame * kFrame, {});
    times.add("surface", frame * kFrame, {});
    if (frame == 7) times.add("surface", frame * kFrame, {});  // twice for one stamp: a cut
  }
  ASSERT_TRUE(times.framePeriod());
  EXPECT_NEAR(*times.framePeriod(), 33.3, 0.1);
}

TEST(FrameTimes, barsAreInTheOrderOfTheData) {
  FrameTimes times;
  for (const char* node : {"my_node", "surface", "simulator", "camera_ingest", "feature_tracker"})
    times.add(node, kFrame, {{"work", 1.0}});
  std::vector<std::string> nodes;
  for (const StageBar& bar : times.bars()) nodes.push_back(bar.node);
  const std::vector<std::string> expected{"camera_ingest", "feature_tracker", "simulator", "surface",
                                          "my_node"};
  EXPECT_EQ(nodes, expected);
}

TEST(FrameTimes, silentStagesDisappear) {
  FrameTimes times;
  times.add("surface", 0, {{"Cutting", 8.0}});
  times.add("surface", 60 * kFrame, {{"Resolution Enhancement", 1.0}});
  ASSERT_EQ(times.bars().size(), 1u);
  EXPECT_EQ(times.bars()[0].stage, "Resolution Enhancement");
}

TEST(FrameTimes, aJumpBackInTimeStartsAgain) {
  FrameTimes times;
  times.add("surface", 1000 * kFrame, {{"Resolution Enhancement", 9.0}});
  times.add("surface", kFrame, {{"Resolution Enhancement", 1.0}});
  ASSERT_EQ(times.bars().size(), 1u);
  EXPECT_EQ(times.bars()[0].largest, 1.0);
}

TEST(StatusWords, everyStateHasItsOwnSentence) {
  for (int a = 0; a <= 4; ++a) {
    EXPECT_FALSE(sentenceOf(static_cast<TrackingState>(a)).empty());
    for (int b = 0; b < a; ++b)
      EXPECT_NE(sentenceOf(static_cast<TrackingState>(a)), sentenceOf(static_cast<TrackingState>(b)));
  }
}

TEST(FrameTimes, timesThatNoStageCanTakeAreIgnored) {
  FrameTimes times;
  times.add("surface", 1'000'000'000,
            {{"a", std::nan(""), false}, {"b", 1e20, false}, {"c", -1.0, false}, {"d", 2.0, false}});
  ASSERT_EQ(times.bars().size(), 1u);
  EXPECT_EQ(times.bars()[0].stage, "d");
}

}  // namespace
}  // namespace softbody
