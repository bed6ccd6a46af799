#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_virtual_camera/rendering/layer.h"

namespace softbody::virtual_camera {

struct RenderedImage {
  cv::Mat3b color;                       ///< r, g, b; anti-aliased by 2 by 2 samples per pixel
  cv::Mat1f depth;                       ///< z of the nearest surface at the pixel's centre [m]; 0: nothing
  cv::Mat1b labels;                      ///< of the same surface, as in pixel_labels.h; nothing: background
  std::vector<float> visibility;         ///< per vertex of the first actor; 1: visible, 0: hidden
  std::vector<float> second_visibility;  ///< of the second body's vertices; empty without one
};

/// Renders a scene on the CPU with baked textures, diffuse light and a z-buffer. Still actors are drawn once;
/// each frame redraws only the regions of the moving actors.
class Renderer {
 public:
  Renderer(const Scene& scene, const Pinhole& camera);

  /// Ignores the vertices of still actors and the light on them.
  void render(const SceneState& state, RenderedImage* image);
  /// Only colour, or only depth, labels and visibility.
  void renderColor(const SceneState& state, cv::Mat3b* color);
  void renderDepth(const SceneState& state, RenderedImage* image);

 private:
  void place(const SceneState& state);
  void drawDepth(RenderedImage* image);

  int body_vertices_ = 0, second_first_ = 0, second_vertices_ = 0;
  std::vector<char> still_;  ///< per actor
  Layer moving_;
  Canvas backdrop_;  ///< the still actors
  cv::Mat1f inverse_z_;
};

}  // namespace softbody::virtual_camera
