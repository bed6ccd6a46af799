#include "softbody_recordings/tools/validate_bag.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_recordings/ros/facts_reader.h"
#include "softbody_recordings/ros/object_trial.h"
#include "softbody_recordings/validation/checks.h"

namespace softbody::validation {

int runValidateBag(int argc, char** argv) {
  std::string input;
  CameraTopics camera = "/camera";
  CheckLimits limits;
  bool json = false;
  std::string object;
  FileScope scope = FileScope::kOwnFolder;
  CLI::App app("Checks whether a recording is usable for tracking. Exit code 0: usable; 1: not usable");
  app.add_option("input", input, "bag with the camera's topics")
      ->required()
      ->check(CLI::ExistingFile | CLI::ExistingDirectory);
  app.add_option("--object", object, "object YAML: also checks that the recording shows this body")
      ->check(CLI::ExistingPath);
  addAllowOutside(&app, &scope);
  addCameraOptions(&app, &camera);
  app.add_option("--sync-tolerance", limits.sync_tolerance_s, "largest time between colour and depth [s]")
      ->check(CLI::Range(0.0, 1.0))
      ->capture_default_str();
  app.add_flag("--json", json, "findings as JSON instead of sentences");
  return runTool(&app, argc, argv, [&] {
    BagFramesConfig config;
    config.camera = camera;
    config.pairing.tolerance = nanoseconds(limits.sync_tolerance_s);
    RecordingFacts facts = readFacts(input, config, ProgressLine("validate_bag"));
    if (!object.empty() && facts.frames.with_depth > 0)
      facts.trial = tryObject(input, config, object, scope, ProgressLine("validate_bag"));
    const Findings findings = check(facts, limits);
    fmt::print("{}", json ? toJson(facts, findings).dump(2) + "\n" : toText(facts, findings));
    return usable(findings) ? 0 : 1;
  });
}

}  // namespace softbody::validation
