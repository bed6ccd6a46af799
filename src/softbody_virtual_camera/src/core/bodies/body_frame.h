#pragma once

#include "softbody_virtual_camera/scenes/scene.h"

namespace softbody::virtual_camera {

/// The frame in which the scenes are played: a body of 200 mm length along x, its bounding box centred at the
/// origin. The other bodies are turned and scaled into it, and the scene back out of it, so that all of them
/// look alike to the camera and only the depth tells their size.
struct BodyFrame {
  Eigen::Matrix3d turn = Eigen::Matrix3d::Identity();  ///< a permutation of the axes
  Eigen::Vector3d center = Eigen::Vector3d::Zero();    ///< in the body's own frame [m]
  double scale = 1.0;                                  ///< the body's length / 200 mm
};

/// The longest side of the bounding box becomes x; z stays up unless it is the longest.
/// @throw std::invalid_argument if the body is shorter than 50 mm or longer than 2 m.
BodyFrame frameOf(const Points& rest);

/// Rows of the body's own frame in the played one.
Points toPlayed(const BodyFrame& frame, const Points& own);

/// A scene that was played in the frame, with the body's own coordinates and the true sizes.
Scene toOwn(const BodyFrame& frame, const Scene& played, const TriangleMesh& body);

}  // namespace softbody::virtual_camera
