#pragma once

#include <ros/node_handle.h>

#include <QLabel>
#include <QProcess>
#include <QPushButton>

namespace softbody {

/// Starts and ends a recording of the result: surface, volume, status, times, tf. The bag is one that
/// export, evaluate and Python read.
class RecordButton : public QPushButton {
 public:
  /// @param node in the graph's namespace. @param answer shows what happened; must outlive this.
  RecordButton(const ros::NodeHandle& node, QLabel* answer);
  /// Ends the recording, so that the bag is whole.
  ~RecordButton() override;

  /// The next recording is of the graph in another namespace.
  void setNode(const ros::NodeHandle& node) { node_ = node; }

 private:
  void startOrStop();
  void onEnd();

  ros::NodeHandle node_;
  QLabel* answer_;
  QProcess recorder_;
  QString path_;
};

}  // namespace softbody
