#include <test_support/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "fixtures/tracked_box.h"
#include "softbody_tracking/known/known_surface.h"

namespace softbody {
namespace {

TEST(FindingTheBody, FindsABodyThatNobodyPointedOut) {
  BoxBody box = makeBox();
  BodyTracker tracker{TrackerConfig()};
  tracker.setTopologies(box.volume, box.surface);
  StageTimer timer;
  const Points truth = posedBox(box, 0.03, 0.4);
  const TrackingResult result = tracker.track(renderFrame(box, truth, 1000), nullptr, &timer);
  ASSERT_TRUE(result.has_targets) << result.status.reason;
  EXPECT_EQ(result.status.state, TrackingState::kTracking);
  // A box looks the same in four poses; its surface is at the same place in all of them.
  const Points found = transformed(box.volume.rest_vertices, result.targets.body_pose);
  for (Eigen::Index v = 0; v < found.rows(); ++v)
    EXPECT_LT((truth.rowwise() - found.row(v)).rowwise().norm().minCoeff(), 0.003);
  EXPECT_TRUE(says(result.status.reason, "look alike"));
}

/// Of a box that moves, is away for a while and comes back. In some pixels nothing is measured.
std::vector<TrackingResult> resultsWith(float no_depth, bool pose_given) {
  BoxBody box = makeBox();
  box.volume.has_initial_pose = pose_given;
  box.volume.initial_pose = boxPose();
  BodyTracker tracker{TrackerConfig()};
  tracker.setTopologies(box.volume, box.surface);
  std::vector<TrackingResult> results;
  Points before;
  for (int i = 0; i < 24; ++i) {
    const Points truth = posedBox(box, 0.001 * i, 0.01 * i);
    RgbdFrame frame = renderFrame(box, truth, (i + 1) * kFrameInterval);
    if (i >= 4 && i < 12) frame.depth.setTo(1.2f), frame.color.setTo(cv::Vec3b(200, 190, 60));
    for (const cv::Rect& gap : {cv::Rect(300, 60, 120, 90), cv::Rect(330, 230, 25, 200)})
      frame.depth(gap).setTo(no_depth);
    const MeshState state{box.volume.revision, frame.stamp - kFrameInterval, before, {}};
    StageTimer timer;
    const bool followed = !results.empty() && results.back().has_targets;
    results.push_back(tracker.track(frame, followed ? &state : nullptr, &timer));
    before = truth;
  }
  return results;
}

/// Cameras and camera_ingest say either.
TEST(FindingTheBody, NaNIsNoDepthLikeZero) {
  for (const bool given : {true, false}) {
    const std::vector<TrackingResult> zero = resultsWith(0.0f, given),
                                      nan = resultsWith(std::numeric_limits<float>::quiet_NaN(), given);
    for (std::size_t i = 0; i < zero.size(); ++i) {
      EXPECT_EQ(nan[i].status.state, zero[i].status.state) << i;
      EXPECT_EQ(nan[i].status.reason, zero[i].status.reason) << i;
      ASSERT_EQ(nan[i].targets.targets.size(), zero[i].targets.targets.size()) << i;
      for (std::size_t k = 0; k < zero[i].targets.targets.size(); ++k) {
        const Target &a = nan[i].targets.targets[k], &b = zero[i].targets.targets[k];
        ASSERT_TRUE(a.position == b.position && a.normal == b.normal && a.weight == b.weight)
            << i << " " << k;
      }
    }
    EXPECT_TRUE(zero.front().has_targets && zero.back().has_targets);
  }
}

/// What looks like the body is known to be another one; or a known plate hides all of it.
TEST(FindingTheBody, DoesNotFindABodyThatAKnownSurfaceHides) {
  BoxBody box = makeBox();
  box.volume.initial_pose = boxPose();
  const Points truth = transformed(box.volume.rest_vertices, boxPose());
  Points plate = 2.0 * box.surface.rest_vertices;
  plate.col(2).array() += 0.3;
  for (const Points& known : {truth, plate}) {
    RgbdFrame frame = renderFrame(box, truth, 1000);
    frame.depth = cv::min(frame.depth, renderFrame(box, known, 1000).depth);
    for (const bool given : {false, true}) {
      box.volume.has_initial_pose = given;
      BodyTracker tracker{TrackerConfig()};
      tracker.setTopologies(box.volume, box.surface);
      StageTimer timer;
      const RgbdFrame marked = withKnownSurfaces(frame, {{"other", {known, box.surface.triangles}, 0.001}});
      EXPECT_FALSE(tracker.track(marked, nullptr, &timer).has_targets) << "given " << given;
    }
  }
}

TEST(FindingTheBody, FindsABodyThatComesBackElsewhereAndTurned) {
  TrackedBox tracked;
  tracked.show(posedBox(tracked.box()));
  for (int i = 0; i < 15; ++i) {
    tracked.show(posedBox(tracked.box()), [](RgbdFrame* frame) {
      frame->depth.setTo(1.2f);
      frame->color.setTo(cv::Vec3b(200, 190, 60));
    });
  }
  const Points elsewhere = posedBox(tracked.box(), 0.08, 0.5);
  ASSERT_TRUE(tracked.tracksWithin(15, elsewhere));
  const TrackingResult result = tracked.show(elsewhere);
  // Its features distinguish the four poses that are alike in depth.
  EXPECT_LT((transformed(tracked.box().volume.rest_vertices, result.targets.body_pose) - elsewhere)
                .rowwise()
                .norm()
                .maxCoeff(),
            0.003);
}

TEST(FindingTheBody, FindsACubeThatComesBackTurned) {
  BoxBody cube = makeBox(6, 6, 6);
  for (Points* vertices : {&cube.volume.rest_vertices, &cube.surface.rest_vertices})
    *vertices *= Eigen::Vector3d(0.5, 1.0, 2.5).asDiagonal();
  TrackedBox tracked(TrackerConfig(), cube);
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(cube));
  for (int i = 0; i < 15; ++i) {
    tracked.show(posedBox(cube), [](RgbdFrame* frame) {
      frame->depth.setTo(1.2f);
      frame->color.setTo(cv::Vec3b(200, 190, 60));
    });
  }
  // In depth it looks the same in 24 poses.
  const Points elsewhere = posedBox(cube, 0.06, 0.4);
  EXPECT_EQ(tracked.show(elsewhere).status.state, TrackingState::kTracking) << "in the very first frame";
  const TrackingResult result = tracked.show(elsewhere);
  EXPECT_LT((transformed(cube.volume.rest_vertices, result.targets.body_pose) - elsewhere)
                .rowwise()
                .norm()
                .maxCoeff(),
            0.003);
}

/// Largest distance of a vertex between the found pose and another one [m].
double distanceTo(const BoxBody& box, const TrackingResult& result, const Eigen::Isometry3d& pose) {
  return (transformed(box.volume.rest_vertices, result.targets.body_pose) -
          transformed(box.volume.rest_vertices, pose))
      .rowwise()
      .norm()
      .maxCoeff();
}

TEST(FindingTheBody, StartsAnewNearAPoseSetByHand) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  for (int i = 0; i < 5; ++i) tracked.show(rest);
  // Half a turn about each axis gives the same depth; only the user knows which pose is right.
  for (int k = 0; k < 3; ++k) {
    const Eigen::Vector3d axis = Eigen::Vector3d::Unit(k);
    const Eigen::Isometry3d meant = boxPose() * Eigen::AngleAxisd(M_PI, axis);
    const Eigen::Isometry3d rough =
        Eigen::Translation3d(0.015, -0.01, 0.02) * meant * Eigen::AngleAxisd(0.15, Eigen::Vector3d::UnitY());
    tracked.tracker().restart(rough);
    const TrackingResult result = tracked.show(rest);
    ASSERT_TRUE(result.has_targets) << result.status.reason;
    EXPECT_TRUE(result.targets.reset);
    EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    EXPECT_LT(distanceTo(tracked.box(), result, meant), 0.003) << "about " << axis.transpose();
  }
}

