#pragma once

#include <opencv2/core.hpp>
#include <set>
#include <vector>

#include "softbody_evaluation/records/recorded_frame.h"
#include "softbody_evaluation/records/surface_record.h"

namespace softbody::evaluation {

/// Images with the result's mesh over them, of up to `count` frames at equal intervals.
class Overlays {
 public:
  /// @param result in the camera's frame; must outlive the overlays.
  Overlays(const SurfaceRecord& result, int count);

  /// Draws the frame if it is one of the chosen frames. @param number of the frame in the recording.
  void add(const RecordedFrame& frame, int number);

  /// The overlays on one picture; empty if none was drawn.
  cv::Mat3b sheet() const;

 private:
  const SurfaceRecord& result_;
  std::set<Nanoseconds> chosen_;
  cv::Rect view_;  ///< part of the image that is shown
  std::vector<cv::Mat3b> pictures_;
};

}  // namespace softbody::evaluation
