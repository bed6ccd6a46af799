#include "softbody_evaluation/ros/simulate_truth.h"

#include <CLI/CLI.hpp>

#include "softbody_common/run_tool.h"

int main(int argc, char** argv) {
  softbody::TruthSimulationOptions options;
  CLI::App app(
      "Simulates an object whose visible vertices are exactly where a scene's truth has them: what evaluate "
      "measures in it is left of the error however well a tracker sees");
  app.add_option("truth", options.truth, "bag with /ground_truth/surface/...")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--object", options.object, "object YAML")->required()->check(CLI::ExistingFile);
  app.add_option("--output", options.output, "bag to write, for evaluate")->required();
  app.callback([&options] { softbody::requireOtherFile(options.truth, options.output); });
  return softbody::runTool(&app, argc, argv, [&] {
    softbody::simulateTruth(options, softbody::ProgressLine("simulate_truth"));
    return 0;
  });
}
