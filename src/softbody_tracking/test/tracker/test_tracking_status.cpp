#include "tracker/tracking_status.h"

#include <test_support/gtest.h>

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

constexpr double kTolerance = 0.01;

TrackingStatus statusWith(const Observation& seen, const Disagreement& disagreement = {},
                          double image_scale = 1.0) {
  return statusOf(seen, {}, {disagreement, 0.0, image_scale}, kTolerance);
}

TEST(StatusOf, NamesWhatDisagreesBeyondTheTolerance) {
  for (const auto& [kind, words] :
       {std::pair(Disagreement::Kind::kBackground, "the background at the left part of the body, 23 mm wide"),
        std::pair(Disagreement::Kind::kBehind, "the left part of the body 23 mm behind its prediction"),
        std::pair(Disagreement::Kind::kBeyond, "23 mm beyond the left side of its prediction")}) {
    const TrackingStatus status = statusWith(wellSeen(), {kind, 0.023, "left"});
    EXPECT_EQ(status.state, TrackingState::kDegraded);
    EXPECT_TRUE(says(status.reason, words));
    EXPECT_TRUE(says(status.reason, "check mesh, scale and pose"))
        << "the outline says nothing of the size: ";
    const TrackingStatus tracked = statusWith(wellSeen(), {kind, 0.9 * kTolerance, "left"});
    EXPECT_EQ(tracked.state, TrackingState::kTracking);
    EXPECT_EQ(tracked.reason, "");
  }
}

TEST(StatusOf, AnOutlineSmallerAllAroundNamesTheScale) {
  const Disagreement wide{Disagreement::Kind::kBackground, 0.02, "left"};
  Observation seen = wellSeen();
  seen.outline.disagreement = 0.3;
  seen.outline.excess = -0.28;
  EXPECT_TRUE(says(statusWith(seen, wide, 0.77).reason, "a body about 23 % smaller"));
  EXPECT_FALSE(says(statusWith(seen, wide, 0.998).reason, "smaller"));
  seen.outline.excess = 0.05;
  EXPECT_TRUE(says(statusWith(seen, wide, 0.77).reason, "check mesh, scale and pose"));
}

/// A mesh that was bent to the shape of another body agrees with the image, but its state is not certain.
TEST(StatusOf, AnUncertainStateIsNotTracked) {
  const auto status = [](double bound_m) { return statusOf(wellSeen(), {}, {{}, bound_m}, kTolerance); };
  EXPECT_EQ(status(0.9 * kTolerance).state, TrackingState::kTracking);
  EXPECT_EQ(status(0.012).state, TrackingState::kDegraded);
  EXPECT_TRUE(says(status(0.012).reason, "may be 12 mm off"));
}

/// What is hidden, and features that are not found, say nothing against the rest.
TEST(StatusOf, ABodyThatIsMostlyOccludedIsTracked) {
  Observation covered = wellSeen(2, 0);
  covered.agreeing_blocks = 100;
  covered.depth.occluded_blocks = 900;
  covered.expected_features = 100;
  EXPECT_EQ(statusWith(covered).state, TrackingState::kTracking) << statusWith(covered).reason;
}

TEST(StatusOf, PiecesThatAreAllHeldAreNotTracked) {
  Observation seen = wellSeen();
  seen.visibility = {Visibility::kAlmostHidden, Visibility::kAlmostHidden};
  EXPECT_EQ(statusWith(seen).state, TrackingState::kDegraded);
  seen.visibility[0] = Visibility::kPartly;
  EXPECT_EQ(statusWith(seen).state, TrackingState::kTracking);
}

/// Features on a piece that is almost hidden are no inliers; they do not affect the others.
TEST(StatusOf, CountsTheFeaturesOfTrackedPieces) {
  EXPECT_NEAR(statusWith(wellSeen()).inlier_ratio, 0.95, 1e-9);
  Observation seen = wellSeen(100, 90);
  seen.matched_features = 10;
  EXPECT_EQ(statusWith(seen).features_tracked, 10u);
  EXPECT_EQ(statusWith(seen).inlier_ratio, 1.0);
}

TEST(StatusOf, IsLostWhereNothingAgrees) {
  Observation seen = wellSeen(5, 0);
  seen.agreeing_blocks = 3;
  EXPECT_EQ(statusWith(seen).state, TrackingState::kLost);
  seen.depth.visible_blocks = 0;
  EXPECT_TRUE(says(statusWith(seen).reason, "out of view"));
}

constexpr Nanoseconds kFrameInterval = 33'333'333;
using Names = std::vector<std::set<std::uint32_t>>;

