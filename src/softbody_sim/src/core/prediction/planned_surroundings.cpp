#include "prediction/planned_surroundings.h"

#include <fmt/format.h>

#include <stdexcept>

namespace softbody {
namespace {

/// At present. @param vertices then.
Eigen::Vector3d centerOf(const PlannedPins& planned, const BodySurface& surface, const TetTopology& topology,
                         const Points& vertices) {
  if (planned.region && planned.region->in_frame)
    return planned.frame * (0.5 * (planned.region->min + planned.region->max));
  std::vector<Eigen::Vector3d> places;
  for (const Pin& pin : planned.held) places.push_back(pin.position);
  if (planned.region) {
    for (const int v :
         surface.verticesToHold(planned.region->box(), Eigen::Isometry3d::Identity(), topology.rest_vertices))
      places.push_back(vertices.row(v));
  }
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& place : places) sum += place;
  return places.empty() ? sum : Eigen::Vector3d(sum / static_cast<double>(places.size()));
}

}  // namespace

PlannedSurroundings::PlannedSurroundings(const MotionPlan& plan, const TetTopology& topology,
                                         const Points& vertices)
    : plan_(&plan), topology_(&topology), holds_(plan.pins.size()) {
  for (std::size_t k = 0; k < plan.pins.size(); ++k)
    holds_[k] = {!plan.pins[k].region, centerOf(plan.pins[k], *plan.surface, topology, vertices),
                 plan.pins[k].held};
  for (std::size_t k = 0; k < plan.obstacles.size(); ++k)
    if (plan.obstacles[k].acts_now) active_obstacles_.push_back(k);
}

const Surroundings& PlannedSurroundings::during(double begin_s, double end_s, const Points& vertices) {
  surroundings_.pins.clear();
  pin_owners_.clear();
  for (std::size_t k = 0; k < plan_->pins.size(); ++k) {
    const PlannedPins& planned = plan_->pins[k];
    if (!planned.period.contains(end_s)) continue;
    if (!holds_[k].began) takeHold(planned, begin_s, vertices, &holds_[k]);
    const Eigen::Isometry3d motion = planned.path.at(end_s, holds_[k].center);
    for (const Pin& pin : holds_[k].pins)
      surroundings_.pins.push_back({pin.vertex, motion * pin.position, pin.accuracy_m});
    pin_owners_.resize(surroundings_.pins.size(), k);
  }
  const std::vector<std::size_t> before = std::move(active_obstacles_);
  active_obstacles_.clear();
  surroundings_.obstacles.clear();
  for (std::size_t k = 0; k < plan_->obstacles.size(); ++k) {
    const PlannedObstacle& planned = plan_->obstacles[k];
    if (!planned.period.contains(end_s)) continue;
    active_obstacles_.push_back(k);
    surroundings_.obstacles.push_back(planned.shape);
    surroundings_.obstacles.back().pose =
        planned.path.at(end_s, planned.shape.pose.translation()) * planned.shape.pose;
  }
  surroundings_.obstacles_changed = before != active_obstacles_;
  return surroundings_;
}

void PlannedSurroundings::takeHold(const PlannedPins& planned, double time_s, const Points& vertices,
                                   Hold* hold) const {
  const Eigen::Isometry3d back = planned.path.at(time_s, hold->center).inverse();
  const bool in_frame = planned.region->in_frame;
  const Eigen::Isometry3d T_box_points =
      in_frame ? planned.frame.inverse() * back : Eigen::Isometry3d::Identity();
  const Points& places = in_frame ? vertices : topology_->rest_vertices;
  const std::vector<int> held = plan_->surface->verticesToHold(planned.region->box(), T_box_points, places);
  if (held.empty()) {
    throw std::invalid_argument(
        fmt::format("pin '{}' holds nothing at {:.3g} s: nothing of the body is in its box; {}; move or "
                    "enlarge the box",
                    planned.name, planned.period.begin_s,
                    plan_->surface->nearestTo(planned.region->box(), T_box_points, places)));
  }
  hold->began = true;
  for (const int v : held)
    hold->pins.push_back({v, back * Eigen::Vector3d(vertices.row(v)), planned.accuracy_m});
}

std::map<std::string, Wrench> PlannedSurroundings::sumsOf(const Reactions& reactions) const {
  std::map<std::string, Wrench> sums;
  const auto add = [&sums](const std::string& name, const Wrench& wrench, const Eigen::Vector3d& place) {
    Wrench& sum = sums[name];
    sum.force += wrench.force;
    sum.torque += wrench.torque + place.cross(wrench.force);
  };
  for (std::size_t k = 0; k < reactions.pins.size(); ++k)
    add(plan_->pins[pin_owners_[k]].name, reactions.pins[k], surroundings_.pins[k].position);
  for (std::size_t k = 0; k < reactions.obstacles.size(); ++k)
    add(nameOf(static_cast<int>(k)), reactions.obstacles[k], surroundings_.obstacles[k].pose.translation());
  return sums;
}

}  // namespace softbody
