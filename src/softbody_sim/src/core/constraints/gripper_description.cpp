#include "softbody_sim/constraints/gripper_description.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_common/topics.h"

namespace softbody {
namespace {

constexpr double kLargestFinger = 1.0;  // [m]
constexpr double kRounding = 0.1;       // of the smallest edge: sharp edges would catch single vertices

/// What describes a gripper, as its YAML and the parameters say it.
struct GripperWords {
  std::string frame, fingers;  ///< fingers: frames, separated by spaces
  std::vector<double> box = {-0.02, -0.05, -0.03, 0.02, 0.05, 0.03}, finger_size = {0.02, 0.01, 0.06};
  std::string closed = topics::kGripperClosed;
};

bool isYaml(const std::string& name) {
  const auto extension = std::filesystem::path(name).extension();
  return extension == ".yaml" || extension == ".yml";
}

/// @param prefix of the keys in messages.
void check(const GripperWords& words, const std::string& prefix) {
  const Eigen::Map<const Eigen::Matrix<double, 3, 2>> box(words.box.data());
  if ((box.col(1) - box.col(0)).minCoeff() <= 0.0) {
    throw std::invalid_argument(fmt::format(
        "{}box is [{}]; each of the first three numbers must be below its partner of the last three", prefix,
        fmt::join(words.box, ", ")));
  }
  const Eigen::Map<const Eigen::Vector3d> size(words.finger_size.data());
  if (size.minCoeff() <= 0.0 || size.maxCoeff() > kLargestFinger) {
    throw std::invalid_argument(fmt::format("{}finger_size is [{}]; allowed: above 0, up to {}", prefix,
                                            fmt::join(words.finger_size, ", "), kLargestFinger));
  }
}

GripperWords readFile(const std::string& path, std::vector<std::string>* unknown) {
  YamlMapReader file(parseYamlFile(path), path, "");
  const std::string prefix = path + ": gripper/";
  Parameters gripper(file.get("gripper"), prefix);
  GripperWords words;
  words.frame = gripper.requiredText("frame");
  words.fingers = fmt::format("{}", fmt::join(gripper.texts("fingers"), " "));
  words.box = gripper.numbers("box", words.box);
  words.finger_size = gripper.numbers("finger_size", words.finger_size);
  words.closed = gripper.text("closed", words.closed);
  check(words, prefix);
  for (const std::string& key : gripper.unknown()) unknown->push_back(key);
  return words;
}

/// `gripper` names a file or a frame. The other parameters replace what it says.
GripperWords readWords(Parameters& parameters, std::vector<std::string>* unknown) {
  const std::string gripper = parameters.text("gripper", "");
  GripperWords words = isYaml(gripper) ? readFile(gripper, unknown) : GripperWords{gripper, ""};
  words.frame = parameters.text("gripper_frame", words.frame);
  words.fingers = parameters.text("gripper_fingers", words.fingers);
  words.box = parameters.numbers("gripper_box", words.box);
  words.finger_size = parameters.numbers("gripper_finger_size", words.finger_size);
  words.closed = parameters.text("gripper_closed", words.closed);
  check(words, "gripper_");
  return words;
}

}  // namespace

std::optional<GripperDescription> readGripper(Parameters& parameters, std::vector<std::string>* unknown) {
  const GripperWords words = readWords(parameters, unknown);
  if (words.frame.empty()) return {};
  GripperDescription gripper;
  gripper.space = {"gripper", words.frame, Eigen::Vector3d(&words.box[0]), Eigen::Vector3d(&words.box[3]),
                   true};
  gripper.closed = words.closed;
  const Eigen::Vector3d size(words.finger_size.data());
  const Obstacle finger = Obstacle::box(size, kRounding * size.minCoeff());
  std::istringstream frames(words.fingers);
  for (std::string frame; frames >> frame;)
    gripper.fingers.push_back({fmt::format("gripper_finger_{}", gripper.fingers.size() + 1), frame, finger});
  return gripper;
}

}  // namespace softbody
