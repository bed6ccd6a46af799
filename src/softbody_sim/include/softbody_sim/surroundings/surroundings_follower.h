#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "softbody_sim/constraints/obstacle_description.h"
#include "softbody_sim/constraints/surroundings.h"
#include "softbody_sim/dynamics/simulator.h"
#include "softbody_sim/surroundings/body_surface.h"
#include "softbody_sim/surroundings/followed_frame.h"
#include "softbody_sim/surroundings/frame_lookup.h"
#include "softbody_sim/surroundings/lasting_fault.h"
#include "softbody_sim/surroundings/named_surroundings.h"
#include "softbody_sim/surroundings/pinned_vertices.h"

namespace softbody {

/// Pins and obstacles that follow frames. One whose frame never had a pose does not act. All vertices are in
/// the frame of the targets [m]; names of frames have no leading slash.
class SurroundingsFollower {
 public:
  /// Name of a pin or obstacle, and what is wrong with it in a sentence.
  using Faults = std::vector<std::pair<std::string, std::string>>;

  /// @param pin_accuracy_m standard deviation of a pin's position; 0: exact. @param surface of the body,
  /// which pins are meant about.
  explicit SurroundingsFollower(double pin_accuracy_m, BodySurface surface = {})
      : pin_accuracy_m_(pin_accuracy_m), surface_(std::make_shared<BodySurface>(std::move(surface))) {}

  /// Holds the vertices of a region from the next surroundingsAt() on, in place of a region of the same name.
  /// @param volume the body's tets at present. @return number of their vertices that are held.
  /// @throw std::invalid_argument if the region holds nothing, its name is not usable, or too many are held.
  std::size_t addPin(PinRegion region, const TetTopology& volume);
  /// Closes a gripper: holds what lies in a box in a frame, in place of a pin of the same name. If the body
  /// is not placed, or the frame has no pose, it takes hold when both are known.
  /// @param vertices of the body at a stamp; empty if it is not placed. @return number of vertices that are
  /// held at once. @throw std::invalid_argument as addPin().
  std::size_t grip(PinRegion region, const FrameLookup& lookup, const TetTopology& volume,
                   const Points& vertices, Nanoseconds stamp);
  /// @return false if no pin has the name.
  bool removePin(const std::string& name);
  /// Lets all pins go and holds other regions, of another body. @throw as addPin(); nothing has changed.
  void replacePins(BodySurface surface, const std::vector<PinRegion>& regions, const TetTopology& volume);

  /// Adds an obstacle, or replaces the one of the same name, from the next surroundingsAt() on.
  /// @throw std::invalid_argument if a pin has the name, or there are too many obstacles.
  void setObstacle(ObstacleDescription description);
  /// Moves an obstacle. It pushes what lies in its way.
  /// @param frame that it follows from now on. @param pose in that frame.
  /// @return false if no obstacle has the name.
  bool moveObstacle(const std::string& name, const std::string& frame, const Eigen::Isometry3d& pose);
  /// @return false if no obstacle has the name.
  bool removeObstacle(const std::string& name);

  std::vector<std::string> pinNames() const;
  std::vector<std::string> obstacleNames() const;
  /// What a pin or obstacle follows; null: none has the name.
  const FollowedFrame* followedBy(const std::string& name) const;
  /// The frame of a pin or obstacle is not known when somebody names it. @return the fault in a sentence.
  std::string reportUnknownFrame(const std::string& name);

  /// Adds the vertices that a cut created to their regions. @param vertices empty if the body is not placed.
  void updatePins(const TetTopology& volume, const Points& vertices);
  /// Pins hold the vertices where they are at the next surroundingsAt().
  void forgetPinPositions();

  /// What acts on the body at a stamp.
  /// @param vertices after the last step, or verticesToHold(); empty if the body is not placed. @param step
  /// their stamp.
  const Surroundings& surroundingsAt(Nanoseconds stamp, const FrameLookup& lookup, const Points& vertices,
                                     Nanoseconds step);

  /// What acted on the body at the last surroundingsAt(), with the pins of the last updatePins(). Obstacles
  /// and pins that were set since do not act yet.
  const NamedSurroundings& lastSurroundings() const { return surroundings_; }

  /// Finds pins that the targets of the last surroundingsAt() contradict. @param vertices after the step.
  void findConflicts(const std::vector<Target>& targets, const Tets& tets, const Points& vertices);

  /// The reactions of a step under the last surroundingsAt(), by name. Those that are not of this step are
  /// left out.
  std::vector<NamedReaction> named(const Reactions& reactions) const;

  /// The surface in the body's tets at present, for plans.
  std::shared_ptr<const BodySurface> surfaceIn(const TetTopology& volume);

  double pinAccuracy_m() const { return pin_accuracy_m_; }
  Faults faults() const;
  /// What is to be logged since the last call.
  LogLines takeLog() { return std::exchange(log_, {}); }

 private:
  struct PlacedObstacle {
    ObstacleDescription description;
    FollowedFrame frame;
  };
  struct HeldPin {
    PinnedVertices held;
    FollowedFrame frame;
    LastingFault conflict;
  };

  void requireFree(const std::string& pin);
  std::size_t insert(PinnedVertices held);
  PlacedObstacle* find(const std::string& obstacle);
  void placeObstacles(Nanoseconds stamp, const FrameLookup& lookup);
  void placePins(Nanoseconds stamp, const FrameLookup& lookup, const Points& vertices, Nanoseconds step);
  void appendPins(const std::string& name, const PinnedVertices& held);
  void judge(double conflict_m, HeldPin* pin);
  void addObstacles(const Reactions& reactions, std::vector<NamedReaction>* named) const;
  void addPins(const Reactions& reactions, std::vector<NamedReaction>* named) const;

  double pin_accuracy_m_;
  std::shared_ptr<const BodySurface> surface_;  ///< in the tets of the last edit while there are pins
  std::vector<PlacedObstacle> obstacles_;
  bool obstacles_changed_ = false;  ///< since the last surroundingsAt()
  std::map<std::string, HeldPin> pins_;
  NamedSurroundings surroundings_;  ///< of the last surroundingsAt()
  LogLines log_;
};

/// Where the pins of a body take hold that targets with `reset` place. The first time it is at rest. Placed
/// again, it may be deformed: empty, and the pins take hold after the step. @param simulator before the step.
Points verticesToHold(const TargetSet& targets, const Simulator& simulator);

}  // namespace softbody
