#pragma once

#include <geometry_msgs/WrenchStamped.h>
#include <softbody_msgs/Forces.h>
#include <visualization_msgs/MarkerArray.h>

#include <string>

#include "softbody_sim/forces/force_estimate.h"
#include "softbody_sim/surroundings/named_surroundings.h"

namespace softbody {

/// The caller sets the header. @param wrench_frame in which the estimate's wrench is given.
softbody_msgs::Forces toMessage(const ForceEstimate& estimate, const std::string& wrench_frame);

/// The caller sets the stamp. @param target_frame of the targets, if the reaction follows no frame.
geometry_msgs::WrenchStamped toMessage(const NamedReaction& reaction, const std::string& target_frame);

/// An arrow for each patch, that ends at its place; 0.1 m are 1 N, or 1 N at E = 20 kPa if the stiffness is
/// not known. The first marker deletes earlier arrows. All have the header of the message.
visualization_msgs::MarkerArray makeForceMarkers(const softbody_msgs::Forces& forces);

}  // namespace softbody
