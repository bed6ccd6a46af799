#pragma once

#include <dynamic_reconfigure/Config.h>
#include <ros/node_handle.h>

#include <QGroupBox>
#include <QLabel>
#include <QLineEdit>
#include <QSlider>
#include <map>
#include <string>
#include <vector>

#include "ros/panel/service_caller.h"

namespace softbody {

/// A number of the simulator with its slider, which is logarithmic, and its field.
struct StiffnessRow {
  std::string parameter;  ///< of the node simulator
  double per_unit = 1.0;  ///< shown number per value
  QSlider* slider = nullptr;
  QLineEdit* field = nullptr;
};

/// Sliders for the stiffness of targets and body. They show what the node simulator has, and change it by the
/// protocol of dynamic_reconfigure.
class StiffnessControls : public QGroupBox {
 public:
  /// @param node in the graph's namespace. @param caller must outlive this.
  StiffnessControls(const ros::NodeHandle& node, ServiceCaller* caller, QWidget* parent);

  /// @param node in the namespace of another graph, whose values are not known yet.
  void setNode(const ros::NodeHandle& node);
  /// The values of the graph.
  void show(const dynamic_reconfigure::Config& config);
  /// Shows them again: the graph may have refused a change. A row stays while the user types or drags in it.
  void restore();
  void setBusy(bool busy);

 private:
  void addRow(const StiffnessRow& row, const char* title, const char* unit, const char* tip);
  void showValue(const StiffnessRow& row);
  void enter(const StiffnessRow& row);
  void set(const StiffnessRow& row, double shown);

  ros::NodeHandle node_;
  ServiceCaller* caller_;
  std::vector<StiffnessRow> rows_;
  std::map<std::string, double> values_;  // of the graph
};

}  // namespace softbody
