#include "tool/tool_hypotheses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

namespace softbody {
namespace {

constexpr double kCoarseGate = 0.5;  // of a marker's side; largest rms error before the pose is refined
constexpr double kSameRotation_rad = 0.05;   // [rad] rotations that differ by less are the same pose,
constexpr double kSameRotationSigmas = 4.0;  // as are those within this many standard deviations
constexpr double kMaxMotionCost = 3.0;  // times the ambiguity: a faster motion than predicted stays possible

double side(const Eigen::Matrix<double, 2, 4>& corners) {
  double longest = 0.0;
  for (int k = 0; k < 4; ++k) longest = std::max(longest, (corners.col(k) - corners.col((k + 1) % 4)).norm());
  return longest;
}

/// For each marker id, the detection nearest to its projection.
std::vector<const MarkerMeasurement*> agreeing(const std::vector<MarkerMeasurement>& measurements,
                                               const Pinhole& camera, const Eigen::Isometry3d& T) {
  std::vector<const MarkerMeasurement*> markers;
  for (const MarkerMeasurement& candidate : measurements) {
    const double error = reprojectionRms(candidate, camera, T);
    if (!(error < kCoarseGate * side(candidate.corners))) continue;
    const auto same = std::find_if(markers.begin(), markers.end(), [&candidate](const auto* other) {
      return other->marker == candidate.marker;
    });
    if (same == markers.end()) {
      markers.push_back(&candidate);
    } else if (error < reprojectionRms(**same, camera, T)) {
      *same = &candidate;
    }
  }
  return markers;
}

/// Refines the pose, and removes the worst marker until all agree. May return no markers.
ToolHypothesis refined(std::vector<const MarkerMeasurement*> markers, const Pinhole& camera,
                       const Eigen::Isometry3d& start, const ToolTrackerConfig& config) {
  ToolHypothesis hypothesis;
  while (!markers.empty()) {
    hypothesis.estimate = refinePose(markers, camera, start, config);
    const auto error = [&](const MarkerMeasurement* m) {
      return reprojectionRms(*m, camera, hypothesis.estimate.T_camera_tool);
    };
    const auto worst =
        std::max_element(markers.begin(), markers.end(),
                         [&error](const auto* a, const auto* b) { return error(a) < error(b); });
    if (error(*worst) <= config.max_reprojection_px) break;
    markers.erase(worst);
  }
  hypothesis.markers = std::move(markers);
  return hypothesis;
}

double motionCost(const PoseEstimate& estimate, const PoseMotion::Prediction& predicted, double bound) {
  const Eigen::Matrix<double, 6, 1> difference = poseDifference(predicted.pose, estimate.T_camera_tool);
  const PoseCovariance covariance = predicted.covariance + estimate.covariance;
  const double squared = difference.dot(covariance.ldlt().solve(difference));
  return std::min(bound, squared);
}

double rotationBetween(const ToolHypothesis& a, const ToolHypothesis& b) {
  return poseDifference(a.estimate.T_camera_tool, b.estimate.T_camera_tool).tail<3>().norm();
}

}  // namespace

std::vector<ToolHypothesis> toolHypotheses(const std::vector<MarkerMeasurement>& measurements,
                                           const Pinhole& camera,
                                           const std::optional<PoseMotion::Prediction>& predicted,
                                           const ToolTrackerConfig& config) {
  std::vector<ToolHypothesis> hypotheses;
  for (const MarkerMeasurement& measurement : measurements) {
    for (const Eigen::Isometry3d& start : planarPoses(measurement, camera)) {
      ToolHypothesis hypothesis = refined(agreeing(measurements, camera, start), camera, start, config);
      if (hypothesis.markers.empty()) continue;
      if (predicted)
        hypothesis.motion_cost =
            motionCost(hypothesis.estimate, *predicted, kMaxMotionCost * config.ambiguity);
      hypotheses.push_back(std::move(hypothesis));
    }
  }
  std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const auto& a, const auto& b) {
    if (a.markers.size() != b.markers.size()) return a.markers.size() > b.markers.size();
    return a.estimate.cost + a.motion_cost < b.estimate.cost + b.motion_cost;
  });
  return hypotheses;
}

bool isAmbiguous(const std::vector<ToolHypothesis>& best_first, const ToolTrackerConfig& config) {
  const ToolHypothesis& best = best_first.front();
  const double uncertainty = std::sqrt(best.estimate.covariance.bottomRightCorner<3, 3>().trace());
  const double scale = best.estimate.variance_factor;
  return std::any_of(best_first.begin() + 1, best_first.end(), [&](const ToolHypothesis& other) {
    if (other.markers.size() < best.markers.size()) return false;
    const double worse =
        (other.estimate.cost - best.estimate.cost) / scale + other.motion_cost - best.motion_cost;
    const bool different =
        rotationBetween(best, other) > std::max(kSameRotation_rad, kSameRotationSigmas * uncertainty);
    return different && worse < config.ambiguity;
  });
}

}  // namespace softbody
