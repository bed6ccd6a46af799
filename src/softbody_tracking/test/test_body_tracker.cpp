#include <gtest/gtest.h>

#include "softbody_common/rigid_fit.h"
#include "softbody_tracking/body_tracker.h"
#include "synthetic_scene.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33'333'333;

/// Drives a tracker with rendered frames; the "simulator" answers every frame with the truth.
class TrackedBox {
 public:
  explicit TrackedBox(const TrackerConfig& config = TrackerConfig()) : tracker_(config) {
    box_.volume.has_initial_pose = true;
    box_.volume.initial_pose = Eigen::Translation3d(0.01, -0.008, 0.01) * boxPose() *
                               Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitZ());
    tracker_.setTopologies(box_.volume, box_.surface);
  }

  const BoxBody& box() const { return box_; }
  BodyTracker& tracker() { return tracker_; }
  const RgbdFrame& frame() const { return frame_; }

  TrackingResult show(const Points& vertices) {
    return show(vertices, [](RgbdFrame*) {});
  }

  template <typename Edit>
  TrackingResult show(const Points& vertices, Edit edit) {
    stamp_ += kFrame;
    frame_ = renderFrame(box_, vertices, stamp_);
    edit(&frame_);
    StageTimer timer;
    const TrackingResult result = tracker_.track(frame_, has_state_ ? &state_ : nullptr, &timer);
    if (result.has_targets) {
      state_ = {box_.volume.revision, stamp_, vertices, {}};
      has_state_ = true;
    }
    return result;
  }

  /// A cut at rest, in the state last shown.
  void cut(const Points& vertices) {
    box_ = cutBox(box_);
    tracker_.setTopologies(box_.volume, box_.surface);
    state_ = {box_.volume.revision, stamp_, vertices, {}};
  }

  /// Whether it tracks again within so many frames.
  bool tracksWithin(int frames, const Points& vertices) {
    for (int i = 0; i < frames; ++i) {
      if (show(vertices).status.state == TrackingState::kTracking) return true;
    }
    return false;
  }

  /// Share of the targets that are further than a tolerance from where their material points truly are.
  double shareOff(const TrackingResult& result, const Points& vertices, double tolerance) const {
    double off = 0.0;
    for (const Target& target : result.targets.targets)
      off += std::abs(target.normal.dot(target.position - placeOf(target, vertices))) > tolerance ? 1.0 : 0.0;
    return off / static_cast<double>(result.targets.targets.size());
  }

  /// Largest distance of the targets from where their material points truly are, along their normals if they
  /// have one.
  double worstTarget(const TrackingResult& result, const Points& vertices, TargetKind kind) const {
    double worst = 0.0;
    for (const Target& target : result.targets.targets) {
      if (target.kind != kind) continue;
      const Eigen::Vector3d d = target.position - placeOf(target, vertices);
      worst = std::max(worst, target.normal.isZero() ? d.norm() : std::abs(target.normal.dot(d)));
    }
    return worst;
  }

 private:
  Eigen::Vector3d placeOf(const Target& target, const Points& vertices) const {
    return positionOf(target.place, vertices, box_.volume.tets);
  }

  BoxBody box_ = makeBox();
  BodyTracker tracker_;
  RgbdFrame frame_;
  MeshState state_;
  bool has_state_ = false;
  Nanoseconds stamp_ = 1'000'000'000;
};

Points posedBox(const BoxBody& box, double shift = 0.0, double turn = 0.0) {
  return transformed(box.volume.rest_vertices,
                     Eigen::Translation3d(shift, 0.5 * shift, shift) * boxPose() *
                         Eigen::AngleAxisd(turn, Eigen::Vector3d(0.3, 1.0, 0.2).normalized()));
}

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

TEST(BodyTracker, FollowsThePiecesOfABodyThatIsCut) {
  TrackedBox tracked;
  TrackingResult result;
  for (int i = 0; i < 5; ++i) result = tracked.show(posedBox(tracked.box()));
  const auto features_before = result.status.features_tracked;
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Eigen::Index whole = makeBox().volume.rest_vertices.rows();
  for (int i = 1; i <= 10; ++i) {
    const TetTopology& volume = tracked.box().volume;
    Points truth = posedBox(tracked.box());
    for (Eigen::Index v = 0; v < truth.rows(); ++v) {
      const bool right = v >= whole || volume.rest_vertices(v, 0) > 1e-9;
      truth.row(v) += (right ? 1.0 : -1.0) * i * 0.002 * Eigen::RowVector3d(1.0, 0.2, -0.5);
    }
    result = tracked.show(truth);
    EXPECT_FALSE(result.targets.reset);
    EXPECT_EQ(result.targets.revision, 1u);
    EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    EXPECT_GT(result.status.features_tracked, 0.4 * features_before) << "the bound ones are still known";
    // A block on the rim of the gap may show the other piece.
    EXPECT_LT(tracked.shareOff(result, truth, 0.002), 0.01);
  }
}

