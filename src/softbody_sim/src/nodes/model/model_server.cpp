#include "nodes/model/model_server.h"

#include <exception>
#include <filesystem>
#include <sstream>

#include "nodes/give_way.h"
#include "nodes/model/model_goal.h"
#include "softbody_common/files/input_file.h"
#include "softbody_sim/report/model_folder.h"

namespace softbody {
namespace {

/// Ends the work. It is no std::exception, so that nobody takes it for a mesh that cannot be used.
struct Cancelled {};

}  // namespace

ModelServer::ModelServer(const ros::NodeHandle& /*node*/, const ros::NodeHandle& private_node)
    : action_(
          private_node, "prepare_model", [this](const auto& goal) { onGoal(goal); }, false) {
  action_.start();
}

ModelServer::~ModelServer() {
  ends_ = true;
  action_.shutdown();
}

void ModelServer::onGoal(const softbody_msgs::PrepareModelGoalConstPtr& goal) {
  giveWay();
  softbody_msgs::PrepareModelResult result;
  try {
    result = prepare(*goal);
    ROS_INFO_STREAM("written: " << result.object << ", verdict: " << result.verdict);
    return action_.setSucceeded(result);
  } catch (const Cancelled&) {
    result.message = goal->output + " is as it was: the goal was cancelled";
    return action_.setPreempted(result, result.message);
  } catch (const std::exception& error) {
    result.message = error.what();
    ROS_WARN_STREAM("no object is made: " << result.message);
  }
  action_.setAborted(result, result.message);
}

/// @throw Cancelled; std::exception if the mesh is refused or the folder cannot be written.
softbody_msgs::PrepareModelResult ModelServer::prepare(const softbody_msgs::PrepareModelGoal& goal) {
  const ModelSource source = sourceOf(goal);
  VolumeSettings settings = settingsOf(goal);
  double told = -1.0;
  settings.progress = [&](double share) { tell(share, &told); };
  std::ostringstream printed;
  softbody_msgs::PrepareModelResult result;
  result.verdict = nameOf(prepareModel(source, goal.output, settings, printed));
  const std::filesystem::path folder = std::filesystem::path(goal.output).lexically_normal();
  result.object = (folder / "object.yaml").string();
  result.report = readFile(folder / "report/report.md");
  return result;
}

/// @param told share of the last feedback. @throw Cancelled
void ModelServer::tell(double share, double* told) {
  constexpr double kStep = 0.01;  // a percent: what a bar shows
  if (share >= 1.0) return;       // written
  if (ends_ || action_.isPreemptRequested()) throw Cancelled();
  if (share - *told < kStep) return;
  *told = share;
  softbody_msgs::PrepareModelFeedback progress;
  progress.stage = share < kModelShare ? "model" : "report";
  progress.share = static_cast<float>(share);
  action_.publishFeedback(progress);
}

}  // namespace softbody
