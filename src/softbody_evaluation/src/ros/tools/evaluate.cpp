#include "softbody_evaluation/tools/evaluate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "report/metrics.h"
#include "report/model_report.h"
#include "report/report_json.h"
#include "report/summary_text.h"
#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_evaluation/models/model_distance.h"
#include "softbody_evaluation/models/model_fit.h"
#include "softbody_evaluation/ros/evaluator.h"

namespace softbody::evaluation {
namespace {

constexpr std::uint64_t kModelSeed = 1;  // of the samples: the same metrics each time

/// What is printed, and of which results.
struct Output {
  std::string other_result;  ///< empty: only one result
  bool json = false;
  bool windows = false;
  std::vector<std::string> models;  ///< empty, or a scanned and a true one
  bool aligned = false;
};

void declareInput(CLI::App* app, EvaluatorOptions* options, Output* output) {
  app->add_option("result", options->result, "bag with the tracker's output")->check(CLI::ExistingFile);
  app->add_option("--truth", options->truth, "bag with /ground_truth/surface/...")->check(CLI::ExistingFile);
  app->add_option("--recording", options->recording,
                  "bag with the camera's topics; default: the truth, if it has these topics")
      ->check(CLI::ExistingFile);
  app->add_option("--unhidden", options->unhidden,
                  "bag with the result for the same motion without occluders; its error is the normal error "
                  "after an occlusion")
      ->check(CLI::ExistingFile);
  app->add_option("--compare", output->other_result, "bag with another result, shown beside the first")
      ->check(CLI::ExistingFile);
  app->add_option("--namespace", options->result_namespace, "namespace of the result's topics")
      ->capture_default_str();
  app->add_option("--truth-namespace", options->truth_namespace,
                  "namespace of the body's topics in the truth; /ground_truth/second: of a second body")
      ->capture_default_str();
  addCameraOptions(app, &options->camera);
}

void declareMeasures(CLI::App* app, EvaluatorOptions* options, Output* output) {
  app->add_option("--occluder", options->occluder_m,
                  "depth that is nearer than the surface by more than this is an occluder [m]")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  app->add_option("--near-cut", options->near_cut_m,
                  "largest distance of the vertices in the row 'near a cut' [m]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app->add_option("--open-loop", options->open_loop,
                  "share of the frames at the end that the result predicts without images (replay "
                  "--open-loop): their error is a metric of its own")
      ->check(CLI::Range(0.0, 0.95));
  app->add_option_function<int>(
         "--window",
         [options, output](int frames) {
           options->window = frames;
           output->windows = true;
         },
         "prints the depth residual too, a row for each such number of frames")
      ->check(CLI::Range(1, 1000000));
  app->add_option("--report", options->report_folder,
                  "folder for report.html, a page with all metrics and pictures, and report.json");
  app->add_flag("--json", output->json, "prints all metrics as JSON, and nothing else");
}

/// Must come last: models are not measured together with bags.
void declareModels(CLI::App* app, EvaluatorOptions* options, Output* output) {
  CLI::Option* models =
      app->add_option("--model", output->models,
                      "compares a scanned mesh with the true one instead: mesh files in metres, object YAMLs "
                      "or their folders")
          ->expected(2)
          ->type_name("SCANNED TRUE");
  for (const char* of_bags : {"result", "--truth", "--recording", "--unhidden", "--compare", "--report"})
    models->excludes(app->get_option(of_bags));
  app->add_flag("--aligned", output->aligned, "the two meshes are in one frame: compares them without a fit")
      ->needs(models);
  app->callback([options, output] {
    if (options->result.empty() && output->models.empty()) throw CLI::RequiredError("result, or --model,");
  });
}

/// Where the page is, or how to get it.
std::string pageLine(const EvaluatorOptions& options) {
  if (options.report_folder.empty()) return "page with all metrics and pictures: add --report FOLDER\n";
  const std::filesystem::path folder = std::filesystem::absolute(options.report_folder);
  return fmt::format("report: {}\n", (folder / "report.html").lexically_normal().string());
}

void printReport(const EvaluatorOptions& options, const Output& output) {
  const Report report = evaluate(options);
  if (output.json) {
    fmt::print("{}\n", toJson(report).dump(2));
    return;
  }
  fmt::print("{}\n{}", verdictText(report), summaryTable(report));
  if (output.windows) fmt::print("\n{}", residualTable(report));
  fmt::print("\n{}", pageLine(options));
}

void printComparison(const EvaluatorOptions& options, const Output& output) {
  const Comparison comparison = evaluateBoth(options, output.other_result);
  if (output.json) {
    fmt::print("{}\n", toJson(comparison).dump(2));
    return;
  }
  fmt::print("result: {}\n{}\nother: {}\n{}\n", options.result, verdictText(comparison.first),
             output.other_result, verdictText(comparison.second));
  fmt::print("{}\n{}", toText(compare(comparison.first, comparison.second)), pageLine(options));
}

void printModels(const Output& output) {
  std::vector<std::string> warnings;
  const Model scanned = readModel(output.models[0], &warnings),
              truth = readModel(output.models[1], &warnings);
  for (const std::string& warning : warnings) fmt::print(stderr, "evaluate: {}\n", warning);
  const Eigen::Isometry3d pose = output.aligned ? Eigen::Isometry3d::Identity() : fitModel(scanned, truth);
  const ModelReport report = compareModels(scanned, truth, pose, kModelSeed);
  if (output.json)
    fmt::print("{}\n", toJson(report).dump(2));
  else
    fmt::print("{}", toText(report));
}

}  // namespace

int runEvaluate(int argc, char** argv) {
  EvaluatorOptions options;
  Output output;
  CLI::App app(
      "Measures a tracking result against the truth, or against the depth of its recording; or a scanned "
      "mesh against the true one");
  declareInput(&app, &options, &output);
  declareMeasures(&app, &options, &output);
  declareModels(&app, &options, &output);
  return runTool(&app, argc, argv, [&] {
    if (!output.models.empty()) {
      printModels(output);
    } else if (output.other_result.empty()) {
      printReport(options, output);
    } else {
      printComparison(options, output);
    }
    return 0;
  });
}

}  // namespace softbody::evaluation
