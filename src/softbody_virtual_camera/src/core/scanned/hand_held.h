#pragma once

#include <cstdint>

#include "softbody_common/geometry/types.h"

/// Where the camera is while it records a body at rest. World frame: z is up, the body lies at the origin.
namespace softbody::virtual_camera {

struct CameraWay {
  double duration_s = 20.0, distance_m = 0.45;
  Eigen::Vector3d target = Eigen::Vector3d::Zero();  ///< the body's middle [m]
  bool jerks = false;
  std::uint64_t seed = 0;  ///< of the tremor
};

/// Pose of the optical frame in the world. One round of 375 degrees, so the end repeats the beginning;
/// between 30 and 60 degrees above the table. The hand trembles by up to 2 mm and 0.5 degrees on each axis.
Eigen::Isometry3d walkingCamera(const CameraWay& way, double t);
/// The same round without tremor and jerks.
Eigen::Isometry3d steadyCamera(const CameraWay& way, double t);

/// A camera on a stand, 30 degrees above the table; it is lifted to 60 in the middle of the recording.
Eigen::Isometry3d standingCamera(const CameraWay& way, double t);

}  // namespace softbody::virtual_camera
