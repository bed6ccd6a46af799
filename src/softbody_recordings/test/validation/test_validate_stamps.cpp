#include <test_support/gtest.h>

#include "fixtures/validation_bag.h"

namespace softbody::validation {
namespace {

TEST(ValidateStamps, Stamps) {
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 4) f->color.header.stamp = ros::Time();
            }),
            Severity::kWarning, "stamps", kColor, "1 messages without a stamp, the first is message 4");
  expectOne(writeBag([](Frame* f, int) { f->color.header.stamp = ros::Time(); }), Severity::kError, "stamps",
            kColor, "60 messages without a stamp");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10) f->color.header.stamp = ros::Time(4294967295u, 0);
            }),
            Severity::kWarning, "stamps", kColor,
            "has 1 stamps far from those before and after, the first by");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10 || k == 11)
                f->color.header.stamp += ros::Duration(k == 10 ? 1.0 / 30.0 : -1.0 / 30.0);
            }),
            Severity::kWarning, "stamps", kColor,
            "goes back in time 1 times, first by 0.033 s at message 11");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10) f->depth.header.stamp -= ros::Duration(1.0 / 30.0);
            }),
            Severity::kWarning, "stamps", kDepth, "repeats a stamp 1 times");
  expectOne(writeBag([](Frame* f, int k) {
              if (k == 10) f->color.header.stamp += ros::Duration(2.0);
            }),
            Severity::kWarning, "stamps", kColor, "has 1 stamps far from those before and after");
}

TEST(ValidateStamps, AClockThatIsOffIsNamedOnBothStreams) {
  const Findings findings = check(facts(writeBag([](Frame* f, int) { f->delay = ros::Duration(100.0); })));
  ASSERT_EQ(findings.size(), 2u);
  for (const Finding& finding : findings) {
    EXPECT_EQ(finding.check, "clock");
    EXPECT_TRUE(says(finding.sentence, "was recorded 100.000 s after its stamps"));
  }
}

TEST(ValidateStamps, RatesGapsAndLength) {
  expectOne(writeBag([](Frame* f, int k) {
              // Once every three frames makes 10 Hz.
              f->has_depth = true;
              if (k % 3 != 0) f->has_color = false;
            }),
            Severity::kWarning, "rates", kColor, "comes at 10.0 Hz");
  expectOne(writeBag([](Frame* f, int k) { f->has_color = k < 30 || k >= 36; }), Severity::kWarning, "gaps",
            kColor, "1 gaps at 30.0 Hz, the longest of 0.233 s at 0.97 s");
  const Findings brief =
      check(facts(writeBag([](Frame* f, int k) { f->has_color = f->has_depth = k < 20; })));
  ASSERT_EQ(brief.size(), 2u);
  EXPECT_TRUE(says(brief[0].sentence, "20 images over 0.63 s"));
}

TEST(ValidateStamps, SyncOffset) {
  // Midway between frames: no depth image is within 15 ms.
  const auto late = [](Frame* f, int) { f->depth.header.stamp += ros::Duration(0.0165); };
  expectOne(writeBag(late), Severity::kError, "sync", kDepth, "within 15 ms of only 0 %");
  const auto some = [](Frame* f, int k) {
    if (k % 4 == 0) f->depth.header.stamp += ros::Duration(0.016);
  };
  expectOne(writeBag(some), Severity::kWarning, "sync", kDepth, "of only 75 %");
}

}  // namespace
}  // namespace softbody::validation
