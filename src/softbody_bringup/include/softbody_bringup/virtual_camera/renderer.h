#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_bringup/virtual_camera/layer.h"

namespace softbody::virtual_camera {

struct RenderedImage {
  cv::Mat3b color;                ///< r, g, b; anti-aliased by 2 by 2 samples a pixel
  cv::Mat1f depth;                ///< z of the nearest surface at the pixel's centre [m]; 0: nothing
  std::vector<float> visibility;  ///< per vertex of the first actor: 1 seen, 0 hidden
};

/// Renders a scene on the CPU: solid textures baked once, diffuse light, z-buffer. Actors that stand still
/// are drawn once; only where the others are, a frame is drawn anew.
class Renderer {
 public:
  Renderer(const Scene& scene, const Pinhole& camera);

  /// @param vertices one entry an actor, in the camera's frame [m]; those of still actors are not looked at.
  void render(const std::vector<Points>& vertices, RenderedImage* image);
  /// One half of it each.
  void renderColor(const std::vector<Points>& vertices, cv::Mat3b* color);
  void renderDepth(const std::vector<Points>& vertices, RenderedImage* image);

 private:
  void place(const std::vector<Points>& vertices);
  void drawDepth(RenderedImage* image);

  Eigen::Vector3d to_light_;
  int body_vertices_ = 0;
  std::vector<char> still_;  ///< per actor
  Layer moving_;
  Canvas backdrop_;  ///< the still actors
  cv::Mat1f inverse_z_;
};

}  // namespace softbody::virtual_camera
