#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "softbody_evaluation/measures/absences.h"
#include "softbody_evaluation/measures/calibration.h"
#include "softbody_evaluation/measures/cut_surface.h"
#include "softbody_evaluation/measures/depth_residual.h"
#include "softbody_evaluation/measures/force_agreement.h"
#include "softbody_evaluation/measures/label_agreement.h"
#include "softbody_evaluation/measures/pose_error.h"
#include "softbody_evaluation/measures/silhouette.h"
#include "softbody_evaluation/measures/stage_times.h"
#include "softbody_evaluation/measures/steadiness.h"
#include "softbody_evaluation/measures/surface_distance.h"
#include "softbody_evaluation/measures/vertex_error.h"
#include "softbody_evaluation/measures/volume.h"
#include "softbody_evaluation/report/alike_poses.h"

namespace softbody::evaluation {

/// How many frames have a result.
struct FrameCount {
  std::size_t expected = 0;             ///< frames of the truth or of the recording
  std::size_t answered = 0;             ///< of these: with a surface of the same stamp
  std::optional<std::size_t> recorded;  ///< images in the recording, without lost images
};

/// The result's pieces compared with the true pieces. Begins with the first cut of either of them.
struct PiecesReport {
  std::size_t frames = 0;       ///< answered frames since then
  double frames_right = 0.0;    ///< share of them with the true number of pieces, 0..1
  double vertices_right = 0.0;  ///< mean share of the vertices that are in the right piece, 0..1
  std::size_t result_pieces = 0, true_pieces = 0;  ///< in the last of these frames
  /// Delay of the last piece [s]: from the frame in which the truth gets its last number of pieces to that in
  /// which the result gets it. Negative: too early. Empty: the result does not have this number at the end.
  std::optional<double> delay_s;
};

/// Errors of the states at the end that were predicted without images [m].
struct OpenLoopReport {
  std::size_t frames = 0;
  double duration_s = 0.0;      ///< from the last image to the last state
  Summary all;                  ///< over all vertices
  double last_mean = kNothing;  ///< of the last frame
};

/// Everything that was measured of a result.
struct Report {
  FrameCount frames;
  std::map<std::string, std::size_t> states;    ///< frames by the tracker's state, if the result has states
  std::map<Nanoseconds, std::string> state_of;  ///< the first state of each stamp
  std::vector<std::string> frame_states;        ///< of the frames of vertex_error; empty text: unknown
  std::vector<std::string> notes;               ///< what was left out, in sentences
  std::optional<AlikePoses> alike;              ///< if the tracker said that poses look alike
  std::optional<VertexErrorReport> vertex_error;
  std::optional<OpenLoopReport> open_loop;  ///< if it is asked for; its frames are in no other measure
  std::optional<SurfaceDistanceReport> surface_distance;
  std::optional<CalibrationReport> calibration;  ///< if the result has standard deviations
  std::optional<PiecesReport> pieces;
  std::optional<CutSurfaceReport> cut_surface;   ///< if the truth is cut
  std::vector<Absence> absences;                 ///< occlusions and times out of view
  std::optional<JitterReport> jitter;            ///< while the truth is still
  std::optional<PoseErrorReport> tool;           ///< if the truth has a tool
  std::optional<LabelReport> labels;             ///< if result and truth have label images
  std::optional<ForceReport> forces;             ///< if result and truth have forces in newtons
  std::optional<SilhouetteReport> silhouette;    ///< if there is a recording
  std::map<StageName, Summary> stages;           ///< [ms], if the result has timing
  std::optional<ResidualReport> residual;        ///< over all frames
  std::vector<ResidualReport> residual_windows;  ///< over windows of EvaluatorOptions::window frames
  VolumeReport volume;
};

}  // namespace softbody::evaluation
