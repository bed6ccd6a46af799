#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "softbody_bringup/evaluation/depth_residual.h"
#include "softbody_bringup/evaluation/vertex_error.h"
#include "softbody_bringup/evaluation/volume.h"

namespace softbody::evaluation {

/// What was asked and what came.
struct FrameCount {
  std::size_t expected = 0;  ///< frames of the truth or the recording
  std::size_t answered = 0;  ///< of these: with a surface of the same stamp
};

struct Report {
  FrameCount frames;
  std::optional<VertexErrorReport> vertex_error;
  std::optional<ResidualReport> residual;        ///< over all frames
  std::vector<ResidualReport> residual_windows;  ///< every so many frames
  VolumeReport volume;
};

/// Lengths in millimetres, shares 0..1; the names carry the units.
nlohmann::json toJson(const Report& report);

/// A table for people.
std::string toText(const Report& report);

}  // namespace softbody::evaluation
