#pragma once

#include <ros/ros.h>
#include <tf2_ros/transform_listener.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/object/object_model.h"

namespace softbody {

/// Where pins and obstacles are at an instant, from tf, and their reactions on topics. What tf does not know
/// at that instant is taken where it was last; what it has never known is left out, with a warning.
class SurroundingsTracker {
 public:
  SurroundingsTracker(const ros::NodeHandle& node, std::vector<ObstacleDescription> obstacles);
  SurroundingsTracker(const SurroundingsTracker&) = delete;
  SurroundingsTracker& operator=(const SurroundingsTracker&) = delete;

  /// Holds the vertices of a region from the next at() on. @throw std::invalid_argument if it has none.
  void hold(const PinRegion& region, const Points& rest_vertices);
  /// False where no region has the name.
  bool release(const std::string& name);
  /// The volume was cut: held regions hold their new vertices too, where those are now.
  /// @param vertices none: the body has no place.
  void regionsChanged(const Points& rest_vertices, const Points& vertices);
  /// Regions are held anew, where the vertices are then.
  void forgetPlaces();

  /// @param vertices in `frame`, as the step left them whose reactions were last published; none where the
  /// body has no place.
  Surroundings at(const std::string& frame, const ros::Time& stamp, const Points& vertices);

  /// The reactions of a step under the last at(), each in the frame that its pin or obstacle follows (`frame`
  /// where it follows none), about that frame's origin: what a sensor there would feel.
  void publish(const Reactions& reactions, const ros::Time& stamp);

 private:
  struct Held {
    PinRegion region;
    std::vector<int> vertices;
    std::optional<Points> places;  ///< in the region's frame; none until the body and the frame have a place
    Eigen::Isometry3d frame_pose;  ///< in the targets' frame
    bool acts = false;             ///< in the last at()
  };
  struct Placed {
    ObstacleDescription description;
    std::optional<Eigen::Isometry3d> frame_pose;
  };

  std::optional<Eigen::Isometry3d> poseOf(const std::string& frame, const std::string& target_frame,
                                          const ros::Time& stamp) const;
  void grip(const Points& vertices, Held* held) const;
  void publishWrench(const std::string& name, const std::string& frame, const Eigen::Isometry3d& frame_pose,
                     const Wrench& about_origin, const ros::Time& stamp);

  ros::NodeHandle node_;
  tf2_ros::Buffer buffer_;
  tf2_ros::TransformListener listener_;
  std::vector<Placed> obstacles_;
  std::map<std::string, Held> held_;
  Surroundings last_;
  std::string frame_;  ///< of the targets
  ros::Time stepped_;  ///< stamp of the last step
  std::map<std::string, ros::Publisher> publishers_;
};

}  // namespace softbody
