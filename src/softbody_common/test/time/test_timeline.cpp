#include "softbody_common/time/timeline.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <vector>

namespace softbody {
namespace {

using Kind = StampVerdict::Kind;

constexpr Nanoseconds kSecond = 1'000'000'000, kFrame = 33'333'333, kStart = 1'600'000'000 * kSecond;

/// The kinds of the verdicts on stamps.
std::vector<Kind> judged(Timeline* timeline, const std::vector<Nanoseconds>& stamps) {
  std::vector<Kind> kinds;
  for (const Nanoseconds stamp : stamps) kinds.push_back(timeline->judge(stamp).kind);
  return kinds;
}

Timeline running() {
  Timeline timeline;
  for (int i = 0; i < 90; ++i) EXPECT_EQ(timeline.judge(kStart + i * kFrame).kind, Kind::kInOrder);
  return timeline;
}

TEST(Time, EveryNumberOfSecondsGivesADuration) {
  EXPECT_EQ(nanoseconds(1.5), 1'500'000'000);
  EXPECT_EQ(nanoseconds(-0.25), -250'000'000);
  EXPECT_EQ(nanoseconds(std::numeric_limits<double>::quiet_NaN()), 0);
  for (const double huge : {1e10, 1e300, std::numeric_limits<double>::infinity()}) {
    EXPECT_LE(nanoseconds(huge), kLatestTime);
    EXPECT_EQ(nanoseconds(-huge), -nanoseconds(huge));
  }
}

TEST(Timeline, OneStampAnywhereElseChangesNothing) {
  for (const Nanoseconds odd :
       {Nanoseconds{0}, Nanoseconds{1}, -kSecond, kStart - 2 * kSecond, kStart + 6 * kSecond, kLatestTime}) {
    Timeline timeline = running();
    const Nanoseconds last = timeline.last();
    EXPECT_FALSE(timeline.judge(odd).accepted()) << odd;
    EXPECT_EQ(timeline.last(), last) << odd;
    EXPECT_EQ(timeline.judge(last + kFrame).kind, Kind::kInOrder) << odd;
    EXPECT_EQ(timeline.pass(), 0) << odd;
  }
}

TEST(Timeline, LateAndRepeatedStampsAreNamed) {
  Timeline timeline = running();
  const Nanoseconds last = timeline.last();
  EXPECT_EQ(judged(&timeline, {last, last - kFrame, last - kSecond + 1, 0, last + kFrame}),
            (std::vector<Kind>{Kind::kRepeated, Kind::kLate, Kind::kLate, Kind::kUnstamped, Kind::kInOrder}));
  for (const Nanoseconds stamp : {last, last - kFrame, Nanoseconds{0}, kLatestTime, last})
    EXPECT_FALSE(whyRefused(timeline.judge(stamp)).empty()) << stamp;
}

TEST(Timeline, ARecordingThatStartsAgainIsANewPassFromItsThirdStampOn) {
  Timeline timeline = running();
  for (int pass = 1; pass < 4; ++pass) {
    EXPECT_EQ(judged(&timeline, {kStart, kStart + kFrame, kStart + 2 * kFrame, kStart + 3 * kFrame}),
              (std::vector<Kind>{Kind::kOutlier, Kind::kOutlier, Kind::kJumpedBack, Kind::kInOrder}));
    EXPECT_EQ(timeline.pass(), pass);
    for (int i = 4; i < 90; ++i) EXPECT_EQ(timeline.judge(kStart + i * kFrame).kind, Kind::kInOrder);
  }
}

TEST(Timeline, TheClockConfirmsAMoveAtOnce) {
  Timeline timeline;
  EXPECT_EQ(timeline.judge(kStart, 5 * kSecond).kind, Kind::kInOrder);
  EXPECT_EQ(timeline.judge(kStart + 60 * kSecond, 65 * kSecond).kind, Kind::kInOrder) << "after a pause";
  EXPECT_EQ(timeline.judge(kStart + 63 * kSecond, 65 * kSecond).kind, Kind::kOutlier);
  EXPECT_EQ(timeline.judge(kStart + kSecond, 6 * kSecond).kind, Kind::kJumpedBack) << "simulated time loops";
  EXPECT_EQ(timeline.judge(kStart + kSecond + kFrame, 6 * kSecond + kFrame).kind, Kind::kInOrder);
}

TEST(Timeline, ALateMessageDoesNotMakeTheNextOneAnOutlier) {
  Timeline timeline;
  const Nanoseconds delay = kFrame, arrival = 5 * kSecond + delay;
  for (int i = 0; i < 30; ++i)
    EXPECT_EQ(timeline.judge(kStart + i * kFrame, arrival + i * kFrame).kind, Kind::kInOrder);
  // The machine is busy for three seconds: one message comes late, most are lost.
  EXPECT_EQ(timeline.judge(kStart + kSecond, arrival + 4 * kSecond).kind, Kind::kInOrder);
  EXPECT_EQ(timeline.judge(kStart + 4 * kSecond + kFrame, arrival + 4 * kSecond + kFrame).kind,
            Kind::kInOrder);
  EXPECT_EQ(timeline.judge(kStart + 6 * kSecond, arrival + 4 * kSecond + 2 * kFrame).kind, Kind::kOutlier);
}

TEST(Timeline, OutliersOfAnyStepLeaveTheRuleAsItIs) {
  Timeline timeline = running();
  const Nanoseconds last = timeline.last();
  EXPECT_EQ(
      judged(&timeline, {last + 20 * kSecond, last + 45 * kSecond, last + kFrame, last + 20 * kSecond,
                         last + 2 * kFrame}),
      (std::vector<Kind>{Kind::kOutlier, Kind::kOutlier, Kind::kInOrder, Kind::kOutlier, Kind::kInOrder}));
}

TEST(Timeline, TimeThatLeapsAheadAndReturnsIsNoNewPass) {
  Timeline timeline = running();
  const Nanoseconds last = timeline.last(), ahead = 2 * kSecond;
  EXPECT_EQ(judged(&timeline, {last + ahead + kFrame, last + ahead + 2 * kFrame, last + ahead + 3 * kFrame,
                               last + 4 * kFrame, last + 5 * kFrame, last + 6 * kFrame, last + 7 * kFrame}),
            (std::vector<Kind>{Kind::kOutlier, Kind::kOutlier, Kind::kMoved, Kind::kOutlier, Kind::kOutlier,
                               Kind::kMoved, Kind::kInOrder}));
  EXPECT_EQ(timeline.pass(), 0);
}

TEST(Timeline, AnotherRecordingAfterALeapMayLoop) {
  Timeline timeline = running();
  const Nanoseconds second = kStart + 1000 * kSecond;
  for (int pass = 0; pass < 3; ++pass) {
    for (int i = 0; i < 300; ++i) timeline.judge(second + i * kFrame);
    EXPECT_EQ(timeline.pass(), pass);
  }
}

TEST(Timeline, ASlowStreamIsBelievedAsAWhole) {
  Timeline timeline;
  int accepted = 0;
  for (int i = 0; i < 20; ++i) accepted += timeline.judge(kStart + i * 20 * kSecond).accepted() ? 1 : 0;
  EXPECT_EQ(accepted, 18) << "the second and the third could have been outliers";
}

/// A stream with jitter, lost and late stamps, and with single stamps from anywhere.
class RandomStream {
 public:
  explicit RandomStream(unsigned seed) : random_(seed) {}

  void run(Timeline* timeline, Nanoseconds from, int stamps) {
    for (int i = 0; i < stamps; ++i) {
      const Nanoseconds stamp = from + i * kFrame + uniform(-kFrame / 3, kFrame / 3);
      const Nanoseconds fate = uniform(0, 19);
      if (fate == 0) continue;
      if (fate == 1) {
        const Nanoseconds odd = uniform(0, 1) == 0 ? stamp + 2 * kSecond : uniform(-kSecond, kLatestTime);
        EXPECT_FALSE(timeline->judge(odd).accepted()) << odd;
        for (Nanoseconds copies = uniform(0, 1); copies > 0; --copies)
          EXPECT_FALSE(timeline->judge(odd).accepted()) << "sent again";
      }
      const Nanoseconds late = timeline->last() - uniform(1, 29) * kFrame;
      EXPECT_TRUE(fate != 2 || !timeline->judge(late).accepted());
      EXPECT_EQ(timeline->judge(stamp).kind, Kind::kInOrder) << i;
    }
  }

 private:
  Nanoseconds uniform(Nanoseconds low, Nanoseconds high) {
    return std::uniform_int_distribution<Nanoseconds>(low, high)(random_);
  }
  std::mt19937 random_;
};

TEST(Timeline, SingleOddStampsNeverMoveARandomStream) {
  for (unsigned seed = 0; seed < 200; ++seed) {
    Timeline timeline;
    timeline.judge(kStart - kFrame);
    RandomStream(seed).run(&timeline, kStart, 200);
    EXPECT_EQ(timeline.pass(), 0) << seed;
  }
}

TEST(Timeline, AnyStampsAtAnyTimeGiveAVerdictAndAnEndToIt) {
  std::mt19937_64 random(3);
  std::uniform_int_distribution<Nanoseconds> any(0, kLatestTime);
  for (int round = 0; round < 200; ++round) {
    Timeline timeline;
    for (int i = 0; i < 100; ++i) timeline.judge(any(random), any(random));
    // Whatever came before: time that stays is believed.
    const Nanoseconds start = any(random) / 2 + 1;
    int accepted = 0;
    for (int i = 0; i < 40; ++i) accepted += timeline.judge(start + i * kFrame).accepted() ? 1 : 0;
    EXPECT_GE(accepted, 40 - 31) << "up to a second may be late";
    EXPECT_EQ(timeline.last(), start + 39 * kFrame);
  }
}

TEST(Timeline, AShortRecordingThatStartsAgainIsNotLate) {
  for (const double jump : {0.2, 0.6, 0.97, 5.0}) {
    Timeline timeline;
    const auto judge = [&](double stamp, double now) {
      return timeline.judge(kStart + nanoseconds(stamp), kStart + nanoseconds(now)).kind;
    };
    for (int i = 0; i < 300; ++i) EXPECT_EQ(judge(i / 30.0, i / 30.0 + 0.05), Kind::kInOrder);
    const double last = 299 / 30.0, begin = last - jump;
    EXPECT_EQ(judge(begin, begin + 0.1), Kind::kJumpedBack) << jump;
    EXPECT_EQ(judge(begin + 0.03, begin + 0.13), Kind::kInOrder) << jump;
  }
}

TEST(Timeline, AClockThatIsCorrectedStartsNothingAnew) {
  Timeline timeline;
  for (int i = 0; i < 90; ++i) timeline.judge(kStart + i * kFrame, kStart + i * kFrame);
  EXPECT_EQ(timeline.judge(kStart + 80 * kFrame, kStart + 89 * kFrame - 5'000'000).kind, Kind::kLate);
}

/// The stamps to warn of when these come, in tenths of a second.
std::vector<Nanoseconds> warnings(const std::vector<Nanoseconds>& stamps) {
  Timeline timeline;
  RefusedStamps refused;
  std::vector<Nanoseconds> said;
  for (const Nanoseconds stamp : stamps) {
    const auto warning = refused.note(stamp * kSecond / 10, timeline.judge(stamp * kSecond / 10));
    if (warning) said.push_back(warning->stamp * 10 / kSecond);
  }
  return said;
}

TEST(RefusedStamps, ALoneOddStampIsWarnedOfWhenTheStreamGoesOn) {
  EXPECT_EQ(warnings({1000, 1001, 5000}), std::vector<Nanoseconds>{});
  EXPECT_EQ(warnings({1000, 1001, 5000, 1002, 1003}), std::vector<Nanoseconds>{5000});
  EXPECT_EQ(warnings({1000, 1001, 1001, 0}), (std::vector<Nanoseconds>{1001, 0}));
}

TEST(RefusedStamps, ARecordingThatStartsAgainIsNoMistake) {
  EXPECT_EQ(warnings({1000, 1010, 1020, 1000, 1001, 1002, 1003}), std::vector<Nanoseconds>{});
  EXPECT_EQ(warnings({1000, 1001, 9000, 9001, 9002, 9003}), std::vector<Nanoseconds>{});
}

}  // namespace
}  // namespace softbody
