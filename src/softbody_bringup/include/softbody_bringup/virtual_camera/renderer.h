#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_bringup/virtual_camera/baked_texture.h"
#include "softbody_bringup/virtual_camera/scene.h"
#include "softbody_bringup/virtual_camera/visibility_buffer.h"
#include "softbody_common/pinhole.h"

namespace softbody::virtual_camera {

struct RenderedImage {
  cv::Mat3b color;                ///< r, g, b; anti-aliased by 2 by 2 samples a pixel
  cv::Mat1f depth;                ///< z of the nearest surface at the pixel's centre [m]; 0: nothing
  std::vector<float> visibility;  ///< per vertex of the first actor: 1 seen, 0 hidden
};

/// Renders a scene on the CPU: solid textures baked once, diffuse light, z-buffer.
class Renderer {
 public:
  Renderer(const Scene& scene, const Pinhole& camera);

  /// @param vertices one entry an actor, in the camera's frame [m].
  void render(const std::vector<Points>& vertices, RenderedImage* image);
  void renderColor(const std::vector<Points>& vertices, cv::Mat3b* color);

 private:
  void gather(const std::vector<Points>& vertices);
  cv::Vec3f colorAt(int triangle, double u, double v) const;
  cv::Vec3f pixelColor(int u, int v) const;
  void shade(cv::Mat3b* color) const;

  Pinhole camera_;
  Eigen::Vector3d to_light_;
  int body_vertices_ = 0;
  Triangles triangles_;                             ///< of all actors
  std::vector<std::vector<int>> smooth_neighbors_;  ///< per corner (3 f + k): triangles that share its normal
  BakedTexture texture_;
  Points vertices_;  ///< of all actors
  std::vector<ProjectedTriangle> projected_;
  std::vector<float> brightness_;  ///< per corner, 0..1
  VisibilityBuffer color_samples_, depth_samples_;
};

}  // namespace softbody::virtual_camera
