#include "softbody_evaluation/tools/draw_cut.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <opencv2/imgcodecs.hpp>

#include "report/cut_pictures.h"
#include "ros/recording_reader.h"
#include "ros/result_reader.h"
#include "softbody_common/files/staged_output.h"
#include "softbody_common/protocol/topics.h"
#include "softbody_common/tools/camera_options.h"
#include "softbody_common/tools/run_tool.h"
#include "softbody_evaluation/ros/surface_reader.h"

namespace softbody::evaluation {
namespace {

struct Options {
  std::vector<std::string> results;
  std::string recording, output, topic_namespace = "/softbody";
  CameraTopics camera = "/camera";
};

SurfaceRecord readResult(const Options& options, const std::string& path) {
  return readSurface(path, options.topic_namespace + "/" + topics::kSurfaceTopology,
                     options.topic_namespace + "/" + topics::kSurfaceState);
}

cv::Mat3b drawModels(const Options& options) {
  std::vector<cv::Mat3b> columns;
  for (const std::string& path : options.results) columns.push_back(drawCutModels(readResult(options, path)));
  cv::Mat3b picture;
  cv::hconcat(columns, picture);
  return picture;
}

cv::Mat3b drawStrip(const Options& options) {
  const std::string& path = options.results.front();
  const SurfaceRecord result = readResult(options, path);
  const std::string camera_frame = recordingFrame(options.recording, options.camera);
  if (result.frame_id != camera_frame) {
    throw std::invalid_argument(fmt::format(
        "{}: the surface is in frame '{}', but the images are in frame '{}'. Make a result in the "
        "frame of the images",
        path, result.frame_id, camera_frame));
  }
  CutStrip strip(result, readBlades(path, options.topic_namespace + "/" + topics::kToolBlade));
  readRecording(options.recording, options.camera, [&](const RecordedFrame& frame) { strip.add(frame); });
  return strip.picture();
}

void writePicture(const std::filesystem::path& path, const cv::Mat3b& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(path.extension().string(), picture, bytes);
  replaceFile(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

void declare(CLI::App* app, Options* options) {
  app->add_option("results", options->results,
                  "bags of replay or of the graph; with --recording one bag, in the camera's frame")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* recording = app->add_option("--recording", options->recording, "bag with the camera's topics")
                               ->check(CLI::ExistingFile);
  app->add_option("--output", options->output, "picture to write, e.g. cut.png")->required();
  app->add_option("--namespace", options->topic_namespace, "namespace of the results' topics")
      ->capture_default_str();
  addCameraOptions(app, &options->camera);
  app->callback([options, recording] {
    if (!cv::haveImageWriter(options->output))
      throw CLI::ValidationError("--output", options->output + " is not the name of a picture, e.g. cut.png");
    if (*recording && options->results.size() != 1)
      throw CLI::ValidationError("--recording", "needs exactly one result");
  });
}

}  // namespace

int runDrawCut(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Draws cut bodies, without a display. Without --recording: models before and after the cuts, one "
      "column "
      "per result (as Kang et al. 2022, figure 10). With --recording: the course of the cuts (as figure 11)");
  declare(&app, &options);
  return runTool(&app, argc, argv, [&] {
    writePicture(options.output, options.recording.empty() ? drawModels(options) : drawStrip(options));
    return 0;
  });
}

}  // namespace softbody::evaluation
