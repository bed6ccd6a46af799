#include "nodes/simulator/surroundings_tracker.h"

#include <fmt/format.h>

#include <stdexcept>
#include <utility>

namespace softbody {

SurroundingsTracker::SurroundingsTracker(const ros::NodeHandle& node,
                                         std::vector<ObstacleDescription> obstacles)
    : reactions_(node) {
  for (ObstacleDescription& obstacle : obstacles) obstacles_.push_back({std::move(obstacle), {}});
}

void SurroundingsTracker::addPin(const PinRegion& region, const Points& rest_vertices) {
  requireTopicName(region.name);
  for (const PlacedObstacle& obstacle : obstacles_) {
    if (obstacle.description.name == region.name)
      throw std::invalid_argument(fmt::format("pin '{}' has the name of an obstacle", region.name));
  }
  held_.insert_or_assign(region.name, HeldRegion(region, rest_vertices));
}

bool SurroundingsTracker::removePin(const std::string& name) { return held_.erase(name) > 0; }

void SurroundingsTracker::updatePins(const Points& rest_vertices, const Points& vertices) {
  for (auto& entry : held_) entry.second.updateVertices(rest_vertices, vertices);
}

void SurroundingsTracker::forgetPinPositions() {
  for (auto& entry : held_) entry.second.forgetPositions();
}

const Surroundings& SurroundingsTracker::surroundingsAt(const std::string& frame, const ros::Time& stamp,
                                                        const Points& vertices) {
  frame_ = frame;
  surroundings_ = {};
  placeObstacles(stamp);
  placePins(stamp, vertices);
  return surroundings_;
}

void SurroundingsTracker::placeObstacles(const ros::Time& stamp) {
  for (PlacedObstacle& obstacle : obstacles_) {
    const auto pose = poses_.find(obstacle.description.frame, frame_, stamp);
    if (pose) obstacle.frame_pose = pose;
    if (!obstacle.frame_pose) continue;
    surroundings_.obstacles.push_back(obstacle.description.shape);
    surroundings_.obstacles.back().pose = *obstacle.frame_pose * obstacle.description.shape.pose;
  }
}

void SurroundingsTracker::placePins(const ros::Time& stamp, const Points& vertices) {
  for (auto& entry : held_) {
    HeldRegion& held = entry.second;
    const std::string& frame = held.region().frame;
    if (!held.hasPositions() && vertices.rows() > 0) {
      const auto pose = poses_.find(frame, frame_, step_stamp_);  // the vertices are of that stamp
      if (pose) held.hold(*pose, vertices);
    }
    held.setFramePose(poses_.find(frame, frame_, stamp));
    if (held.acts()) held.appendPins(&surroundings_.pins);
  }
}

void SurroundingsTracker::publishReactions(const Reactions& reactions, const ros::Time& stamp) {
  step_stamp_ = stamp;
  if (reactions.obstacles.size() != surroundings_.obstacles.size() ||
      reactions.pins.size() != surroundings_.pins.size())
    return;
  publishObstacles(reactions, stamp);
  publishPins(reactions, stamp);
}

void SurroundingsTracker::publishObstacles(const Reactions& reactions, const ros::Time& stamp) {
  std::size_t next = 0;
  for (const PlacedObstacle& obstacle : obstacles_) {
    if (!obstacle.frame_pose) continue;
    const std::size_t k = next++;
    reactions_.publish(
        obstacle.description.name, orTargetFrame(obstacle.description.frame), *obstacle.frame_pose,
        aboutOrigin(reactions.obstacles[k], surroundings_.obstacles[k].pose.translation()), stamp);
  }
}

void SurroundingsTracker::publishPins(const Reactions& reactions, const ros::Time& stamp) {
  std::size_t next = 0;
  for (const auto& [name, held] : held_) {
    if (!held.acts()) continue;
    Wrench sum;
    for (std::size_t k = 0; k < held.vertexCount(); ++k, ++next) {
      const Wrench wrench = aboutOrigin(reactions.pins[next], surroundings_.pins[next].position);
      sum.force += wrench.force;
      sum.torque += wrench.torque;
    }
    reactions_.publish(name, orTargetFrame(held.region().frame), held.framePose(), sum, stamp);
  }
}

}  // namespace softbody
