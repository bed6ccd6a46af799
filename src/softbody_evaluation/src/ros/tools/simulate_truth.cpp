#include "softbody_evaluation/tools/simulate_truth.h"

#include <CLI/CLI.hpp>

#include "softbody_common/tools/run_tool.h"
#include "softbody_evaluation/ros/simulate_truth.h"

namespace softbody::evaluation {

int runSimulateTruth(int argc, char** argv) {
  TruthSimulationOptions options;
  CLI::App app(
      "Simulates an object with exact targets for all visible vertices of a scene's truth. The error of the "
      "output is the error that remains with a perfect tracker; measure it with evaluate");
  app.add_option("truth", options.truth, "bag with /ground_truth/surface/...")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--object", options.object, "object YAML, or its folder")
      ->required()
      ->check(CLI::ExistingPath);
  app.add_option("--output", options.output, "bag to write")->required();
  addAllowOutside(&app, &options.scope);
  app.callback([&options] { requireOtherFile(options.truth, options.output); });
  return runTool(&app, argc, argv, [&] {
    simulateTruth(options, ProgressLine("simulate_truth"));
    return 0;
  });
}

}  // namespace softbody::evaluation
