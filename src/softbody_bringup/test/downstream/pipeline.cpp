#include "softbody_recordings/pipeline/pipeline.h"

#include <iostream>

#include "frames.h"

/// Tracks a body through all stages, and compares its surface with the truth.
int main(int, char** argv) {
  const softbody::ObjectModel model = softbody::buildObjectModel(softbody::loadObjectDescription(argv[1]));
  softbody::Pipeline pipeline(model, {});
  softbody::virtual_camera::VirtualCamera camera = cameraOf("bend", argv[2]);
  softbody::FrameOutput output;
  const int last = 20;
  for (int k = 0; k <= last; ++k) output = pipeline.process(frameOf(&camera, k));
  if (!output.surface) return 1;
  const softbody::Points error = output.surface->vertices - camera.capture(last, last / 30.0).truth.vertices;
  std::cout << "mean error " << 1000.0 * error.rowwise().norm().mean() << " mm\n";
  return 0;
}
