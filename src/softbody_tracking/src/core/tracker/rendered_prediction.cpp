#include "tracker/rendered_prediction.h"

#include <utility>

#include "softbody_common/tet_geometry.h"

namespace softbody {
namespace {

// Share of the last frame in the usual error of the prediction: motion changes within some frames.
constexpr double kNewestShare = 0.5;

}  // namespace

RenderedPrediction::RenderedPrediction(const TrackerConfig& config, const TetTopology& volume,
                                       const MeshTopology& surface)
    : wanted_samples_(config.depth.max_targets),
      depth_weight_{config.depth.weight, meanEdgeLength(volume.rest_vertices, volume.tets),
                    config.depth.max_distance_m},
      contour_weight_{config.knn_targets || !config.use_depth ? 0.0 : config.outline.weight,
                      depth_weight_.edge_m},
      model_(std::make_shared<SurfaceModel>(volume, surface)) {}

void RenderedPrediction::render(const Pinhole& camera, const Points& volume_vertices) {
  surface_.emplace(model_, camera, volume_vertices);
  samples_ = sampleSurface(*surface_, wanted_samples_);
  if (contour_weight_.per_edge <= 0.0) return;
  outline_ = sampleOutline(*surface_);
  creases_ = sampleCreases(*surface_);
}

RigidMotions RenderedPrediction::align(const RgbdFrame& frame, const ColorModel& colors,
                                       const std::vector<FeatureMatch>& matches) const {
  const RigidMotions still(surface_->pieceCount(), Eigen::Isometry3d::Identity());
  return alignRigidly(frame, *surface_, samples_, colors.region(), matches,
                      contoursOf(frame, still, colors).associations, depth_weight_, usual_error_m_);
}

void RenderedPrediction::learnError(const Points& predicted) {
  const double error_m = (surface_->volumeVertices() - predicted).rowwise().norm().maxCoeff();
  usual_error_m_ += kNewestShare * (error_m - usual_error_m_);
}

DepthAssociations RenderedPrediction::depthOf(const RgbdFrame& frame, const RigidMotions& motions,
                                              const ColorModel& colors) const {
  return associateDepth(frame, surface_->image(), samples_, motions, colors.region(), depth_weight_);
}

OutlineAssociations RenderedPrediction::contoursOf(const RgbdFrame& frame, const RigidMotions& motions,
                                                   const ColorModel& colors) const {
  OutlineAssociations contours =
      associateOutline(frame, surface_->image(), outline_, motions, colors.region(), contour_weight_);
  const std::vector<Association> creases =
      associateCreases(frame, *surface_, creases_, motions, contour_weight_);
  contours.associations.insert(contours.associations.end(), creases.begin(), creases.end());
  return contours;
}

}  // namespace softbody
