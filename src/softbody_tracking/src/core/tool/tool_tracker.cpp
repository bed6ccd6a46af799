#include "softbody_tracking/tool/tool_tracker.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <opencv2/imgproc.hpp>

#include "softbody_common/time/time.h"
#include "softbody_tracking/tool/marker_detector.h"
#include "tool/expected_markers.h"
#include "tool/pose_motion.h"
#include "tool/tool_hypotheses.h"
#include "tool/tool_pose.h"

namespace softbody {
namespace {

/// [px] Windows of the adaptive threshold, OpenCV's three. The whole image is searched with one a frame:
/// first with the one that finds markers of most sizes.
constexpr int kWindows_px[] = {13, 23, 3};
constexpr std::size_t kSmallWindow = 2;  // comes first after a region: it sees markers at the image's edge
/// Of the blade's length: with a larger standard deviation a stroke would not be where the hand made it.
constexpr double kMaxBladeStd = 0.1;

/// A window that reaches over one cell on both sides of an edge, odd. Smaller ones see two edges of a thin
/// border, and larger ones see what is beside the white margin.
int windowFor(double cell_px) { return std::max(3, 2 * static_cast<int>(std::lround(cell_px)) + 1); }

/// Only the region is set.
cv::Mat1b grayOf(const cv::Mat3b& color, const cv::Rect& region) {
  cv::Mat1b gray(color.size());
  cv::cvtColor(color(region), gray(region), cv::COLOR_BGR2GRAY);
  return gray;
}

double rmsOver(const ToolHypothesis& hypothesis, const Pinhole& camera) {
  double sum = 0.0;
  for (const MarkerMeasurement* m : hypothesis.markers) {
    const double rms = reprojectionRms(*m, camera, hypothesis.estimate.T_camera_tool);
    sum += rms * rms;
  }
  return std::sqrt(sum / static_cast<double>(hypothesis.markers.size()));
}

/// The covariance with its axes rotated by R.
PoseCovariance rotated(const PoseCovariance& covariance, const Eigen::Matrix3d& R) {
  PoseCovariance rotation = PoseCovariance::Zero();
  rotation.topLeftCorner<3, 3>() = R;
  rotation.bottomRightCorner<3, 3>() = R;
  return rotation * covariance * rotation.transpose();
}

/// Largest standard deviation of a blade's corner [m].
double bladeStd(const Points& blade, const Eigen::Isometry3d& T, const PoseCovariance& covariance) {
  double largest = 0.0;
  for (const auto& corner : blade.rowwise()) {
    const Eigen::Vector3d arm = T.linear() * corner.transpose();
    Eigen::Matrix<double, 3, 6> J;  // of the corner by the pose
    J << Eigen::Matrix3d::Identity(),
        (Eigen::Matrix3d() << 0, arm.z(), -arm.y(), -arm.z(), 0, arm.x(), arm.y(), -arm.x(), 0).finished();
    largest = std::max(largest, (J * covariance * J.transpose()).trace());
  }
  return std::sqrt(largest);
}

double lengthOf(const Points& blade) {
  return (blade.colwise().maxCoeff() - blade.colwise().minCoeff()).norm();
}

ToolObservation observationOf(const std::vector<ToolHypothesis>& best_first, const RgbdFrame& frame) {
  const ToolHypothesis& hypothesis = best_first.front();
  ToolObservation observation;
  observation.stamp = frame.stamp;
  observation.T_camera_tool = hypothesis.estimate.T_camera_tool;
  observation.covariance = mixedCovariance(best_first);
  observation.markers = static_cast<int>(hypothesis.markers.size());
  observation.reprojection_px = rmsOver(hypothesis, frame.camera);
  observation.depth_offset_m = depthOffset(hypothesis.markers, observation.T_camera_tool);
  return observation;
}

ParameterTable<ToolTrackerConfig> makeToolTrackerTable() {
  using Config = ToolTrackerConfig;
  ParameterTable<Config> table;
  table.group("tool_tracker");
  table.number("bridge_time_s", &Config::bridge_time_s, {0.0, 10.0}, "s",
               "prediction of a tool that is out of view; 0: none");
  return table;
}

}  // namespace

const ParameterTable<ToolTrackerConfig>& toolTrackerParameters() {
  static const ParameterTable<ToolTrackerConfig> table = makeToolTrackerTable();
  return table;
}

struct ToolTracker::Implementation {
  Implementation(const ToolDescription& description, const ToolTrackerConfig& tracker_config)
      : tool(description), config(tracker_config), noise(tracker_config.corner_std_px) {
    if (!tool.frame.empty()) return;
    if (tool.markers.empty()) throw std::invalid_argument("a tool without markers cannot be tracked");
    detector.emplace(description.dictionary);
  }

