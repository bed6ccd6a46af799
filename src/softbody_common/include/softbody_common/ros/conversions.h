#pragma once

#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>
#include <softbody_msgs/TrackingStatus.h>

#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_common/ros/geometry_messages.h"
#include "softbody_common/ros/time.h"
#include "softbody_common/time/stage_timer.h"

/// Conversions between the core's structs and softbody_msgs. fromMessage throws std::invalid_argument with
/// field and index if array sizes, indices or numbers are not valid. The caller sets and reads the
/// headers.
namespace softbody {

softbody_msgs::TetTopology toMessage(const TetTopology& topology);
TetTopology fromMessage(const softbody_msgs::TetTopology& message);

softbody_msgs::MeshTopology toMessage(const MeshTopology& topology);
MeshTopology fromMessage(const softbody_msgs::MeshTopology& message);

/// Whether two topologies are the same but for header and initial pose. Topologies are sent again every
/// second: a message that is known, or equals one, need not be converted. A message is equal to itself at no
/// cost.
bool sameTopology(const softbody_msgs::TetTopology& a, const softbody_msgs::TetTopology& b);
bool sameTopology(const softbody_msgs::MeshTopology& a, const softbody_msgs::MeshTopology& b);

softbody_msgs::MeshState toMessage(const MeshState& state);
MeshState fromMessage(const softbody_msgs::MeshState& message);
/// Stamp of the last image that went into a state; without one, the stamp of the state. States without images
/// run ahead of the next image, so that only this stamp shows how time goes.
/// @throw std::invalid_argument if the two stamps do not fit together.
ros::Time stampOfImage(const softbody_msgs::MeshState& message);

softbody_msgs::Targets toMessage(const TargetSet& targets);
/// Does not check tet indices, because the topology is not known here; the simulator checks them.
TargetSet fromMessage(const softbody_msgs::Targets& message);

softbody_msgs::TrackingStatus toMessage(const TrackingStatus& status);

/// The times of a node's stages for one stamp.
softbody_msgs::StageTiming timingMessage(const std::string& node, const std::vector<StageTime>& stages);

}  // namespace softbody
