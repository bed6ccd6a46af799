#include <test_support/gtest.h>

#include "report/model_verdict.h"

namespace softbody {
namespace {

ModelQuality goodModel() {
  ModelQuality quality;
  quality.visual_vertices = 522;
  quality.tets = 300;
  quality.size = 0.25;
  quality.visual_volume = 1.0e-3;
  quality.cage_volume = 1.1e-3;
  quality.dihedral_percentile = 30.0;
  quality.edge_spread = 1.5;
  return quality;
}

TEST(ModelVerdict, AGoodModelIsCalledGood) { EXPECT_EQ(worst(judge(goodModel(), 0.2)), Verdict::kGood); }

TEST(ModelVerdict, AWrongUnitIsSeenByTheSize) {
  for (const double side : {200.0, 0.0002}) EXPECT_EQ(worst(judge(goodModel(), side)), Verdict::kBad);
  EXPECT_TRUE(says(judge(goodModel(), 200.0).front().sentence, "--unit"));
}

/// Each property that gets worse makes the verdict worse, never better.
TEST(ModelVerdict, FollowsEachProperty) {
  const auto spoil = [](int property, double by) {
    ModelQuality quality = goodModel();
    if (property == 0) quality.outside = static_cast<int>(0.6 * by);
    if (property == 1) quality.cage_volume *= by;
    if (property == 2) quality.dihedral_percentile /= by;
    if (property == 3) quality.edge_spread *= by;
    if (property == 4) quality.tets = static_cast<int>(300 * by);
    if (property == 5) quality.partition_error = 1e-9 * by * by * by * by;
    return worst(judge(quality, 0.2));
  };
  for (int property = 0; property < 6; ++property) {
    Verdict before = Verdict::kGood;
    for (double by = 1.0; by < 200.0; by *= 1.3) {
      const Verdict now = spoil(property, by);
      EXPECT_GE(now, before) << property;
      before = now;
    }
    EXPECT_EQ(before, Verdict::kBad) << property;
  }
}

}  // namespace
}  // namespace softbody
