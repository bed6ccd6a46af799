#include "softbody_bringup/graph_config.h"

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <array>
#include <stdexcept>

#include "softbody_common/parameters.h"
#include "softbody_common/yaml_map_reader.h"

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
    throw std::invalid_argument(
        fmt::format("{}:{}: '{}' is no node; parameters stand in the section of their node: {}", path,
                    section.first.Mark().line + 1, name, fmt::join(kNodes, ", ")));
  }
  return file;
}

/// Reads one section; says which of its keys nobody knows.
template <typename Reader>
auto readSection(const YAML::Node& file, const std::string& name, std::vector<std::string>* warnings,
                 Reader reader) {
  const YAML::Node section = file[name];
  Parameters parameters(section.IsDefined() ? section : YAML::Node(), name + "/");
  const auto config = reader(parameters);
  for (const std::string& key : parameters.unknown())
    warnings->push_back(fmt::format("unknown parameter {} is ignored", key));
  return config;
}

}  // namespace

GraphConfig readGraphConfig(const std::string& path, std::vector<std::string>* warnings) {
  const YAML::Node file = path.empty() ? YAML::Node(YAML::NodeType::Map) : sectionsOf(path);
  GraphConfig config;
  config.ingest = readSection(file, "camera_ingest", warnings, [&config](Parameters& parameters) {
    config.sync_tolerance = static_cast<Nanoseconds>(
        1e9 *
        parameters.number("sync_tolerance_s", 1e-9 * static_cast<double>(config.sync_tolerance), 0.0, 1.0));
    if (parameters.choice("sync", "approximate", {"approximate", "exact"}) == "exact")
      config.sync_tolerance = 0;
    for (const char* live_only : {"queue_size", "voxel_size_m", "silence_timeout_s"})
      parameters.number(live_only, 0.0, 0.0, 1e9);
    return readCameraIngestConfig(parameters);
  });
  config.pipeline.tracker = readSection(file, "feature_tracker", warnings, [](Parameters& parameters) {
    for (const char* live_only : {"body_frame", "output_frame"}) parameters.text(live_only, "");
    return readTrackerConfig(parameters);
  });
  config.pipeline.simulator = readSection(file, "simulator", warnings, [](Parameters& parameters) {
    for (const char* live_only : {"body_frame", "object"}) parameters.text(live_only, "");
    for (const char* live_only : {"free_run_rate_hz", "stall_timeout_s"})
      parameters.number(live_only, 0.0, 0.0, 1e9);
    return readSimulatorConfig(parameters);
  });
  config.pipeline.blade = readSection(file, "surface", warnings, [](Parameters& parameters) {
    for (const char* live_only : {"body_frame", "object"}) parameters.text(live_only, "");
    return readBladeConfig(parameters);
  });
  config.pipeline.tool_tracker = readSection(file, "tool_tracker", warnings, [](Parameters& parameters) {
    for (const char* live_only : {"tool", "tool_frame"}) parameters.text(live_only, "");
    return readToolTrackerConfig(parameters);
  });
  return config;
}

}  // namespace softbody
