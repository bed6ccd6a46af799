#pragma once

#include <ros/ros.h>

#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "nodes/frame_poses.h"
#include "nodes/simulator/reaction_publisher.h"
#include "softbody_sim/surroundings/surroundings_config.h"
#include "softbody_sim/surroundings/surroundings_follower.h"

namespace softbody {

/// A SurroundingsFollower with poses from tf, reactions on topics, and faults in the log. Names of frames may
/// have a leading slash.
class SurroundingsTracker {
 public:
  /// @param surface of the body, which pins are meant about.
  SurroundingsTracker(const ros::NodeHandle& node, const SurroundingsConfig& config, BodySurface surface);

  std::size_t addPin(PinRegion region, const TetTopology& volume);
  std::size_t grip(PinRegion region, const TetTopology& volume, const Points& vertices);
  bool removePin(const std::string& name);
  /// Lets all pins go and holds other regions, of another body. @throw std::invalid_argument as
  /// SurroundingsFollower; nothing has changed.
  void replacePins(BodySurface surface, std::vector<PinRegion> regions, const TetTopology& volume);

  void setObstacle(ObstacleDescription description);
  bool moveObstacle(const std::string& name, const std::string& frame, const Eigen::Isometry3d& pose);
  bool removeObstacle(const std::string& name);

  /// Says whether a pin or obstacle that was just set has to wait for its frame. @return empty: it has not.
  std::string waitingForFrame(const std::string& name);

  /// Names of all pins and obstacles.
  std::vector<std::string> names() const;
  void updatePins(const TetTopology& volume, const Points& vertices) {
    follower_.updatePins(volume, vertices);
  }
  void forgetPinPositions() { follower_.forgetPinPositions(); }

  /// What acts on the body at a stamp.
  /// @param vertices in `frame`, after the step whose reactions were published last; empty if the body is not
  /// placed.
  const Surroundings& surroundingsAt(const std::string& frame, const ros::Time& stamp,
                                     const Points& vertices) {
    return surroundingsAt(frame, stamp, vertices, step_stamp_);
  }
  /// The same with vertices of another stamp.
  const Surroundings& surroundingsAt(const std::string& frame, const ros::Time& stamp, const Points& vertices,
                                     const ros::Time& vertices_stamp);
  const NamedSurroundings& lastSurroundings() const { return follower_.lastSurroundings(); }

  std::shared_ptr<const BodySurface> surfaceIn(const TetTopology& volume) {
    return follower_.surfaceIn(volume);
  }
  double pinAccuracy_m() const { return follower_.pinAccuracy_m(); }
  /// Poses of the frames that tf knows, at the last step.
  std::map<std::string, Eigen::Isometry3d> posesOf(const std::set<std::string>& frames) const;
  /// Of a frame at a stamp; nothing if tf does not know the frame.
  std::optional<Eigen::Isometry3d> poseOf(const std::string& frame, const ros::Time& stamp) const;

  void findConflicts(const std::vector<Target>& targets, const Tets& tets, const Points& vertices);

  /// Whether somebody listens to the reaction of a pin.
  bool hasListenedPins() const;

  /// Publishes the reactions of a step under the last surroundingsAt().
  void publishReactions(const Reactions& reactions, const ros::Time& stamp);

  SurroundingsFollower::Faults faults() const { return follower_.faults(); }

 private:
  FrameLookup lookup() const;
  void writeLog();

  ros::NodeHandle node_;
  FramePoses poses_;
  SurroundingsFollower follower_;
  std::map<std::string, ReactionPublisher> publishers_;  ///< of the pins and obstacles
  std::string frame_;                                    ///< of the targets
  ros::Time step_stamp_;                                 ///< of the last step
};

}  // namespace softbody
