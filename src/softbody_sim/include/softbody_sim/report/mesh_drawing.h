#pragma once

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_sim/surface_mesh/cut_lines.h"

/// Pictures of meshes, drawn without a display.
namespace softbody {

/// From where a picture is taken.
struct View {
  Eigen::Isometry3d T_camera_mesh = Eigen::Isometry3d::Identity();
  Pinhole camera;
};

/// From the front, the left and above (z points up), such that the points just fit into a picture.
View viewOf(const Points& points, const cv::Size& size);

/// What is drawn of a mesh. Colours are BGR, 0 to 255.
struct MeshPaint {
  std::vector<cv::Vec3d> colors;  ///< #F, or one for all
  bool edges = false;             ///< of the triangles
  Edges lines;                    ///< that are drawn upon the surface
  cv::Vec3d line_color = cv::Vec3d(40.0, 20.0, 230.0);
};

/// The mesh on white, in the size of the view's camera. Faces that look away are drawn too, darker.
cv::Mat3b drawMesh(const Points& vertices, const Triangles& triangles, const MeshPaint& paint,
                   const View& view);

}  // namespace softbody
