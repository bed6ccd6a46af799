#include "softbody_sim/ros/surface_options.h"

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/ros_parameters.h"

namespace softbody {
namespace {

ParameterTable<SurfaceLimits> makeLimitsTable() {
  ParameterTable<SurfaceLimits> table;
  table.group("surface limits");
  table.number("latency_limit_s", &SurfaceLimits::latency_s, {0.0, kLongestLatency_s}, "s",
               "from the image's stamp to the mesh; a longer time is a warning", Change::kLive);
  table.number("deviation_limit_m", &SurfaceLimits::deviation_m, {0.0, 10.0}, "m",
               "mean standard deviation of the vertices; a larger one is a warning", Change::kLive);
  return table;
}

ParameterTable<SurfaceOptions> makeSurfaceNodeTable() {
  using Options = SurfaceOptions;
  ParameterTable<Options> table;
  table.group("surface");
  table.requiredText("object", &Options::object, "object YAML");
  table.flag("allow_outside", &Options::allow_outside,
             "the object YAML may name [files in other folders](../reference.md#files-in-other-folders)");
  table.text("body_frame", &Options::body_frame, "name of the rest frame, as that of the simulator").initial =
      ownFrameText("softbody");
  table.text("save_folder", &Options::save_folder, "where the service `surface/save_mesh` writes").initial =
      "the folder in which the node runs; with roslaunch `~/.ros`";
  table.part(&Options::cutting, cuttingParameters());
  table.part(&Options::limits, makeLimitsTable());
  return table;
}

}  // namespace

const ParameterTable<SurfaceOptions>& surfaceNodeParameters() {
  static const ParameterTable<SurfaceOptions> table = makeSurfaceNodeTable();
  return table;
}

SurfaceOptions readSurfaceOptions(const ros::NodeHandle& private_node) {
  SurfaceOptions options = readOptions(private_node, surfaceNodeParameters());
  options.body_frame = ownFrame(options.body_frame, "body_frame", private_node, "softbody");
  return options;
}

}  // namespace softbody
