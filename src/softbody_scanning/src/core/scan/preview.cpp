#include "scan/preview.h"

#include "scan/single_scan.h"

namespace softbody::scanning {

RegisteredSurface previewOf(PosedRecording recording) {
  constexpr std::size_t kFrames = 24;
  constexpr double kVoxel_m = 3e-3;
  std::vector<KeyFrame> some;
  const std::size_t count = recording.frames.size();
  for (std::size_t i = 0; i < std::min(count, kFrames); ++i)
    some.push_back(recording.frames[count <= kFrames ? i : i * count / kFrames]);
  recording.frames = std::move(some);
  return surfaceOfScan(prepareScan(recording), kVoxel_m);
}

}  // namespace softbody::scanning
