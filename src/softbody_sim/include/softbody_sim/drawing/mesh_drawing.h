#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/geometry/pinhole.h"
#include "softbody_sim/surface_mesh/cut_lines.h"

/// Pictures of meshes, drawn without a display.
namespace softbody {

/// Pose and intrinsics of the camera of a picture.
struct View {
  Eigen::Isometry3d T_camera_mesh = Eigen::Isometry3d::Identity();
  Pinhole camera;
};

/// A view from the front left and above (z points up) in which the points fill the picture.
View viewOf(const Points& points, const cv::Size& size);

/// Colours (BGR, 0 to 255) and lines of a drawn mesh.
struct MeshPaint {
  std::vector<cv::Vec3d> colors;  ///< one per triangle, or one for all
  bool edges = false;             ///< whether to draw the edges of the triangles
  Edges lines;                    ///< drawn on the surface
  cv::Vec3d line_color = cv::Vec3d(40.0, 20.0, 230.0);
};

/// The mesh on a white background, in the size of the view's camera. Back faces are drawn darker.
cv::Mat3b drawMesh(const Points& vertices, const Triangles& triangles, const MeshPaint& paint,
                   const View& view);

}  // namespace softbody
