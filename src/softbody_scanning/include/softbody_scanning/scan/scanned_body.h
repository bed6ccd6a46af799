#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "softbody_common/geometry/types.h"
#include "softbody_scanning/key_frames/key_frame.h"
#include "softbody_scanning/registration/surface_registration.h"

namespace softbody::scanning {

/// One recording of the object as it stands on a table. Its model frame: z up, the table at z = 0.
struct PosedRecording {
  std::string name;
  std::vector<KeyFrame> frames;
  Eigen::AlignedBox3d region;  ///< where the object is, model frame [m]
  /// On the object or in it, model frame [m]: of several things this one. Nothing: see scanBody().
  std::optional<Eigen::Vector3d> at = std::nullopt;
};

struct ScanSettings {
  double voxel_m = 0.0;  ///< 0: 1 mm, or 1/200 of a larger object
  std::function<void(const std::string& step)> progress = [](const std::string&) {};
};

/// How a further recording, of the object turned over, lies on the first one.
struct TurnedRecording {
  std::string name;
  Registration registration;
};

/// Whether a vertex counts as seen. @param agreement how far the views agree on the surface there, 0..1
inline bool isSeen(float agreement) { return agreement >= 0.5f; }

/// The object's surface in the model frame of the first recording.
struct ScannedBody {
  TriangleMesh mesh;             ///< closed
  std::vector<float> seen;       ///< #V, 0..1: how far the views agree on the surface there; see isSeen()
  std::vector<KeyFrame> frames;  ///< of all recordings, in this model frame
  std::vector<TurnedRecording> turned;
  double voxel_m = 0.0;
  double depth_std_m = 0.0;  ///< of one pixel at the object, measured
};

/// Fuses the recordings and takes the object out: what stands on the table at the chosen point. Without such
/// a point, what is large and near to the middle. The underside of a single recording is closed flat. @throw
/// std::invalid_argument with the recording, what is missing and what to do: no depth, no object, none at the
/// point, one that is larger than the region, recordings that do not fit together.
ScannedBody scanBody(std::vector<PosedRecording> recordings, const ScanSettings& settings);

}  // namespace softbody::scanning
