#include "softbody_tracking/ros/node_options.h"

#include <tuple>

#include "softbody_common/ros/frame_name.h"

namespace softbody {
namespace {

ParameterTable<OutputFrameOptions> outputFrameTable(const std::string& group, const std::string& meaning,
                                                    const std::string& also_waits = "") {
  ParameterTable<OutputFrameOptions> table;
  table.group(group);
  ParameterDescription& frame = table.text("output_frame", &OutputFrameOptions::name, meaning);
  frame.initial = "(colour optical frame)";
  frame.allowed = "tf frame";
  table.number("tf_timeout_s", &OutputFrameOptions::timeout_s, {0.0, 5.0}, "s",
               "how long a frame waits for the camera's pose in `output_frame`" + also_waits);
  return table;
}

ParameterTable<RobotOptions> robotTable() {
  ParameterTable<RobotOptions> table;
  table.group("known surfaces");
  table.text("robot", &RobotOptions::description, "name of the parameter with the URDF");
  table.number("robot_deviation_m", &RobotOptions::deviation_m, {0.0, 0.1}, "m",
               "standard deviation of a link's place: joints, and the camera's calibration");
  return table;
}

ParameterTable<MaskOptions> maskTable() {
  ParameterTable<MaskOptions> table;
  table.group("depth");
  table.flag("use_mask", &MaskOptions::use, "wait for `mask`");
  table.number("mask_timeout_s", &MaskOptions::timeout_s, {0.0, 5.0}, "s",
               "how long a frame waits for its mask");
  return table;
}

ParameterTable<CameraIngestOptions> makeCameraIngestNodeTable() {
  using Options = CameraIngestOptions;
  constexpr double kLongestUnit_m = 1.0;  // no camera measures in larger ones
  ParameterTable<Options> table;
  table.group("camera_ingest");
  table.part(&Options::pairing, pairingParameters());
  table.number("silence_timeout_s", &Options::silence_timeout_s, {0.1, 3600.0}, "s",
               "time without a frame before the node says so; more for a camera that starts late");
  table.number("depth_scale", &Options::depth_scale, {0.0, kLongestUnit_m}, "m",
               "metres of one unit of depth; 0: 0.001 for 16UC1, 1 for 32FC1");
  table.part(&Options::ingest, cameraIngestParameters());
  table.number("voxel_size_m", &Options::voxel_size_m, {0.0, 1.0}, "m",
               "thins `points`; 0: one point per pixel", Change::kLive);
  for (const auto& [name, member, stream] :
       {std::tuple("color_transport", &Options::color_transport, "colour"),
        std::tuple("depth_transport", &Options::depth_transport, "depth")}) {
    ParameterDescription& row = table.text(name, member,
                                           std::string("transport of ") + stream +
                                               "; compressed and compressedDepth are decoded here. auto: raw "
                                               "if somebody publishes raw images, or else what is published");
    row.allowed = "auto, raw, compressed, compressedDepth, any installed";
  }
  return table;
}

ParameterTable<FeatureTrackerOptions> makeFeatureTrackerNodeTable() {
  using Options = FeatureTrackerOptions;
  ParameterTable<Options> table;
  table.part(
      &Options::output_frame,
      outputFrameTable("prediction", "frame of targets and states. For a moving camera: a fixed frame"));
  table.part(&Options::tracker, trackerParameters());
  table.group("registration");
  table.text("object", &Options::object, "the object YAML, as for the simulator: only its picture is read");
  table.flag("allow_outside", &Options::allow_outside,
             "it may name [files in other folders](../reference.md#files-in-other-folders)");
  table.group("prediction");
  table.text("body_frame", &Options::body_frame, "child frame of the body's pose on /tf").initial =
      ownFrameText("softbody");
  table.part(&Options::mask, maskTable());
  table.group("known surfaces");
  table.texts("known_surfaces", &Options::known_surfaces,
              "namespaces of the surfaces of other tracked bodies, e.g. `[/cup/surface]`");
  table.part(&Options::robot, robotTable());
  return table;
}

ParameterTable<ToolTrackerOptions> makeToolTrackerNodeTable() {
  using Options = ToolTrackerOptions;
  ParameterTable<Options> table;
  table.group("tool_tracker");
  table.requiredText("tool", &Options::tool, "tool YAML");
  table.flag("allow_outside", &Options::allow_outside,
             "the tool YAML may name [a file in another folder](../reference.md#files-in-other-folders)");
  table
      .text("blade_frame", &Options::blade_frame,
            "frame of tf that carries the tool, in place of its markers")
      .allowed = "tf frame";
  table.text("tool_frame", &Options::tool_frame, "child frame on /tf").initial = ownFrameText("tool");
  table.part(&Options::tracker, toolTrackerParameters());
  table.part(&Options::output_frame,
             outputFrameTable("tool_tracker", "frame in which the motion is predicted",
                              ", and for the tool's frame"));
  return table;
}

ParameterTable<PoseMarkerOptions> makePoseMarkerNodeTable() {
  ParameterTable<PoseMarkerOptions> table;
  table.group("pose_marker");
  table.text("frame", &PoseMarkerOptions::frame, "frame of the marker").initial = "that of the images";
  return table;
}

}  // namespace

const ParameterTable<CameraIngestOptions>& cameraIngestNodeParameters() {
  static const ParameterTable<CameraIngestOptions> table = makeCameraIngestNodeTable();
  return table;
}

const ParameterTable<FeatureTrackerOptions>& featureTrackerNodeParameters() {
  static const ParameterTable<FeatureTrackerOptions> table = makeFeatureTrackerNodeTable();
  return table;
}

const ParameterTable<ToolTrackerOptions>& toolTrackerNodeParameters() {
  static const ParameterTable<ToolTrackerOptions> table = makeToolTrackerNodeTable();
  return table;
}

const ParameterTable<PoseMarkerOptions>& poseMarkerNodeParameters() {
  static const ParameterTable<PoseMarkerOptions> table = makePoseMarkerNodeTable();
  return table;
}

}  // namespace softbody
