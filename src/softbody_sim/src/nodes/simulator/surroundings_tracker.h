#pragma once

#include <ros/ros.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "nodes/frame_poses.h"
#include "nodes/prediction/named_surroundings.h"
#include "nodes/simulator/followed_frame.h"
#include "nodes/simulator/held_region.h"
#include "nodes/simulator/lasting_fault.h"
#include "nodes/simulator/reaction_publisher.h"
#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/constraints/surroundings.h"

namespace softbody {

/// How pins are weighed against the camera, and when their frames are faulty.
struct PinOptions {
  double accuracy_m = 0.001;     ///< standard deviation of a pin's position; 0: exact
  double conflict_m = 0.0042;    ///< a pin and the camera that disagree by more are in conflict
  double frame_timeout_s = 1.0;  ///< also of obstacles: time without a pose until a frame is faulty
};

/// Pins and obstacles with their poses from tf, and their reactions on topics. An obstacle or pin whose frame
/// never had a pose does not act.
class SurroundingsTracker {
 public:
  /// Name of a pin or obstacle, and what is wrong with it in a sentence.
  using Faults = std::vector<std::pair<std::string, std::string>>;

  SurroundingsTracker(const ros::NodeHandle& node, const std::vector<ObstacleDescription>& obstacles,
                      const PinOptions& options);

  /// Holds the vertices of a region from the next surroundingsAt() on, in place of a region of the same name.
  /// @return number of vertices that are held.
  /// @throw std::invalid_argument if the region has no vertex, its name is not usable, or too many are held.
  std::size_t addPin(PinRegion region, const Points& rest_vertices);
  /// Closes a gripper: holds what lies in a box in a frame, in place of a pin of the same name. If the body
  /// is not placed, or tf does not know the frame, it takes hold when both are known.
  /// @param vertices as in surroundingsAt(). @return number of vertices that are held at once.
  /// @throw std::invalid_argument as addPin().
  std::size_t grip(PinRegion region, const Points& vertices);
  /// @return false if no pin has the name.
  bool removePin(const std::string& name);

  /// Adds an obstacle, or replaces the one of the same name, from the next surroundingsAt() on.
  /// @throw std::invalid_argument if a pin has the name, or there are too many obstacles.
  void setObstacle(ObstacleDescription description);
  /// Moves an obstacle. It pushes what lies in its way.
  /// @param frame that it follows from now on. @param pose in that frame.
  /// @return false if no obstacle has the name.
  bool moveObstacle(const std::string& name, const std::string& frame, const Eigen::Isometry3d& pose);
  /// @return false if no obstacle has the name.
  bool removeObstacle(const std::string& name);

  /// Says whether a pin or obstacle that was just set has to wait for its frame. @return empty: it has not.
  std::string waitingForFrame(const std::string& name);

  /// Names of all pins and obstacles.
  std::vector<std::string> names() const;
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

  /// What acted on the body at the last surroundingsAt(), with the pins of the last updatePins(). Obstacles
  /// and pins that were set since do not act yet.
  const NamedSurroundings& lastSurroundings() const { return surroundings_; }

  double pinAccuracy_m() const { return options_.accuracy_m; }
  /// Poses of the frames that tf knows, at the last step.
  std::map<std::string, Eigen::Isometry3d> posesOf(const std::set<std::string>& frames) const;
  /// Of a frame at a stamp; nothing if tf does not know the frame.
  std::optional<Eigen::Isometry3d> poseOf(const std::string& frame, const ros::Time& stamp) const;

  /// Finds pins that the targets of the last surroundingsAt() contradict. @param vertices after the step [m].
  void findConflicts(const std::vector<Target>& targets, const Tets& tets, const Points& vertices);

  /// Whether somebody listens to the reaction of a pin.
  bool hasListenedPins() const;

  /// Publishes the reactions of a step under the last surroundingsAt(). Each is in the frame that its pin or
  /// obstacle follows (default: the targets' frame), about that frame's origin.
  void publishReactions(const Reactions& reactions, const ros::Time& stamp);

  Faults faults() const;

 private:
  struct PlacedObstacle {
    ObstacleDescription description;
    FollowedFrame frame;
    ReactionPublisher reaction;
  };
  struct HeldPin {
    HeldRegion held;
    FollowedFrame frame;
    ReactionPublisher reaction;
    LastingFault conflict;
  };

  void requireFree(const std::string& pin);
  std::size_t insert(HeldRegion held);
  FollowedFrame frameOf(const ObstacleDescription& description) const;
  PlacedObstacle* find(const std::string& obstacle);
  void placeObstacles(const ros::Time& stamp);
  void placePins(const ros::Time& stamp, const Points& vertices);
  void appendPins(const std::string& name, const HeldRegion& held);
  void judge(double conflict_m, HeldPin* pin) const;
  void publishObstacles(const Reactions& reactions, const ros::Time& stamp);
  void publishPins(const Reactions& reactions, const ros::Time& stamp);
  const std::string& orTargetFrame(const std::string& frame) const { return frame.empty() ? frame_ : frame; }

  ros::NodeHandle node_;
  const PinOptions options_;
  FramePoses poses_;
  std::vector<PlacedObstacle> obstacles_;
  bool obstacles_changed_ = false;  ///< since the last surroundingsAt()
  std::map<std::string, HeldPin> pins_;
  NamedSurroundings surroundings_;  ///< of the last surroundingsAt()
  std::string frame_;               ///< of the targets
  ros::Time step_stamp_;            ///< of the last step
};

}  // namespace softbody
