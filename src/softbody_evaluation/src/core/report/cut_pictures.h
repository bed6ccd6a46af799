#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <vector>

#include "records/recorded_frame.h"
#include "softbody_evaluation/records/surface_record.h"

/// Pictures of cut bodies, drawn without a display.
namespace softbody::evaluation {

/// Four pictures below each other, as in Kang et al. 2022, figure 10: the body before the cuts; the lines of
/// the cuts (red); the cut body at the end, without and with the faces that fill the cuts.
/// @throw std::invalid_argument if the body was not cut.
cv::Mat3b drawCutModels(const SurfaceRecord& result);

/// The course of the cuts, as in Kang et al. 2022, figure 11: camera images with mesh and blade above the
/// mesh alone. The frames shown are before the first cut, in the middle, after the last cut and at the end.
class CutStrip {
 public:
  /// @param result must outlive the strip. @param blades in the camera's frame [m], by stamp.
  /// @throw std::invalid_argument if the body was not cut.
  CutStrip(const SurfaceRecord& result, std::map<Nanoseconds, Points> blades);

  /// Takes the next frame of the recording.
  void add(const RecordedFrame& frame);
  /// @throw std::invalid_argument if a frame to be shown was not added.
  cv::Mat3b picture() const;

 private:
  const SurfaceRecord& result_;
  std::map<Nanoseconds, Points> blades_;
  std::vector<Nanoseconds> shown_;
  std::vector<cv::Mat3b> images_, meshes_;
};

}  // namespace softbody::evaluation
