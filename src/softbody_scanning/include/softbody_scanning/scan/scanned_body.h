#pragma once

#include <functional>
#include <string>
#include <vector>

#include "softbody_common/types.h"
#include "softbody_scanning/key_frames/key_frame.h"

namespace softbody::scanning {

/// What a scan looks at and how finely.
struct ScanSettings {
  Eigen::AlignedBox3d region;  ///< where the object is, model frame [m]; its floor is the table
  double voxel_m = 0.0;        ///< 0: 1 mm, or 1/200 of a larger object
  std::function<void(const std::string& step)> progress = [](const std::string&) {};
};

/// The object's surface in the model frame.
struct ScannedBody {
  TriangleMesh mesh;        ///< closed
  std::vector<float> seen;  ///< #V, 0..1: share of the surface around the vertex that was measured
  double voxel_m = 0.0;
  double depth_std_m = 0.0;  ///< of one pixel at the object, measured
};

/// Fuses the frames and takes the object out: what stands on the table nearest to the middle.
/// @throw std::invalid_argument with what is missing and what to do: no depth, no object, one that is larger
/// than the region.
ScannedBody scanBody(const std::vector<KeyFrame>& frames, const ScanSettings& settings);

}  // namespace softbody::scanning
