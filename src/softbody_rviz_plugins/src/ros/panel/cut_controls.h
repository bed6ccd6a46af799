#pragma once

#include <ros/node_handle.h>

#include <QComboBox>
#include <QGroupBox>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <vector>

#include "ros/panel/service_caller.h"
#include "softbody_common/geometry/types.h"

namespace softbody {

/// Buttons for the edits of the surface: a plane across the body, preview, cut, undo, redo, reset.
class CutControls : public QGroupBox {
 public:
  /// @param node in the graph's namespace. @param caller must outlive this.
  CutControls(const ros::NodeHandle& node, ServiceCaller* caller, QWidget* parent);

  /// @param node in the namespace of another graph, whose body is not known yet.
  void setNode(const ros::NodeHandle& node);
  /// The body's extent at rest gives the range of the plane.
  void setBody(const Points& rest_vertices);
  void setBusy(bool busy);

 private:
  void addPlane(QLayout* layout);
  QPushButton* addButton(QLayout* layout, const char* text, const char* tip);
  double position() const;
  void showPosition();
  template <typename Service>
  Service planeRequest() const;
  void preview();
  void cut();
  void trigger(const std::string& name);

  ros::NodeHandle node_;
  ServiceCaller* caller_;
  QComboBox* axis_;
  QSlider* slider_;
  QLabel* place_;
  std::vector<QPushButton*> buttons_;
  Eigen::Vector3d low_ = Eigen::Vector3d::Zero(), high_ = Eigen::Vector3d::Zero();
  bool has_body_ = false;
};

}  // namespace softbody