  std::vector<MarkerMeasurement> measure(const RgbdFrame& frame, const cv::Rect& region,
                                         int window_px) const {
    std::vector<MarkerMeasurement> found;
    for (const MarkerDetection& detection :
         detector->detect(grayOf(frame.color, region), region, window_px)) {
      const auto marker = std::find_if(tool.markers.begin(), tool.markers.end(),
                                       [&](const ToolMarker& m) { return m.id == detection.id; });
      if (marker == tool.markers.end()) continue;
      found.push_back({&*marker, detection.corners, depthUnder(detection.corners, frame)});
    }
    return found;
  }

  /// Searches around the prediction first, then in the whole image.
  std::vector<ToolHypothesis> search(const RgbdFrame& frame) {
    const auto predicted = predict(frame);
    const auto searchIn = [&](const cv::Rect& region, int window_px) {
      measurements = measure(frame, region, window_px);
      return toolHypotheses(measurements, frame.camera, predicted, noise, config);
    };
    const auto expected =
        predicted ? expectedMarkers(tool, detector->cells(), frame.camera, *predicted) : std::nullopt;
    std::size_t turn = lost_frames;
    std::vector<ToolHypothesis> hypotheses;
    if (expected && !expected->region.empty()) {
      hypotheses = searchIn(expected->region, windowFor(expected->cell_px));
      turn += kSmallWindow;
    }
    if (hypotheses.empty())
      hypotheses = searchIn({{}, frame.color.size()}, kWindows_px[turn % std::size(kWindows_px)]);
    lost_frames = hypotheses.empty() ? lost_frames + 1 : 0;
    return hypotheses;
  }

  std::optional<ToolObservation> observe(const RgbdFrame& frame) {
    measurements.clear();
    const std::vector<ToolHypothesis> hypotheses = search(frame);
    if (measurements.empty()) {
      reason = kNoMarkerSeen;
    } else if (hypotheses.empty()) {
      reason = fmt::format("no pose fits the markers to {} px", config.max_reprojection_px);
    } else {
      return judged(hypotheses, frame);
    }
    return std::nullopt;
  }

  ToolObservation judged(const std::vector<ToolHypothesis>& hypotheses, const RgbdFrame& frame) {
    const ToolHypothesis& best = hypotheses.front();
    noise.add(best.estimate.corner_cost, best.estimate.corner_freedom);
    ToolObservation observation = observationOf(hypotheses, frame);
    observation.ambiguous = isAmbiguous(hypotheses, true, config);
    const bool follows = motion && !best.against_motion;
    if (!follows) motion.reset();
    const bool certain_alone = !isAmbiguous(hypotheses, false, config);
    // Without the camera's pose nothing says whether two poses agree.
    confirmed = follows && (confirmed || (certain_alone && frame.placed));
    if (observation.ambiguous || (follows && !confirmed)) {
      reason = "two poses fit equally well: the marker is too small in the image, or it faces the camera";
    } else if (isUncertain(observation)) {
      reason = "the blade's place is uncertain: the markers are too small in the image";
    } else {
      reason.clear();
    }
    observation.cuts = reason.empty() && confirmed;
    return observation;
  }

  bool isUncertain(const ToolObservation& observation) const {
    if (tool.blade.rows() == 0) return false;
    return bladeStd(tool.blade, observation.T_camera_tool, observation.covariance) >
           kMaxBladeStd * lengthOf(tool.blade);
  }

