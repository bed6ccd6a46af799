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
constexpr double kAgrees = 24.1;        // chi squared: 99.95 % of the poses that follow the predicted motion

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

double motionCost(const PoseEstimate& estimate, const PoseMotion::Prediction& predicted) {
  const Eigen::Matrix<double, 6, 1> difference = poseDifference(predicted.pose, estimate.T_camera_tool);
  const PoseCovariance covariance = predicted.covariance + estimate.covariance;
  return difference.dot(covariance.ldlt().solve(difference));
}

/// With an unknown standard deviation, which the corners of earlier frames show with so many degrees of
/// freedom, residuals follow Student's t distribution.
void judge(const std::optional<PoseMotion::Prediction>& predicted, double freedom,
           const ToolTrackerConfig& config, ToolHypothesis* hypothesis) {
  PoseEstimate& estimate = hypothesis->estimate;
  const double factor = (freedom + estimate.cost) / (freedom + estimate.freedom);
  estimate.covariance *= std::max(1.0, factor);
  if (predicted) {
    const double cost = motionCost(estimate, *predicted);
    hypothesis->against_motion = cost > kAgrees;
    hypothesis->motion_cost = std::min(cost, kMaxMotionCost * config.ambiguity);
  }
  hypothesis->unlikelihood =
      (freedom + estimate.freedom) * std::log1p(estimate.cost / freedom) + hypothesis->motion_cost;
}

/// As many markers agree with the other one.
bool isRival(const ToolHypothesis& best, const ToolHypothesis& other) {
  return other.markers.size() >= best.markers.size();
}

double rotationBetween(const ToolHypothesis& a, const ToolHypothesis& b) {
  return poseDifference(a.estimate.T_camera_tool, b.estimate.T_camera_tool).tail<3>().norm();
}

}  // namespace

std::vector<ToolHypothesis> toolHypotheses(const std::vector<MarkerMeasurement>& measurements,
                                           const Pinhole& camera,
                                           const std::optional<PoseMotion::Prediction>& predicted,
                                           const CornerNoise& noise, const ToolTrackerConfig& config) {
  ToolTrackerConfig weights = config;
  weights.corner_std_px = noise.std_px();
  std::vector<ToolHypothesis> hypotheses;
  for (const MarkerMeasurement& measurement : measurements) {
    for (const Eigen::Isometry3d& start : planarPoses(measurement, camera)) {
      ToolHypothesis hypothesis = refined(agreeing(measurements, camera, start), camera, start, weights);
      if (hypothesis.markers.empty()) continue;
      judge(predicted, noise.freedom(), config, &hypothesis);
      hypotheses.push_back(std::move(hypothesis));
    }
  }
  std::stable_sort(hypotheses.begin(), hypotheses.end(), [](const auto& a, const auto& b) {
    if (a.markers.size() != b.markers.size()) return a.markers.size() > b.markers.size();
    return a.unlikelihood < b.unlikelihood;
  });
  return hypotheses;
}

bool isAmbiguous(const std::vector<ToolHypothesis>& best_first, bool with_motion,
                 const ToolTrackerConfig& config) {
  const ToolHypothesis& best = best_first.front();
  const double uncertainty = std::sqrt(best.estimate.covariance.bottomRightCorner<3, 3>().trace());
  const double same = std::max(kSameRotation_rad, kSameRotationSigmas * uncertainty);
  const auto against = [with_motion](const ToolHypothesis& h) {
    return h.unlikelihood - (with_motion ? 0.0 : h.motion_cost);
  };
  return std::any_of(best_first.begin() + 1, best_first.end(), [&](const ToolHypothesis& other) {
    return isRival(best, other) && rotationBetween(best, other) > same &&
           against(other) - against(best) < config.ambiguity;
  });
}

PoseCovariance mixedCovariance(const std::vector<ToolHypothesis>& best_first) {
  const ToolHypothesis& best = best_first.front();
  PoseCovariance covariance = best.estimate.covariance;
  for (auto other = best_first.begin() + 1; other != best_first.end(); ++other) {
    if (!isRival(best, *other)) continue;
    const double odds = std::exp(-0.5 * (other->unlikelihood - best.unlikelihood));
    const Eigen::Matrix<double, 6, 1> d =
        poseDifference(best.estimate.T_camera_tool, other->estimate.T_camera_tool);
    covariance += odds / (1.0 + odds) * d * d.transpose();
  }
  return covariance;
}

}  // namespace softbody
