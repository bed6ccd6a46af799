#include <gtest/gtest.h>

#include <set>
#include <vector>

#include "fixtures/tracked_box.h"

namespace softbody {
namespace {

TEST(BodyTracker, WaitsForTopologies) {
  BodyTracker tracker{TrackerConfig()};
  StageTimer timer;
  const BoxBody box = makeBox();
  const TrackingResult result = tracker.track(renderFrame(box, posedBox(box), 1), nullptr, &timer);
  EXPECT_FALSE(result.has_targets);
  EXPECT_EQ(result.status.state, TrackingState::kInitializing);
  EXPECT_FALSE(result.status.reason.empty());
}

TEST(BodyTracker, RegistersAndAsksForAResetUntilTheSimulatorAnswers) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  const TrackingResult first = tracked.show(rest);
  ASSERT_TRUE(first.has_targets);
  EXPECT_TRUE(first.targets.reset);
  EXPECT_LT((transformed(tracked.box().volume.rest_vertices, first.targets.body_pose) - rest)
                .rowwise()
                .norm()
                .maxCoeff(),
            0.002);
  EXPECT_FALSE(tracked.show(rest).targets.reset);
}

TEST(BodyTracker, TargetsLieWhereTheBodyIs) {
  TrackedBox tracked;
  tracked.show(posedBox(tracked.box()));
  for (int i = 1; i <= 10; ++i) {
    const Points truth = posedBox(tracked.box(), 0.002 * i, 0.01 * i);
    const TrackingResult result = tracked.show(truth);
    EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    EXPECT_GT(result.targets.targets.size(), 500u);
    EXPECT_GT(result.status.features_tracked, 100u);
    EXPECT_GT(result.status.inlier_ratio, 0.8);
    EXPECT_LT(tracked.worstTarget(result, truth, TargetKind::kDepth), 0.002);
    EXPECT_LT(tracked.worstTarget(result, truth, TargetKind::kFeature), 0.009);
  }
}

/// Found, tracked, lost and sought again.
TEST(BodyTracker, TargetsAreUsedOnceAndAreThoseOfTheResult) {
  BoxBody box = makeBox();
  box.volume.has_initial_pose = true;
  box.volume.initial_pose = boxPose();
  BodyTracker tracker{TrackerConfig()};
  std::set<TrackingState> states;
  for (int i = 0; i < 20; ++i) {
    if (i == 1) tracker.setTopologies(box.volume, box.surface);
    RgbdFrame frame = renderFrame(box, posedBox(box), (i + 1) * kFrameInterval);
    if (i >= 5) frame.depth.setTo(1.2f), frame.color.setTo(cv::Vec3b(200, 190, 60));
    std::vector<TargetSet> used;
    StageTimer timer;
    const TrackingResult result =
        tracker.track(frame, nullptr, &timer, [&](const TargetSet& targets) { used.push_back(targets); });
    states.insert(result.status.state);
    ASSERT_EQ(used.size(), result.has_targets ? 1u : 0u) << i;
    if (used.empty()) continue;
    EXPECT_EQ(used[0].reset, result.targets.reset);
    EXPECT_EQ(used[0].revision, result.targets.revision);
    EXPECT_TRUE(used[0].body_pose.isApprox(result.targets.body_pose, 0.0));
    ASSERT_EQ(used[0].targets.size(), result.targets.targets.size());
    for (std::size_t k = 0; k < used[0].targets.size(); ++k)
      EXPECT_EQ(used[0].targets[k].position, result.targets.targets[k].position);
  }
  EXPECT_GE(states.size(), 3u);
}

TEST(BodyTracker, AnOccluderMakesNoTargets) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  const cv::Rect hand(300, 200, 100, 80);
  const TrackingResult result = tracked.show(rest, [&](RgbdFrame* frame) {
    frame->depth(hand) -= 0.012f;
    frame->color(hand).setTo(cv::Vec3b(250, 20, 20));
  });
  for (const Target& target : result.targets.targets) {
    const Eigen::Vector2d pixel = tracked.frame().camera.project(target.position);
    const bool covered = pixel.x() > hand.x + 4 && pixel.x() < hand.br().x - 4 && pixel.y() > hand.y + 4 &&
                         pixel.y() < hand.br().y - 4;
    EXPECT_FALSE(covered) << "target at " << pixel.transpose() << " lies on the hand";
  }
}

