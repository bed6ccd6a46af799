#include "softbody_tracking/tracker/body_tracker.h"

#include <iostream>

#include "frames.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/object/object_model.h"

/// The tracker makes targets from each frame and the last state; the simulator follows them.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  softbody::BodyTracker tracker({});
  tracker.setTopologies(model.volume, model.visual);
  softbody::Simulator simulator(model.volume, model.material, {});
  softbody::virtual_camera::VirtualCamera camera = cameraOf("bend", argv[2]);
  softbody::StageTimer timer;
  softbody::TrackingResult result;
  for (int k = 0; k < 10; ++k) {
    const softbody::RgbdFrame frame = frameOf(&camera, k);
    result = tracker.track(frame, simulator.placed() ? &simulator.state() : nullptr, &timer);
    if (result.has_targets) simulator.step(result.targets, frame.stamp);
  }
  std::cout << result.targets.targets.size() << " targets, " << result.features.size() << " features\n";
  return result.status.state == softbody::TrackingState::kTracking ? 0 : 1;
}
