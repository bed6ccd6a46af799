#include <test_support/gtest.h>

#include <random>

#include "fixtures/tracked_box.h"

namespace softbody {
namespace {

constexpr int kFramesOfASecond = 30;  // at 30 Hz

/// Drives a tracker that is told where the body is. The "simulator" answers with a body that follows the
/// tracker rigidly, so that only the status can say that something is wrong.
class PlacedBox {
 public:
  explicit PlacedBox(double scale = 1.0) : shown_(makeBox()), model_(makeBox()), tracker_(TrackerConfig()) {
    model_.volume.rest_vertices *= scale;
    model_.surface.rest_vertices *= scale;
    tracker_.setTopologies(model_.volume, model_.surface);
  }

  void placeAt(const Eigen::Isometry3d& pose) {
    tracker_.placeAt(pose);
    has_state_ = false;
  }

  TrackingResult show() {
    stamp_ += 33'333'333;
    const Points truth = transformed(shown_.volume.rest_vertices, boxPose());
    const RgbdFrame frame = renderFrame(shown_, truth, stamp_);
    StageTimer timer;
    TrackingResult result = tracker_.track(frame, has_state_ ? &state_ : nullptr, &timer);
    pose_ = result.targets.body_pose;
    state_ = {model_.volume.revision, stamp_, transformed(model_.volume.rest_vertices, pose_), {}};
    has_state_ = true;
    return result;
  }

  TrackingResult showForASecond() {
    for (int i = 1; i < kFramesOfASecond; ++i) show();
    return show();
  }

  double offBy() const {
    const Points& rest = shown_.volume.rest_vertices;
    return (transformed(rest, pose_) - transformed(rest, boxPose())).rowwise().norm().maxCoeff();
  }

 private:
  BoxBody shown_, model_;
  BodyTracker tracker_;
  Eigen::Isometry3d pose_ = Eigen::Isometry3d::Identity();
  MeshState state_;
  bool has_state_ = false;
  Nanoseconds stamp_ = 1'000'000'000;
};

Eigen::Vector3d randomDirection(std::mt19937* generator) {
  std::normal_distribution<double> normal;
  return Eigen::Vector3d(normal(*generator), normal(*generator), normal(*generator)).normalized();
}

TEST(PlacedBody, TracksFromTheRightPose) {
  PlacedBox box;
  box.placeAt(boxPose());
  for (int i = 0; i < kFramesOfASecond; ++i) {
    const TrackingStatus status = box.show().status;
    EXPECT_EQ(status.state, TrackingState::kTracking) << status.reason << ", frame " << i;
  }
}

TEST(PlacedBody, AWrongPoseIsRightOrReportedWithinASecond) {
  std::mt19937 generator(1);
  for (int i = 0; i < 8; ++i) {
    const Eigen::Vector3d direction = randomDirection(&generator);
    for (const bool turned : {false, true}) {
      PlacedBox box;
      Eigen::Isometry3d wrong = boxPose();
      if (turned)
        wrong.rotate(Eigen::AngleAxisd(20.0 * M_PI / 180.0, direction));
      else
        wrong.pretranslate(0.02 * direction);
      box.placeAt(wrong);
      const TrackingStatus status = box.showForASecond().status;
      if (status.state != TrackingState::kTracking) continue;
      EXPECT_LT(box.offBy(), 0.005) << (turned ? "turned about " : "moved along ") << direction.transpose();
    }
  }
}

TEST(PlacedBody, AMeshOfTheWrongSizeIsReported) {
  for (const auto& [scale, words] : {std::pair(1.3, "% smaller"), std::pair(0.77, "a larger body")}) {
    PlacedBox box(scale);
    box.placeAt(boxPose());
    const TrackingStatus status = box.showForASecond().status;
    EXPECT_NE(status.state, TrackingState::kTracking);
    EXPECT_TRUE(says(status.reason, words));
  }
}

}  // namespace
}  // namespace softbody
