#pragma once

#include <ros/node_handle.h>
#include <ros/subscriber.h>
#include <rviz/display.h>
#include <rviz/properties/bool_property.h>
#include <rviz/properties/color_property.h>
#include <rviz/properties/float_property.h>
#include <rviz/properties/ros_topic_property.h>
#include <softbody_msgs/Targets.h>

#include <array>
#include <memory>
#include <mutex>

#include "ros/drawing/body_material.h"
#include "ros/drawing/dynamic_mesh.h"
#include "tets/tets_model.h"

namespace softbody {

/// Draws the targets of the simulation as arrows, from the body to where it is pulled.
class TargetArrows {
 public:
  /// Adds the properties. @param redraw and @param resubscribe are slots of the display.
  void addProperties(rviz::Display* display, const char* redraw, const char* resubscribe);
  void initialize(Ogre::SceneManager* scene, Ogre::SceneNode* node);
  void subscribe(ros::NodeHandle node);
  void unsubscribe();

  /// Whether targets came since the last draw.
  bool hasNews();
  /// Draws the newest targets at a state of the tets. @throw std::invalid_argument if they are not valid.
  void draw(const TetsModel& tets);
  void clear();

 private:
  struct Kind {
    TargetKind kind;
    rviz::BoolProperty* shown;
    rviz::ColorProperty* color;
    std::unique_ptr<BodyMaterial> material;
    std::unique_ptr<DynamicMesh> mesh;
    int capacity = 0;
  };

  void draw(const std::vector<Arrow>& arrows, Kind* kind);

  rviz::RosTopicProperty* topic_ = nullptr;
  rviz::BoolProperty* shown_ = nullptr;
  rviz::FloatProperty *stretch_ = nullptr, *width_ = nullptr;
  std::array<Kind, 4> kinds_{};
  ros::Subscriber subscriber_;
  std::mutex mutex_;
  softbody_msgs::TargetsConstPtr newest_, drawn_;
};

}  // namespace softbody
