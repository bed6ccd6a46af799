#pragma once

#include "softbody_virtual_camera/rendering/exposure.h"
#include "softbody_virtual_camera/rendering/noise.h"
#include "softbody_virtual_camera/rendering/renderer.h"
#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// Colour intrinsics of a RealSense D435 at 640 x 480 and 848 x 480, scaled with the image height for other
/// sizes.
Pinhole d435(int width, int height);

struct NoiseOptions {
  ExposureDriftOptions exposure;
  MotionBlurOptions blur;
  ColorNoiseOptions color;
  DepthNoiseOptions depth;
};
/// Every part switched off.
NoiseOptions noNoise();

/// One frame and its truth.
struct Capture {
  cv::Mat3b color;     ///< r, g, b
  cv::Mat1w depth_mm;  ///< registered to colour; 0: none
  MeshState truth;     ///< optical frame, that of the world if the camera moves; confidence 1 seen, 0 hidden
  Eigen::Isometry3d T_camera_body;
  std::optional<Eigen::Isometry3d> T_camera_tool;
  std::optional<Eigen::Isometry3d> T_world_camera;  ///< of a camera that moves
};

/// A seeded RGB-D camera before a scene: the same seed, scene and frame give the same bytes.
class VirtualCamera {
 public:
  VirtualCamera(Scene scene, const Pinhole& camera, const NoiseOptions& noise, std::uint64_t seed);

  /// @param frame picks the noise. @param t time of the scene [s].
  Capture capture(int frame, double t);

  const Pinhole& pinhole() const { return camera_; }
  const Scene& scene() const { return scene_; }
  /// The soft body at rest; revision 0 is vertex by vertex the input mesh.
  const MeshTopology& topology(std::uint32_t revision) const { return topologies_.at(revision); }

 private:
  int imagesAt(double t, const SceneState& state) const;  ///< that motion blur takes
  cv::Mat3b blurredColor(double t, int images);

  Scene scene_;
  Pinhole camera_;
  std::vector<MeshTopology> topologies_;  ///< by revision
  std::vector<Renderer> renderers_;       ///< likewise
  MotionBlurOptions blur_;
  ExposureDrift exposure_drift_;
  ColorNoise color_noise_;
  DepthNoise depth_noise_;
  RenderedImage image_;
};

}  // namespace softbody::virtual_camera
