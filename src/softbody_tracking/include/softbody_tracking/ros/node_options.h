#pragma once

#include <string>
#include <vector>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/camera/frame_pairer.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "softbody_tracking/tracker_config.h"

/// The parameters of this package's nodes.
namespace softbody {

struct CameraIngestOptions {
  PairingConfig pairing;
  CameraIngestConfig ingest;
  double depth_scale = 0.0;        ///< metres per unit of depth; 0: by the encoding
  double voxel_size_m = 0.0;       ///< of `points`; 0: a point for each pixel
  double silence_timeout_s = 2.0;  ///< without a frame, after which the node says so
  std::string color_transport = "raw", depth_transport = "raw";
};

/// The fixed frame of bodies and tools.
struct OutputFrameOptions {
  std::string name;         ///< empty: the camera's own frame
  double timeout_s = 0.05;  ///< how long a frame waits for the camera's pose in it
};

/// The links of a robot in view.
struct RobotOptions {
  std::string description;     ///< name of the parameter with the URDF; empty: no robot
  double deviation_m = 0.003;  ///< standard deviation of a link's place
};

/// Segmentation masks from elsewhere.
struct MaskOptions {
  bool use = false;
  double timeout_s = 0.3;  ///< how long a frame waits for its mask
};

struct FeatureTrackerOptions {
  TrackerConfig tracker;
  OutputFrameOptions output_frame;
  std::string body_frame;
  std::string object;          ///< path of the object YAML, for its picture; empty: no picture
  bool allow_outside = false;  ///< files that the object YAML names may be outside of its folder
  MaskOptions mask;
  std::vector<std::string> known_surfaces;  ///< namespaces of the topics of other bodies' surfaces
  RobotOptions robot;
};

struct ToolTrackerOptions {
  std::string tool;            ///< path of the tool YAML
  bool allow_outside = false;  ///< files that the tool YAML names may be outside of its folder
  std::string blade_frame;     ///< of tf, in place of the tool's markers; empty: as the tool YAML says
  std::string tool_frame;
  ToolTrackerConfig tracker;
  OutputFrameOptions output_frame;
};

struct PoseMarkerOptions {
  std::string frame;  ///< of the marker; empty: that of the images
};

const ParameterTable<CameraIngestOptions>& cameraIngestNodeParameters();
const ParameterTable<FeatureTrackerOptions>& featureTrackerNodeParameters();
const ParameterTable<ToolTrackerOptions>& toolTrackerNodeParameters();
const ParameterTable<PoseMarkerOptions>& poseMarkerNodeParameters();

}  // namespace softbody
