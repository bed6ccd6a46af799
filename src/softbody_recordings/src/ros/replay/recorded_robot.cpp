#include "ros/replay/recorded_robot.h"

#include <fmt/format.h>
#include <tf2/exceptions.h>

#include <filesystem>
#include <utility>

#include "softbody_common/files/input_file.h"
#include "softbody_tracking/ros/robot_reader.h"

namespace softbody {

RecordedRobot::RecordedRobot(const std::string& file, double deviation_m, Warn warn)
    : robot_(readRobot(readTextFile(file), std::filesystem::absolute(file).parent_path().string())),
      deviation_m_(deviation_m),
      warn_(std::move(warn)) {
  for (const std::string& warning : robot_.warnings) warn_(fmt::format("robot {}: {}", robot_.name, warning));
}

std::vector<KnownSurface> RecordedRobot::at(const std_msgs::Header& header, const BagTransforms& transforms) {
  const LinkPose pose = [&](const std::string& link) -> std::optional<Eigen::Isometry3d> {
    try {
      return transforms.at(header.frame_id, link, header.stamp);
    } catch (const tf2::TransformException& error) {
      if (absent_.insert(link).second)
        warn_(fmt::format("the robot's link {} is left out while tf does not say where it is: {}", link,
                          error.what()));
      return std::nullopt;
    }
  };
  return robotSurfaces(robot_, pose, deviation_m_);
}

}  // namespace softbody
