#pragma once

#include <rviz/display.h>
#include <rviz/properties/ros_topic_property.h>
#include <std_msgs/Header.h>

#include <stdexcept>
#include <string>

#include "ros/displays/body_feed.h"

namespace softbody {

/// What the displays of a body share: two topics, the frame, and the status.
class BodyDisplayBase : public rviz::Display {
  Q_OBJECT

 public:
  void reset() override;

 protected:
  void addTopics(const char* topology_type, const QString& topology, const QString& state);
  void onEnable() override { resubscribe(); }
  void onDisable() override;
  void fixedFrameChanged() override;

  virtual void subscribe() = 0;
  virtual void unsubscribe() = 0;
  /// Removes everything from the scene.
  virtual void clearScene() = 0;

  /// Moves the scene node to the frame of a state. If the transform at its stamp is not known, takes the
  /// newest.
  void moveTo(const std_msgs::Header& header);
  void refuse(const char* what, const std::exception& error);
  void accept(const char* what, const std::string& text);

  rviz::RosTopicProperty* topology_topic_ = nullptr;
  rviz::RosTopicProperty* state_topic_ = nullptr;

 protected Q_SLOTS:
  void resubscribe();

 private:
  std_msgs::Header shown_;
};

/// Brings states to the subclass in the window's thread, after their topologies, and refuses bad messages.
template <typename TopologyMessage>
class BodyDisplay : public BodyDisplayBase {
 public:
  void update(float /*wall_dt*/, float /*ros_dt*/) override {
    const auto news = feed_.take();
    if (!news) return reportHeld();
    if (news->topology) showTopology(*news->topology);
    if (!has_topology_) return;
    try {
      setState(*news->state);
      accept("State", stateText());
      moveTo(news->state->header);
    } catch (const std::exception& error) {  // of Ogre, too: rviz would end
      refuse("State", error);
    }
    queueRender();
  }

 protected:
  /// @throw std::invalid_argument if the message is not valid.
  virtual void setTopology(const TopologyMessage& message) = 0;
  virtual void setState(const softbody_msgs::MeshState& message) = 0;
  virtual std::string topologyText() const = 0;
  virtual std::string stateText() const = 0;

  void subscribe() override {
    feed_.subscribe(threaded_nh_, topology_topic_->getTopicStd(), state_topic_->getTopicStd());
  }
  void unsubscribe() override {
    feed_.unsubscribe();
    has_topology_ = false;
  }
  bool hasTopology() const { return has_topology_; }

 private:
  void showTopology(const TopologyMessage& message) {
    has_topology_ = false;
    try {
      setTopology(message);
      has_topology_ = true;
      accept("Topology", topologyText());
    } catch (const std::exception& error) {
      clearScene();
      refuse("Topology", error);
    }
  }

  void reportHeld() {
    if (const auto revision = feed_.heldRevision()) {
      setStatusStd(rviz::StatusProperty::Warn, "State",
                   "waits for the topology of revision " + std::to_string(*revision));
    }
  }

  BodyFeed<TopologyMessage> feed_;
  bool has_topology_ = false;
};

}  // namespace softbody
