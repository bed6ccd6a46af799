#pragma once

#include <ros/node_handle.h>

#include "softbody_common/parameters/parameter_table.h"

namespace softbody {

/// The current private parameters of a node.
Parameters readParameters(const ros::NodeHandle& private_handle);

/// Logs a warning for every private parameter that was never read.
void warnUnknown(const Parameters& parameters);

/// The options that a node's private parameters give. Warns of unknown keys.
/// @throw std::invalid_argument as Parameters does.
template <typename Options>
Options readOptions(const ros::NodeHandle& private_handle, const ParameterTable<Options>& table) {
  Parameters given = readParameters(private_handle);
  Options options = table.read(given);
  warnUnknown(given);
  return options;
}

}  // namespace softbody