  void forgetOldMotion(Nanoseconds stamp) {
    const auto bridged = nanoseconds(config.bridge_time_s);
    if (motion && (stamp < motion->stamp() || stamp - motion->stamp() > bridged)) motion.reset();
  }

  /// Predicted pose in the camera's frame.
  std::optional<PoseMotion::Prediction> predict(const RgbdFrame& frame) const {
    if (!motion || !frame.placed) return std::nullopt;
    const Eigen::Isometry3d T_camera_fixed = frame.T_fixed_camera.inverse();
    const PoseMotion::Prediction predicted = motion->predict(frame.stamp);
    return PoseMotion::Prediction{T_camera_fixed * predicted.pose,
                                  rotated(predicted.covariance, T_camera_fixed.linear())};
  }

  void updateMotion(const ToolObservation& seen, const RgbdFrame& frame) {
    if (!frame.placed) return;
    const Eigen::Isometry3d pose = frame.T_fixed_camera * seen.T_camera_tool;
    const PoseCovariance covariance = rotated(seen.covariance, frame.T_fixed_camera.linear());
    if (motion) {
      motion->update(pose, covariance, frame.stamp);
    } else {
      motion.emplace(pose, covariance, frame.stamp);
    }
  }

  std::optional<ToolObservation> bridge(const RgbdFrame& frame) const {
    const auto predicted = predict(frame);
    if (!predicted) return std::nullopt;
    ToolObservation observation;
    observation.stamp = frame.stamp;
    observation.T_camera_tool = predicted->pose;
    observation.covariance = predicted->covariance;
    observation.bridged = true;
    return observation;
  }

  ToolDescription tool;
  ToolTrackerConfig config;
  std::optional<MarkerDetector> detector;  ///< of a tool with markers
  CornerNoise noise;
  std::optional<PoseMotion> motion;  ///< in the fixed frame
  std::size_t lost_frames = 0;       ///< since a pose was found
  bool confirmed = false;  ///< two poses in a row, each certain without the motion, began the motion
  std::vector<MarkerMeasurement> measurements;  ///< of the current frame; hypotheses point into it
  int pass = 0;                                 ///< of the last frame
  std::string reason = "no frame yet";
};

ToolTracker::ToolTracker(const ToolDescription& tool, const ToolTrackerConfig& config)
    : implementation_(std::make_unique<Implementation>(tool, config)) {}

ToolTracker::~ToolTracker() = default;

std::optional<ToolObservation> ToolTracker::track(const RgbdFrame& frame, StageTimer* timer) {
  Implementation& self = *implementation_;
  StageTimer unused;
  const auto stage = (timer != nullptr ? timer : &unused)->stage("Tool Tracking");
  if (frame.pass != self.pass) reset();
  self.pass = frame.pass;
  self.forgetOldMotion(frame.stamp);
  std::optional<ToolObservation> observation = self.observe(frame);
  if (observation && !observation->ambiguous) {
    self.updateMotion(*observation, frame);
    return observation;
  }
  const std::optional<ToolObservation> bridged = self.bridge(frame);
  return bridged ? bridged : observation;
}

std::optional<ToolObservation> ToolTracker::follow(Nanoseconds stamp,
                                                   const std::optional<Eigen::Isometry3d>& T_camera_tool) {
  Implementation& self = *implementation_;
  if (!T_camera_tool) {
    self.reason = fmt::format("tf gives no pose of its frame '{}'", self.tool.frame);
    return std::nullopt;
  }
  self.reason.clear();
  ToolObservation observation;
  observation.stamp = stamp;
  observation.T_camera_tool = *T_camera_tool;
  observation.cuts = true;
  return observation;
}

const ToolDescription& ToolTracker::tool() const { return implementation_->tool; }

const std::string& ToolTracker::reason() const { return implementation_->reason; }

void ToolTracker::reset() {
  implementation_->motion.reset();
  implementation_->lost_frames = 0;
  implementation_->reason = "no frame yet";
}

}  // namespace softbody
