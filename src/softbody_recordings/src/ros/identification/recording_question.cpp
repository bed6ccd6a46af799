#include "ros/identification/recording_question.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "identification/recorded_observations.h"
#include "identification/sensor_check.h"
#include "ros/identification/seen_frames.h"
#include "softbody_common/ros/frame_name.h"
#include "softbody_sim/object/vertex_region.h"

namespace softbody {
namespace {

constexpr double kGravity = 9.81;      // [m/s^2]
constexpr double kWeightShare = 0.01;  // deviation of a weight that was weighed

/// REGION@FRAME; without a frame the region stays where it is. The frame names the pin.
PinRegion pinOf(const std::string& text, std::size_t number) {
  const std::size_t at = text.find('@');
  const Eigen::AlignedBox3d box = boxOf(text.substr(0, at));
  const std::string frame = at == std::string::npos ? "" : withoutSlash(text.substr(at + 1));
  return {frame.empty() ? fmt::format("pin{}", number) : frame, frame, box.min(), box.max()};
}

std::vector<PinRegion> pinsOf(const RecordingQuestion& question, const ObjectDescription& description) {
  std::vector<PinRegion> pins = description.pins;
  for (PinRegion& pin : pins) pin.frame = withoutSlash(pin.frame);
  for (const std::string& text : question.pins) pins.push_back(pinOf(text, pins.size()));
  return pins;
}

/// Something must hold the body, and every measured force must be at something.
void requireNames(const RecordingQuestion& question, const SurroundingsConfig& surroundings,
                  const std::vector<PinRegion>& pins) {
  std::vector<std::string> names;
  for (const PinRegion& pin : pins) names.push_back(pin.name);
  for (const ObstacleDescription& obstacle : surroundings.obstacles) names.push_back(obstacle.name);
  if (surroundings.gripper) names.push_back(surroundings.gripper->name);
  if (names.empty())
    throw std::invalid_argument(
        "nothing holds the body: give the object pins, or name the held part with --pin REGION@FRAME, for "
        "example --pin \"x<0.01@clamp\" [m]");
  const auto require = [&names](const std::string& option, const std::string& name) {
    if (std::find(names.begin(), names.end(), name) != names.end()) return;
    throw std::invalid_argument(fmt::format("{}: there is no pin or obstacle '{}'; there are: {}", option,
                                            name, fmt::join(names, ", ")));
  };
  for (const WrenchTopic& wrench : question.wrenches) require("--wrench " + wrench.topic, wrench.at);
  for (const LaidWeight& weight : question.weights) require("--weight", weight.obstacle);
}

/// The body carries the weight, so it presses the obstacle upwards.
WrenchRecord recordOf(const LaidWeight& weight) {
  const double force = kGravity * weight.mass_kg;
  WrenchRecord record{
      weight.obstacle, fmt::format("{:.3g} kg", weight.mass_kg), kWeightShare * force, {}, true};
  WrenchSample sample;
  sample.value.force.z() = force;
  record.samples = {sample};
  return record;
}

void setGravity(const RecordingQuestion& question, const std::string& frame, SimulatorConfig* simulator) {
  const bool weighs = question.material.mass_kg > 0.0;
  if (!weighs && question.weights.empty()) return;
  if (frame.empty())
    throw std::invalid_argument(
        "a weight needs the direction of gravity: record tf from a frame with z up to the camera, and name "
        "it "
        "with --frame");
  if (weighs && simulator->gravity.isZero(0.0)) simulator->gravity = {0.0, 0.0, -kGravity};
}

}  // namespace

RecordingAnswer answer(const RecordingQuestion& question, const ObjectDescription& description,
                       const ObjectModel& model, const std::function<void(const std::string&)>& warn,
                       const std::function<void(double)>& progress) {
  std::vector<std::string> warnings;
  const GraphConfig config = readGraphConfig(question.parameters, &warnings, question.gripper);
  for (const std::string& warning : warnings) warn(warning);
  const std::vector<PinRegion> pins = pinsOf(question, description);
  requireNames(question, config.pipeline.surroundings, pins);
  SeenRecording recording = readRecording(question, config, model, pins, warn,
                                          [&progress](double share) { progress(0.7 * share); });
  for (const LaidWeight& weight : question.weights) recording.wrenches.push_back(recordOf(weight));
  MaterialQuestion material = question.material;
  material.simulator = config.pipeline.simulator;
  setGravity(question, recording.frame, &material.simulator);
  RecordingAnswer found{{problemOf(model, material), {}}, ""};
  MaterialProblem& problem = found.answer.problem;
  problem.moves = material.free.damping;
  RecordedObservations recorded =
      observationsOf(recording.frames, recording.wrenches, model.volume.rest_vertices, problem.moves);
  problem.observations = std::move(recorded.observations);
  problem.body_pose = recorded.body_pose;
  found.answer.estimate =
      identifyMaterial(problem, [&progress](double share) { progress(0.7 + 0.3 * share); });
  found.sentences =
      recorded.sentence + "\n" + sensorSentences(problem, found.answer.estimate, recording.wrenches);
  return found;
}

}  // namespace softbody
