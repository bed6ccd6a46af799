#include "nodes/surface/cut_services.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/cutting/patch/cut_shapes.h"

namespace softbody {

CutServices::CutServices(ros::NodeHandle private_node, std::string body_frame, SurfaceEditor* editor,
                         std::function<void(const CutPreview&)> on_preview)
    : body_frame_(std::move(body_frame)), editor_(editor), on_preview_(std::move(on_preview)) {
  cut_ = private_node.advertiseService("cut", &CutServices::onCut, this);
  preview_ = private_node.advertiseService("preview", &CutServices::onPreview, this);
  undo_ = advertiseEdit(&private_node, "undo", CutKind::kUndo);
  redo_ = advertiseEdit(&private_node, "redo", CutKind::kRedo);
  reset_ = advertiseEdit(&private_node, "reset", CutKind::kReset);
}

ros::ServiceServer CutServices::advertiseEdit(ros::NodeHandle* node, const char* name, CutKind kind) {
  using Trigger = std_srvs::Trigger;
  return node->advertiseService<Trigger::Request, Trigger::Response>(
      name, [this, kind](Trigger::Request&, Trigger::Response& response) {
        const bool done = editor_->isReady(&response.message) &&
                          editor_->apply(editor_->body().edit(kind), &response.message);
        response.success = static_cast<unsigned char>(done);
        if (done) response.message = fmt::format("revision {}", editor_->body().volume().revision);
        return true;
      });
}

bool CutServices::onCut(softbody_msgs::CutBody::Request& request,
                        softbody_msgs::CutBody::Response& response) {
  try {
    const bool done = editor_->isReady(&response.message) &&
                      editor_->apply(editor_->body().separateCut(patchOf(request)), &response.message);
    response.success = static_cast<unsigned char>(done);
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  if (editor_->started()) response.revision = editor_->body().volume().revision;
  return true;
}

bool CutServices::onPreview(softbody_msgs::PreviewCut::Request& request,
                            softbody_msgs::PreviewCut::Response& response) {
  try {
    if (!editor_->isReady(&response.message)) return true;
    const CutPreview preview = editor_->body().preview(patchOf(request));
    response.success = static_cast<unsigned char>(preview.refusal.empty());
    response.message = preview.refusal;
    response.volumes = preview.volumes;
    on_preview_(preview);
  } catch (const std::invalid_argument& error) {
    response.message = error.what();
  }
  return true;
}

/// The request's polygon, or its plane. @throw std::invalid_argument if the request is not in the rest frame.
template <typename Request>
TriangleMesh CutServices::patchOf(const Request& request) const {
  if (!request.header.frame_id.empty() && withoutSlash(request.header.frame_id) != body_frame_) {
    throw std::invalid_argument(fmt::format("frame_id is {}; allowed: empty, or the rest frame {}",
                                            request.header.frame_id, body_frame_));
  }
  if (request.polygon.empty()) {
    return planePatch({request.point.x, request.point.y, request.point.z},
                      {request.normal.x, request.normal.y, request.normal.z}, editor_->startVertices());
  }
  Points corners(static_cast<Eigen::Index>(request.polygon.size()), 3);
  for (Eigen::Index i = 0; i < corners.rows(); ++i) {
    const geometry_msgs::Point32& p = request.polygon[static_cast<std::size_t>(i)];
    corners.row(i) << p.x, p.y, p.z;
  }
  return polygonPatch(corners);
}

}  // namespace softbody
