#include "nodes/feature_tracker/robot_links.h"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <stdexcept>
#include <utility>

#include "softbody_tracking/ros/robot_reader.h"

namespace softbody {
namespace {

// [s] A robot's joints are sent at 10 Hz or more.
constexpr double kOldestPose_s = 0.5;

}  // namespace

RobotLinks::RobotLinks(RobotDescription robot, double deviation_m, const OutputFrame* frame)
    : robot_(std::move(robot)), deviation_m_(deviation_m), frame_(frame) {}

std::vector<KnownSurface> RobotLinks::at(const RgbdFrame& frame, const std_msgs::Header& header) {
  return robotSurfaces(
      robot_, [&](const std::string& link) { return poseOf(link, frame, header); }, deviation_m_);
}

std::optional<Eigen::Isometry3d> RobotLinks::poseOf(const std::string& link, const RgbdFrame& frame,
                                                    const std_msgs::Header& header) try {
  std_msgs::Header source = header;
  source.frame_id = link;
  return frame.T_fixed_camera.inverse() * frame_->newestPoseOf(source, header.frame_id, kOldestPose_s);
} catch (const tf2::TransformException& error) {
  if (absent_.insert(link).second)
    ROS_WARN_STREAM("the robot's link "
                    << link << " is left out while tf does not say where it is: " << error.what());
  return std::nullopt;
}

std::unique_ptr<RobotLinks> makeRobotLinks(const ros::NodeHandle& handle, const RobotOptions& options,
                                           const OutputFrame* frame) {
  const std::string& name = options.description;
  if (name.empty()) return nullptr;
  std::string place, urdf;
  if (!handle.searchParam(name, place) || !handle.getParam(place, urdf))
    throw std::invalid_argument(fmt::format(
        "parameter robot: there is no parameter {} with a URDF; load the robot's description first, "
        "as its own launch file does",
        name));
  RobotDescription robot = readRobot(urdf, "/");
  for (const std::string& warning : robot.warnings)
    ROS_WARN_STREAM("robot " << robot.name << ": " << warning);
  ROS_INFO_STREAM("robot " << robot.name << ": " << robot.links.size() << " links are known surfaces");
  return std::make_unique<RobotLinks>(std::move(robot), options.deviation_m, frame);
}

}  // namespace softbody