TEST(BodyTracker, HoldsAPieceThatDoesNotShowUntilItDoes) {
  TrackedBox tracked;
  for (int i = 0; i < 5; ++i) tracked.show(posedBox(tracked.box()));
  tracked.cut(posedBox(cutBox(tracked.box())));
  const Points rest = posedBox(tracked.box());
  EXPECT_EQ(tracked.show(rest).status.state, TrackingState::kTracking);
  const TetTopology& volume = tracked.box().volume;
  const int middle = cvRound(tracked.frame().camera.project(boxPose().translation()).x());
  const cv::Rect right(middle - 20, 0, 640 - middle + 20, 480);
  TrackingResult result;
  for (int i = 0; i < 10; ++i) {
    result = tracked.show(rest, [&](RgbdFrame* frame) { frame->depth(right).setTo(0.3f); });
  }
  EXPECT_EQ(result.status.state, TrackingState::kDegraded);
  EXPECT_NE(result.status.reason.find("of 2 shows too little"), std::string::npos) << result.status.reason;
  int held = 0;
  for (const Target& target : result.targets.targets) {
    if (target.kind != TargetKind::kVertex) continue;
    EXPECT_LT((target.position - positionOf(target.place, rest, volume.tets)).norm(), 1e-9);
    ++held;
  }
  EXPECT_GT(held, volume.rest_vertices.rows() / 3);
  result = tracked.show(rest);
  EXPECT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
  EXPECT_LT(tracked.shareOff(result, rest, 0.002), 0.01);
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

TEST(BodyTracker, SaysThatItsFeaturesAreCovered) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  tracked.show(rest);
  const TrackingResult result =
      tracked.show(rest, [](RgbdFrame* frame) { frame->color.setTo(cv::Vec3b(35, 90, 140)); });
  EXPECT_EQ(result.status.state, TrackingState::kDegraded);
  EXPECT_FALSE(result.status.reason.empty());
}

TEST(BodyTracker, FindsABodyThatNobodyPointedOut) {
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
  EXPECT_NE(result.status.reason.find("look alike"), std::string::npos) << result.status.reason;
}

TEST(BodyTracker, FindsABodyThatComesBackElsewhereAndTurned) {
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
  // Its features tell apart the four poses that look alike in depth.
  EXPECT_LT((transformed(tracked.box().volume.rest_vertices, result.targets.body_pose) - elsewhere)
                .rowwise()
                .norm()
                .maxCoeff(),
            0.003);
}

/// Largest distance of a vertex between the pose found and another.
double distanceTo(const BoxBody& box, const TrackingResult& result, const Eigen::Isometry3d& pose) {
  return (transformed(box.volume.rest_vertices, result.targets.body_pose) -
          transformed(box.volume.rest_vertices, pose))
      .rowwise()
      .norm()
      .maxCoeff();
}

TEST(BodyTracker, StartsAnewNearAPoseSetByHand) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  for (int i = 0; i < 5; ++i) tracked.show(rest);
  // The same surface in depth, half a turn about each axis: which of the four is meant, only the user knows.
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

TEST(BodyTracker, APoseSetByHandHoldsUntilAReset) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  const Eigen::Isometry3d turned = boxPose() * Eigen::AngleAxisd(M_PI, Eigen::Vector3d::UnitZ());
  tracked.tracker().restart(turned);
  EXPECT_LT(distanceTo(tracked.box(), tracked.show(rest), turned), 0.003);
  tracked.tracker().reset();
  EXPECT_LT(distanceTo(tracked.box(), tracked.show(rest), boxPose()), 0.003);
}

TEST(BodyTracker, RestartEndsBeingLost) {
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

TEST(BodyTracker, RefusesARestartWithoutABody) {
  EXPECT_THROW(BodyTracker(TrackerConfig()).restart(Eigen::Isometry3d::Identity()), std::logic_error);
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
  EXPECT_FALSE(resetsWith({0, 1000, rest, {}}));
}

TEST(BodyTracker, RefusesImagesOfAnotherSizeThanTheCameras) {
  TrackedBox tracked;
  const Points rest = posedBox(tracked.box());
  EXPECT_THROW(tracked.show(rest, [](RgbdFrame* frame) { frame->depth.release(); }), std::invalid_argument);
  EXPECT_THROW(tracked.show(rest, [](RgbdFrame* frame) { frame->color.create(2, 2); }),
               std::invalid_argument);
}

TEST(BodyTracker, KnnModeMovesVertices) {
  TrackerConfig config;
  config.knn_targets = true;
  TrackedBox tracked(config);
  tracked.show(posedBox(tracked.box()));
  const Points truth = posedBox(tracked.box(), 0.005, 0.05);
  const TrackingResult result = tracked.show(truth);
  ASSERT_FALSE(result.targets.targets.empty());
  for (const Target& target : result.targets.targets) EXPECT_EQ(target.kind, TargetKind::kVertex);
  EXPECT_LT(tracked.worstTarget(result, truth, TargetKind::kVertex), 0.006);
}

}  // namespace
}  // namespace softbody
