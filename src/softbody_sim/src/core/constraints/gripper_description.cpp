#include "softbody_sim/constraints/gripper_description.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_common/protocol/topics.h"

namespace softbody {
namespace {

constexpr double kLargestFinger = 1.0;  // [m]
constexpr double kRounding = 0.1;       // of the smallest edge: sharp edges would catch single vertices

/// Fills the space between the fingers: lowest, then highest x, y, z [m].
void readBox(Parameters& gripper, const std::string& prefix, PinRegion* space) {
  const std::vector<double> box = gripper.numbers("box", {-0.02, -0.05, -0.03, 0.02, 0.05, 0.03});
  space->min = Eigen::Vector3d(box.data());
  space->max = Eigen::Vector3d(box.data() + 3);
  if ((space->max - space->min).minCoeff() > 0.0) return;
  throw std::invalid_argument(fmt::format(
      "{}box is [{}]; each of the first three numbers must be below its partner of the last three", prefix,
      fmt::join(box, ", ")));
}

Obstacle readFinger(Parameters& gripper, const std::string& prefix) {
  const std::vector<double> size = gripper.numbers("finger_size", {0.02, 0.01, 0.06});
  const auto [smallest, largest] = std::minmax_element(size.begin(), size.end());
  if (!(*smallest > 0.0 && *largest <= kLargestFinger)) {
    throw std::invalid_argument(fmt::format("{}finger_size is [{}]; allowed: above 0, up to {}", prefix,
                                            fmt::join(size, ", "), kLargestFinger));
  }
  return Obstacle::box(Eigen::Vector3d(size.data()), kRounding * *smallest);
}

GripperDescription readGripper(Parameters gripper, const std::string& prefix,
                               std::vector<std::string>* unknown) {
  GripperDescription description;
  description.space.name = "gripper";
  description.space.in_frame = true;
  description.space.frame = gripper.requiredText("frame");
  readBox(gripper, prefix, &description.space);
  const Obstacle finger = readFinger(gripper, prefix);
  for (const std::string& frame : gripper.texts("fingers")) {
    const std::size_t number = description.fingers.size() + 1;
    description.fingers.push_back({fmt::format("gripper_finger_{}", number), frame, finger});
  }
  description.closed = gripper.text("closed", topics::kGripperClosed);
  for (const std::string& key : gripper.unknown()) unknown->push_back(key);
  return description;
}

}  // namespace

std::optional<GripperDescription> readGripper(const std::string& gripper, std::vector<std::string>* unknown) {
  if (gripper.empty()) return {};
  const auto extension = std::filesystem::path(gripper).extension();
  if (extension != ".yaml" && extension != ".yml") {
    YAML::Node frame;
    frame["frame"] = gripper;
    return readGripper(Parameters(frame), "", unknown);
  }
  YamlMapReader file(parseYamlFile(gripper), gripper, "");
  const std::string prefix = gripper + ": gripper/";
  return readGripper(Parameters(file.get("gripper"), prefix), prefix, unknown);
}

}  // namespace softbody
