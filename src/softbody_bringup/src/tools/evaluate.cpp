#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "softbody_common/run_tool.h"
#include "softbody_evaluation/ros/evaluator.h"

namespace {

void run(const softbody::evaluation::EvaluatorOptions& options, const std::string& other) {
  if (other.empty()) {
    const softbody::evaluation::Report report = softbody::evaluation::evaluate(options);
    fmt::print(stderr, "{}", toText(report));
    fmt::print("{}\n", toJson(report).dump(2));
  } else {
    const softbody::evaluation::Comparison comparison = softbody::evaluation::evaluateBoth(options, other);
    fmt::print(stderr, "{}", toText(compare(comparison.first, comparison.second)));
    fmt::print("{}\n", toJson(comparison).dump(2));
  }
}

}  // namespace

int main(int argc, char** argv) {
  softbody::evaluation::EvaluatorOptions options;
  std::string other;
  CLI::App app(
      "Measures a tracking result against the truth, or against the depth of the recording it was made from");
  app.add_option("result", options.result, "bag with the tracker's output")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--truth", options.truth, "bag with /ground_truth/surface/...")->check(CLI::ExistingFile);
  app.add_option("--recording", options.recording,
                 "bag with the camera's topics; default: the truth, if it has them")
      ->check(CLI::ExistingFile);
  app.add_option(
         "--unhidden", options.unhidden,
         "result for the same motion with nothing before the body: what is normal after it was hidden")
      ->check(CLI::ExistingFile);
  app.add_option("--compare", other, "bag with another result, shown beside the first")
      ->check(CLI::ExistingFile);
  app.add_option("--report", options.report_folder, "folder for report.json, report.html and pictures");
  app.add_option("--namespace", options.result_namespace, "of the result's topics")->capture_default_str();
  app.add_option("--camera", options.camera, "namespace of the recording's topics")->capture_default_str();
  app.add_option("--occluder", options.occluder_m, "what is nearer than the surface by more hides it [m]")
      ->check(CLI::Range(0.001, 10.0))
      ->capture_default_str();
  app.add_option("--near-cut", options.near_cut_m, "vertices so near to a cut have a row of their own [m]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_option("--window", options.window, "frames a row of the depth residual's table")
      ->check(CLI::Range(1, 1000000))
      ->capture_default_str();
  return softbody::runTool(&app, argc, argv, [&] {
    run(options, other);
    return 0;
  });
}
