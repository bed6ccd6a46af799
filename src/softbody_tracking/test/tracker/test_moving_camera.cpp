#include <gtest/gtest.h>

#include <algorithm>

#include "fixtures/synthetic_scene.h"
#include "softbody_common/geometry/rigid_fit.h"
#include "softbody_tracking/tool/tool_mask.h"
#include "softbody_tracking/tracker/body_tracker.h"

namespace softbody {
namespace {

constexpr Nanoseconds kFrame = 33'333'333;

/// A box before a moving camera; the "simulator" answers every frame with the truth.
class MovingCamera {
 public:
  MovingCamera() {
    box_.volume.has_initial_pose = true;
    box_.volume.initial_pose = Eigen::Translation3d(0.01, -0.008, 0.01) * boxPose();
    tracker_.setTopologies(box_.volume, box_.surface);
  }

  /// @param vertices in the fixed frame.
  TrackingResult show(const Eigen::Isometry3d& T_fixed_camera, const Points& vertices) {
    stamp_ += kFrame;
    RgbdFrame frame = renderFrame(box_, transformed(vertices, T_fixed_camera.inverse()), stamp_);
    frame.T_fixed_camera = T_fixed_camera;
    StageTimer timer;
    const TrackingResult result = tracker_.track(frame, has_state_ ? &state_ : nullptr, &timer);
    state_ = {box_.volume.revision, stamp_, vertices, {}};
    has_state_ = result.has_targets;
    return result;
  }

  double worstTarget(const TrackingResult& result, const Points& vertices) const {
    double worst = 0.0;
    for (const Target& target : result.targets.targets) {
      const Eigen::Vector3d d = target.position - positionOf(target.place, vertices, box_.volume.tets);
      worst = std::max(worst, target.normal.isZero() ? d.norm() : std::abs(target.normal.dot(d)));
    }
    return worst;
  }

  const BoxBody& box() const { return box_; }
  BodyTracker& tracker() { return tracker_; }

 private:
  BoxBody box_ = makeBox();
  BodyTracker tracker_{TrackerConfig()};
  MeshState state_;
  bool has_state_ = false;
  Nanoseconds stamp_ = 1'000'000'000;
};

/// The camera starts somewhere in the world and moves around the box, about 12 cm and 14 degrees a step.
Eigen::Isometry3d cameraAt(double step) {
  const Eigen::Isometry3d start = Eigen::Translation3d(2.0, -1.0, 0.7) *
                                  Eigen::AngleAxisd(2.0, Eigen::Vector3d(1.0, -0.4, 0.6).normalized());
  const Eigen::Vector3d box(0.0, 0.0, 0.5);
  return start * Eigen::Translation3d(box) *
         Eigen::AngleAxisd(0.25 * step, Eigen::Vector3d(0.1, 1.0, 0.0).normalized()) *
         Eigen::Translation3d(-box);
}

TEST(MovingCamera, ABodyAtRestStaysWhereItIsHoweverTheCameraMoves) {
  MovingCamera moving, resting;
  const Points body = transformed(moving.box().volume.rest_vertices, cameraAt(0) * boxPose());
  // Back and forth: a body that is predicted to move with the camera would not be found.
  for (const double step : {0.0, 1.0, 2.0, 1.0, 0.0, -1.0, 0.0}) {
    const TrackingResult result = moving.show(cameraAt(step), body), still = resting.show(cameraAt(0), body);
    ASSERT_EQ(result.status.state, TrackingState::kTracking) << result.status.reason;
    EXPECT_LT(moving.worstTarget(result, body), 0.002) << step;
    EXPECT_LT((transformed(moving.box().volume.rest_vertices, result.targets.body_pose) - body)
                  .rowwise()
                  .norm()
                  .maxCoeff(),
              0.002);
    // From the side, at most a third fewer features are found than from the front.
    EXPECT_GE(result.features.size(), 0.65 * static_cast<double>(still.features.size())) << step;
  }
}

TEST(MovingCamera, FeatureVectorsOfABodyAtRestHaveNoLength) {
  MovingCamera moving;
  const Points body = transformed(moving.box().volume.rest_vertices, cameraAt(0) * boxPose());
  for (const double step : {0.0, 0.2, 0.4}) {
    for (const TrackedFeature& feature : moving.show(cameraAt(step), body).features)
      EXPECT_LT((feature.position - feature.reference).norm(), 0.003);
  }
}

TEST(MovingCamera, ARoughPoseByHandIsInTheFixedFrame) {
  MovingCamera moving;
  const Eigen::Isometry3d pose = cameraAt(0) * boxPose();
  const Points body = transformed(moving.box().volume.rest_vertices, pose);
  moving.show(cameraAt(0), body);
  moving.tracker().restart(pose * Eigen::Translation3d(0.01, 0.01, 0.0));
  const TrackingResult result = moving.show(cameraAt(1), body);
  ASSERT_TRUE(result.has_targets) << result.status.reason;
  EXPECT_TRUE(result.targets.reset);
  EXPECT_LT(moving.worstTarget(result, body), 0.003);
}

TEST(MovingCamera, ABladeIsWhereItWasSeenFromAnotherPlace) {
  Points blade(4, 3);
  blade << -0.05, -0.05, 0.5, 0.05, -0.05, 0.5, 0.05, 0.05, 0.5, -0.05, 0.05, 0.5;
  RgbdFrame frame;
  frame.stamp = kFrame;
  frame.camera = {160, 120, 150.0, 150.0, 80.0, 60.0};
  frame.color = cv::Mat3b(120, 160);
  frame.depth = cv::Mat1f(120, 160, 0.5f);
  frame.T_fixed_camera = cameraAt(2);
  ToolMask mask;
  mask.setBlade(kFrame, transformed(blade, cameraAt(2)));
  EXPECT_EQ(mask.withoutBlade(frame).depth(60, 80), 0.0f);
  frame.T_fixed_camera = cameraAt(2) * Eigen::Translation3d(0.2, 0.0, 0.0);
  const cv::Mat1f left = mask.withoutBlade(frame).depth;
  EXPECT_EQ(left(60, 80), 0.5f);
  EXPECT_EQ(left(60, 20), 0.0f);
}

}  // namespace
}  // namespace softbody
