#pragma once

#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <string>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_common/time/stage_timer.h"
#include "softbody_tracking/rgbd_frame.h"
#include "softbody_tracking/tool/tool_description.h"

namespace softbody {

struct ToolTrackerConfig {
  double corner_std_px = 0.15;           ///< standard deviation of each coordinate of a detected corner
  bool use_depth = true;                 ///< use the depth on the markers
  double depth_std_1_m = 0.005;          ///< standard deviation of depth at 1 m; it grows with z^2
  double depth_independent_samples = 8;  ///< effective number of independent samples on a marker
  double max_reprojection_px = 3.0;      ///< largest rms error of a marker that belongs to the tool
  double ambiguity = 8.0;      ///< two poses are ambiguous if their costs (chi squared) differ by less
  double bridge_time_s = 0.3;  ///< how long a tool that is not seen is predicted
};

const ParameterTable<ToolTrackerConfig>& toolTrackerParameters();

/// Rows and columns: x y z [m], then small rotations about the camera's x y z axes through the tool's origin
/// [rad], as in geometry_msgs/PoseWithCovariance.
using PoseCovariance = Eigen::Matrix<double, 6, 6>;

/// The tool's pose in one frame.
struct ToolObservation {
  Nanoseconds stamp = 0;
  Eigen::Isometry3d T_camera_tool = Eigen::Isometry3d::Identity();  ///< colour optical frame
  PoseCovariance covariance = PoseCovariance::Zero();
  bool bridged = false;          ///< predicted from its motion, not seen; the covariance grows with time
  bool ambiguous = false;        ///< another pose fits equally well; the covariance includes it
  bool cuts = false;             ///< seen, certain, and where its motion led: the blade may cut
  int markers = 0;               ///< number of markers used; 0 if bridged
  double reprojection_px = 0.0;  ///< rms over the markers' corners
  double depth_offset_m = 0.0;   ///< mean measured minus computed depth on the markers; 0 without depth
};

/// ToolTracker::reason() of a frame without any of the tool's markers.
constexpr char kNoMarkerSeen[] = "no marker of the tool is seen";

/// Tracks a tool by the corners of its markers and the depth on them, all markers together. A tool with a
/// frame of tf is where the frame is, exactly.
class ToolTracker {
 public:
  /// @throw std::invalid_argument if the description has neither markers nor a frame, or an unknown
  /// dictionary.
  explicit ToolTracker(const ToolDescription& tool, const ToolTrackerConfig& config = {});
  ~ToolTracker();

  /// The tool's pose; nothing if it is neither seen nor bridged. reason() says why the blade may not cut. A
  /// frame of another pass resets the tracker. Motion is predicted in the fixed frame: without a camera pose
  /// there (frame.placed) the tool is neither predicted nor bridged. @param timer may be null.
  std::optional<ToolObservation> track(const RgbdFrame& frame, StageTimer* timer);

  /// The same for a tool with a frame, which no image is needed for. @param T_camera_tool at the stamp;
  /// empty: tf does not know it.
  std::optional<ToolObservation> follow(Nanoseconds stamp,
                                        const std::optional<Eigen::Isometry3d>& T_camera_tool);

  const ToolDescription& tool() const;
  /// Why the tool's blade may not cut in the last frame; empty: it may.
  const std::string& reason() const;
  void reset();

 private:
  struct Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace softbody
