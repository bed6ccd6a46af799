#pragma once

#include <ros/ros.h>

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "nodes/simulator/frame_poses.h"
#include "nodes/simulator/held_region.h"
#include "nodes/simulator/reaction_publisher.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// Pins and obstacles with their poses from tf, and their reactions on topics. A frame without a pose at the
/// stamp keeps its last pose. An obstacle or pin whose frame never had a pose does not act, with a warning.
class SurroundingsTracker {
 public:
  SurroundingsTracker(const ros::NodeHandle& node, std::vector<ObstacleDescription> obstacles);

  /// Holds the vertices of a region from the next surroundingsAt() on.
  /// @throw std::invalid_argument if the region has no vertex, or its name is not usable.
  void addPin(const PinRegion& region, const Points& rest_vertices);
  /// @return false if no pin has the name.
  bool removePin(const std::string& name);
  /// Adds the vertices that a cut created to their regions. @param vertices [m], empty if the body is not
  /// placed.
  void updatePins(const Points& rest_vertices, const Points& vertices);
  /// Pins hold the vertices where they are at the next surroundingsAt().
  void forgetPinPositions();

  /// What acts on the body at a stamp.
  /// @param vertices in `frame`, after the step whose reactions were published last; empty if the body is not
  /// placed.
  const Surroundings& surroundingsAt(const std::string& frame, const ros::Time& stamp,
                                     const Points& vertices);

  /// Publishes the reactions of a step under the last surroundingsAt(). Each is in the frame that its pin or
  /// obstacle follows (default: the targets' frame), about that frame's origin.
  void publishReactions(const Reactions& reactions, const ros::Time& stamp);

 private:
  struct PlacedObstacle {
    ObstacleDescription description;
    std::optional<Eigen::Isometry3d> frame_pose;  ///< the last one known
  };

  void placeObstacles(const ros::Time& stamp);
  void placePins(const ros::Time& stamp, const Points& vertices);
  void publishObstacles(const Reactions& reactions, const ros::Time& stamp);
  void publishPins(const Reactions& reactions, const ros::Time& stamp);
  const std::string& orTargetFrame(const std::string& frame) const { return frame.empty() ? frame_ : frame; }

  ReactionPublisher reactions_;
  FramePoses poses_;
  std::vector<PlacedObstacle> obstacles_;
  std::map<std::string, HeldRegion> held_;
  Surroundings surroundings_;  ///< of the last surroundingsAt()
  std::string frame_;          ///< of the targets
  ros::Time step_stamp_;       ///< of the last step
};

}  // namespace softbody
