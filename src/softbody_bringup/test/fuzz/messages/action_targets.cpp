#include <actionlib_msgs/GoalID.h>
#include <softbody_msgs/PrepareModelAction.h>
#include <softbody_msgs/RecordAction.h>

#include <filesystem>

#include "fuzz/messages/target.h"
#include "fuzz/scratch_files.h"
#include "softbody_recordings/ros/recorder_node.h"
#include "softbody_sim/ros/nodes.h"

namespace softbody::fuzz {
namespace {

/// A node with one action.
template <typename Goal, typename Result>
class ActionTarget : public Target {
 public:
  ActionTarget(const std::string& node, const std::string& action, const DrivenNode::Make& make)
      : node_(node, {}, make), result_(&node_, node + "/" + action + "/result") {
    goal_ = add<Goal>(&node_, node + "/" + action + "/goal", 1, [this] { return good(); });
    add<actionlib_msgs::GoalID>(&node_, node + "/" + action + "/cancel", 1,
                                [] { return actionlib_msgs::GoalID(); });
  }

  std::string check() override {
    LoneRos::instance().advance(60.0);  // a goal from before a leap in time must not be later
    Goal goal = good();
    goal.goal_id.id = "check " + std::to_string(++checks_);
    goal_->send(goal);
    const bool came = node_.processUntil([&] {
      LoneRos::instance().advance(0.001);
      return result_.get() != nullptr && result_.get()->status.goal_id.id == goal.goal_id.id;
    });
    return came ? whyBad(*result_.get()) : "a good goal has no result";
  }

 protected:
  virtual Goal good() = 0;
  virtual std::string whyBad(const Result& result) = 0;

 private:
  int checks_ = 0;
  DrivenNode node_;
  Newest<Result> result_;
  TopicInput<Goal>* goal_;
};

class RecorderTarget
    : public ActionTarget<softbody_msgs::RecordActionGoal, softbody_msgs::RecordActionResult> {
 public:
  RecorderTarget()
      : ActionTarget("recorder", "record", [](const auto& handle, const auto& own) {
          return std::make_shared<RecorderNode>(handle, own);
        }) {}

 private:
  softbody_msgs::RecordActionGoal good() override {
    softbody_msgs::RecordActionGoal goal;
    goal.goal.topics = {"surface/state"};
    // An earlier goal may still be writing.
    goal.goal.file = (scratch() / ("recorded_" + std::to_string(++count_ % 8) + ".bag")).string();
    goal.goal.duration = 0.01;
    std::filesystem::remove(goal.goal.file);
    return goal;
  }

  std::string whyBad(const softbody_msgs::RecordActionResult& result) override {
    return result.result.path.empty() ? "nothing is recorded: " + result.result.message : "";
  }

  int count_ = 0;
};

/// A mesh that is made into an object takes seconds, so the good one is empty, and is refused.
class ModelServerTarget
    : public ActionTarget<softbody_msgs::PrepareModelActionGoal, softbody_msgs::PrepareModelActionResult> {
 public:
  ModelServerTarget() : ActionTarget("model_server", "prepare_model", makeModelServer) {}

 private:
  softbody_msgs::PrepareModelActionGoal good() override {
    softbody_msgs::PrepareModelActionGoal goal;
    goal.goal.mesh = fileWith("empty.obj", "");
    goal.goal.output = (scratch() / "prepared").string();
    return goal;
  }

  std::string whyBad(const softbody_msgs::PrepareModelActionResult& result) override {
    const std::string& said = result.result.message;
    return said.find("empty.obj") != std::string::npos ? "" : "an empty mesh is not refused: " + said;
  }
};

}  // namespace

std::unique_ptr<Target> makeRecorderTarget() { return std::make_unique<RecorderTarget>(); }
std::unique_ptr<Target> makeModelServerTarget() { return std::make_unique<ModelServerTarget>(); }

}  // namespace softbody::fuzz
