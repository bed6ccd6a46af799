#include "tracker/tracking_status.h"

#include <gtest/gtest.h>

namespace softbody {
namespace {

/// A body in view, with some features.
Observation wellSeen(int matched = 100, int outliers = 5) {
  Observation seen;
  seen.agreeing_blocks = 900;
  seen.depth.visible_blocks = 1000;
  seen.matches.resize(static_cast<std::size_t>(matched));
  for (int i = 0; i < outliers; ++i) seen.matches[static_cast<std::size_t>(i)].inlier = false;
  seen.matched_features = matched;
  seen.expected_features = matched + 20;
  return seen;
}

TEST(StatusOf, TellsWhatDegradesTheTracking) {
  EXPECT_EQ(statusOf(wellSeen(), {}).state, TrackingState::kTracking);
  EXPECT_NEAR(statusOf(wellSeen(), {}).inlier_ratio, 0.95, 1e-9);
  const auto degraded = [](const Observation& seen) { return statusOf(seen, {}).reason; };
  Observation covered = wellSeen();
  covered.agreeing_blocks = 100;
  covered.depth.occluded_blocks = 900;
  EXPECT_EQ(degraded(covered), "most of the body is occluded");
  covered.depth.occluded_blocks = 0;
  covered.depth.absent_blocks = 900;
  EXPECT_EQ(degraded(covered), "most of the body is not where predicted");
  Observation unknown = wellSeen(2, 0);
  unknown.expected_features = 100;
  EXPECT_EQ(degraded(unknown), "hardly any of the expected features are found");
  EXPECT_EQ(degraded(wellSeen(100, 90)), "most feature matches disagree with their neighbours");
}

/// Those of a piece that hardly shows are no inliers, but say nothing of the others.
TEST(StatusOf, CountsTheFeaturesOfPiecesThatShow) {
  Observation seen = wellSeen(100, 90);
  seen.matched_features = 10;
  seen.expected_features = 12;
  const TrackingStatus status = statusOf(seen, {});
  EXPECT_EQ(status.state, TrackingState::kTracking) << status.reason;
  EXPECT_EQ(status.features_tracked, 10u);
  EXPECT_EQ(status.inlier_ratio, 1.0);
}

TEST(StatusOf, IsLostWhereNothingAgrees) {
  Observation seen = wellSeen(5, 0);
  seen.agreeing_blocks = 3;
  EXPECT_EQ(statusOf(seen, {}).state, TrackingState::kLost);
  seen.depth.visible_blocks = 0;
  EXPECT_NE(statusOf(seen, {}).reason.find("out of view"), std::string::npos);
}

using Names = std::vector<std::set<std::uint32_t>>;

/// Of three pieces, after so many frames. @param reason that each frame has already.
TrackingStatus told(const std::vector<Shows>& shown, const std::vector<bool>& in_view, int frames,
                    TrackingState state = TrackingState::kTracking, const std::string& reason = {}) {
  Observation seen;
  seen.shown = shown;
  seen.in_view = in_view;
  HeldPieces held;
  TrackingStatus status;
  for (int i = 0; i < frames; ++i) {
    status = {};
    status.state = state;
    status.reason = reason;
    held.tell(seen, Names{{2}, {0, 3}, {1}}, &status);
  }
  return status;
}

constexpr Shows kHardly = Shows::kHardly, kWell = Shows::kWell;

TEST(HeldPieces, DegradeTheTrackingWhereTheyShouldShow) {
  EXPECT_EQ(told({kWell, kWell, kWell}, {true, true, true}, 20).reason, "");
  EXPECT_EQ(told({kHardly, kWell, kWell}, {true, true, true}, 2).state, TrackingState::kTracking) << "yet";
  const TrackingStatus status = told({kHardly, kWell, kWell}, {true, true, true}, 20);
  EXPECT_EQ(status.state, TrackingState::kDegraded);
  EXPECT_NE(status.reason.find("piece 2 of 4"), std::string::npos) << status.reason;
  EXPECT_NE(told({kHardly, kHardly, kWell}, {true, true, true}, 20).reason.find("pieces 0, 2, 3 of 4"),
            std::string::npos);
}

TEST(HeldPieces, AreOnlyInferredWhereTheyCannotBeSeen) {
  const TrackingStatus status = told({kWell, kWell, kHardly}, {true, true, false}, 20);
  EXPECT_EQ(status.state, TrackingState::kTracking);
  EXPECT_NE(status.reason.find("piece 1 of 4"), std::string::npos) << status.reason;
  EXPECT_EQ(told({kHardly, kWell, kHardly}, {true, true, false}, 20).state, TrackingState::kDegraded)
      << "another is to be seen";
}

/// A crumb in plain view is not said to be out of it.
TEST(HeldPieces, AreInferredOutOfViewOrTooSmall) {
  for (const std::size_t blocks : {0u, 11u}) {
    SurfaceSamples samples;
    samples.samples.resize(100 + blocks);
    for (std::size_t i = 100; i < samples.samples.size(); ++i) samples.samples[i].body = 1;
    Observation seen;
    seen.shown = {kWell, kHardly};
    seen.in_view = predictedPieces(samples, 2);
    HeldPieces held;
    TrackingStatus status;
    status.state = TrackingState::kTracking;
    for (int i = 0; i < 20; ++i) {
      status.reason.clear();
      held.tell(seen, Names{{0}, {1}}, &status);
    }
    EXPECT_EQ(status.state, TrackingState::kTracking);
    EXPECT_EQ(status.reason,
              "piece 1 of 2 (triangle_bodies, from 0) out of view or too small to be followed: only inferred")
        << blocks << " blocks";
  }
}

TEST(HeldPieces, AreSaidBesideWhatIsSaidAlready) {
  const auto reason = [](const std::vector<Shows>& shown, const std::string& before) {
    return told(shown, {true, true, false}, 20, TrackingState::kTracking, before).reason;
  };
  const std::string alike = "tracked in one of 4 poses that look alike";
  EXPECT_EQ(reason({kWell, kWell, kWell}, alike), alike);
  EXPECT_EQ(reason({kWell, kWell, kHardly}, alike), alike + "; " + reason({kWell, kWell, kHardly}, ""));
  EXPECT_EQ(reason({kHardly, kWell, kHardly}, alike),
            alike + "; " + reason({kHardly, kWell, kWell}, "") + "; " + reason({kWell, kWell, kHardly}, ""));
}

TEST(HeldPieces, DoNotChangeWhatIsWorse) {
  for (const TrackingState state : {TrackingState::kLost, TrackingState::kDegraded}) {
    EXPECT_EQ(told({kHardly, kHardly, kHardly}, {true, true, true}, 20, state).state, state);
    EXPECT_EQ(told({kHardly, kHardly, kHardly}, {true, true, true}, 20, state).reason, "");
  }
}

}  // namespace
}  // namespace softbody
