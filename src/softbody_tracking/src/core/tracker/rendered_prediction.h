#pragma once

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

  const PredictedSurface& surface() const { return surface_; }
  const SurfaceSamples& samples() const { return samples_; }
  double volumeEdge() const { return volume_edge_m_; }  ///< mean length of the volume's edges [m]

  /// Aligns the rendered surface with depth, outline and these features, see alignRigidly().
  RigidMotions align(const RgbdFrame& frame, const ColorModel& colors,
                     const std::vector<FeatureMatch>& matches);
  /// Depth of the frame on the surface, which is moved by the motions. Valid until the next call or align().
  const DepthAssociations& associateDepth(const RgbdFrame& frame, const RigidMotions& motions,
                                          const ColorModel& colors);
  /// The outline and the creases of the surface in the frame. Valid until the next call.
  const OutlineAssociations& associateOutline(const RgbdFrame& frame, const RigidMotions& motions,
                                              const ColorModel& colors);

  /// Moves the pieces without rendering again.
  void move(const RigidMotions& motions) { surface_.move(motions); }

  /// Learns how far predictions are off: later alignments expect such motions.
  /// @param predicted vertices of the volume, which then were aligned and moved.
  /// @param elapsed_s since the frame before.
  void learnError(const Points& predicted, double elapsed_s);
  void forgetError() { usual_error_m_ = 0.0; }

 private:
  int wanted_samples_;
  double volume_edge_m_;
  double usual_error_m_ = 0.0;  ///< largest error of a predicted vertex, mean of the last frames
  PredictedSurface surface_;
  SurfaceSamples samples_;
  DepthAssociator depth_;
  OutlineAssociator outline_;
  CreaseAssociator creases_;
  OutlineAssociations contours_;
};

}  // namespace softbody
