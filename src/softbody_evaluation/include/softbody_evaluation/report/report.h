#pragma once

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "softbody_evaluation/measures/absences.h"
#include "softbody_evaluation/measures/cut_surface.h"
#include "softbody_evaluation/measures/depth_residual.h"
#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/measures/silhouette.h"
#include "softbody_evaluation/measures/stage_times.h"
#include "softbody_evaluation/measures/steadiness.h"
#include "softbody_evaluation/measures/vertex_error.h"
#include "softbody_evaluation/measures/volume.h"

namespace softbody::evaluation {

/// What was asked and what came.
struct FrameCount {
  std::size_t expected = 0;  ///< frames of the truth or the recording
  std::size_t answered = 0;  ///< of these: with a surface of the same stamp
  std::optional<std::size_t>
      recorded;  ///< images in the recording, if there is one: some may have been dropped
};

/// The result's pieces against the true ones, from the first cut of either on.
struct PiecesReport {
  std::size_t frames = 0;       ///< answered ones since then
  double frames_right = 0.0;    ///< share of them with as many pieces as the truth, 0..1
  double vertices_right = 0.0;  ///< mean share of the vertices that are in the right piece, 0..1
  std::size_t result_pieces = 0, true_pieces = 0;  ///< in the last of them
};

struct Report {
  FrameCount frames;
  std::map<std::string, std::size_t> states;  ///< frames by the tracker's state, if the result says
  std::vector<std::string> notes;             ///< what was left out, in sentences
  std::optional<VertexErrorReport> vertex_error;
  std::optional<PiecesReport> pieces;
  std::optional<CutSurfaceReport> cut_surface;   ///< if the truth is cut
  std::vector<Absence> absences;                 ///< occlusions and times out of view, if the truth has any
  std::optional<JitterReport> jitter;            ///< where the truth is still, if it ever is
  std::optional<PoseErrorReport> tool;           ///< if the truth has a tool
  std::optional<SilhouetteReport> silhouette;    ///< if there is a recording
  std::map<StageName, Summary> stages;           ///< [ms], if the result has timing
  std::optional<ResidualReport> residual;        ///< over all frames
  std::vector<ResidualReport> residual_windows;  ///< every so many frames
  VolumeReport volume;
};

/// Lengths in millimetres, shares 0..1; the names carry the units.
nlohmann::json toJson(const Report& report);

/// A table for people.
std::string toText(const Report& report);

/// One number of a report.
struct Figure {
  std::string name, unit;
  double value = 0.0;
};

/// The numbers that results are compared by, in the order of the report.
std::vector<Figure> figures(const Report& report);

/// Rows of two results side by side: figure by figure, with the difference; those that only one has are left
/// blank.
struct ComparedFigure {
  std::string name, unit;
  std::optional<double> first, second;
};

std::vector<ComparedFigure> compare(const Report& first, const Report& second);
nlohmann::json toJson(const std::vector<ComparedFigure>& comparison);
std::string toText(const std::vector<ComparedFigure>& comparison);

}  // namespace softbody::evaluation
