#include "fuzz/messages/target.h"

namespace softbody::fuzz {

const std::vector<TargetKind>& targetKinds() {
  constexpr std::size_t kLong = 50'000;
  static const std::vector<TargetKind> kinds{
      {"camera_ingest", makeCameraTarget, kLong},
      {"camera_ingest_compressed", makeCompressedCameraTarget, kLong},
      {"feature_tracker", makeTrackerTarget, kLong},
      {"feature_tracker_placed", makePlacedTrackerTarget, kLong},
      {"tool_tracker", makeToolTarget, kLong},
      {"pose_marker", makeMarkerTarget, 500},
      {"simulator", makeSimulatorTarget, kLong},
      {"simulator_alone", makeLoneSimulatorTarget, kLong},
      {"surface", makeSurfaceTarget, kLong},
      {"transforms", makeTransformTarget, kLong},
      {"injector", makeInjectorTarget, kLong},
      {"scanner", makeScannerTarget, kLong},
      {"recorder", makeRecorderTarget, kLong},
      {"model_server", makeModelServerTarget, kLong},
      {"rviz", makeDisplayTarget, kLong},
      {"recordings", makeRecordingTarget, kLong},
  };
  return kinds;
}

}  // namespace softbody::fuzz
