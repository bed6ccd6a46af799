#include <CLI/CLI.hpp>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/injection/injector_options.h"
#include "softbody_scanning/ros/scanner_options.h"
#include "softbody_sim/ros/simulator_options.h"
#include "softbody_sim/ros/surface_options.h"
#include "softbody_tracking/ros/node_options.h"
#include "softbody_virtual_camera/ros/node_options.h"

namespace {

using softbody::ParameterDescription;
using Tables = std::map<std::string, std::vector<ParameterDescription>>;

Tables tablesOfNodes() {
  return {{"camera_ingest", softbody::cameraIngestNodeParameters().describe()},
          {"feature_tracker", softbody::featureTrackerNodeParameters().describe()},
          {"tool_tracker", softbody::toolTrackerNodeParameters().describe()},
          {"pose_marker", softbody::poseMarkerNodeParameters().describe()},
          {"simulator", softbody::simulatorNodeParameters().describe()},
          {"surface", softbody::surfaceNodeParameters().describe()},
          {"injector", softbody::injection::injectorParameters().describe()},
          {"scanner", softbody::scanning::scannerParameters().describe()},
          {"virtual_camera", softbody::virtual_camera::nodeParameters().describe()}};
}

/// The same parameters, as the pages of the documentation group them.
Tables tablesOfGroups(const Tables& nodes) {
  Tables groups;
  for (const auto& node : nodes)
    for (const ParameterDescription& parameter : node.second) groups[parameter.group].push_back(parameter);
  return groups;
}

void print(const Tables& tables, const std::string& wanted) {
  for (const auto& [name, parameters] : tables)
    if (wanted.empty() || name == wanted)
      std::printf("## %s\n\n%s\n", name.c_str(), softbody::markdownTable(parameters).c_str());
}

}  // namespace

int main(int argc, char** argv) {
  const Tables nodes = tablesOfNodes();
  std::string node;
  bool groups = false;
  CLI::App app(
      "Prints the parameters of the nodes as Markdown: default, unit, range, whether they may change live");
  app.add_option("node", node, "only of this node")->check(CLI::IsMember(nodes));
  app.add_flag("--groups", groups, "in the groups of the documentation");
  return softbody::runTool(&app, argc, argv, [&] {
    print(groups ? tablesOfGroups(nodes) : nodes, node);
    return 0;
  });
}
