#include "softbody_sim/constraints/gripper_description.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"

namespace softbody {
namespace {

constexpr double kLargestFinger = 1.0;  // [m]
constexpr double kRounding = 0.1;       // of the smallest edge: sharp edges would catch single vertices

bool isYaml(const std::string& name) {
  const auto extension = std::filesystem::path(name).extension();
  return extension == ".yaml" || extension == ".yml";
}

/// @param prefix of the keys in messages.
void requireUsable(const GripperWords& words, const std::string& prefix) {
  if ((words.box.tail<3>() - words.box.head<3>()).minCoeff() <= 0.0) {
    throw std::invalid_argument(fmt::format(
        "{}box is {}; each of the first three numbers must be below its partner of the last three", prefix,
        toText(std::vector<double>(words.box.begin(), words.box.end()))));
  }
  const Eigen::Vector3d& size = words.finger_size;
  if (size.minCoeff() <= 0.0 || size.maxCoeff() > kLargestFinger) {
    throw std::invalid_argument(fmt::format("{}finger_size is {}; allowed: above 0, up to {}", prefix,
                                            toText(std::vector<double>(size.begin(), size.end())),
                                            kLargestFinger));
  }
}

/// The keys in the YAML of a gripper.
ParameterTable<GripperWords> fileTable() {
  using Words = GripperWords;
  ParameterTable<Words> table;
  table.requiredText("frame", &Words::frame, "");
  table.other("fingers", "", "", "", [](Parameters& given, Words* words) {
    words->fingers = fmt::format("{}", fmt::join(given.texts("fingers"), " "));
  });
  table.numbers("box", &Words::box, "m", "", "");
  table.numbers("finger_size", &Words::finger_size, "m", "", "");
  table.text("closed", &Words::closed, "");
  return table;
}

GripperWords readGripperFile(const std::string& path) {
  YamlMapReader file(parseYamlFile(path), path, "");
  const std::string prefix = path + ": gripper/";
  Parameters gripper(file.get("gripper"), prefix);
  GripperWords words = fileTable().read(gripper);
  requireUsable(words, prefix);
  words.unknown = gripper.unknown();
  return words;
}

/// `gripper` names a file or a frame, and comes first: the other parameters replace what it says.
void readGripper(Parameters& given, GripperWords* words) {
  const std::string gripper = given.text("gripper", "");
  if (isYaml(gripper))
    *words = readGripperFile(gripper);
  else
    words->frame = gripper;
}

ParameterTable<GripperWords> makeGripperTable() {
  using Words = GripperWords;
  ParameterTable<Words> table;
  table.group("simulator");
  table.other("gripper", "(none)", "",
              "YAML of a [gripper](#gripper), or its tf frame. The parameters `gripper_...` replace what the "
              "YAML says",
              readGripper);
  table.text("gripper_frame", &Words::frame, "tf frame of the gripper").initial = "as `gripper` says";
  table.text("gripper_closed", &Words::closed, "topic (std_msgs/Bool): the gripper is closed");
  table.numbers("gripper_box", &Words::box, "m", "six numbers",
                "space between the fingers: lowest, then highest x, y, z in `gripper_frame`");
  table.text("gripper_fingers", &Words::fingers,
             "tf frames at the centres of the fingers, separated by spaces; each finger is an obstacle");
  table.numbers("gripper_finger_size", &Words::finger_size, "m", "above 0, up to 1",
                "size of a finger along x, y, z of its frame");
  table.check([](const Words& words) { requireUsable(words, "gripper_"); });
  return table;
}

}  // namespace

const ParameterTable<GripperWords>& gripperParameters() {
  static const ParameterTable<GripperWords> table = makeGripperTable();
  return table;
}

std::optional<GripperDescription> gripperOf(const GripperWords& words) {
  if (words.frame.empty()) return {};
  GripperDescription gripper;
  gripper.space = {"gripper", words.frame, words.box.head<3>(), words.box.tail<3>(), true};
  gripper.closed = words.closed;
  const Eigen::Vector3d& size = words.finger_size;
  const Obstacle finger = Obstacle::box(size, kRounding * size.minCoeff());
  std::istringstream frames(words.fingers);
  for (std::string frame; frames >> frame;)
    gripper.fingers.push_back({fmt::format("gripper_finger_{}", gripper.fingers.size() + 1), frame, finger});
  return gripper;
}

}  // namespace softbody
