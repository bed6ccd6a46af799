#pragma once

#include <map>
#include <opencv2/core.hpp>
#include <set>
#include <tuple>
#include <vector>

#include "measures/material_match.h"
#include "records/recorded_frame.h"
#include "report/film.h"
#include "softbody_evaluation/comparison/evaluator_options.h"
#include "softbody_evaluation/records/surface_record.h"

namespace softbody::evaluation {

/// Draws the result on frames at equal intervals. Draws nothing if no report is written.
class FilmMaker {
 public:
  /// @param result, truth in the camera's frame; must outlive the maker. The truth may be null: then the
  /// error is the distance from the measured depth.
  FilmMaker(const EvaluatorOptions& options, const SurfaceRecord& result, const SurfaceRecord* truth);

  /// Draws the frame if it is one of the chosen frames. @param number of the frame in the recording.
  /// @param rendered z of the result in the frame's camera [m].
  void add(const RecordedFrame& frame, int number, const cv::Mat1f& rendered);

  const Film& film() const { return film_; }
  /// Some of the overlays on one picture; empty if none was drawn.
  cv::Mat3b sheet() const;

 private:
  std::vector<float> errorsOf(const MeshState& state, const RecordedFrame& frame, const cv::Mat1f& rendered);

  const EvaluatorOptions& options_;
  const SurfaceRecord& result_;
  const SurfaceRecord* truth_;
  std::set<Nanoseconds> chosen_;
  cv::Rect view_;          ///< part of the image that is shown
  double radius_m_ = 0.0;  ///< of the body in the first chosen frame
  /// By material and both revisions.
  std::map<std::tuple<const MaterialMap*, std::uint32_t, std::uint32_t>, VertexMatches> matches_;
  Film film_;
};

}  // namespace softbody::evaluation
