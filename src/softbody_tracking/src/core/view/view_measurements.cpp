#include "view/view_measurements.h"

#include "outline/crease_associations.h"
#include "softbody_common/geometry/tet_geometry.h"

namespace softbody {

MeasurementWeights::MeasurementWeights(const TrackerConfig& config, const TetTopology& volume)
    : depth{config.depth_weight, meanEdgeLength(volume.rest_vertices, volume.tets)},
      contour{config.outline_weight, depth.edge_m} {}

DepthAssociations depthOf(const RgbdFrame& frame, const View& view, const RigidMotions& motions,
                          const Labels& labels, const MeasurementWeights& weights, int pixel_step) {
  return associateDepth(frame, view.surface.image(), view.samples, motions, labels, weights.depth,
                        pixel_step);
}

OutlineAssociations contoursOf(const RgbdFrame& frame, const View& view, const RigidMotions& motions,
                               const Labels& labels, const MeasurementWeights& weights) {
  OutlineAssociations contours =
      associateOutline(frame, view.surface.image(), view.outline, motions, labels, weights.contour);
  const std::vector<Association> creases =
      associateCreases(frame, view.surface, view.creases, motions, labels, weights.contour);
  contours.associations.insert(contours.associations.end(), creases.begin(), creases.end());
  return contours;
}

}  // namespace softbody
