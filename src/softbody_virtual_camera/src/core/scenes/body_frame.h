#pragma once

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// The frame of the scenes: the body is 200 mm long along x, and its bounding box is centred at the origin.
/// Other bodies are turned and scaled into this frame, and the scene is scaled back, so all bodies have the
/// same size in the image.
struct BodyFrame {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a permutation of the axes
  Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< in the body's own frame [m]
  double scale = 1.0;                                  ///< the body's length / 200 mm
};

/// The longest side of the bounding box becomes x. z stays up, unless it is the longest.
/// @throw std::invalid_argument if the body is shorter than 50 mm or longer than 2 m.
BodyFrame frameOf(const Points& rest);

/// Points (rows) of the body's frame in the scene's frame.
Points toSceneFrame(const BodyFrame& frame, const Points& points);

/// A scene in the body's coordinates and true size.
Scene toBodyFrame(const BodyFrame& frame, const Scene& scene, const TriangleMesh& body);

}  // namespace softbody::virtual_camera
