#include "softbody_recordings/tools/identify_material.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <opencv2/core/utility.hpp>

#include "identification/estimate_output.h"
#include "identification/shape_question.h"
#include "ros/identification/recording_question.h"
#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"

namespace softbody {
namespace {

constexpr int kNotObservable = 3;  ///< exit code: done, but a property that was asked for does not show

struct Arguments {
  std::string shape, shape_unit = "m";
  std::vector<std::string> free{"e"}, pins;
  std::vector<double> gravity{0.0, 0.0, -9.81};
  std::vector<std::vector<std::string>> loads, wrenches, weights;
  FileScope scope = FileScope::kOwnFolder;
  RecordingQuestion recording;
  EstimateOutput output;
};

void declareObject(CLI::App* app, Arguments* arguments) {
  MaterialQuestion& material = arguments->recording.material;
  app->add_option("--object", arguments->output.object, "object YAML, or its folder")
      ->required()
      ->check(CLI::ExistingPath);
  app->add_option("--parameters", arguments->recording.parameters,
                  "YAML with a section of parameters for each node")
      ->check(CLI::ExistingFile);
  CLI::Option* mass = app->add_option("--mass", material.mass_kg, "mass of the whole object [kg], weighed")
                          ->check(CLI::PositiveNumber);
  app->add_option("--mass-std", material.mass_std_kg,
                  "standard deviation of the mass [kg]; default: a hundredth of it")
      ->check(CLI::PositiveNumber)
      ->needs(mass);
  app->add_option("--free", arguments->free, "what to find: e, nu, damping")
      ->delimiter(',')
      ->capture_default_str();
  app->add_option("--pin", arguments->pins,
                  "region of the rest shape that is held, for example \"x<0.01 "
                  "& z>0\" [m]; in a recording with "
                  "@FRAME after it, if it moves with a frame of tf; may be "
                  "repeated; also the object's pins are held");
  app->add_option("--output", arguments->output.yaml,
                  "gets the object YAML with the found material; in the "
                  "object's folder, may be the object itself");
  app->add_option("--report", arguments->output.folder, "folder that gets report.txt and fit.png");
  addAllowOutside(app, &arguments->scope);
}

CLI::Option* declareShape(CLI::App* app, Arguments* arguments) {
  CLI::Option* shape = app->add_option("--from-shape", arguments->shape,
                                       "PLY, OBJ, STL or OFF: points on the surface of the body "
                                       "at rest under its loads, in the "
                                       "object's frame; the held part lies on the object's")
                           ->check(CLI::ExistingFile);
  app->add_option("--shape-unit", arguments->shape_unit, "unit of that file")
      ->check(CLI::IsMember({"m", "cm", "mm", "inch"}))
      ->needs(shape)
      ->capture_default_str();
  app->add_option("--load", arguments->loads,
                  "REGION FX FY FZ: a known force [N], divided among the "
                  "region's vertices; may be repeated")
      ->type_size(4)
      ->needs(shape);
  app->add_option("--gravity", arguments->gravity, "gravity X Y Z in the object's frame [m/s^2]")
      ->expected(3)
      ->needs(shape)
      ->capture_default_str();
  return shape;
}

void declareFrames(CLI::App* app, CLI::Option* recording, RecordingQuestion* asked) {
  RecordingQuestion& question = *asked;
  app->add_option("--frame", question.frame,
                  "frame of tf in which the body is simulated, z up; default: "
                  "that of the parameters, or world")
      ->needs(recording);
  app->add_option("--gripper", question.gripper,
                  "YAML of a gripper, or the frame between its fingers: what it "
                  "grips is held; replaces the parameter")
      ->needs(recording);
  app->add_option("--from", question.from_s, "used part of the recording: its begin [s]")->needs(recording);
  app->add_option("--to", question.to_s, "its end [s]")->needs(recording);
  addCameraOptions(app, &question.camera);
}

void declareRecording(CLI::App* app, CLI::Option* shape, Arguments* arguments) {
  RecordingQuestion& question = arguments->recording;
  CLI::Option* recording = app->add_option("recording", question.recording,
                                           "bag with the camera's topics and tf: the held body deforms")
                               ->check(CLI::ExistingFile)
                               ->excludes(shape);
  app->add_option("--wrench", arguments->wrenches,
                  "TOPIC NAME: geometry_msgs/WrenchStamped, what the body does "
                  "to a pin (the name of its frame) or an "
                  "obstacle; may be repeated")
      ->type_size(2)
      ->needs(recording);
  app->add_option("--wrench-std", question.wrench_std_n,
                  "least standard deviation of a measured force [N], e.g. what "
                  "the sensor's zero is sure to; default: "
                  "the noise of the topic alone")
      ->check(CLI::Range(0.0, 1e6))
      ->needs(recording);
  app->add_option("--weight", arguments->weights,
                  "OBSTACLE KG: an obstacle that lies on the body with this mass")
      ->type_size(2)
      ->needs(recording);
  declareFrames(app, recording, &question);
}

double numberOf(const std::string& option, const std::string& text) {
  double number = 0.0;
  if (!CLI::detail::lexical_cast(text, number) || !std::isfinite(number))
    throw CLI::ValidationError(option, "'" + text + "' is not a number");
  return number;
}

/// @throw CLI::ValidationError.
void read(Arguments* arguments) {
  RecordingQuestion& question = arguments->recording;
  if (arguments->shape.empty() && question.recording.empty())
    throw CLI::ValidationError("give a recording, or a shape with --from-shape");
  try {
    question.material.free = freePropertiesOf(arguments->free);
    requireUsable(arguments->output);
  } catch (const std::invalid_argument& error) {
    throw CLI::ValidationError(error.what());
  }
  for (const auto& words : arguments->wrenches) question.wrenches.push_back({words[0], words[1]});
  for (const auto& words : arguments->weights) {
    question.weights.push_back({words[0], numberOf("--weight", words[1])});
    if (!(question.weights.back().mass_kg > 0.0))
      throw CLI::ValidationError("--weight", "must be above 0 kg");
  }
  question.pins = arguments->pins;
}

using Warn = std::function<void(const std::string&)>;

MaterialAnswer fromShape(const Arguments& arguments, const ObjectDescription& description,
                         const ObjectModel& model, const Warn& warn) {
  ShapeQuestion question{
      arguments.recording.material, arguments.shape, metresPer(arguments.shape_unit), arguments.pins, {}};
  for (const auto& words : arguments.loads)
    question.loads.push_back(
        {words[0],
         {numberOf("--load", words[1]), numberOf("--load", words[2]), numberOf("--load", words[3])}});
  std::vector<std::string> warnings;
  question.material.simulator = readGraphConfig(arguments.recording.parameters, &warnings).pipeline.simulator;
  for (const std::string& warning : warnings) warn(warning);
  question.material.simulator.gravity = Eigen::Vector3d(arguments.gravity.data());
  return answer(question, description, model, warn, ProgressLine("identify_material"));
}

int identify(const Arguments& arguments) {
  cv::setNumThreads(1);  // the order of floating-point sums must not depend on scheduling
  const Warn warn = [](const std::string& sentence) {
    fmt::print(stderr, "identify_material: {}\n", sentence);
  };
  const ObjectDescription description = loadObjectDescription(arguments.output.object, arguments.scope);
  const ObjectModel model = buildObjectModel(description);
  for (const std::string& warning : model.warnings) warn(warning);
  RecordingAnswer found;
  if (arguments.shape.empty())
    found = answer(arguments.recording, description, model, warn, ProgressLine("identify_material"));
  else
    found.answer = fromShape(arguments, description, model, warn);
  const MaterialEstimate& estimate = found.answer.estimate;
  const std::string report = reportOf(estimate) + found.sentences;
  fmt::print("{}", report);
  fmt::print("{}", write(arguments.output, found.answer.problem, estimate, report));
  return isComplete(estimate) ? 0 : kNotObservable;
}

}  // namespace

int runIdentifyMaterial(int argc, char** argv) {
  Arguments arguments;
  CLI::App app(
      "Finds the stiffness of an object where its weight or a known "
      "force shows it");
  declareObject(&app, &arguments);
  declareRecording(&app, declareShape(&app, &arguments), &arguments);
  app.callback([&arguments] { read(&arguments); });
  app.footer(
      "Exit codes: 0 found; 1 the data could not be processed; 2 wrong "
      "usage; 3 done, but a property that was asked "
      "for does not show in the data.");
  return runTool(&app, argc, argv, [&arguments] { return identify(arguments); });
}

}  // namespace softbody