TEST(BodyTracker, SaysThatTheBodyIsGoneAndFindsItAgain) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  for (int i = 0; i < 12; ++i) {
    const TrackingResult gone = tracked.show(rest, [](RgbdFrame* frame) {
      frame->depth.setTo(1.2f);
      frame->color.setTo(cv::Vec3b(200, 190, 60));
    });
    EXPECT_NE(gone.status.state, TrackingState::kTracking);
    EXPECT_FALSE(gone.status.reason.empty());
  }
  EXPECT_TRUE(tracked.tracksWithin(15, rest));
}

TEST(BodyTracker, SurvivesFramesWithoutAnyMeasurement) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  for (int i = 0; i < 15; ++i) {
    tracked.show(rest, [](RgbdFrame* frame) {
      frame->depth.setTo(0.0f);
      frame->color.setTo(cv::Vec3b());
    });
  }
  EXPECT_TRUE(tracked.tracksWithin(15, rest));
}

TEST(BodyTracker, ABlankFrameDoesNotForgetTheBodysShape) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  for (int i = 0; i < 3; ++i) tracked.show(rest);
  const TrackingResult blank = tracked.show(rest, [](RgbdFrame* frame) {
    frame->depth.setTo(0.0f);
    frame->color.setTo(cv::Vec3b());
  });
  EXPECT_EQ(blank.status.state, TrackingState::kLost);
  const TrackingResult next = tracked.show(rest);
  EXPECT_EQ(next.status.state, TrackingState::kTracking) << next.status.reason;
  EXPECT_FALSE(next.targets.reset);
}

TEST(BodyTracker, WrongDepthDoesNotCarryTheBodyAway) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  for (int i = 0; i < 5; ++i) {
    const TrackingResult result = tracked.show(rest, [](RgbdFrame* frame) { frame->depth.setTo(3.0f); });
    EXPECT_NE(result.status.state, TrackingState::kTracking);
    EXPECT_LT((result.targets.body_pose.translation() - boxPose().translation()).norm(), 0.01);
    for (const Target& target : result.targets.targets) EXPECT_LT(target.position.z(), 1.0);
  }
}

/// Depth and outline suffice: that features are not found is no error.
TEST(BodyTracker, TracksWhereItsFeaturesAreCovered) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  const TrackingResult result =
      tracked.show(rest, [](RgbdFrame* frame) { frame->color.setTo(cv::Vec3b(35, 90, 140)); });
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_LT(tracked.worstTarget(result, rest, TargetKind::kDepth), 0.005);
}

TEST(BodyTracker, FollowsAJumpOfMoreThanTheSearchWindow) {
  TrackedBox tracked;
  tracked.show(posedBox(tracked.box()));
  tracked.show(posedBox(tracked.box()));
  const Points truth = posedBox(tracked.box(), 0.025);
  const TrackingResult result = tracked.show(truth);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_LT(tracked.worstTarget(result, truth, TargetKind::kDepth), 0.003);
}

TEST(BodyTracker, FollowsAJumpAcrossTheImage) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  // It moves by half its length and turns by 29 degrees in one frame.
  const Points truth = posedBox(tracked.box(), 0.1, 0.5);
  const TrackingResult result = tracked.show(truth);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_FALSE(result.targets.reset) << "its deformation is not forgotten";
  EXPECT_LT(tracked.worstTarget(result, truth, TargetKind::kDepth), 0.003);
}

