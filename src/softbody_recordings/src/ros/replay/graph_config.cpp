#include "softbody_recordings/ros/graph_config.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <set>
#include <stdexcept>

#include "softbody_common/files/yaml_map_reader.h"
#include "softbody_common/parameters.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_tracking/ros/camera_reader.h"
#include "softbody_tracking/ros/robot_reader.h"

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

/// The keys of a node's section that a replay does not read.
struct LiveOnly {
  std::set<std::string> unused;
  std::set<std::string> missed;  ///< keys that change the result of the live graph
};

/// Reads one section. Warns about unknown keys, and about keys without effect in a replay.
template <typename Reader>
auto readSection(const YAML::Node& file, const std::string& name, const LiveOnly& live,
                 std::vector<std::string>* warnings, Reader reader) {
  const YAML::Node section = file[name];
  Parameters parameters(section.IsDefined() ? section : YAML::Node(), name + "/");
  auto config = reader(parameters);
  for (const std::string& full_key : parameters.unknown()) {
    const std::string key = full_key.substr(name.size() + 1);
    if (live.unused.count(key) != 0) continue;
    warnings->push_back(live.missed.count(key) != 0
                            ? fmt::format("parameter {} has no effect in a replay", full_key)
                            : fmt::format("unknown parameter {} is ignored", full_key));
  }
  return config;
}

SurroundingsConfig readSurroundings(Parameters& parameters, const SimulatorConfig& simulator,
                                    std::vector<std::string>* warnings) {
  std::vector<std::string> unknown;
  SurroundingsConfig config = readSurroundingsConfig(parameters, simulator.target_accuracy_m, &unknown);
  for (const std::string& key : unknown)
    warnings->push_back(fmt::format("unknown parameter {} is ignored", key));
  for (ObstacleDescription& obstacle : config.obstacles) obstacle.frame = withoutSlash(obstacle.frame);
  if (!config.gripper) return config;
  config.gripper->frame = withoutSlash(config.gripper->frame);
  config.gripper_closed = "/" + withoutSlash(config.gripper_closed);
  return config;
}

void readToolTracker(const YAML::Node& file, std::vector<std::string>* warnings, GraphConfig* config) {
  const LiveOnly live{{"tool", "allow_outside", "tool_frame", "output_frame", "tf_timeout_s"}, {}};
  config->pipeline.tool_tracker =
      readSection(file, "tool_tracker", live, warnings, [config](Parameters& parameters) {
        config->blade_frame = parameters.text("blade_frame", "");
        return readToolTrackerConfig(parameters);
      });
}

}  // namespace

GraphConfig readGraphConfig(const std::string& path, std::vector<std::string>* warnings,
                            const std::map<std::string, std::string>& simulator) {
  YAML::Node file = path.empty() ? YAML::Node(YAML::NodeType::Map) : sectionsOf(path);
  for (const auto& [key, text] : simulator)
    if (!text.empty() && !file["simulator"].IsScalar()) file["simulator"][key] = text;
  GraphConfig config;
  config.ingest = readSection(
      file, "camera_ingest",
      {{"voxel_size_m", "silence_timeout_s", "image_transport", "color_transport", "depth_transport"}, {}},
      warnings, [&config](Parameters& parameters) {
        config.pairing = readPairingConfig(parameters);
        config.depth_scale = readDepthScale(parameters);
        return readCameraIngestConfig(parameters);
      });
  config.pipeline.tracker =
      readSection(file, "feature_tracker",
                  {{"body_frame", "object", "allow_outside", "mask_timeout_s", "tf_timeout_s"},
                   {"known_surfaces", "robot", "use_mask"}},
                  warnings, [&config](Parameters& parameters) {
                    config.output_frame = parameters.text("output_frame", "");
                    config.robot_deviation_m = readRobotDeviation(parameters);
                    return readTrackerConfig(parameters);
                  });
  readSection(file, "pose_marker", {{"frame"}, {}}, warnings, [](Parameters&) { return 0; });
  config.pipeline.simulator = readSection(
      file, "simulator",
      {{"body_frame", "object", "free_run_rate_hz", "stall_timeout_s", "allow_outside"}, {"wrench_frame"}},
      warnings, [&](Parameters& parameters) {
        const SimulatorConfig simulator_config = readSimulatorConfig(parameters);
        config.pipeline.surroundings = readSurroundings(parameters, simulator_config, warnings);
        return simulator_config;
      });
  config.pipeline.cutting = readSection(file, "surface", {{"body_frame", "object", "allow_outside"}, {}},
                                        warnings, readCuttingConfig);
  readToolTracker(file, warnings, &config);
  return config;
}

}  // namespace softbody
