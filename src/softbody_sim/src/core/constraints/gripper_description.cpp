#include "softbody_sim/constraints/gripper_description.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <sstream>
#include <stdexcept>
#include <string>

namespace softbody {
namespace {

const std::vector<double> kBox = {-0.02, -0.05, -0.03, 0.02, 0.05, 0.03};  // [m]
constexpr double kLargestFinger = 1.0;                                     // [m]
constexpr double kRounding = 0.1;  // of the smallest edge: sharp edges would catch single vertices

Eigen::Vector3d readFingerSize(Parameters& parameters) {
  const std::vector<double> sizes = parameters.numbers("gripper_finger_size", {0.02, 0.01, 0.06});
  const Eigen::Vector3d size(sizes.data());
  if (size.minCoeff() <= 0.0 || size.maxCoeff() > kLargestFinger) {
    throw std::invalid_argument(fmt::format("gripper_finger_size is [{}]; allowed: above 0, up to {}",
                                            fmt::join(sizes, ", "), kLargestFinger));
  }
  return size;
}

}  // namespace

std::optional<PinRegion> readGripper(Parameters& parameters, std::vector<ObstacleDescription>* obstacles) {
  PinRegion gripper{"gripper", parameters.text("gripper_frame", ""), {}, {}, true};
  const std::vector<double> box = parameters.numbers("gripper_box", kBox);
  gripper.min = Eigen::Vector3d(&box[0]);
  gripper.max = Eigen::Vector3d(&box[3]);
  const Eigen::Vector3d size = readFingerSize(parameters);
  std::istringstream fingers(parameters.text("gripper_fingers", ""));
  if (gripper.frame.empty()) return {};
  if ((gripper.max - gripper.min).minCoeff() <= 0.0) {
    throw std::invalid_argument(fmt::format(
        "gripper_box is [{}]; each of the first three numbers must be below its partner of the last three",
        fmt::join(box, ", ")));
  }
  int number = 0;
  for (std::string frame; fingers >> frame;) {
    obstacles->push_back({fmt::format("gripper_finger_{}", ++number), frame,
                          Obstacle::box(size, kRounding * size.minCoeff())});
  }
  return gripper;
}

}  // namespace softbody
