#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "softbody_common/run_tool.h"
#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/validation/checks.h"

int main(int argc, char** argv) {
  namespace validation = softbody::validation;
  std::string input, camera = "/camera";
  validation::CheckLimits limits;
  bool json = false;
  CLI::App app("Says what is wrong with a bag before the tracker is blamed; 0: usable, 1: not");
  app.add_option("input", input, "bag with the camera's topics")->required()->check(CLI::ExistingFile);
  app.add_option("--camera", camera, "namespace of the camera's topics")->capture_default_str();
  app.add_option("--sync-tolerance", limits.sync_tolerance_s, "between colour and depth [s]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag("--json", json, "findings as JSON instead of sentences");
  return softbody::runTool(&app, argc, argv, [&] {
    const validation::RecordingFacts facts =
        validation::readFacts(input, camera, softbody::ProgressLine("validate_bag"));
    const validation::Findings findings = validation::check(facts, limits);
    fmt::print("{}", json ? toJson(facts, findings).dump(2) + "\n" : toText(facts, findings));
    return usable(findings) ? 0 : 1;
  });
}
