#pragma once

#include <ros/node_handle.h>

#include "softbody_common/parameters.h"

namespace softbody {

/// The current private parameters of a node.
Parameters readParameters(const ros::NodeHandle& private_handle);

/// Logs a warning for every private parameter that was never read.
void warnUnknown(const Parameters& parameters);

}  // namespace softbody
