#pragma once

#include <ros/ros.h>
#include <softbody_msgs/CutBody.h>
#include <softbody_msgs/PreviewCut.h>
#include <std_srvs/Trigger.h>

#include <functional>
#include <string>

#include "nodes/surface/surface_editor.h"

namespace softbody {

/// The services ~cut, ~preview, ~undo, ~redo and ~reset.
class CutServices {
 public:
  /// @param editor outlives this. @param on_preview called with the result of each preview.
  CutServices(ros::NodeHandle private_node, std::string body_frame, SurfaceEditor* editor,
              std::function<void(const CutPreview&)> on_preview);

 private:
  bool onCut(softbody_msgs::CutBody::Request& request, softbody_msgs::CutBody::Response& response);
  bool onPreview(softbody_msgs::PreviewCut::Request& request, softbody_msgs::PreviewCut::Response& response);
  ros::ServiceServer advertiseEdit(ros::NodeHandle* node, const char* name, CutKind kind);
  template <typename Request>
  TriangleMesh patchOf(const Request& request) const;

  std::string body_frame_;
  SurfaceEditor* editor_;
  std::function<void(const CutPreview&)> on_preview_;
  ros::ServiceServer cut_, preview_, undo_, redo_, reset_;
};

}  // namespace softbody
