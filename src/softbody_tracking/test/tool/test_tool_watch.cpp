#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "softbody_tracking/tool/tool_watch.h"

namespace softbody {
namespace {

constexpr char kNone[] = "none of the tool's markers is seen";

/// At 10 Hz: what is said, by the number of the frame.
class Session {
 public:
  std::map<int, std::string> watch(int frames, const std::optional<ToolObservation>& seen,
                                   const std::string& reason) {
    std::map<int, std::string> said;
    for (int i = 0; i < frames; ++i, ++frame_) {
      const auto sentence = watch_.heed(1'000'000'000 + frame_ * 100'000'000LL, seen, reason);
      if (sentence) said[frame_] = *sentence;
    }
    return said;
  }
  void restart() { frame_ = 0; }
  std::string missed() const { return watch_.missed(); }

 private:
  ToolWatch watch_;
  int frame_ = 0;
};

ToolObservation bridged() {
  ToolObservation observation;
  observation.bridged = true;
  return observation;
}

TEST(ToolWatch, TellsOfAToolThatNeverShowsLessAndLessOften) {
  Session session;
  const auto said = session.watch(250, std::nullopt, kNone);
  ASSERT_EQ(said.size(), 3u);
  EXPECT_EQ(said.at(50),
            "the tool has not been seen once in 5.0 s, nor cut anything: 51 frames: "
            "none of the tool's markers is seen");
  EXPECT_TRUE(said.count(100) == 1 && said.count(200) == 1);
  EXPECT_EQ(session.missed(), "250 frames: none of the tool's markers is seen");
}

TEST(ToolWatch, TellsForHowLongAToolHasNotBeenSeenAndWhy) {
  Session session;
  EXPECT_TRUE(session.watch(30, std::nullopt, kNone).empty());
  EXPECT_TRUE(session.watch(100, ToolObservation(), "").empty());
  EXPECT_TRUE(session.watch(10, bridged(), "two poses fit alike").empty());
  const auto said = session.watch(60, std::nullopt, kNone);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said.begin()->second,
            "the tool has not been seen for 5.0 s, nor cut anything: 40 frames: none of the tool's "
            "markers is seen; 10 frames: two poses fit alike");
  EXPECT_EQ(session.missed(),
            "90 frames: none of the tool's markers is seen; 10 frames: two poses fit alike");
}

TEST(ToolWatch, SaysNothingOfShortAbsences) {
  Session session;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(session.watch(40, std::nullopt, kNone).empty());
    EXPECT_TRUE(session.watch(1, ToolObservation(), "").empty());
  }
}

/// As where the camera stops for a while.
TEST(ToolWatch, TellsOnceOfALongGapBetweenFrames) {
  constexpr Nanoseconds kSecond = 1'000'000'000;
  ToolWatch watch;
  watch.heed(kSecond, std::nullopt, kNone);
  EXPECT_TRUE(watch.heed(101 * kSecond, std::nullopt, kNone));
  EXPECT_FALSE(watch.heed(102 * kSecond, std::nullopt, kNone));
  EXPECT_TRUE(watch.heed(161 * kSecond, std::nullopt, kNone));
}

TEST(ToolWatch, StartsAnewWithABagThatLoops) {
  Session session;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(session.watch(40, std::nullopt, kNone).empty());
    session.restart();
  }
  EXPECT_EQ(session.missed(), "200 frames: none of the tool's markers is seen") << "in all rounds";
}

}  // namespace
}  // namespace softbody
