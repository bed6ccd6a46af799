#include "nodes/prediction/plan_messages.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <stdexcept>

#include "softbody_common/ros/geometry_messages.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

std::string shortened(const std::string& name) { return name.substr(0, 100); }

/// What the messages of a plan say, by name.
class PlanReader {
 public:
  explicit PlanReader(const Present& present) : present_(present) {}

  void addPresent();
  void add(const softbody_msgs::PlannedPin& message);
  void add(const softbody_msgs::PlannedObstacle& message);
  void add(const softbody_msgs::PlannedRelease& message);
  void add(const softbody_msgs::PlannedMotion& message);
  MotionPlan take() { return std::move(plan_); }

 private:
  /// Path and period of a pin or an obstacle.
  struct Entry {
    RigidPath* path;
    ActivePeriod* period;
    bool is_present, moves;
  };
  void requireFree(const std::string& name) const;
  Entry find(const std::string& name);
  Eigen::Isometry3d poseOf(const std::string& frame, const std::string& what) const;

  const Present& present_;
  MotionPlan plan_;
  std::size_t present_pins_ = 0, present_obstacles_ = 0;
};

double endOf(double time_s) { return time_s == 0.0 ? std::numeric_limits<double>::infinity() : time_s; }

ActivePeriod periodOf(double begin_s, double end_s, const std::string& what) {
  for (const double time : {begin_s, end_s}) {
    if (time >= 0.0 && time <= kLongestPrediction_s) continue;
    throw std::invalid_argument(
        fmt::format("{}: its time is {} s; allowed: 0 to {} s", what, time, kLongestPrediction_s));
  }
  if (end_s != 0.0 && end_s <= begin_s)
    throw std::invalid_argument(
        fmt::format("{}: it ends at {} s, but it begins at {} s; let it end later", what, end_s, begin_s));
  return {begin_s, endOf(end_s)};
}

void PlanReader::addPresent() {
  const NamedSurroundings& now = present_.surroundings;
  std::map<std::string, std::size_t> known;
  for (std::size_t k = 0; k < now.pins.size(); ++k) {
    const auto entry = known.emplace(now.pins[k], plan_.pins.size());
    if (entry.second) plan_.pins.push_back({now.pins[k], {}, {}});
    plan_.pins[entry.first->second].held.push_back(now.all.pins[k]);
  }
  for (std::size_t k = 0; k < now.obstacles.size(); ++k)
    plan_.obstacles.push_back({now.obstacles[k], now.all.obstacles[k]});
  present_pins_ = plan_.pins.size();
  present_obstacles_ = plan_.obstacles.size();
}

PlanReader::Entry PlanReader::find(const std::string& name) {
  for (std::size_t k = 0; k < plan_.pins.size(); ++k) {
    PlannedPins& pins = plan_.pins[k];
    if (pins.name == name) return {&pins.path, &pins.period, k < present_pins_, !pins.path.times_s.empty()};
  }
  for (std::size_t k = 0; k < plan_.obstacles.size(); ++k) {
    PlannedObstacle& obstacle = plan_.obstacles[k];
    if (obstacle.name == name)
      return {&obstacle.path, &obstacle.period, k < present_obstacles_, !obstacle.path.times_s.empty()};
  }
  throw std::invalid_argument(fmt::format(
      "no pin or obstacle that acts has the name '{}': add it to the plan, or set it by the services pin or "
      "set_obstacle first",
      shortened(name)));
}

void PlanReader::requireFree(const std::string& name) const {
  const auto has = [&](const auto& entries) {
    return std::any_of(entries.begin(), entries.end(), [&](const auto& entry) { return entry.name == name; });
  };
  if (has(plan_.pins) || has(plan_.obstacles))
    throw std::invalid_argument(
        fmt::format("the plan adds '{}', but a pin or an obstacle has that name already: choose another",
                    shortened(name)));
}

Eigen::Isometry3d PlanReader::poseOf(const std::string& frame, const std::string& what) const {
  if (frame.empty()) return Eigen::Isometry3d::Identity();
  const auto found = present_.frames.find(frame);
  if (found != present_.frames.end()) return found->second;
  throw std::invalid_argument(fmt::format("{}: tf does not know frame '{}' in '{}'; check the name", what,
                                          shortened(frame), present_.header.frame_id));
}

