#include "nodes/surroundings_tracker.h"

#include <fmt/format.h>
#include <geometry_msgs/WrenchStamped.h>
#include <tf2_eigen/tf2_eigen.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "softbody_common/topics.h"

namespace softbody {
namespace {

geometry_msgs::Vector3 toMessage(const Eigen::Vector3d& vector) {
  geometry_msgs::Vector3 message;
  message.x = vector.x();
  message.y = vector.y();
  message.z = vector.z();
  return message;
}

/// The same wrench about the origin of the targets' frame.
Wrench aboutOrigin(const Wrench& wrench, const Eigen::Vector3d& place) {
  return {wrench.force, wrench.torque + place.cross(wrench.force)};
}

/// Ascending.
std::vector<int> verticesIn(const PinRegion& region, const Points& rest_vertices) {
  std::vector<int> vertices;
  for (int v = 0; v < rest_vertices.rows(); ++v) {
    const Eigen::Array3d p = rest_vertices.row(v).transpose().array();
    if ((p >= region.min.array()).all() && (p <= region.max.array()).all()) vertices.push_back(v);
  }
  return vertices;
}

}  // namespace

SurroundingsTracker::SurroundingsTracker(const ros::NodeHandle& node,
                                         std::vector<ObstacleDescription> obstacles)
    : node_(node), listener_(buffer_) {
  for (ObstacleDescription& obstacle : obstacles) obstacles_.push_back({std::move(obstacle), {}});
}

void SurroundingsTracker::hold(const PinRegion& region, const Points& rest_vertices) {
  requireTopicName(region.name);
  for (const Placed& obstacle : obstacles_) {
    if (obstacle.description.name == region.name)
      throw std::invalid_argument(fmt::format("pin '{}' has the name of an obstacle", region.name));
  }
  Held held{region, verticesIn(region, rest_vertices), {}, Eigen::Isometry3d::Identity(), false};
  if (held.vertices.empty())
    throw std::invalid_argument(
        fmt::format("no vertex of the volume lies in the box of pin '{}'", region.name));
  held_[region.name] = std::move(held);
}

void SurroundingsTracker::regionsChanged(const Points& rest_vertices, const Points& vertices) {
  for (auto& entry : held_) {
    Held& held = entry.second;
    const std::vector<int> before = std::exchange(held.vertices, verticesIn(held.region, rest_vertices));
    if (vertices.rows() == 0) held.places.reset();
    if (!held.places) continue;
    Points places(static_cast<Eigen::Index>(held.vertices.size()), 3);
    for (std::size_t k = 0; k < held.vertices.size(); ++k) {
      const auto known = std::lower_bound(before.begin(), before.end(), held.vertices[k]);
      const auto row = static_cast<Eigen::Index>(k);
      if (known != before.end() && *known == held.vertices[k])
        places.row(row) = held.places->row(known - before.begin());
      else
        places.row(row) = held.frame_pose.inverse() * Eigen::Vector3d(vertices.row(held.vertices[k]));
    }
    held.places = std::move(places);
  }
}

bool SurroundingsTracker::release(const std::string& name) { return held_.erase(name) > 0; }

void SurroundingsTracker::forgetPlaces() {
  for (auto& entry : held_) entry.second.places.reset();
}

std::optional<Eigen::Isometry3d> SurroundingsTracker::poseOf(const std::string& frame,
                                                             const std::string& target_frame,
                                                             const ros::Time& stamp) const {
  if (frame.empty() || frame == target_frame) return Eigen::Isometry3d::Identity();
  for (const ros::Time& time : {stamp, ros::Time()}) {  // the zero time: the latest there is
    try {
      return Eigen::Isometry3d(
          tf2::transformToEigen(buffer_.lookupTransform(target_frame, frame, time)).matrix());
    } catch (const tf2::TransformException& error) {
      if (time.isZero())
        ROS_WARN_STREAM_THROTTLE(5.0, "frame " << frame << " is not known: " << error.what());
    }
  }
  return {};
}

/// Where the vertices are in the region's frame: both at the instant of the last step.
void SurroundingsTracker::grip(const Points& vertices, Held* held) const {
  const auto pose = poseOf(held->region.frame, frame_, stepped_);
  if (!pose) return;
  held->places.emplace(static_cast<Eigen::Index>(held->vertices.size()), 3);
  for (std::size_t k = 0; k < held->vertices.size(); ++k) {
    held->places->row(static_cast<Eigen::Index>(k)) =
        pose->inverse() * Eigen::Vector3d(vertices.row(held->vertices[k]));
  }
}

Surroundings SurroundingsTracker::at(const std::string& frame, const ros::Time& stamp,
                                     const Points& vertices) {
  frame_ = frame;
  last_ = {};
  for (Placed& obstacle : obstacles_) {
    const auto pose = poseOf(obstacle.description.frame, frame, stamp);
    if (pose) obstacle.frame_pose = pose;
    if (!obstacle.frame_pose) continue;
    last_.obstacles.push_back(obstacle.description.shape);
    last_.obstacles.back().pose = *obstacle.frame_pose * obstacle.description.shape.pose;
  }
  for (auto& entry : held_) {
    Held& held = entry.second;
    if (!held.places && vertices.rows() > 0) grip(vertices, &held);
    const auto pose = poseOf(held.region.frame, frame, stamp);
    held.acts = held.places && (pose || held.acts);
    if (!held.acts) continue;
    if (pose) held.frame_pose = *pose;
    for (std::size_t k = 0; k < held.vertices.size(); ++k) {
      const Eigen::Vector3d place = held.places->row(static_cast<Eigen::Index>(k));
      last_.pins.push_back({held.vertices[k], held.frame_pose * place});
    }
  }
  return last_;
}

void SurroundingsTracker::publish(const Reactions& reactions, const ros::Time& stamp) {
  stepped_ = stamp;
  if (reactions.obstacles.size() != last_.obstacles.size() || reactions.pins.size() != last_.pins.size())
    return;
  std::size_t next_obstacle = 0, next_pin = 0;
  for (const Placed& obstacle : obstacles_) {
    if (!obstacle.frame_pose) continue;
    const std::size_t k = next_obstacle++;
    publishWrench(obstacle.description.name, obstacle.description.frame, *obstacle.frame_pose,
                  aboutOrigin(reactions.obstacles[k], last_.obstacles[k].pose.translation()), stamp);
  }
  for (const auto& [name, held] : held_) {
    if (!held.acts) continue;
    Wrench sum;
    for (std::size_t k = 0; k < held.vertices.size(); ++k, ++next_pin) {
      const Wrench wrench = aboutOrigin(reactions.pins[next_pin], last_.pins[next_pin].position);
      sum.force += wrench.force;
      sum.torque += wrench.torque;
    }
    publishWrench(name, held.region.frame, held.frame_pose, sum, stamp);
  }
}

void SurroundingsTracker::publishWrench(const std::string& name, const std::string& frame,
                                        const Eigen::Isometry3d& frame_pose, const Wrench& about_origin,
                                        const ros::Time& stamp) {
  ros::Publisher& publisher = publishers_[name];
  if (!publisher) publisher = node_.advertise<geometry_msgs::WrenchStamped>(topics::kReaction + name, 10);
  const Eigen::Matrix3d to_frame = frame_pose.linear().transpose();
  geometry_msgs::WrenchStamped message;
  message.header.stamp = stamp;
  message.header.frame_id = frame.empty() ? frame_ : frame;
  message.wrench.force = toMessage(to_frame * about_origin.force);
  message.wrench.torque =
      toMessage(to_frame * (about_origin.torque - frame_pose.translation().cross(about_origin.force)));
  publisher.publish(message);
}

}  // namespace softbody
