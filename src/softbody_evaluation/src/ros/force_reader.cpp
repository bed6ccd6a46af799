#include "ros/force_reader.h"

#include <fmt/format.h>
#include <rosbag/view.h>
#include <softbody_msgs/Forces.h>

#include <map>
#include <stdexcept>

#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/input_bag.h"
#include "softbody_recordings/ros/typed_message.h"

namespace softbody::evaluation {
namespace {

using Messages = std::map<ros::Time, softbody_msgs::ForcesConstPtr>;

Messages readForces(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  Messages messages;
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instantiate<softbody_msgs::Forces>(instance, bag);
    messages[message->header.stamp] = message;
  }
  return messages;
}

std::vector<ForcePatch> patchesOf(const softbody_msgs::Forces& message) {
  std::vector<ForcePatch> patches;
  for (const softbody_msgs::PatchForce& patch : message.patches) {
    patches.push_back({{patch.place.x, patch.place.y, patch.place.z},
                       {patch.normal.x, patch.normal.y, patch.normal.z},
                       {patch.force.x, patch.force.y, patch.force.z},
                       Eigen::Map<const Eigen::Matrix3d>(patch.covariance.data())});
  }
  return patches;
}

}  // namespace

std::optional<ForceReport> compareForces(const std::string& result, const std::string& result_topic,
                                         const std::string& truth, const std::string& truth_topic) {
  const Messages found = readForces(result, result_topic), expected = readForces(truth, truth_topic);
  ForceAgreement agreement;
  for (const auto& [stamp, message] : found) {
    const auto other = expected.find(stamp);
    if (other == expected.end() || !message->in_newtons) continue;
    if (message->header.frame_id != other->second->header.frame_id) {
      throw std::invalid_argument(fmt::format("{}: forces on {} are in frame {}, the truth in {}", result,
                                              result_topic, message->header.frame_id,
                                              other->second->header.frame_id));
    }
    agreement.add(patchesOf(*other->second), patchesOf(*message));
  }
  return agreement.report();
}

}  // namespace softbody::evaluation
