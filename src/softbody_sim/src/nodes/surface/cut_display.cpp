#include "nodes/surface/cut_display.h"

#include <visualization_msgs/Marker.h>
#include <visualization_msgs/MarkerArray.h>

#include <boost/make_shared.hpp>

#include "ros/cut_markers.h"
#include "softbody_common/geometry/surface_binding.h"
#include "softbody_common/geometry/tet_locator.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/time.h"

namespace softbody {
namespace {

constexpr double kPreviewTime = 10.0;  // [s]

}  // namespace

CutDisplay::CutDisplay(ros::NodeHandle node)
    : lines_publisher_(node.advertise<visualization_msgs::Marker>(topics::kCutMarker, 1)),
      preview_publisher_(node.advertise<visualization_msgs::MarkerArray>(topics::kPreviewMarker, 1)) {}

void CutDisplay::startPreview(const CutPreview& preview, const TetTopology& volume) {
  if (preview_publisher_.getNumSubscribers() == 0 || !preview.refusal.empty()) return;
  preview_ =
      Preview{preview.pieces, cutLines(preview.pieces), volume, bindSurface(preview.pieces, volume), {}};
}

void CutDisplay::publish(const MeshTopology& mesh, const MeshState& surface, const MeshState& volume,
                         const std_msgs::Header& header) {
  if (lines_publisher_.getNumSubscribers() > 0) {
    if (!lines_) lines_ = cutLines(mesh);
    lines_publisher_.publish(boost::make_shared<visualization_msgs::Marker>(
        makeCutLinesMarker(*lines_, surface.vertices, header)));
  }
  if (preview_) publishPreview(volume, header);
}

void CutDisplay::publishPreview(const MeshState& volume, const std_msgs::Header& header) {
  if (!preview_->begin) preview_->begin = header.stamp;
  const double age = secondsBetween(*preview_->begin, header.stamp);
  const bool same_tets = volume.revision == preview_->volume.revision &&
                         volume.vertices.rows() == preview_->volume.rest_vertices.rows();
  if (!same_tets || age < 0.0 || age > kPreviewTime) {
    preview_.reset();
    preview_publisher_.publish(boost::make_shared<visualization_msgs::MarkerArray>(endOfPreview(header)));
    return;
  }
  const Points vertices = applyBinding(preview_->places, volume.vertices, preview_->volume.tets);
  preview_publisher_.publish(boost::make_shared<visualization_msgs::MarkerArray>(
      makePreviewMarkers(preview_->pieces, preview_->lines, vertices, header)));
}

}  // namespace softbody