TEST(FindingTheBody, APoseSetByHandHoldsUntilAReset) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  const Eigen::Isometry3d turned = boxPose() * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
  tracked.tracker().restart(turned);
  EXPECT_LT(distanceTo(tracked.box(), tracked.show(rest), turned), 0.003);
  tracked.tracker().reset();
  EXPECT_LT(distanceTo(tracked.box(), tracked.show(rest), boxPose()), 0.003);
}

/// A rough pose is meant: a body of this shape in another place is another one, unless `search` says
/// anywhere.
TEST(FindingTheBody, LooksOnlyWhereARoughPoseSays) {
  for (const bool anywhere : {false, true}) {
    TrackerConfig config;
    config.registration.anywhere = anywhere;
    TrackedBox tracked(config);
    tracked.show(posedBox(tracked.box()));
    tracked.tracker().restart(Eigen::Translation3d(0.15, 0.0, 0.0) * boxPose());
    const TrackingResult result = tracked.show(posedBox(tracked.box()));
    EXPECT_EQ(result.status.state, anywhere ? TrackingState::kTracking : TrackingState::kInitializing);
    EXPECT_EQ(result.status.reason.find("search: anywhere") == std::string::npos, anywhere);
  }
}

TEST(FindingTheBody, RestartEndsBeingLost) {
  TrackedBox tracked;
  tracked.show(posedBox(tracked.box()));
  for (int i = 0; i < 12; ++i) {
    tracked.show(posedBox(tracked.box()), [](RgbdFrame* frame) {
      frame->depth.setTo(1.2f);
      frame->color.setTo(cv::Vec3b(200, 190, 60));
    });
  }
  const Eigen::Isometry3d elsewhere = Eigen::Translation3d(0.06, 0.03, 0.06) * boxPose();
  tracked.tracker().restart(elsewhere);
  const TrackingResult result = tracked.show(posedBox(tracked.box(), 0.06));
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << "in the very next frame";
  EXPECT_LT(distanceTo(tracked.box(), result, elsewhere), 0.003);
}

TEST(FindingTheBody, RefusesARestartWithoutABody) {
  EXPECT_THROW(BodyTracker(TrackerConfig()).restart(Eigen::Isometry3d::Identity()), std::logic_error);
}

}  // namespace
}  // namespace softbody
