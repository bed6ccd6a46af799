#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rviz/panel.h>
#include <softbody_msgs/StageTiming.h>
#include <softbody_msgs/TetTopology.h>
#include <softbody_msgs/TrackingStatus.h>

#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <vector>

#include "ros/panel/cut_controls.h"
#include "ros/panel/record_button.h"
#include "ros/panel/service_caller.h"
#include "ros/panel/stiffness_controls.h"
#include "ros/panel/time_bars.h"
#include "timing/frame_times.h"

namespace softbody {

/// State of the tracker in words, times of the stages, sliders for stiffness, and buttons for the services of
/// the graph.
class SoftbodyPanel : public rviz::Panel {
  Q_OBJECT

 public:
  explicit SoftbodyPanel(QWidget* parent = nullptr);

  void onInitialize() override;
  void load(const rviz::Config& config) override;
  void save(rviz::Config config) const override;

 private:
  void addState();
  void addTimes();
  void addNamespace();
  void setNamespace(const QString& name);
  void subscribe();
  void onStatus(const softbody_msgs::TrackingStatus& message);
  void onTiming(const softbody_msgs::StageTiming& message);
  void onTopology(const softbody_msgs::TetTopology::ConstPtr& message);
  void findAgain();
  void refresh();

  ros::NodeHandle node_;  ///< in the graph's namespace
  ServiceCaller caller_;
  QLabel *state_, *reason_, *numbers_, *latency_, *answer_;
  QPushButton* find_;
  TimeBars* bars_;
  StiffnessControls* stiffness_;
  CutControls* cut_;
  RecordButton* record_;
  QLineEdit* namespace_;
  QString accepted_namespace_;  ///< as written, perhaps empty
  FrameTimes times_;
  softbody_msgs::TetTopology::ConstPtr topology_;  ///< of the cut's controls
  ros::SteadyTime last_status_;
  std::vector<ros::Subscriber> subscribers_;
};

}  // namespace softbody
