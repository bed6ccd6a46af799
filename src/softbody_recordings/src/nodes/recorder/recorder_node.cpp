#include "softbody_recordings/ros/recorder_node.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <set>
#include <stdexcept>

#include "nodes/recorder/topic_recorder.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/ros/ros_parameters.h"

namespace softbody {
namespace {

namespace fs = std::filesystem;

constexpr double kFeedbackPeriod_s = 0.5;
constexpr double kLongest_s = 1e6;
constexpr std::uintmax_t kMegabyte = 1'000'000;

/// Absolute names. @throw std::invalid_argument for an empty name; ros::InvalidNameException.
std::set<std::string> topicsOf(const softbody_msgs::RecordGoal& goal, const ros::NodeHandle& node) {
  std::set<std::string> topics;
  for (const std::string& topic : goal.topics) {
    if (topic.empty()) throw std::invalid_argument("a name in topics is empty; leave it out");
    topics.insert(node.resolveName(topic));
  }
  if (!topics.empty()) return topics;
  for (const char* topic : topics::kResult) topics.insert(node.resolveName(topic));
  for (const char* topic : topics::kTransforms) topics.insert(topic);
  return topics;
}

/// How much ROS time has gone by. It jumps back where a bag is played in a loop; before simulated time has
/// begun, it is zero.
class PassedTime {
 public:
  /// Seconds, to be called often: a jump back counts nothing.
  double update() {
    const ros::Time now = ros::Time::now();
    if (!last_.isZero() && now > last_) passed_s_ += (now - last_).toSec();
    last_ = now;
    return passed_s_;
  }

 private:
  ros::Time last_ = ros::Time::now();
  double passed_s_ = 0.0;
};

void requireUsable(const softbody_msgs::RecordGoal& goal) {
  const fs::path file = goal.file;
  if (!file.is_absolute() || file.extension() != ".bag") {
    throw std::invalid_argument(
        fmt::format("file is '{}'; allowed: an absolute path that ends in .bag", goal.file));
  }
  if (fs::exists(fs::symlink_status(file)))
    throw std::invalid_argument(fmt::format("{} exists; choose another name", goal.file));
  if (!(goal.duration >= 0.0 && goal.duration <= kLongest_s)) {
    throw std::invalid_argument(
        fmt::format("duration is {}; allowed: 0 (until cancelled) to {:g} s", goal.duration, kLongest_s));
  }
}

void addCounts(const TopicRecorder& recorder, softbody_msgs::RecordResult* result) {
  for (const auto& [topic, count] : recorder.counts()) {
    result->topics.push_back(topic);
    result->counts.push_back(count);
  }
}

}  // namespace

RecorderNode::RecorderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node)
    : RecorderNode(node, private_node, readParameters(private_node)) {}

RecorderNode::RecorderNode(const ros::NodeHandle& node, const ros::NodeHandle& private_node,
                           Parameters parameters)
    : node_(node),
      least_free_bytes_(kMegabyte *
                        static_cast<std::uintmax_t>(parameters.integer("min_free_mb", 200, 0, 1 << 30))),
      action_(
          private_node, "record", [this](const auto& goal) { onGoal(goal); }, false) {
  warnUnknown(parameters);
  action_.start();
}

RecorderNode::~RecorderNode() {
  ends_ = true;
  action_.shutdown();
}

void RecorderNode::onGoal(const softbody_msgs::RecordGoalConstPtr& goal) {
  softbody_msgs::RecordResult result;
  try {
    requireUsable(*goal);
    TopicRecorder recorder(node_, topicsOf(*goal, node_), goal->file);
    ROS_INFO_STREAM("recording to " << goal->file);
    result.message = recordUntilEnd(*goal, &recorder);
    recorder.finish();
    result.path = goal->file;
    addCounts(recorder, &result);
  } catch (const std::exception& error) {
    result.message = fmt::format("nothing is recorded: {}", error.what());
  }
  finish(result);
}

bool RecorderNode::isStopped() const { return ends_ || !ros::ok(); }

/// @return why it ends early; empty: it does not, or it was cancelled. @throw as TopicRecorder::record().
std::string RecorderNode::recordUntilEnd(const softbody_msgs::RecordGoal& goal, TopicRecorder* recorder) {
  PassedTime passed;
  const fs::path folder = fs::path(goal.file).parent_path();
  ros::WallTime told;
  while (!action_.isPreemptRequested()) {
    if (isStopped()) return "the recorder ends";
    recorder->record();
    softbody_msgs::RecordFeedback progress;
    progress.seconds = passed.update();
    if (goal.duration > 0.0 && progress.seconds >= goal.duration) return "";
    if ((ros::WallTime::now() - told).toSec() < kFeedbackPeriod_s) continue;
    told = ros::WallTime::now();
    progress.messages = recorder->messages();
    progress.bytes = recorder->bytes();
    action_.publishFeedback(progress);
    if (fs::space(folder).available < least_free_bytes_) {
      return fmt::format("the disk of {} has less than {} MB left (min_free_mb)", folder.string(),
                         least_free_bytes_ / kMegabyte);
    }
  }
  return "";
}

void RecorderNode::finish(const softbody_msgs::RecordResult& result) {
  if (!result.message.empty()) {
    ROS_WARN_STREAM((result.path.empty() ? "" : result.path + " ends early: ") << result.message);
    return action_.setAborted(result, result.message);
  }
  ROS_INFO_STREAM("recorded: " << result.path);
  if (action_.isPreemptRequested()) return action_.setPreempted(result, "cancelled; the recording is kept");
  action_.setSucceeded(result);
}

}  // namespace softbody
