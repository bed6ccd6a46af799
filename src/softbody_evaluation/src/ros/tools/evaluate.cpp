#include "softbody_evaluation/tools/evaluate.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "softbody_common/camera_options.h"
#include "softbody_common/run_tool.h"
#include "softbody_evaluation/report/figures.h"
#include "softbody_evaluation/report/report_json.h"
#include "softbody_evaluation/report/report_text.h"
#include "softbody_evaluation/ros/evaluator.h"

namespace softbody::evaluation {
namespace {

void declare(CLI::App* app, EvaluatorOptions* options, std::string* other_result) {
  app->add_option("result", options->result, "bag with the tracker's output")
      ->required()
      ->check(CLI::ExistingFile);
  app->add_option("--truth", options->truth, "bag with /ground_truth/surface/...")->check(CLI::ExistingFile);
  app->add_option("--recording", options->recording,
                  "bag with the camera's topics; default: the truth, if it has these topics")
      ->check(CLI::ExistingFile);
  app->add_option("--unhidden", options->unhidden,
                  "bag with the result for the same motion without occluders; its error is the normal error "
                  "after an occlusion")
      ->check(CLI::ExistingFile);
  app->add_option("--compare", *other_result, "bag with another result, shown beside the first")
      ->check(CLI::ExistingFile);
  app->add_option("--report", options->report_folder, "folder for report.json, report.html and pictures");
  app->add_option("--namespace", options->result_namespace, "namespace of the result's topics")
      ->capture_default_str();
  addCameraOptions(app, &options->camera);
  app->add_option("--occluder", options->occluder_m,
                  "depth that is nearer than the surface by more than this is an occluder [m]")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  app->add_option("--near-cut", options->near_cut_m,
                  "largest distance of the vertices in the row 'near a cut' [m]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app->add_option("--window", options->window, "frames of a row in the depth residual's table")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
}

void printReport(const EvaluatorOptions& options) {
  const Report report = evaluate(options);
  fmt::print(stderr, "{}", toText(report));
  fmt::print("{}\n", toJson(report).dump(2));
}

void printComparison(const EvaluatorOptions& options, const std::string& other_result) {
  const Comparison comparison = evaluateBoth(options, other_result);
  fmt::print(stderr, "{}", toText(compare(comparison.first, comparison.second)));
  fmt::print("{}\n", toJson(comparison).dump(2));
}

}  // namespace

int runEvaluate(int argc, char** argv) {
  EvaluatorOptions options;
  std::string other_result;
  CLI::App app("Measures a tracking result against the truth, or against the depth of its recording");
  declare(&app, &options, &other_result);
  return runTool(&app, argc, argv, [&] {
    if (other_result.empty()) {
      printReport(options);
    } else {
      printComparison(options, other_result);
    }
    return 0;
  });
}

}  // namespace softbody::evaluation
