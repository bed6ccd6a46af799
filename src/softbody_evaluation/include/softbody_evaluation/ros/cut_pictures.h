#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "softbody_evaluation/ros/bags.h"

/// Pictures of cut bodies, drawn without a display.
namespace softbody::evaluation {

/// As in Kang et al. 2022, figure 10, one below the other: the body as it was, where the cuts run (red), the
/// cut body as it was last seen, without and with the faces that fill its cuts.
/// @throw std::invalid_argument if the body was not cut.
cv::Mat3b drawCutModels(const SurfaceRecord& result);

/// As in Kang et al. 2022, figure 11: the camera's images with mesh and blade, above the mesh alone, before
/// the first cut, in the midst of the cuts, after the last one and at the end.
class CutStrip {
 public:
  /// @param blades in the camera's frame, by stamp.
  /// @throw std::invalid_argument if the body was not cut.
  CutStrip(const SurfaceRecord& result, std::map<Nanoseconds, Points> blades);

  /// Every frame of the recording, in order.
  void add(const RecordedFrame& frame);
  /// @throw std::invalid_argument if a frame that is to be shown has not come.
  cv::Mat3b picture() const;

 private:
  const SurfaceRecord& result_;
  std::map<Nanoseconds, Points> blades_;
  std::vector<Nanoseconds> shown_;
  std::vector<cv::Mat3b> images_, meshes_;
};

}  // namespace softbody::evaluation
