#pragma once

#include <gtest/gtest.h>

#include "softbody_common/rigid_fit.h"
#include "softbody_tracking/body_tracker.h"
#include "synthetic_scene.h"

namespace softbody {

/// Drives a tracker with rendered frames; the "simulator" answers every frame with the truth.
class TrackedBox {
 public:
  explicit TrackedBox(const TrackerConfig& config = TrackerConfig(), const BoxBody& box = makeBox())
      : box_(box), tracker_(config) {
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
  static constexpr Nanoseconds kFrame = 33'333'333;

  Eigen::Vector3d placeOf(const Target& target, const Points& vertices) const {
    return positionOf(target.place, vertices, box_.volume.tets);
  }

  BoxBody box_;
  BodyTracker tracker_;
  RgbdFrame frame_;
  MeshState state_;
  bool has_state_ = false;
  Nanoseconds stamp_ = 1'000'000'000;
};

inline Points posedBox(const BoxBody& box, double shift = 0.0, double turn = 0.0) {
  return transformed(box.volume.rest_vertices,
                     Eigen::Translation3d(shift, 0.5 * shift, shift) * boxPose() *
                         Eigen::AngleAxisd(turn, Eigen::Vector3d(0.3, 1.0, 0.2).normalized()));
}

}  // namespace softbody
