#include "labels/depth_evidence.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace softbody {
namespace {

TEST(DepthEvidence, SpeaksForTheBodyWhereItIsPredicted) {
  const DepthEvidence evidence;
  EXPECT_GT(evidence.logOdds(0.0, 0.5), 1.0);
  EXPECT_LT(evidence.logOdds(0.06, 0.5), -1.0);
  EXPECT_LT(evidence.logOdds(-0.06, 0.5), -1.0);
  EXPECT_DOUBLE_EQ(evidence.logOdds(10.0, 0.5), evidence.logOdds(0.2, 0.5)) << "beyond the table";
}

TEST(DepthEvidence, FallsWithTheDifference) {
  const DepthEvidence evidence;
  for (double difference = 0.0; difference < 0.03; difference += 0.001) {
    EXPECT_GE(evidence.logOdds(difference, 0.5), evidence.logOdds(difference + 0.001, 0.5)) << difference;
    EXPECT_NEAR(evidence.logOdds(difference, 0.5), evidence.logOdds(-difference, 0.5), 0.1) << difference;
  }
}

/// Depth is less precise far away, so the same difference says less there.
TEST(DepthEvidence, ToleratesMoreFarAway) {
  const DepthEvidence evidence;
  EXPECT_GT(evidence.logOdds(0.02, 2.0), evidence.logOdds(0.02, 0.5));
  EXPECT_NEAR(evidence.logOdds(0.04, 2.0), evidence.logOdds(0.02, 1.0), 1e-9);
}

TEST(DepthEvidence, KnowsTheDepthOfTheSurroundings) {
  DepthCounts table;
  for (int i = 0; i < 100000; ++i) table.add(-0.01 + 1e-7 * i, 1.0f);
  DepthEvidence evidence;
  const double before = evidence.logOdds(-0.005, 0.5), farther = evidence.logOdds(0.05, 0.5);
  evidence.compare(table);
  EXPECT_LT(evidence.logOdds(-0.005, 0.5), std::min(0.0, before));
  EXPECT_GT(evidence.logOdds(0.05, 0.5), farther) << "nothing else was seen there";
}

/// What is nearer than the body usually is stands before it; what is farther does not.
TEST(DepthEvidence, TellsTheBodyFromWhatIsBeforeIt) {
  EXPECT_GT(DepthEvidence::logOddsBeforeBody(0.0, 0.003), 1.0);
  EXPECT_LT(DepthEvidence::logOddsBeforeBody(-0.015, 0.003), -2.0);
  EXPECT_GT(DepthEvidence::logOddsBeforeBody(0.005, 0.003), 1.0);
  EXPECT_GT(DepthEvidence::logOddsBeforeBody(-0.015, 0.012), DepthEvidence::logOddsBeforeBody(-0.015, 0.003))
      << "the less certain the prediction, the less a difference says";
  for (double difference = 0.0; difference > -0.01; difference -= 0.001) {
    EXPECT_GE(DepthEvidence::logOddsBeforeBody(difference, 0.003),
              DepthEvidence::logOddsBeforeBody(difference - 0.001, 0.003))
        << difference;
  }
}

/// Depth of the part behind speaks for that part.
TEST(DepthEvidence, KnowsThePartBehind) {
  EXPECT_LT(DepthEvidence::logOddsBefore(0.54, 0.54, 0.50), -1.0);
  EXPECT_GT(DepthEvidence::logOddsBefore(0.54, 0.50, 0.50), 1.0);
}

}  // namespace
}  // namespace softbody
