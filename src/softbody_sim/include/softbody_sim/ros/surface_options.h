#pragma once

#include <ros/ros.h>

#include <string>

#include "softbody_common/parameters/parameter_table.h"
#include "softbody_sim/cutting/cutting_config.h"

namespace softbody {

/// A longer latency means that the clock does not run with the stamps, as with a bag on the wall clock.
constexpr double kLongestLatency_s = 10.0;

/// Values above which the surface warns.
struct SurfaceLimits {
  double latency_s = 0.5;     ///< from the image's stamp to the mesh
  double deviation_m = 0.02;  ///< mean standard deviation of the vertices
};

/// The surface node's parameters.
struct SurfaceOptions {
  std::string object;          ///< path of the object YAML
  bool allow_outside = false;  ///< files that the object YAML names may be outside of its folder
  std::string body_frame;
  std::string save_folder = ".";
  CuttingConfig cutting;
  SurfaceLimits limits;
};

const ParameterTable<SurfaceOptions>& surfaceNodeParameters();

/// Warns of unknown keys. @throw std::invalid_argument as Parameters does.
SurfaceOptions readSurfaceOptions(const ros::NodeHandle& private_node);

}  // namespace softbody
