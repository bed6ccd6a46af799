#pragma once

#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// How a mesh is painted.
struct PaintConfig {
  double depth_tolerance_m = 0.006;  ///< measured depth that differs by more is of something else
  int largest_side_px = 4096;        ///< of the picture; if it would be larger, its texels become larger
};

/// A mesh and its picture.
struct PaintedMesh {
  TriangleMesh mesh;
  Points texture_coordinates;  ///< 3 #F rows (u, v, 0), in the order of the triangles' corners
  cv::Mat3b picture;           ///< BGR
  std::vector<int> frame;      ///< #F: the frame that a triangle is painted from; -1: its neighbours' colours
};

/// Paints a mesh from the frames that saw it (Waechter, Moehrle and Goesele 2014, "Let there be color!"):
/// each triangle is painted from the frame that shows it largest and sharpest, unless the other frames agree
/// on another colour there. Neighbours take the same frame where they can. A texel is about a pixel of that
/// frame. Exposures are made equal first, and what is left at the seams is spread over the surface. Triangles
/// that no frame saw take the colour of the seen ones around them. @throw std::invalid_argument if no frame
/// sees any triangle.
PaintedMesh paintMesh(const TriangleMesh& mesh, const std::vector<KeyFrame>& frames,
                      const PaintConfig& config);

}  // namespace softbody::scanning
