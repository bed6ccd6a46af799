#pragma once

#include <geometry_msgs/Polygon.h>
#include <geometry_msgs/Pose.h>
#include <sensor_msgs/CameraInfo.h>
#include <softbody_msgs/MeshState.h>
#include <softbody_msgs/MeshTopology.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/Targets.h>
#include <softbody_msgs/TetTopology.h>
#include <softbody_msgs/TrackingStatus.h>

#include <string>
#include <vector>

#include "softbody_common/pinhole.h"
#include "softbody_common/ros/time.h"
#include "softbody_common/stage_timer.h"
#include "softbody_common/types.h"

/// Conversions between the core's structs and softbody_msgs. fromMessage throws std::invalid_argument with
/// field and index if array sizes, indices or numbers are not valid. The caller sets and reads the
/// headers.
namespace softbody {

geometry_msgs::Point pointMessage(const Eigen::Vector3d& point);
geometry_msgs::Pose toMessage(const Eigen::Isometry3d& pose);
/// @throw std::invalid_argument if the quaternion is not of unit length (within 1e-3) or a number is not
/// finite.
Eigen::Isometry3d fromMessage(const geometry_msgs::Pose& pose);

/// Corners, #P by 3.
Points fromMessage(const geometry_msgs::Polygon& polygon);

softbody_msgs::TetTopology toMessage(const TetTopology& topology);
TetTopology fromMessage(const softbody_msgs::TetTopology& message);

softbody_msgs::MeshTopology toMessage(const MeshTopology& topology);
MeshTopology fromMessage(const softbody_msgs::MeshTopology& message);

softbody_msgs::MeshState toMessage(const MeshState& state);
MeshState fromMessage(const softbody_msgs::MeshState& message);

softbody_msgs::Targets toMessage(const TargetSet& targets);
/// Does not check tet indices, because the topology is not known here; the simulator checks them.
TargetSet fromMessage(const softbody_msgs::Targets& message);

softbody_msgs::TrackingStatus toMessage(const TrackingStatus& status);

/// The times of a node's stages for one stamp.
softbody_msgs::StageTiming timingMessage(const std::string& node, const std::vector<StageTime>& stages);

/// The camera of the projection matrix P, or of K if P is zero.
/// @throw std::invalid_argument if fx or fy <= 0.
Pinhole pinholeFromMessage(const sensor_msgs::CameraInfo& info);
/// A CameraInfo without distortion.
sensor_msgs::CameraInfo toMessage(const Pinhole& camera);

}  // namespace softbody
