#pragma once

#include "softbody_virtual_camera/camera/wrench_sensor.h"
#include "softbody_virtual_camera/rendering/exposure.h"
#include "softbody_virtual_camera/rendering/noise.h"
#include "softbody_virtual_camera/rendering/renderer.h"
#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// Colour intrinsics of a RealSense D435 at 640 x 480 and 848 x 480. Other sizes are scaled by the image
/// height.
Pinhole d435(int width, int height);

struct NoiseOptions {
  ExposureDriftOptions exposure;
  MotionBlurOptions blur;
  ColorNoiseOptions color;
  DepthNoiseOptions depth;
  WrenchSensorOptions wrench;
};
/// All parts switched off; force/torque sensors without bias and drift.
NoiseOptions noNoise();

/// One frame and its truth.
struct Capture {
  cv::Mat3b color;     ///< r, g, b
  cv::Mat1w depth_mm;  ///< registered to colour; 0: not measured
  cv::Mat1b labels;    ///< true labels of the pixels, without noise, as in pixel_labels.h
  MeshState
      truth;  ///< in the optical frame, or in the world if the camera moves; confidence 1: visible, 0: hidden
  Eigen::Isometry3d T_camera_body;
  std::optional<Eigen::Isometry3d> T_camera_tool;
  std::optional<GripperState> gripper;
  std::optional<MeshState> second;  ///< the truth of a second soft body
  std::optional<Eigen::Isometry3d> T_camera_second;
  std::vector<LinkPose> links;                      ///< of a robot
  std::optional<std::vector<SurfaceForce>> forces;  ///< in the frame of the truth
  std::vector<FramePose> frames;                    ///< of things that hold or touch the body
  std::vector<ContactWrench> wrenches;              ///< what the body does to them, as their sensors say
  std::vector<ContactWrench> true_wrenches;         ///< likewise, without the sensors' errors
  std::optional<Eigen::Isometry3d> T_world_camera;  ///< only with a moving camera
};

/// A seeded RGB-D camera in a scene. The same seed, scene and frame give the same bytes.
class VirtualCamera {
 public:
  VirtualCamera(Scene scene, const Pinhole& camera, const NoiseOptions& noise, std::uint64_t seed);

  /// @param frame selects the noise. @param t time in the scene [s].
  Capture capture(int frame, double t);

  const Pinhole& pinhole() const { return camera_; }
  const Scene& scene() const { return scene_; }
  /// The soft body at rest. Revision 0 has the vertices of the input mesh, in the same order.
  const MeshTopology& topology(std::uint32_t revision) const { return topologies_.at(revision); }
  /// A second soft body at rest; none: the scene has no such body.
  std::optional<MeshTopology> secondTopology() const;

 private:
  int imagesAt(double t, const SceneState& state) const;  ///< number of images for motion blur
  cv::Mat3b blurredColor(double t, int images);

  Scene scene_;
  Pinhole camera_;
  std::vector<MeshTopology> topologies_;  ///< by revision
  std::vector<Renderer> renderers_;       ///< by revision
  MotionBlurOptions blur_;
  ExposureDrift exposure_drift_;
  ColorNoise color_noise_;
  DepthNoise depth_noise_;
  WrenchSensor wrench_sensor_;
  RenderedImage image_;
};

}  // namespace softbody::virtual_camera
