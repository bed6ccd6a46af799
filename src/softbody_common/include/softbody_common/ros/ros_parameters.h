#pragma once

#include <ros/node_handle.h>

#include "softbody_common/parameters.h"

namespace softbody {

/// A snapshot of a node's private parameters.
Parameters readParameters(const ros::NodeHandle& private_handle);

/// Logs a warning for every private parameter that nobody has asked for.
void warnUnknown(const Parameters& parameters);

}  // namespace softbody
