#include "softbody_sim/ros/force_messages.h"

#include <algorithm>

#include "softbody_common/ros/geometry_messages.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

constexpr double kMetresPerNewton = 0.1;  // a hand's few newtons are as long as the body
constexpr double kUsualModulus = 2e4;     // [Pa]

template <typename Matrix, typename Array>
void copyRowByRow(const Matrix& matrix, Array* array) {
  const Eigen::Index size = matrix.rows();
  for (Eigen::Index k = 0; k < size * size; ++k)
    (*array)[static_cast<std::size_t>(k)] = matrix(k / size, k % size);
}

}  // namespace

softbody_msgs::Forces toMessage(const ForceEstimate& estimate, const std::string& wrench_frame) {
  softbody_msgs::Forces message;
  message.in_newtons = estimate.in_newtons;
  for (const ForcePatch& patch : estimate.patches) {
    softbody_msgs::PatchForce force;
    force.place = pointMessage(patch.place);
    force.normal = vectorMessage(patch.normal);
    force.force = vectorMessage(patch.force);
    copyRowByRow(patch.covariance, &force.covariance);
    message.patches.push_back(force);
  }
  message.wrench.force = vectorMessage(estimate.wrench.head<3>());
  message.wrench.torque = vectorMessage(estimate.wrench.tail<3>());
  copyRowByRow(estimate.wrench_covariance, &message.wrench_covariance);
  message.wrench_frame = wrench_frame;
  return message;
}

geometry_msgs::WrenchStamped toMessage(const NamedReaction& reaction, const std::string& target_frame) {
  geometry_msgs::WrenchStamped message;
  message.header.frame_id = reaction.frame.empty() ? target_frame : reaction.frame;
  message.wrench.force = vectorMessage(reaction.wrench.force);
  message.wrench.torque = vectorMessage(reaction.wrench.torque);
  return message;
}

visualization_msgs::MarkerArray makeForceMarkers(const softbody_msgs::Forces& forces) {
  visualization_msgs::MarkerArray array;
  array.markers.resize(1);
  array.markers[0].header = forces.header;
  array.markers[0].action = visualization_msgs::Marker::DELETEALL;
  const double scale = kMetresPerNewton * (forces.in_newtons ? 1.0 : kUsualModulus);
  for (const softbody_msgs::PatchForce& patch : forces.patches) {
    visualization_msgs::Marker arrow;
    arrow.header = forces.header;
    arrow.ns = "forces";
    arrow.id = static_cast<int>(array.markers.size());
    arrow.type = visualization_msgs::Marker::ARROW;
    arrow.pose.orientation.w = 1.0;
    arrow.scale.x = 0.004;
    arrow.scale.y = 0.01;
    arrow.color = colorMessage({0.9f, 0.1f, 0.1f});
    geometry_msgs::Point start = patch.place;
    start.x -= scale * patch.force.x;
    start.y -= scale * patch.force.y;
    start.z -= scale * patch.force.z;
    arrow.points = {start, patch.place};
    array.markers.push_back(arrow);
  }
  return array;
}

}  // namespace softbody
