#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_virtual_camera/rendering/corner_shading.h"
#include "softbody_virtual_camera/rendering/visibility_buffer.h"
#include "softbody_virtual_camera/scenes/scene.h"
#include "softbody_virtual_camera/textures/baked_texture.h"

namespace softbody::virtual_camera {

/// An image to draw over.
struct Canvas {
  cv::Mat3b color;      ///< r, g, b
  cv::Mat1f fine;       ///< inverse z [1/m] at the samples of colour, 2 by 2 per pixel; 0: nothing
  cv::Mat1f inverse_z;  ///< at the pixels' centres [1/m]; 0: nothing
};

/// An empty, dark image.
Canvas emptyCanvas(const Pinhole& camera);

/// Actors that are drawn together over a background. Only the part of the image that they cover takes time.
class Layer {
 public:
  explicit Layer(const Pinhole& camera) : camera_(camera) {}
  /// @param label of its pixels, as in pixel_labels.h.
  void add(const Actor& actor, std::uint8_t label);

  /// @param vertices of the actors, in the order of add(), in the camera's frame [m].
  void place(const std::vector<const Points*>& vertices, const Lights& lights);

  /// Draws the placed actors. @param color gets the size of the canvas.
  void drawColor(const Canvas& behind, cv::Mat3b* color);
  void drawDepth(const Canvas& behind, cv::Mat1f* inverse_z);

  /// The labels of the last depth; background where the layer is not seen.
  void drawLabels(cv::Mat1b* labels) const;

  /// Draws colour and depth.
  Canvas draw(const Canvas& behind);

  /// Visibility of `count` vertices from `first` on, in the last depth: 1 if a triangle at the vertex faces
  /// the camera and nothing is in front of it, otherwise 0.
  std::vector<float> visibility(int first, int count, const cv::Mat1f& inverse_z) const;

 private:
  cv::v_float32x4 colorAt(const PixelWeights& triangle, float u, float v) const;
  void prefetch(int u, int v) const;
  cv::Vec3b pixelColor(const cv::Vec3b& behind, int u, int v) const;

  Pinhole camera_;
  Triangles triangles_;               ///< of all actors
  std::vector<char> one_sided_;       ///< per triangle: of a closed surface
  std::vector<std::uint8_t> labels_;  ///< per triangle
  CornerShading shading_;
  BakedTexture texture_;
  Points vertices_;  ///< of all actors
  Projection projection_;
  VisibilityBuffer color_samples_, depth_samples_;
};

}  // namespace softbody::virtual_camera
