#include "ros/result_reader.h"

#include <fmt/format.h>
#include <geometry_msgs/PolygonStamped.h>
#include <geometry_msgs/PoseStamped.h>
#include <geometry_msgs/PoseWithCovarianceStamped.h>
#include <rosbag/bag.h>
#include <rosbag/view.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/TrackingStatus.h>

#include "softbody_common/protocol/tracking_state.h"
#include "softbody_common/ros/conversions.h"
#include "softbody_recordings/ros/input_bag.h"

namespace softbody::evaluation {

ToolRecord readPoses(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  ToolRecord record;
  const auto add = [&record](const std_msgs::Header& header, const geometry_msgs::Pose& pose) {
    record.frame_id = header.frame_id;
    record.poses[toNanoseconds(header.stamp)] = fromMessage(pose);
  };
  for (const rosbag::MessageInstance& instance : view) {
    if (const auto pose = instance.instantiate<geometry_msgs::PoseStamped>()) {
      add(pose->header, pose->pose);
    } else if (const auto uncertain = instance.instantiate<geometry_msgs::PoseWithCovarianceStamped>()) {
      add(uncertain->header, uncertain->pose.pose);
    } else {
      throw std::invalid_argument(
          fmt::format("{}: {} is of type {} instead of geometry_msgs/PoseWithCovarianceStamped", path, topic,
                      instance.getDataType()));
    }
  }
  return record;
}

std::map<Nanoseconds, Points> readBlades(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::map<Nanoseconds, Points> blades;
  for (const rosbag::MessageInstance& instance : view) {
    if (const auto message = instance.instantiate<geometry_msgs::PolygonStamped>())
      blades[toNanoseconds(message->header.stamp)] = fromMessage(message->polygon);
  }
  return blades;
}

StageTimes readStageTimes(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  StageTimes times;
  for (const rosbag::MessageInstance& instance : view) {
    const auto timing = instance.instantiate<softbody_msgs::StageTiming>();
    if (!timing) continue;
    for (const softbody_msgs::StageTime& row : timing->stages) {
      times[{timing->node, row.stage, row.initialization != 0}].push_back(row.milliseconds);
    }
  }
  return times;
}

std::vector<StatusRecord> readStatuses(const std::string& path, const std::string& topic) {
  const rosbag::Bag bag = openBag(path);
  rosbag::View view(bag, rosbag::TopicQuery(topic));
  std::vector<StatusRecord> statuses;
  for (const rosbag::MessageInstance& instance : view) {
    const auto status = instance.instantiate<softbody_msgs::TrackingStatus>();
    if (!status || status->state > softbody_msgs::TrackingStatus::RECOVERING)
      throw std::invalid_argument(fmt::format(
          "{}: {} is not of type softbody_msgs/TrackingStatus, or has an unknown state", path, topic));
    // The status comes again while no image comes: only the first one of a stamp is that of the frame.
    const Nanoseconds stamp = toNanoseconds(status->header.stamp);
    if (stamp == 0 || (!statuses.empty() && statuses.back().stamp == stamp)) continue;
    statuses.push_back({stamp, static_cast<TrackingState>(status->state), posesAlike(status->reason)});
  }
  return statuses;
}

}  // namespace softbody::evaluation
