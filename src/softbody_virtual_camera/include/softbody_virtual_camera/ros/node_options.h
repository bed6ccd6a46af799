#pragma once

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

namespace softbody::virtual_camera {

/// The parameters of the virtual camera as a node.
struct NodeOptions {
  CameraSetup setup;
  bool noise = true;              ///< false: setup has no noise
  bool loop = true;               ///< repeats the scene
  bool publish_camera_tf = true;  ///< from camera_link to the optical frame
  double hold_s = 2.0;            ///< time at rest before the scene begins
};

const ParameterTable<NodeOptions>& nodeParameters();

}  // namespace softbody::virtual_camera
