#include "softbody_tracking/tool/tool_tracker.h"

#include <iostream>

#include "frames.h"

/// Finds the knife by its marker, and says whether its blade may cut.
int main(int, char** argv) {
  const std::string config = argv[2];
  softbody::virtual_camera::VirtualCamera camera = cameraOf("cut", config);
  softbody::ToolTracker tracker(softbody::loadToolDescription(config + "/knife.yaml"));
  std::optional<softbody::ToolObservation> tool;
  for (int k = 60; k < 66; ++k) tool = tracker.track(frameOf(&camera, k), nullptr);
  if (!tool) return 1;
  std::cout << "the knife is at " << tool->T_camera_tool.translation().transpose() << " m; "
            << (tool->cuts ? "it may cut" : tracker.reason()) << '\n';
  return tool->markers > 0 ? 0 : 1;
}
