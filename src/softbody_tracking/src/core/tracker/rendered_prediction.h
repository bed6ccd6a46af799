#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "alignment/rigid_alignment.h"
#include "depth/depth_associations.h"
#include "outline/crease_associations.h"
#include "outline/outline_associations.h"
#include "prediction/predicted_surface.h"
#include "prediction/surface_samples.h"
#include "softbody_tracking/tracker_config.h"

namespace softbody {

/// The prediction as the camera should see it: rendered and sampled, to be compared with the depth of a
/// frame.
class RenderedPrediction {
 public:
  RenderedPrediction(const TrackerConfig& config, const TetTopology& volume, const MeshTopology& surface);

  /// Renders the surface for these vertices of the volume (camera frame) and samples it. Every rendering of
  /// the prediction happens here; the other members refer to the last one.
  void render(const Pinhole& camera, const Points& volume_vertices);

  const SurfaceModel& model() const { return *model_; }
  const PredictedSurface& surface() const { return *surface_; }
  const SurfaceSamples& samples() const { return samples_; }
  double volumeEdge() const { return depth_weight_.edge_m; }  ///< mean length of the volume's edges [m]

  /// Aligns the rendered surface with depth, outline and these features, see alignRigidly().
  RigidMotions align(const RgbdFrame& frame, const ColorModel& colors,
                     const std::vector<FeatureMatch>& matches) const;
  /// Depth of the frame on the surface, which is moved by the motions.
  DepthAssociations depthOf(const RgbdFrame& frame, const RigidMotions& motions,
                            const ColorModel& colors) const;
  /// The outline and the creases of the surface in the frame.
  OutlineAssociations contoursOf(const RgbdFrame& frame, const RigidMotions& motions,
                                 const ColorModel& colors) const;

  /// Moves the pieces without rendering again.
  void move(const RigidMotions& motions) { surface_ = moved(*surface_, motions); }

  /// Learns how far predictions are off: later alignments expect such motions.
  /// @param predicted vertices of the volume, which then were aligned and moved.
  void learnError(const Points& predicted);
  void forgetError() { usual_error_m_ = 0.0; }

 private:
  int wanted_samples_;
  DepthWeight depth_weight_;
  ContourWeight contour_weight_;  ///< per_edge 0: contours are not sampled
  double usual_error_m_ = 0.0;    ///< largest error of a predicted vertex, mean of the last frames
  std::shared_ptr<const SurfaceModel> model_;
  std::optional<PredictedSurface> surface_;  ///< after the first render()
  SurfaceSamples samples_;
  OutlineSamples outline_;
  CreaseSamples creases_;
};

}  // namespace softbody
