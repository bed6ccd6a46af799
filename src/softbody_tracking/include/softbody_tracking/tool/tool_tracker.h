#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>

#include "softbody_common/parameters.h"
#include "softbody_common/stage_timer.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

struct ToolTrackerConfig {
  double corner_std_px = 0.15;           ///< of a detected corner, each coordinate
  bool use_depth = true;                 ///< depth under the markers
  double depth_std_1_m = 0.005;          ///< standard deviation of a depth at 1 m; grows with z^2
  double depth_independent_samples = 8;  ///< as many as a marker's depths are worth: what they share stays
  double max_reprojection_px = 3.0;      ///< rms of a marker that belongs to the tool
  double ambiguity = 8.0;      ///< a mirrored pose whose cost (chi squared) is within this is as good
  double bridge_time_s = 0.3;  ///< a tool out of sight is predicted for so long
};

/// @throw std::invalid_argument as Parameters does.
ToolTrackerConfig readToolTrackerConfig(Parameters& parameters);

/// Rows and columns: x y z [m], then small rotations about the camera's x y z axes through the tool's origin
/// [rad], as in geometry_msgs/PoseWithCovariance.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// Where the tool is in one frame.
struct ToolObservation {
  Nanoseconds stamp = 0;
  Eigen::Isometry3d T_camera_tool = Eigen::Isometry3d::Identity();  ///< colour optical frame
  PoseCovariance covariance = PoseCovariance::Zero();
  bool bridged = false;  ///< predicted from motion, not seen; its covariance grows from frame to frame
  int markers = 0;       ///< that it was computed from; 0 when bridged
  double reprojection_px = 0.0;  ///< rms over their corners
  double depth_offset_m = 0.0;   ///< mean measured minus computed depth on the markers; 0 without depth
};

/// Follows a tool by its markers: corners and the depth under them, all markers at once.
class ToolTracker {
 public:
  /// @throw std::invalid_argument if the description has no markers, or an unknown dictionary.
  explicit ToolTracker(const ToolDescription& tool, const ToolTrackerConfig& config = {});
  ~ToolTracker();

  /// @return nothing where the tool is neither seen nor bridged; reason() says why. Stamps that jump back
  /// start anew. The tool's motion is predicted in the frame that stands still: in a frame whose camera is
  /// not placed there the tool is seen without a prediction, and not bridged. @param timer may be null.
  std::optional<ToolObservation> track(const RgbdFrame& frame, StageTimer* timer);

  const ToolDescription& tool() const;
  /// Why the last frame gave no pose or a bridged one; empty: it was seen.
  const std::string& reason() const;
  void reset();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