TEST(BodyTracker, IgnoresStatesThatDoNotAnswerItsTargets) {
  BoxBody box = makeBox();
  box.volume.has_initial_pose = true;
  box.volume.initial_pose = boxPose();
  BodyTracker tracker{TrackerConfig()};
  tracker.setTopologies(box.volume, box.surface);
  StageTimer timer;
  const Points rest = posedBox(box);
  const RgbdFrame first = renderFrame(box, rest, 1000), second = renderFrame(box, rest, 2000);
  ASSERT_TRUE(tracker.track(first, nullptr, &timer).targets.reset);
  const auto resetsWith = [&](const MeshState& state) {
    return tracker.track(second, &state, &timer).targets.reset;
  };
  EXPECT_TRUE(resetsWith({0, 500, rest, {}})) << "from before the body was placed";
  EXPECT_TRUE(resetsWith({0, 5000, rest, {}})) << "from a later pass of a looping bag";
  EXPECT_TRUE(resetsWith({7, 1000, rest, {}})) << "of another revision";
  EXPECT_TRUE(resetsWith({0, 1000, rest.topRows(5), {}})) << "of another size";
  for (const double away : {4.0, 1e17}) {
    const Points far = rest.rowwise() + Eigen::RowVector3d(0.0, away, 0.0);
    EXPECT_TRUE(resetsWith({0, 1000, far, {}})) << "the body was driven away: the reset brings it back";
  }
  EXPECT_FALSE(resetsWith({0, 1000, rest, {}}));
}

TEST(BodyTracker, SaysWhenTheSimulatorIsSilentAndResetsItWhenItIsBack) {
  constexpr Nanoseconds kSecond = 1'000'000'000, kFrame = kSecond / 30;
  BoxBody box = makeBox();
  box.volume.has_initial_pose = true;
  box.volume.initial_pose = boxPose();
  BodyTracker tracker{TrackerConfig()};
  tracker.setTopologies(box.volume, box.surface);
  StageTimer timer;
  const Points rest = posedBox(box);
  RgbdFrame frame = renderFrame(box, rest, kSecond);
  tracker.track(frame, nullptr, &timer);
  MeshState state{0, kSecond, rest, {}};
  for (frame.stamp += kFrame; frame.stamp < 2 * kSecond; frame.stamp += kFrame) {
    const TrackingResult result = tracker.track(frame, &state, &timer);
    EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    state.observed = frame.stamp;
  }
  for (; frame.stamp < 4 * kSecond; frame.stamp += kFrame) {
    const TrackingResult result = tracker.track(frame, &state, &timer);
    const bool silent = frame.stamp - state.observed > kSecond;
    EXPECT_EQ(result.status.state, silent ? TrackingState::kDegraded : TrackingState::kTracking);
    EXPECT_EQ(result.status.reason.find("no state from the simulator") == 0, silent) << result.status.reason;
    EXPECT_FALSE(result.targets.reset);
  }
  EXPECT_TRUE(tracker.track(frame, nullptr, &timer).targets.reset) << "the new one's body is not placed";
  state.observed = frame.stamp;
  frame.stamp += kFrame;
  const TrackingResult result = tracker.track(frame, &state, &timer);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_FALSE(result.targets.reset);
}

TEST(BodyTracker, AFrameOfAnotherPassStartsAgainAndTheSameModelsDoNot) {
  TrackedBox tracked;
  for (int i = 0; i < 3; ++i) tracked.show(posedBox(tracked.box()));
  ASSERT_FALSE(tracked.show(posedBox(tracked.box())).targets.reset);
  tracked.tracker().setTopologies(tracked.box().volume, tracked.box().surface);
  EXPECT_FALSE(tracked.show(posedBox(tracked.box())).targets.reset);
  RgbdFrame frame = tracked.frame();
  frame.pass = 1;
  StageTimer timer;
  EXPECT_TRUE(tracked.tracker().track(frame, nullptr, &timer).targets.reset);
}