void PlanReader::add(const softbody_msgs::PlannedPin& message) {
  softbody_msgs::PinRequest box;
  box.header = message.header;
  box.name = message.name;
  box.min = message.min;
  box.max = message.max;
  PlannedPins pins{message.name, {}, fromMessage(box)};
  requireFree(pins.name);
  const std::string what = fmt::format("pin '{}'", pins.name);
  pins.region->in_frame = message.in_frame != 0;
  pins.accuracy_m = present_.pin_accuracy_m;
  pins.period = periodOf(message.grip_time, message.release_time, what);
  if (message.in_frame)
    pins.frame = poseOf(message.header.frame_id, what);
  else if (verticesIn(*pins.region, Eigen::Isometry3d::Identity(),
                      present_.simulator->topology().rest_vertices)
               .empty())
    throw std::invalid_argument(fmt::format("the box of {} contains no vertex of the volume", what));
  plan_.pins.push_back(std::move(pins));
}

void PlanReader::add(const softbody_msgs::PlannedObstacle& message) {
  softbody_msgs::SetObstacleRequest shape;
  shape.header = message.header;
  shape.name = message.name;
  shape.shape = message.shape;
  shape.radius = message.radius;
  shape.length = message.length;
  shape.size = message.size;
  shape.pose = message.pose;
  shape.friction = message.friction;
  PlannedObstacle obstacle{message.name, fromMessage(shape).shape};
  requireFree(obstacle.name);
  const std::string what = fmt::format("obstacle '{}'", obstacle.name);
  obstacle.shape.pose = poseOf(message.header.frame_id, what) * obstacle.shape.pose;
  obstacle.period = periodOf(message.begin_time, message.end_time, what);
  plan_.obstacles.push_back(obstacle);
}

void PlanReader::add(const softbody_msgs::PlannedRelease& message) {
  const Entry entry = find(message.name);
  const std::string what = fmt::format("release of '{}'", shortened(message.name));
  if (!entry.is_present)
    throw std::invalid_argument(
        fmt::format("{}: the plan adds it, so its own message says when it ends", what));
  if (entry.period->end_s != ActivePeriod().end_s)
    throw std::invalid_argument(fmt::format("two releases of '{}' in one plan", shortened(message.name)));
  periodOf(0.0, message.time, what);
  entry.period->end_s = message.time;
}

void PlanReader::add(const softbody_msgs::PlannedMotion& message) {
  const Entry entry = find(message.name);
  const std::string what = fmt::format("motion of '{}'", shortened(message.name));
  if (entry.moves)
    throw std::invalid_argument(fmt::format("two motions of '{}' in one plan", shortened(message.name)));
  requireAscending(message.times, what);
  if (message.times.size() != message.poses.size()) {
    throw std::invalid_argument(
        fmt::format("{}: {} times with {} poses", what, message.times.size(), message.poses.size()));
  }
  entry.path->times_s = message.times;
  for (const geometry_msgs::Pose& pose : message.poses) entry.path->motions.push_back(fromMessage(pose));
}

}  // namespace

void requireAscending(const std::vector<double>& times, const std::string& what) {
  double before = 0.0;
  for (const double time : times) {
    if (!(time > before && time <= kLongestPrediction_s)) {
      throw std::invalid_argument(
          fmt::format("{}: {} s comes after {} s; allowed: ascending times above 0, up to {} s", what, time,
                      before, kLongestPrediction_s));
    }
    before = time;
  }
}

std::set<std::string> framesOf(const std::vector<softbody_msgs::MotionPlan>& plans) {
  std::set<std::string> frames;
  for (const softbody_msgs::MotionPlan& plan : plans) {
    for (const softbody_msgs::PlannedPin& pin : plan.pins)
      if (pin.in_frame) frames.insert(pin.header.frame_id);
    for (const softbody_msgs::PlannedObstacle& obstacle : plan.obstacles)
      frames.insert(obstacle.header.frame_id);
  }
  frames.erase("");
  return frames;
}

MotionPlan fromMessage(const softbody_msgs::MotionPlan& message, const Present& present) {
  PlanReader reader(present);
  reader.addPresent();
  for (const softbody_msgs::PlannedPin& pin : message.pins) reader.add(pin);
  for (const softbody_msgs::PlannedObstacle& obstacle : message.obstacles) reader.add(obstacle);
  for (const softbody_msgs::PlannedRelease& release : message.releases) reader.add(release);
  for (const softbody_msgs::PlannedMotion& motion : message.motions) reader.add(motion);
  return reader.take();
}

}  // namespace softbody
