#include <fmt/format.h>
#include <rosbag/exceptions.h>

#include <CLI/CLI.hpp>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "softbody_bringup/validation/checks.h"
#include "softbody_bringup/validation/facts_reader.h"

namespace {

void showProgress(double share) {
  static int shown = -1;
  const int percent = static_cast<int>(100.0 * share);
  if (percent == shown) return;
  shown = percent;
  fmt::print(stderr, "\rvalidate_bag: {:3d} %{}", percent, percent >= 100 ? "\n" : "");
}

}  // namespace

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
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    const validation::RecordingFacts facts = validation::readFacts(input, camera, showProgress);
    const validation::Findings findings = validation::check(facts, limits);
    fmt::print("{}", json ? toJson(facts, findings).dump(2) + "\n" : toText(facts, findings));
    return usable(findings) ? 0 : 1;
  } catch (const rosbag::BagUnindexedException&) {
    fmt::print(stderr, "validate_bag: {}: the bag was not closed; run rosbag reindex {}\n", input, input);
  } catch (const std::exception& error) {
    fmt::print(stderr, "validate_bag: {}: {}\n", input, error.what());
  }
  return 1;
}