TEST(BodyTracker, RefusesTopologiesWithoutTetsOrVertices) {
  const BoxBody box = makeBox();
  const auto refusalOf = [](const TetTopology& volume, const MeshTopology& surface) -> std::string {
    BodyTracker tracker{TrackerConfig()};
    try {
      tracker.setTopologies(volume, surface);
    } catch (const std::invalid_argument& error) {
      EXPECT_FALSE(tracker.ready());
      return error.what();
    }
    return {};
  };
  const auto refusal = [&](const TetTopology& volume) { return refusalOf(volume, box.surface); };
  EXPECT_EQ(refusal(box.volume), "");
  EXPECT_EQ(refusal({}), "the volume's topology has no tet");
  TetTopology volume = box.volume;
  volume.rest_vertices.resize(0, 3);
  EXPECT_EQ(refusal(volume), "a tet of the volume's topology names vertex 0 of 0");
  volume = box.volume;
  volume.tets(7, 2) = -1;
  EXPECT_EQ(refusal(volume), "a tet of the volume's topology names vertex -1 of 198");
  volume = box.volume;
  volume.surface(3, 1) = 198;
  EXPECT_EQ(refusal(volume), "a triangle of the volume's topology names vertex 198 of 198");
  MeshTopology surface = box.surface;
  surface.triangles(5, 0) = 198;
  EXPECT_EQ(refusalOf(box.volume, surface), "a triangle of the surface's topology names vertex 198 of 198");
  surface = box.surface;
  surface.triangle_pieces.push_back(0);
  EXPECT_EQ(refusalOf(box.volume, surface), "the surface's topology has 321 piece numbers for 320 triangles");
}

TEST(BodyTracker, RefusesImagesOfAnotherSizeThanTheCameras) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  EXPECT_THROW(tracked.show(rest, [](RgbdFrame* frame) { frame->depth.release(); }), std::invalid_argument);
  EXPECT_THROW(tracked.show(rest, [](RgbdFrame* frame) { frame->color.create(2, 2); }),
               std::invalid_argument);
}

/// It has a later revision than the body before, as an edit has.
TEST(BodyTracker, AnotherBodyIsSearchedForFromTheStart) {
  BoxBody box = makeBox();
  for (auto* parents : {&box.volume.vertex_parents, &box.surface.vertex_parents}) parents->clear();
  for (int v = 0; v < box.volume.rest_vertices.rows(); ++v) box.volume.vertex_parents.push_back(v);
  for (int v = 0; v < box.surface.rest_vertices.rows(); ++v) box.surface.vertex_parents.push_back(v);
  TrackedBox tracked(TrackerConfig(), box);
  for (int i = 0; i < 3; ++i) tracked.show(posedBox(tracked.box()));
  const auto isEdit = [&](double scale) {
    TetTopology volume = box.volume;
    MeshTopology surface = box.surface;
    volume.revision = surface.revision = 1;
    volume.rest_vertices *= scale;
    surface.rest_vertices *= scale;
    const bool edit = tracked.tracker().isEdit(volume, surface);
    tracked.tracker().setTopologies(volume, surface);
    return edit;
  };
  EXPECT_FALSE(isEdit(0.5));
  StageTimer timer;
  RgbdFrame empty = tracked.frame();
  empty.depth.setTo(1.2f);
  empty.stamp += kFrameInterval;
  const TrackingResult result = tracked.tracker().track(empty, nullptr, &timer);
  EXPECT_EQ(result.status.state, TrackingState::kInitializing) << "it was never found, so it is not lost";
  EXPECT_EQ(result.status.features_total, 0u);
}

TEST(BodyTracker, TheSameBodyOfALaterRevisionIsTrackedOn) {
  TrackedBox tracked;
  for (int i = 0; i < 3; ++i) tracked.show(posedBox(tracked.box()));
  TetTopology volume = tracked.box().volume;
  MeshTopology surface = tracked.box().surface;
  volume.revision = surface.revision = 1;
  EXPECT_TRUE(tracked.tracker().isEdit(volume, surface));
  volume.revision = surface.revision = 0;
  EXPECT_FALSE(tracked.tracker().isEdit(volume, surface));
}

}  // namespace
}  // namespace softbody
