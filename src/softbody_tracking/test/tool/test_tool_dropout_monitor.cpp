#include <test_support/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "softbody_tracking/tool/tool_dropout_monitor.h"

namespace softbody {
namespace {

constexpr char kNone[] = "no marker of the tool is seen";

/// Frames at 10 Hz. The result holds the warnings by the number of the frame.
class Session {
 public:
  std::map<int, std::string> watch(int frames, const std::optional<ToolObservation>& seen,
                                   const std::string& reason) {
    std::map<int, std::string> warnings;
    for (int i = 0; i < frames; ++i, ++frame_) {
      const auto warning = monitor_.update(1'000'000'000 + frame_ * 100'000'000LL, seen, reason, [this] {
        ++looks;
        return cause;
      });
      if (warning) warnings[frame_] = *warning;
    }
    return warnings;
  }
  void restart() { frame_ = 0; }
  int looks = 0;
  std::string cause;
  std::string missed() const { return monitor_.missedFrames(); }

 private:
  ToolDropoutMonitor monitor_;
  int frame_ = 0;
};

std::string nothing() { return {}; }

ToolObservation bridged() {
  ToolObservation observation;
  observation.bridged = true;
  return observation;
}

TEST(ToolDropoutMonitor, WarnsOfAToolThatIsNeverSeenLessAndLessOften) {
  Session session;
  const auto warnings = session.watch(250, std::nullopt, kNone);
  ASSERT_EQ(warnings.size(), 3u);
  EXPECT_EQ(warnings.at(50),
            "there is no usable pose of the tool in the first 5.0 s, so it cuts nothing: 51 frames: "
            "no marker of the tool is seen");
  EXPECT_TRUE(warnings.count(100) == 1 && warnings.count(200) == 1);
  EXPECT_EQ(session.missed(), "250 frames: no marker of the tool is seen");
}

TEST(ToolDropoutMonitor, SaysHowLongAToolHasNotBeenSeenAndWhy) {
  Session session;
  EXPECT_TRUE(session.watch(30, std::nullopt, kNone).empty());
  EXPECT_TRUE(session.watch(100, ToolObservation(), "").empty());
  EXPECT_TRUE(session.watch(10, bridged(), "two poses fit equally well").empty());
  const auto warnings = session.watch(60, std::nullopt, kNone);
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings.begin()->second,
            "there is no usable pose of the tool for 5.0 s, so it cuts nothing: 40 frames: no marker of the "
            "tool is "
            "seen; 10 frames: two poses fit equally well");
  EXPECT_EQ(session.missed(),
            "90 frames: no marker of the tool is seen; 10 frames: two poses fit equally well");
}

TEST(ToolDropoutMonitor, IgnoresShortAbsences) {
  Session session;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(session.watch(40, std::nullopt, kNone).empty());
    EXPECT_TRUE(session.watch(1, ToolObservation(), "").empty());
  }
}

TEST(ToolDropoutMonitor, LooksCloserOnceASecondAndSaysWhatItFound) {
  Session session;
  session.watch(25, std::nullopt, kNone);
  EXPECT_EQ(session.looks, 2);
  session.cause = "marker 7 is mirrored";
  session.watch(10, std::nullopt, kNone);
  session.cause.clear();  // a blurred image
  const auto warnings = session.watch(365, std::nullopt, kNone);
  ASSERT_EQ(warnings.size(), 3u);
  for (const auto& [frame, warning] : warnings) EXPECT_TRUE(says(warning, "Probably marker 7 is mirrored"));
  EXPECT_LE(session.looks, 9) << "in 40 s";
  session.watch(1, ToolObservation(), "");
  EXPECT_FALSE(says(session.watch(60, std::nullopt, kNone).begin()->second, "Probably"));
}

TEST(ToolDropoutMonitor, MarkersThatAreSeenNeedNoCloserLook) {
  Session session;
  session.watch(200, bridged(), "two poses fit equally well");
  EXPECT_EQ(session.looks, 0);
}

/// The camera has stopped for a while.
TEST(ToolDropoutMonitor, WarnsOnceAfterALongGapBetweenFrames) {
  constexpr Nanoseconds kSecond = 1'000'000'000;
  ToolDropoutMonitor monitor;
  monitor.update(kSecond, std::nullopt, kNone, nothing);
  EXPECT_TRUE(monitor.update(101 * kSecond, std::nullopt, kNone, nothing));
  EXPECT_FALSE(monitor.update(102 * kSecond, std::nullopt, kNone, nothing));
  EXPECT_TRUE(monitor.update(161 * kSecond, std::nullopt, kNone, nothing));
}

TEST(ToolDropoutMonitor, RestartsWithABagThatLoops) {
  Session session;
  for (int i = 0; i < 5; ++i) {
    EXPECT_TRUE(session.watch(40, std::nullopt, kNone).empty());
    session.restart();
  }
  EXPECT_EQ(session.missed(), "200 frames: no marker of the tool is seen") << "in all rounds";
}

}  // namespace
}  // namespace softbody
