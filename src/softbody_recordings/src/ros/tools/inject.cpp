#include "softbody_recordings/tools/inject.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "injection/fault_options.h"
#include "ros/injection/injector.h"
#include "softbody_common/tools/run_tool.h"

namespace softbody::injection {
namespace {

void addFaults(CLI::App* app, InjectorOptions* options) {
  for (const FaultOption& option : faultOptions(&options->deliveries, &options->images)) {
    std::string flag = "--" + option.name;
    std::replace(flag.begin(), flag.end(), '_', '-');
    app->add_option(flag, *option.value,
                    option.description + (option.unit.empty() ? "" : " [" + option.unit + "]"))
        ->check(CLI::Range(option.least, option.most))
        ->capture_default_str();
  }
}

}  // namespace

int runInject(int argc, char** argv) {
  InjectorOptions options;
  std::string stream = "both";
  CLI::App app("Copies a bag and adds faults to the camera's images, to test how robust the tracker is");
  app.add_option("input", options.input, "bag with the camera's topics")
      ->required()
      ->check(CLI::ExistingFile | CLI::ExistingDirectory);
  app.add_option("--output", options.output, "bag to write")->required();
  app.add_option("--camera", options.camera, "namespace of the camera's topics")->capture_default_str();
  app.add_option("--seed", options.deliveries.seed, "seed of the choice of images and pixels")
      ->capture_default_str();
  app.add_option("--stream", stream, "stream with faulty deliveries")
      ->check(CLI::IsMember({"color", "depth", "both"}))
      ->capture_default_str();
  addFaults(&app, &options);
  app.callback([&] { requireOtherFile(options.input, options.output); });
  return runTool(&app, argc, argv, [&] {
    options.images.seed = options.deliveries.seed;
    options.in_color = stream != "depth";
    options.in_depth = stream != "color";
    const InjectionReport report = inject(options, ProgressLine("inject"));
    fmt::print("{}: {} of {} colour and {} of {} depth images, {} other messages unchanged\n", options.output,
               report.color_written, report.color_read, report.depth_written, report.depth_read,
               report.copied);
    return 0;
  });
}

}  // namespace softbody::injection
