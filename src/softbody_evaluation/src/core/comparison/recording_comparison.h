#pragma once

#include <set>
#include <vector>

#include "comparison/film_maker.h"
#include "records/recorded_frame.h"
#include "report/pictures.h"
#include "softbody_common/images/rasterizer.h"
#include "softbody_evaluation/comparison/evaluator_options.h"
#include "softbody_evaluation/measures/depth_residual.h"
#include "softbody_evaluation/records/surface_record.h"
#include "softbody_evaluation/report/report.h"

namespace softbody::evaluation {

/// Compares a result with its recording, frame by frame: depth residuals, silhouettes, a film.
class RecordingComparison {
 public:
  /// @param result, truth in the camera's frame; both must outlive the comparison. The truth may be null:
  /// then silhouettes are compared with the measured depth.
  RecordingComparison(const EvaluatorOptions& options, const SurfaceRecord& result,
                      const SurfaceRecord* truth);

  /// Takes the next frame of the recording.
  /// @throw std::invalid_argument if the frame is not in the result's coordinate frame.
  void add(const RecordedFrame& frame);

  /// Adds the measures and the pictures.
  void finish(Report* report, Pictures* pictures) const;
  const Film& film() const { return film_.film(); }

 private:
  void requireFrame(const RecordedFrame& frame) const;
  void addSilhouette(const RecordedFrame& frame);
  bool drawTruth(const RecordedFrame& frame);

  const EvaluatorOptions& options_;
  const SurfaceRecord& result_;
  const SurfaceRecord* truth_;
  std::set<Nanoseconds> stamps_;  ///< of all images
  RasterImage raster_, truth_raster_;
  std::size_t answered_ = 0;
  std::vector<FrameResidual> residuals_;  ///< per frame; empty without an answer or without depth
  std::vector<double> silhouettes_, silhouette_times_;
  FilmMaker film_;
};

}  // namespace softbody::evaluation
