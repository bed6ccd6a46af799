#include "nodes/prediction/plan_messages.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <stdexcept>
#include <utility>

#include "softbody_common/ros/frame_name.h"
#include "softbody_common/ros/geometry_messages.h"
#include "softbody_sim/ros/conversions.h"

namespace softbody {
namespace {

// The time of a step grows with both.
constexpr std::size_t kMostPins = 1000, kMostObstacles = 1000;
constexpr std::size_t kMostNamesSaid = 10;  // in one sentence

std::string shortened(const std::string& name) { return name.substr(0, 100); }

std::string frameOf(const softbody_msgs::PlannedPin& pin) {
  return frameName(pin.header.frame_id, fmt::format("planned pin '{}'", shortened(pin.name)));
}

std::string frameOf(const softbody_msgs::PlannedObstacle& obstacle) {
  return frameName(obstacle.header.frame_id, fmt::format("planned obstacle '{}'", shortened(obstacle.name)));
}

/// What the messages of a plan say, by name.
class PlanReader {
 public:
  PlanReader(const Present& present, double time_step_s) : present_(present), time_step_s_(time_step_s) {
    plan_.surface = present.surface;
  }

  void addPresent();
  void add(const softbody_msgs::PlannedPin& message);
  void add(const softbody_msgs::PlannedObstacle& message);
  void add(const softbody_msgs::PlannedRelease& message);
  void add(const softbody_msgs::PlannedMotion& message);
  MotionPlan take() { return std::move(plan_); }

 private:
  /// A pin or an obstacle of the plan.
  struct Entry {
    bool is_pin;
    std::size_t index;
    bool is_present, moves = false, is_released = false;
  };
  void insert(const std::string& name, const Entry& entry);
  Entry& find(const std::string& name);
  RigidPath& pathOf(const Entry& entry);
  ActivePeriod& periodOf(const Entry& entry);
  ActivePeriod period(double begin_s, double end_s, const char* begin_name, const char* end_name) const;
  Eigen::Isometry3d poseOf(const std::string& frame) const;
  std::string namesInPlan() const;

