#include "tracker/rendered_prediction.h"

#include <utility>

#include "prediction/memory.h"
#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

/// Weight 0 if no target would use the outline: then it is not sampled.
OutlineConfig usedOutline(const TrackerConfig& config) {
  OutlineConfig outline = config.outline;
  if (config.knn_targets || !config.use_depth) outline.weight = 0.0;
  return outline;
}

}  // namespace

RenderedPrediction::RenderedPrediction(const TrackerConfig& config, const TetTopology& volume,
                                       const MeshTopology& surface)
    : wanted_samples_(config.depth.max_targets),
      volume_edge_m_(meanEdgeLength(volume.rest_vertices, volume.tets)),
      surface_(volume, surface),
      depth_(config.depth, volume_edge_m_),
      outline_(usedOutline(config), volume_edge_m_),
      creases_(usedOutline(config), volume_edge_m_) {}

void RenderedPrediction::render(const Pinhole& camera, const Points& volume_vertices) {
  surface_.render(camera, volume_vertices);
  samples_ = sampleSurface(surface_, wanted_samples_, std::move(samples_));
  outline_.sample(surface_);
  creases_.sample(surface_);
}

RigidMotions RenderedPrediction::align(const RgbdFrame& frame, const ColorModel& colors,
                                       const std::vector<FeatureMatch>& matches) {
  const RigidMotions still(surface_.pieceCount(), Eigen::Isometry3d::Identity());
  const std::vector<Association>& outline = associateOutline(frame, still, colors).associations;
  return alignRigidly(frame, surface_, samples_, colors, matches, outline, usual_error_m_, &depth_);
}

void RenderedPrediction::learnError(const Points& predicted, double elapsed_s) {
  const double error_m = (surface_.volumeVertices() - predicted).rowwise().norm().maxCoeff();
  usual_error_m_ += newestShare(elapsed_s, kErrorMemory_s) * (error_m - usual_error_m_);
}

const DepthAssociations& RenderedPrediction::associateDepth(const RgbdFrame& frame,
                                                            const RigidMotions& motions,
                                                            const ColorModel& colors) {
  return depth_.associate(frame, surface_.image(), samples_, motions, colors);
}

const OutlineAssociations& RenderedPrediction::associateOutline(const RgbdFrame& frame,
                                                                const RigidMotions& motions,
                                                                const ColorModel& colors) {
  contours_ = outline_.associate(frame, surface_.image(), motions, colors.region());
  creases_.associate(frame, surface_, motions, &contours_.associations);
  return contours_;
}

}  // namespace softbody
