#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "softbody_common/run_tool.h"
#include "softbody_recordings/injection/fault_options.h"
#include "softbody_recordings/ros/injector.h"

namespace {

using softbody::injection::InjectorOptions;

void addFaults(CLI::App* app, InjectorOptions* options) {
  for (const softbody::injection::FaultOption& option :
       faultOptions(&options->deliveries, &options->images)) {
    std::string flag = "--" + option.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    app->add_option(flag, *option.value, option.words + (option.unit.empty() ? "" : " [" + option.unit + "]"))
        ->check(CLI::Range(option.least, option.most))
        ->capture_default_str();
  }
}

}  // namespace

int main(int argc, char** argv) {
  InjectorOptions options;
  std::string stream = "both";
  CLI::App app("Copies a bag with faults in the camera's images: what a robust tracker has to stand");
  app.add_option("input", options.input, "bag with the camera's topics")
      ->required()
      ->check(CLI::ExistingFile);
  app.add_option("--output", options.output, "bag to write")->required();
  app.add_option("--camera", options.camera, "namespace of the camera's topics")->capture_default_str();
  app.add_option("--seed", options.deliveries.seed, "which images and which pixels")->capture_default_str();
  app.add_option("--stream", stream, "whose deliveries go wrong")
      ->check(CLI::IsMember({"color", "depth", "both"}))
      ->capture_default_str();
  addFaults(&app, &options);
  app.callback([&] { softbody::requireOtherFile(options.input, options.output); });
  return softbody::runTool(&app, argc, argv, [&] {
    options.images.seed = options.deliveries.seed;
    options.in_color = stream != "depth";
    options.in_depth = stream != "color";
    const softbody::injection::InjectionReport report = inject(options, softbody::ProgressLine("inject"));
    fmt::print("{}: {} of {} colour and {} of {} depth images, {} other messages unchanged\n", options.output,
               report.color_written, report.color_read, report.depth_written, report.depth_read,
               report.copied);
    return 0;
  });
}
