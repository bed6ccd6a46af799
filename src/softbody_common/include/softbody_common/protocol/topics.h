#pragma once

/// Topic names, relative to the namespaces of the graph. Only launch files and remappings change them.
/// Nodes run in the namespace "/softbody"; the camera's topics are remapped from "camera/...".
namespace softbody::topics {

constexpr char kCameraColor[] = "camera/color/image_raw";
constexpr char kCameraColorInfo[] = "camera/color/camera_info";
constexpr char kCameraDepth[] = "camera/aligned_depth_to_color/image_raw";
constexpr char kCameraDepthInfo[] = "camera/aligned_depth_to_color/camera_info";

constexpr char kRgbRect[] = "rgb/image_rect_color";
constexpr char kRgbInfo[] = "rgb/camera_info";
constexpr char kDepthRect[] = "depth/image_rect";
constexpr char kDepthRectInfo[] = "depth/camera_info";
constexpr char kPoints[] = "points";
constexpr char kPointsMarker[] = "points/marker";

constexpr char kMask[] = "mask";
constexpr char kLabels[] = "labels";
constexpr char kFeatures[] = "features";
constexpr char kFeaturesMarker[] = "features/marker";
constexpr char kTargets[] = "targets";
constexpr char kStatus[] = "status";
constexpr char kVolumeTopology[] = "volume/topology";
constexpr char kVolumeCuts[] = "volume/cuts";
constexpr char kVolumeState[] = "volume/state";
constexpr char kSurfaceTopology[] = "surface/topology";
constexpr char kSurfaceCuts[] = "surface/cuts";
constexpr char kSurfaceState[] = "surface/state";
constexpr char kSurfaceMarker[] = "surface/marker";
constexpr char kSurfaceMesh[] = "surface/mesh";
constexpr char kSurfacePoints[] = "surface/points";
constexpr char kPin[] = "pin";
constexpr char kGripperClosed[] = "gripper/closed";
constexpr char kReaction[] = "reaction/";  // followed by a name
constexpr char kForces[] = "forces";
constexpr char kForcesMarker[] = "forces/marker";
constexpr char kToolPose[] = "tool/pose";
constexpr char kToolBlade[] = "tool/blade";
constexpr char kToolMarker[] = "tool/marker";
constexpr char kCut[] = "cut";
constexpr char kCutMarker[] = "cut/marker";
constexpr char kPreviewMarker[] = "preview/marker";
constexpr char kTiming[] = "timing";

/// The result, as a recording has it that export, evaluate and Python read.
constexpr const char* kResult[] = {kSurfaceTopology, kSurfaceState, kVolumeTopology,
                                   kVolumeState,     kStatus,       kTiming};
/// And the frames of it.
constexpr const char* kTransforms[] = {"/tf", "/tf_static"};

}  // namespace softbody::topics
