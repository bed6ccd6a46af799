#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cstdio>

#include "softbody_bringup/injection/injector.h"

namespace {

using softbody::injection::InjectorOptions;

void addDeliveries(CLI::App* app, softbody::injection::DeliveryFaults* faults) {
  const CLI::Range share(0.0, 1.0);
  app->add_option("--drop", faults->drop_share, "share of the images that never arrive")->check(share);
  app->add_option("--duplicate", faults->duplicate_share, "share that arrive twice")->check(share);
  app->add_option("--reorder", faults->reorder_share, "share that change places with the next one")
      ->check(share);
  app->add_option("--delay", faults->delay_share, "share that arrive late")->check(share);
  app->add_option("--delay-by", faults->delay_s, "how late [s]")
      ->check(CLI::Range(0.0, 60.0))
      ->capture_default_str();
  app->add_option("--wrong-stamp", faults->stamp_share, "share whose stamp is off")->check(share);
  app->add_option("--stamp-by", faults->stamp_s, "by how much; negative: too early [s]")
      ->check(CLI::Range(-3600.0, 3600.0))
      ->capture_default_str();
}

void addImages(CLI::App* app, softbody::injection::ImageFaults* faults) {
  const CLI::Range share(0.0, 1.0), seconds(0.0, 1e9);
  app->add_option("--occluder", faults->occluder_share,
                  "share of the image that a flat, skin-coloured thing covers")
      ->check(share);
  app->add_option("--occluder-u", faults->occluder_u, "its centre, in widths of the image")
      ->check(share)
      ->capture_default_str();
  app->add_option("--occluder-v", faults->occluder_v, "its centre, in heights of the image")
      ->check(share)
      ->capture_default_str();
  app->add_option("--occluder-depth", faults->occluder_m, "its distance [m]")
      ->check(CLI::Range(0.001, 65.0))
      ->capture_default_str();
  app->add_option("--occluder-from", faults->occluder_from_s, "when it comes, from the first image on [s]")
      ->check(seconds)
      ->capture_default_str();
  app->add_option("--occluder-for", faults->occluder_for_s, "how long it stays; default: to the end [s]")
      ->check(seconds);
  app->add_option("--holes", faults->hole_share,
                  "share of the depth image that is not measured, in blocks of 8 x 8 px")
      ->check(share);
}

void showProgress(double share) {
  static int shown = -1;
  const int percent = static_cast<int>(100.0 * share);
  if (percent == shown) return;
  shown = percent;
  fmt::print(stderr, "\rinject: {:3d} %{}", percent, percent >= 100 ? "\n" : "");
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
  addDeliveries(&app, &options.deliveries);
  addImages(&app, &options.images);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  options.images.seed = options.deliveries.seed;
  options.in_color = stream != "depth";
  options.in_depth = stream != "color";
  try {
    const softbody::injection::InjectionReport report = inject(options, showProgress);
    fmt::print("{}: {} of {} colour and {} of {} depth images, {} other messages unchanged\n", options.output,
               report.color_written, report.color_read, report.depth_written, report.depth_read,
               report.copied);
  } catch (const std::exception& error) {
    fmt::print(stderr, "inject: {}: {}\n", options.input, error.what());
    return 1;
  }
  return 0;
}