  const Present& present_;
  const double time_step_s_;
  MotionPlan plan_;
  std::map<std::string, Entry> entries_;
};

void requireTime(double time_s, const char* field) {
  if (time_s >= 0.0 && time_s <= kLongestPrediction_s) return;
  throw std::invalid_argument(
      fmt::format("{} is {} s; allowed: 0 to {} s", field, time_s, kLongestPrediction_s));
}

Eigen::Isometry3d motionOf(const std::vector<geometry_msgs::Pose>& poses, std::size_t k) {
  try {
    return fromMessage(poses[k]);
  } catch (const std::invalid_argument& error) {
    throw std::invalid_argument(fmt::format("poses[{}]: {}", k, error.what()));
  }
}

/// When a planned pin or obstacle acts. @param end_s 0: it stays.
ActivePeriod PlanReader::period(double begin_s, double end_s, const char* begin_name,
                                const char* end_name) const {
  requireTime(begin_s, begin_name);
  requireTime(end_s, end_name);
  if (end_s == 0.0) return {begin_s, std::numeric_limits<double>::infinity()};
  if (end_s <= begin_s) {
    throw std::invalid_argument(fmt::format("{} {} s is not after {} {} s: let it end later, or never (0)",
                                            end_name, end_s, begin_name, begin_s));
  }
  const ActivePeriod period{begin_s, end_s};
  if (period.holdsStep(time_step_s_)) return period;
  throw std::invalid_argument(
      fmt::format("no step of {:.4g} s ends between {} {} s and {} {} s: let it act longer, or "
                  "ask for shorter steps",
                  time_step_s_, begin_name, begin_s, end_name, end_s));
}

void PlanReader::insert(const std::string& name, const Entry& entry) {
  if (entries_.emplace(name, entry).second) return;
  throw std::invalid_argument("a pin or an obstacle of the plan has this name already: choose another");
}

void PlanReader::addPresent() {
  const NamedSurroundings& now = present_.surroundings;
  for (std::size_t k = 0; k < now.pins.size(); ++k) {
    const Entry next{true, plan_.pins.size(), true};
    const auto entry = entries_.emplace(now.pins[k], next);
    if (entry.second) plan_.pins.push_back({now.pins[k], {}, {}});
    plan_.pins[entry.first->second.index].held.push_back(now.all.pins[k]);
  }
  for (std::size_t k = 0; k < now.obstacles.size(); ++k) {
    insert(now.obstacles[k], {false, k, true});
    plan_.obstacles.push_back({now.obstacles[k], now.all.obstacles[k], true});
  }
}

std::string PlanReader::namesInPlan() const {
  std::string names;
  std::size_t count = 0;
  for (const auto& entry : entries_) {
    if (++count > kMostNamesSaid) return names + ", ...";
    names += (names.empty() ? "" : ", ") + entry.first;
  }
  return names.empty() ? "none" : names;
}

PlanReader::Entry& PlanReader::find(const std::string& name) {
  const auto found = entries_.find(name);
  if (found != entries_.end()) return found->second;
  throw std::invalid_argument(fmt::format(
      "no pin or obstacle has this name at present, and the plan adds none; known names: {}. Add "
      "it to the plan, or set it by the services pin or set_obstacle; then it acts from the next step on",
      namesInPlan()));
}

RigidPath& PlanReader::pathOf(const Entry& entry) {
  return entry.is_pin ? plan_.pins[entry.index].path : plan_.obstacles[entry.index].path;
}

ActivePeriod& PlanReader::periodOf(const Entry& entry) {
  return entry.is_pin ? plan_.pins[entry.index].period : plan_.obstacles[entry.index].period;
}

Eigen::Isometry3d PlanReader::poseOf(const std::string& frame) const {
  if (frame.empty()) return Eigen::Isometry3d::Identity();
  const auto found = present_.frames.find(frame);
  if (found != present_.frames.end()) return found->second;
  throw std::invalid_argument(
      fmt::format("tf does not know frame '{}' in '{}': check the name, and that a node publishes the frame",
                  shortened(frame), present_.header.frame_id));
}

void PlanReader::add(const softbody_msgs::PlannedPin& message) {
  softbody_msgs::PinRequest box;
  box.header = message.header;
  box.name = message.name;
  box.min = message.min;
  box.max = message.max;
  PlannedPins pins{message.name, {}, fromMessage(box)};
  pins.region->in_frame = message.in_frame != 0;
  pins.accuracy_m = present_.pin_accuracy_m;
  pins.period = period(message.grip_time, message.release_time, "grip_time", "release_time");
  if (plan_.pins.size() >= kMostPins)
    throw std::invalid_argument(fmt::format("the plan has {} pins already: add fewer", plan_.pins.size()));
  if (message.in_frame) {
    pins.frame = poseOf(frameOf(message));
  } else if (!message.header.frame_id.empty()) {
    throw std::invalid_argument(fmt::format(
        "frame_id is '{}', but the box is in rest space, and a plan follows no frame: set in_frame "
        "if the box is in this frame at present, or leave frame_id empty",
        shortened(message.header.frame_id)));
  } else {
    const Points& rest = present_.simulator->topology().rest_vertices;
    present_.surface->verticesAtRest("its box", pins.region->box(), rest);  // throws if it holds nothing
  }
  insert(pins.name, {true, plan_.pins.size(), false});
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
  obstacle.shape.pose = poseOf(frameOf(message)) * obstacle.shape.pose;
  obstacle.period = period(message.begin_time, message.end_time, "begin_time", "end_time");
  if (plan_.obstacles.size() >= kMostObstacles) {
    throw std::invalid_argument(
        fmt::format("the plan has {} obstacles already: add fewer", plan_.obstacles.size()));
  }
  insert(obstacle.name, {false, plan_.obstacles.size(), false});
  plan_.obstacles.push_back(std::move(obstacle));
}

void PlanReader::add(const softbody_msgs::PlannedRelease& message) {
  Entry& entry = find(message.name);
  if (!entry.is_present) {
    throw std::invalid_argument(
        "the plan adds what has this name: set the release_time of the pin, or the end_time of the "
        "obstacle instead");
  }
  if (std::exchange(entry.is_released, true))
    throw std::invalid_argument("the plan releases it twice: give one release");
  requireTime(message.time, "time");
  periodOf(entry).end_s = message.time;
}

void PlanReader::add(const softbody_msgs::PlannedMotion& message) {
  Entry& entry = find(message.name);
  if (std::exchange(entry.moves, true))
    throw std::invalid_argument("the plan moves it twice: give one motion with all times");
  requireAscending(message.times, "times");
  if (message.times.size() != message.poses.size()) {
    throw std::invalid_argument(fmt::format("{} times with {} poses: give one pose per time",
                                            message.times.size(), message.poses.size()));
  }
  RigidPath& path = pathOf(entry);
  path.times_s = message.times;
  for (std::size_t k = 0; k < message.poses.size(); ++k) path.motions.push_back(motionOf(message.poses, k));
}

/// @param field of the messages in the plan, for errors.
template <typename Messages>
void addAll(const Messages& messages, const char* field, PlanReader* reader) {
  for (std::size_t k = 0; k < messages.size(); ++k) {
    try {
      reader->add(messages[k]);
    } catch (const std::invalid_argument& error) {
      throw std::invalid_argument(
          fmt::format("{}[{}] '{}': {}", field, k, shortened(messages[k].name), error.what()));
    }
  }
}

}  // namespace

void requireAscending(const std::vector<double>& times, const std::string& what) {
  double before = 0.0;
  for (const double time : times) {
    if (!(time > 0.0)) {  // also NaN
      throw std::invalid_argument(fmt::format(
          "{}: {} s is not above 0; the present is time 0 and needs no entry: leave it out", what, time));
    }
    if (time > kLongestPrediction_s) {
      throw std::invalid_argument(
          fmt::format("{}: {} s is too long; allowed: up to {} s", what, time, kLongestPrediction_s));
    }
    if (time <= before) {
      throw std::invalid_argument(
          fmt::format("{}: {} s comes after {} s: give ascending times, each once", what, time, before));
    }
    before = time;
  }
}

std::set<std::string> framesOf(const std::vector<softbody_msgs::MotionPlan>& plans) {
  std::set<std::string> frames;
  for (const softbody_msgs::MotionPlan& plan : plans) {
    for (const softbody_msgs::PlannedPin& pin : plan.pins)
      if (pin.in_frame) frames.insert(frameOf(pin));
    for (const softbody_msgs::PlannedObstacle& obstacle : plan.obstacles) frames.insert(frameOf(obstacle));
  }
  frames.erase("");
  return frames;
}

MotionPlan fromMessage(const softbody_msgs::MotionPlan& message, const Present& present, double time_step_s) {
  PlanReader reader(present, time_step_s);
  reader.addPresent();
  addAll(message.pins, "pins", &reader);
  addAll(message.obstacles, "obstacles", &reader);
  addAll(message.releases, "releases", &reader);
  addAll(message.motions, "motions", &reader);
  return reader.take();
}

}  // namespace softbody
