#include <gtest/gtest.h>

#include "fixtures/tracked_box.h"

namespace softbody {
namespace {

double totalWeight(const TrackingResult& result, TargetKind kind) {
  double sum = 0.0;
  for (const Target& target : result.targets.targets) sum += target.kind == kind ? target.weight : 0.0;
  return sum;
}

TEST(BodyTracker, NewWeightsCountFromTheNextFrameOn) {
  TrackerConfig config;
  config.outline_weight = 0.0;
  TrackedBox tracked(config), usual(config);
  const Points rest = posedBox(tracked.box());
  for (int i = 0; i < 5; ++i) {
    tracked.show(rest);
    usual.show(rest);
  }
  config.depth_weight *= 0.5;
  tracked.tracker().setConfig(config);
  const TrackingResult changed = tracked.show(rest), same = usual.show(rest);
  EXPECT_EQ(changed.status.state, TrackingState::kTracking);
  EXPECT_NEAR(totalWeight(changed, TargetKind::kDepth) / totalWeight(same, TargetKind::kDepth), 0.5, 0.05);
}

}  // namespace
}  // namespace softbody
