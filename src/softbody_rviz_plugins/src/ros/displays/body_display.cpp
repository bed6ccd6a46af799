#include "ros/displays/body_display.h"

#include <OgreSceneNode.h>
#include <rviz/display_context.h>
#include <rviz/frame_manager.h>
#include <rviz/properties/status_property.h>

namespace softbody {

void BodyDisplayBase::addTopics(const char* topology_type, const QString& topology, const QString& state) {
  topology_topic_ = new rviz::RosTopicProperty("Topology Topic", topology, topology_type,
                                               "The mesh of the body; sent again every second.", this,
                                               SLOT(resubscribe()), this);
  state_topic_ =
      new rviz::RosTopicProperty("State Topic", state, "softbody_msgs/MeshState",
                                 "Where the vertices of the mesh are.", this, SLOT(resubscribe()), this);
}

void BodyDisplayBase::resubscribe() {
  unsubscribe();
  clearScene();
  clearStatuses();
  if (!isEnabled()) return;
  setStatus(rviz::StatusProperty::Warn, "State", "no message yet");
  try {
    subscribe();
  } catch (const ros::Exception& error) {
    refuse("Topic", error);
  }
}

void BodyDisplayBase::onDisable() {
  unsubscribe();
  clearScene();
}

void BodyDisplayBase::reset() {
  Display::reset();
  resubscribe();
}

void BodyDisplayBase::fixedFrameChanged() {
  if (!shown_.frame_id.empty()) moveTo(shown_);
}

void BodyDisplayBase::moveTo(const std_msgs::Header& header) {
  shown_ = header;
  Ogre::Vector3 position = Ogre::Vector3::ZERO;
  Ogre::Quaternion orientation = Ogre::Quaternion::IDENTITY;
  rviz::FrameManager* frames = context_->getFrameManager();
  const bool same = header.frame_id == fixed_frame_.toStdString();  // tf need not know it
  const bool known = same || frames->getTransform(header, position, orientation) ||
                     frames->getTransform(header.frame_id, ros::Time(), position, orientation);
  scene_node_->setVisible(known);
  if (!known) {
    setStatusStd(
        rviz::StatusProperty::Error, "Transform",
        "no transform from " + header.frame_id + " to the fixed frame " + fixed_frame_.toStdString());
    return;
  }
  deleteStatus("Transform");
  scene_node_->setPosition(position);
  scene_node_->setOrientation(orientation);
}

void BodyDisplayBase::refuse(const char* what, const std::exception& error) {
  setStatusStd(rviz::StatusProperty::Error, what, std::string("refused: ") + error.what());
}

void BodyDisplayBase::accept(const char* what, const std::string& text) {
  setStatusStd(rviz::StatusProperty::Ok, what, text);
}

}  // namespace softbody
