#include "softbody_recordings/ros/graph_config.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_common/parameters/parameters.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/ros/simulator_options.h"
#include "softbody_sim/ros/surface_options.h"
#include "softbody_tracking/ros/node_options.h"

namespace softbody {
namespace {

const std::array<std::string, 6> kNodes{"camera_ingest", "feature_tracker", "pose_marker",
                                        "simulator",     "surface",         "tool_tracker"};

YAML::Node sectionsOf(const std::string& path) {
  YAML::Node file = parseYamlFile(path);
  if (!file.IsMap())
    throw std::invalid_argument(path + ": must be a map with a section of parameters for each node");
  for (const auto& section : file) {
    const std::string name = YamlMapReader::shown(section.first);
    if (std::find(kNodes.begin(), kNodes.end(), name) != kNodes.end()) continue;
    throw std::invalid_argument(fmt::format("{}:{}: '{}' is not a node; allowed sections: {}", path,
                                            section.first.Mark().line + 1, name, fmt::join(kNodes, ", ")));
  }
  return file;
}

/// Parameters of the live graph, in the section of one node.
struct Known {
  std::vector<ParameterDescription> parameters;
  std::vector<std::string> missed;  ///< keys that change the result of the live graph, but not of a replay
};

/// Reads one section. Warns about unknown keys, and about keys that a replay misses.
template <typename Reader>
auto readSection(const YAML::Node& file, const std::string& name, const Known& known,
                 std::vector<std::string>* warnings, Reader reader) {
  const YAML::Node section = file[name].IsDefined() ? file[name] : YAML::Node();
  Parameters parameters(section, name + "/");
  auto config = reader(parameters);
  for (const std::string& key : parameters.unknown()) {
    const bool is_known = std::any_of(known.parameters.begin(), known.parameters.end(),
                                      [&](const auto& p) { return key == name + "/" + p.name; });
    if (!is_known) warnings->push_back(fmt::format("unknown parameter {} is ignored", key));
  }
  for (const std::string& key : known.missed)
    if (section.IsMap() && section[key].IsDefined())
      warnings->push_back(fmt::format("parameter {}/{} has no effect in a replay", name, key));
  return config;
}

SurroundingsConfig readSurroundings(Parameters& parameters, std::vector<std::string>* warnings) {
  SurroundingsConfig config = surroundingsParameters().read(parameters);
  for (const std::string& key : config.unknown)
    warnings->push_back(fmt::format("unknown parameter {} is ignored", key));
  for (ObstacleDescription& obstacle : config.obstacles) obstacle.frame = withoutSlash(obstacle.frame);
  if (!config.gripper) return config;
  config.gripper->frame = withoutSlash(config.gripper->frame);
  config.gripper_closed = "/" + withoutSlash(config.gripper_closed);
  return config;
}

}  // namespace

GraphConfig readGraphConfig(const std::string& path, std::vector<std::string>* warnings,
                            const std::string& gripper) {
  YAML::Node file = path.empty() ? YAML::Node(YAML::NodeType::Map) : sectionsOf(path);
  if (!gripper.empty() && !file["simulator"].IsScalar()) file["simulator"]["gripper"] = gripper;
  const auto read = [&](const std::string& name, const Known& known, auto reader) {
    return readSection(file, name, known, warnings, reader);
  };
  GraphConfig config;
  const CameraIngestOptions ingest =
      read("camera_ingest", {}, [](Parameters& given) { return cameraIngestNodeParameters().read(given); });
  config.pairing = ingest.pairing;
  config.ingest = ingest.ingest;
  config.depth_scale = ingest.depth_scale;
  const FeatureTrackerOptions tracker =
      read("feature_tracker", {{}, {"known_surfaces", "robot", "use_mask"}},
           [](Parameters& given) { return featureTrackerNodeParameters().read(given); });
  config.pipeline.tracker = tracker.tracker;
  config.output_frame = tracker.output_frame.name;
  config.robot_deviation_m = tracker.robot.deviation_m;
  read("pose_marker", {}, [](Parameters& given) { return poseMarkerNodeParameters().read(given); });
  config.pipeline.simulator =
      read("simulator", {simulatorNodeParameters().describe(), {"wrench_frame"}}, [&](Parameters& given) {
        config.pipeline.material = materialParameters().read(given);
        config.pipeline.surroundings = readSurroundings(given, warnings);
        return simulatorParameters().read(given);
      });
  config.pipeline.cutting = read("surface", {surfaceNodeParameters().describe(), {}},
                                 [](Parameters& given) { return cuttingParameters().read(given); });
  config.pipeline.tool_tracker =
      read("tool_tracker", {toolTrackerNodeParameters().describe(), {}}, [&](Parameters& given) {
        config.blade_frame = given.text("blade_frame", "");
        return toolTrackerParameters().read(given);
      });
  return config;
}

}  // namespace softbody