/// Status of three pieces after some frames. @param reason of each frame before.
TrackingStatus statusAfter(const std::vector<Visibility>& visibility, const std::vector<bool>& in_view,
                           int frames, TrackingState state = TrackingState::kTracking,
                           const std::string& reason = {}) {
  Observation seen;
  seen.visibility = visibility;
  seen.in_view = in_view;
  HeldPieces held;
  TrackingStatus status;
  for (int i = 0; i < frames; ++i) {
    status = {};
    status.state = state;
    status.reason = reason;
    status = held.report(seen, Names{{2}, {0, 3}, {1}}, i * kFrameInterval, status);
  }
  return status;
}

constexpr Visibility kAlmostHidden = Visibility::kAlmostHidden, kWell = Visibility::kWell;

TEST(HeldPieces, DegradeTheTrackingIfInView) {
  EXPECT_EQ(statusAfter({kWell, kWell, kWell}, {true, true, true}, 20).reason, "");
  EXPECT_EQ(statusAfter({kAlmostHidden, kWell, kWell}, {true, true, true}, 2).state, TrackingState::kTracking)
      << "yet";
  const TrackingStatus status = statusAfter({kAlmostHidden, kWell, kWell}, {true, true, true}, 20);
  EXPECT_EQ(status.state, TrackingState::kDegraded);
  EXPECT_TRUE(says(status.reason, "piece 2 of 4"));
  EXPECT_TRUE(says(statusAfter({kAlmostHidden, kAlmostHidden, kWell}, {true, true, true}, 20).reason,
                   "pieces 0, 2, 3 of 4"));
}

TEST(HeldPieces, AreOnlyInferredIfOutOfView) {
  const TrackingStatus status = statusAfter({kWell, kWell, kAlmostHidden}, {true, true, false}, 20);
  EXPECT_EQ(status.state, TrackingState::kTracking);
  EXPECT_TRUE(says(status.reason, "piece 1 of 4"));
  EXPECT_EQ(statusAfter({kAlmostHidden, kWell, kAlmostHidden}, {true, true, false}, 20).state,
            TrackingState::kDegraded)
      << "another piece is in view";
}

/// The text covers both cases: a small piece in view is not said to be out of view.
TEST(HeldPieces, AreInferredOutOfViewOrTooSmall) {
  for (const std::size_t blocks : {0u, 11u}) {
    SurfaceSamples samples;
    samples.samples.resize(100 + blocks);
    for (std::size_t i = 100; i < samples.samples.size(); ++i) samples.samples[i].piece = 1;
    Observation seen;
    seen.visibility = {kWell, kAlmostHidden};
    seen.in_view = piecesInView(samples, 2);
    HeldPieces held;
    TrackingStatus status;
    status.state = TrackingState::kTracking;
    for (int i = 0; i < 20; ++i) {
      status.reason.clear();
      status = held.report(seen, Names{{0}, {1}}, i * kFrameInterval, status);
    }
    EXPECT_EQ(status.state, TrackingState::kTracking);
    EXPECT_EQ(status.reason,
              "piece 1 of 2 (triangle_bodies, from 0) out of view or too small to be followed: only inferred")
        << blocks << " blocks";
  }
}

TEST(HeldPieces, AreAddedToTheReason) {
  const auto reason = [](const std::vector<Visibility>& visibility, const std::string& before) {
    return statusAfter(visibility, {true, true, false}, 20, TrackingState::kTracking, before).reason;
  };
  const std::string alike = "tracked in one of 4 poses that look alike";
  EXPECT_EQ(reason({kWell, kWell, kWell}, alike), alike);
  EXPECT_EQ(reason({kWell, kWell, kAlmostHidden}, alike),
            alike + "; " + reason({kWell, kWell, kAlmostHidden}, ""));
  EXPECT_EQ(reason({kAlmostHidden, kWell, kAlmostHidden}, alike),
            alike + "; " + reason({kAlmostHidden, kWell, kWell}, "") + "; " +
                reason({kWell, kWell, kAlmostHidden}, ""));
}

TEST(HeldPieces, DoNotChangeAWorseState) {
  for (const TrackingState state : {TrackingState::kLost, TrackingState::kDegraded}) {
    EXPECT_EQ(statusAfter({kAlmostHidden, kAlmostHidden, kAlmostHidden}, {true, true, true}, 20, state).state,
              state);
    EXPECT_EQ(
        statusAfter({kAlmostHidden, kAlmostHidden, kAlmostHidden}, {true, true, true}, 20, state).reason, "");
  }
}

}  // namespace
}  // namespace softbody
