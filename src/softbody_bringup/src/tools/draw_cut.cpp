#include <fmt/format.h>
#include <geometry_msgs/PolygonStamped.h>
#include <rosbag/view.h>

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <opencv2/imgcodecs.hpp>

#include "softbody_common/ros/conversions.h"
#include "softbody_common/run_tool.h"
#include "softbody_evaluation/ros/cut_pictures.h"
#include "softbody_recordings/ros/input_bag.h"

namespace {

namespace evaluation = softbody::evaluation;

struct Options {
  std::vector<std::string> results;
  std::string recording, output, topic_namespace = "/softbody", camera = "/camera";
};

evaluation::SurfaceRecord readResult(const Options& options, const std::string& path) {
  return evaluation::readSurface(path, options.topic_namespace + "/surface/topology",
                                 options.topic_namespace + "/surface/state");
}

std::map<softbody::Nanoseconds, softbody::Points> readBlades(const Options& options) {
  std::map<softbody::Nanoseconds, softbody::Points> blades;
  const rosbag::Bag bag = softbody::openBag(options.results.front());
  rosbag::View view(bag, rosbag::TopicQuery(options.topic_namespace + "/tool/blade"));
  for (const rosbag::MessageInstance& instance : view) {
    const auto message = instance.instantiate<geometry_msgs::PolygonStamped>();
    if (!message) continue;
    softbody::Points corners(static_cast<Eigen::Index>(message->polygon.points.size()), 3);
    for (Eigen::Index i = 0; i < corners.rows(); ++i) {
      const geometry_msgs::Point32& p = message->polygon.points[static_cast<std::size_t>(i)];
      corners.row(i) << p.x, p.y, p.z;
    }
    blades[softbody::toNanoseconds(message->header.stamp)] = corners;
  }
  return blades;
}

cv::Mat3b drawModels(const Options& options) {
  std::vector<cv::Mat3b> columns;
  for (const std::string& path : options.results)
    columns.push_back(evaluation::drawCutModels(readResult(options, path)));
  cv::Mat3b picture;
  cv::hconcat(columns, picture);
  return picture;
}

cv::Mat3b drawStrip(const Options& options) {
  const evaluation::SurfaceRecord result = readResult(options, options.results.front());
  const std::string frame = evaluation::recordingFrame(options.recording, options.camera);
  if (result.frame_id != frame) {
    throw std::invalid_argument(fmt::format(
        "{}: the surface is in frame '{}'; to be drawn into the images it has to be in theirs, '{}'",
        options.results.front(), result.frame_id, frame));
  }
  evaluation::CutStrip strip(result, readBlades(options));
  evaluation::readRecording(options.recording, options.camera,
                            [&](const evaluation::RecordedFrame& frame) { strip.add(frame); });
  return strip.picture();
}

/// An earlier file stays as it was if this fails.
void writePicture(const std::filesystem::path& path, const cv::Mat3b& picture) {
  std::vector<std::uint8_t> bytes;
  cv::imencode(path.extension().string(), picture, bytes);
  const std::string part = path.string() + ".part";
  std::ofstream file(part, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) throw std::invalid_argument(fmt::format("{}: cannot be written", part));
  std::filesystem::rename(part, path);
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  CLI::App app(
      "Draws bodies that were cut, without a display: models before and after, a column a result, as in Kang "
      "et al. 2022, figure 10; with a recording the course of the cut, as in figure 11");
  app.add_option("results", options.results,
                 "bags of replay or of the graph; with --recording in the camera's frame")
      ->required()
      ->check(CLI::ExistingFile);
  CLI::Option* recording = app.add_option("--recording", options.recording, "bag with the camera's topics")
                               ->check(CLI::ExistingFile);
  app.add_option("--output", options.output, "picture to write, e.g. cut.png")->required();
  app.add_option("--namespace", options.topic_namespace, "of the results' topics")->capture_default_str();
  app.add_option("--camera", options.camera, "namespace of the recording's topics")->capture_default_str();
  app.callback([&] {
    if (!cv::haveImageWriter(options.output))
      throw CLI::ValidationError("--output", options.output + " is not named as a picture, e.g. cut.png");
    if (*recording && options.results.size() != 1)
      throw CLI::ValidationError("--recording", "needs one result");
  });
  return softbody::runTool(&app, argc, argv, [&] {
    writePicture(options.output, options.recording.empty() ? drawModels(options) : drawStrip(options));
    return 0;
  });
}
