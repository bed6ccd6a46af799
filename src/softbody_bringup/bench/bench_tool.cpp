#include <benchmark/benchmark.h>

#include <algorithm>
#include <opencv2/aruco.hpp>
#include <opencv2/imgproc.hpp>

#include "bench/thread_time.h"
#include "softbody_common/statistics/median.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_tracking/tool/tool_tracker.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

/// Tool tracking, and OpenCV's detection of markers in the same images, in turn on one thread. In scene
/// `cut` the knife comes into view, cuts and leaves, so that about half of the frames do not show its marker.
namespace {

using namespace softbody;
using bench::millisecondsOf;

constexpr int kFrames = 240, kSeeds = 3;
constexpr double kRate_hz = 30.0;

const std::string kTool = CONFIG_DIR "/knife.yaml";

/// OpenCV's detector with its defaults.
class PlainDetector {
 public:
  void detect(const cv::Mat3b& color) {
    cv::cvtColor(color, gray_, cv::COLOR_BGR2GRAY);
    cv::aruco::detectMarkers(gray_, dictionary_, corners_, ids_);
  }

 private:
  cv::Ptr<cv::aruco::Dictionary> dictionary_ = cv::aruco::getPredefinedDictionary(cv::aruco::DICT_4X4_50);
  cv::Mat1b gray_;
  std::vector<std::vector<cv::Point2f>> corners_;
  std::vector<int> ids_;
};

/// Sums over the frames of all passes.
struct Sums {
  int frames = 0, seen = 0;
  double ours_ms = 0.0, seen_ms = 0.0, plain_ms = 0.0, worst_ms = 0.0, worst_plain_ms = 0.0;
  double place_mm = 0.0, angle_deg = 0.0;  ///< errors of the poses that are seen

  void add(double ours, double plain) {
    ++frames;
    ours_ms += ours;
    plain_ms += plain;
    worst_ms = std::max(worst_ms, ours);
    worst_plain_ms = std::max(worst_plain_ms, plain);
  }

  void add(double ours, const Eigen::Isometry3d& pose, const Eigen::Isometry3d& truth) {
    ++seen;
    seen_ms += ours;
    place_mm += 1e3 * (pose.translation() - truth.translation()).norm();
    angle_deg += 180.0 / M_PI * Eigen::AngleAxisd(pose.linear() * truth.linear().transpose()).angle();
  }
};

virtual_camera::VirtualCamera cameraOf(std::uint64_t seed) {
  virtual_camera::CameraSetup setup;
  setup.scene = "cut";
  setup.config_folder = CONFIG_DIR;
  setup.seed = seed;
  return virtual_camera::makeCamera(setup);
}

void watchCut(std::uint64_t seed, Sums* sums) {
  virtual_camera::VirtualCamera camera = cameraOf(seed);
  CameraIngest ingest(CameraIngestConfig{});
  const ToolDescription tool = loadToolDescription(kTool);
  // The median of their times counts, so that an interrupt does not.
  ToolTracker trackers[] = {ToolTracker(tool), ToolTracker(tool), ToolTracker(tool)};
  PlainDetector detector;
  for (int i = 0; i < kFrames; ++i) {
    const double t = i / kRate_hz;
    const virtual_camera::Capture capture = camera.capture(i, t);
    cv::Mat3b color;
    cv::cvtColor(capture.color, color, cv::COLOR_RGB2BGR);
    const RgbdFrame frame = ingest.process(
        {color, capture.depth_mm, Distortion{}, camera.pinhole(), static_cast<Nanoseconds>(1e9 * (1.0 + t))});
    std::vector<double> ours, plain;
    std::optional<ToolObservation> seen;
    for (ToolTracker& tracker : trackers) {
      ours.push_back(millisecondsOf([&] { seen = tracker.track(frame, nullptr); }));
      plain.push_back(millisecondsOf([&] { detector.detect(frame.color); }));
    }
    sums->add(medianOf(ours), medianOf(plain));
    if (seen && !seen->bridged) sums->add(medianOf(ours), seen->T_camera_tool, *capture.T_camera_tool);
  }
}

/// One iteration is one seed of the scene's textures and noise.
void trackTool(benchmark::State& state) {
  Sums sums;
  std::uint64_t seed = 0;
  for (auto _ : state) {
    watchCut(++seed, &sums);
    state.SetIterationTime(1e-3 * sums.ours_ms / sums.frames);
  }
  const auto mean = [](double sum, int count) { return sum / count; };
  state.counters["frames"] = sums.frames;
  state.counters["frames with a pose"] = sums.seen;
  state.counters["frame with a pose [ms]"] = mean(sums.seen_ms, sums.seen);
  state.counters["frame without [ms]"] = mean(sums.ours_ms - sums.seen_ms, sums.frames - sums.seen);
  state.counters["error of its place, mean [mm]"] = mean(sums.place_mm, sums.seen);
  state.counters["error of its angle, mean [deg]"] = mean(sums.angle_deg, sums.seen);
  state.counters["cv::aruco [ms]"] = mean(sums.plain_ms, sums.frames);
  state.counters["cv::aruco, worst [ms]"] = sums.worst_plain_ms;
  state.counters["summary/tool/frame_ms"] = mean(sums.ours_ms, sums.frames);
  state.counters["summary/tool/worst_frame_ms"] = sums.worst_ms;
  state.counters["summary/tool/aruco_ratio"] = sums.plain_ms / sums.ours_ms;
}
BENCHMARK(trackTool)->UseManualTime()->Iterations(kSeeds)->Unit(benchmark::kMillisecond);

}  // namespace
