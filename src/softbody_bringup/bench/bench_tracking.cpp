#include <benchmark/benchmark.h>

#include <algorithm>
#include <opencv2/core/utility.hpp>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <optional>

#include "bench/thread_time.h"
#include "softbody_common/statistics/median.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

/// Our tracking stage, and the tracking of the paper: ORB features of OpenCV, matched by brute force. Both
/// take the same frames alternately, on one thread. Likewise our features alone, and optical flow (OpenCV's
/// calcOpticalFlowPyrLK) of the same features. Argument: 0 sponge, 1 doll.
namespace {

using namespace softbody;
using bench::millisecondsOf;

constexpr int kFrames = 60;
constexpr double kStart_s = 1.0, kRate_hz = 30.0;
constexpr int kFeatures = 1000;  // N_p of Kang et al. 2022
constexpr int kMargin = 32;      // [px] of the region around the body

/// The tracker's inputs, frame by frame, recorded from a run of the whole pipeline.
struct Recording {
  TetTopology volume;
  MeshTopology surface;
  std::vector<RgbdFrame> frames;
  std::vector<std::optional<MeshState>> before;  ///< state of the volume before the frame
  std::vector<cv::Rect> regions;                 ///< regions that contain the body
};

cv::Rect regionOf(const Points& vertices, const Pinhole& camera) {
  cv::Point2d first(camera.width, camera.height), last(0.0, 0.0);
  for (Eigen::Index v = 0; v < vertices.rows(); ++v) {
    const Eigen::Vector2d pixel = camera.project(vertices.row(v).transpose());
    first = {std::min(first.x, pixel.x()), std::min(first.y, pixel.y())};
    last = {std::max(last.x, pixel.x()), std::max(last.y, pixel.y())};
  }
  const cv::Point margin(kMargin, kMargin);
  return cv::Rect(cv::Point(first) - margin, cv::Point(last) + margin) &
         cv::Rect(0, 0, camera.width, camera.height);
}

Recording record(const std::string& scene, const std::string& object) {
  const std::string config = CONFIG_DIR;
  virtual_camera::CameraSetup setup;
  setup.scene = scene;
  setup.config_folder = config;
  virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
  CameraIngest ingest(CameraIngestConfig{});
  Pipeline pipeline(buildObjectModel(loadObjectDescription(config + "/" + object)), PipelineConfig{});
  Recording recording{pipeline.volumeTopology(), pipeline.surfaceTopology(), {}, {}, {}};
  std::optional<MeshState> volume;
  for (int i = 0; i < kFrames; ++i) {
    const double t = kStart_s + i / kRate_hz;
    const virtual_camera::Capture capture = camera.capture(i, t);
    cv::Mat3b color;
    cv::cvtColor(capture.color, color, cv::COLOR_RGB2BGR);
    recording.frames.push_back(ingest.process(
        {color, capture.depth_mm, Distortion{}, camera.pinhole(), static_cast<Nanoseconds>(1e9 * t)}));
    recording.before.push_back(volume);
    recording.regions.push_back(regionOf(capture.truth.vertices, camera.pinhole()));
    volume = pipeline.process(recording.frames.back()).volume;
  }
  return recording;
}

const Recording& recordingOf(const benchmark::State& state) {
  static const Recording sponge = record("bend", "sponge.yaml"), doll = record("doll_bend", "doll.yaml");
  return state.range(0) == 0 ? sponge : doll;
}

/// ORB features of OpenCV in a region, cross-matched with those of the first frame.
class PlainMatching {
 public:
  PlainMatching(const RgbdFrame& first, const cv::Rect& body) { extract(first, body, &model_); }

  std::size_t match(const RgbdFrame& frame, const cv::Rect& region) {
    cv::Mat descriptors;
    extract(frame, region, &descriptors);
    std::vector<cv::DMatch> matches;
    if (!descriptors.empty() && !model_.empty()) matcher_.match(descriptors, model_, matches);
    return matches.size();
  }

 private:
  void extract(const RgbdFrame& frame, const cv::Rect& region, cv::Mat* descriptors) {
    cv::Mat gray;
    std::vector<cv::KeyPoint> keypoints;
    cv::cvtColor(frame.color(region), gray, cv::COLOR_BGR2GRAY);
    orb_->detectAndCompute(gray, cv::noArray(), keypoints, *descriptors);
  }

  cv::Ptr<cv::ORB> orb_ = cv::ORB::create(kFeatures);
  cv::BFMatcher matcher_{cv::NORM_HAMMING, true};
  cv::Mat model_;
};

/// Optical flow of OpenCV, with its defaults, from the frame before.
class PlainFlow {
 public:
  /// @param features of this frame, to be followed into the next one.
  PlainFlow(const RgbdFrame& frame, const std::vector<TrackedFeature>& features) {
    cv::cvtColor(frame.color, gray_, cv::COLOR_BGR2GRAY);
    for (const TrackedFeature& feature : features)
      points_.emplace_back(static_cast<float>(feature.pixel.x()), static_cast<float>(feature.pixel.y()));
  }

  int follow(const RgbdFrame& next) const {
    if (points_.empty()) return 0;
    cv::Mat gray;
    cv::cvtColor(next.color, gray, cv::COLOR_BGR2GRAY);
    std::vector<cv::Point2f> found;
    std::vector<std::uint8_t> status;
    cv::calcOpticalFlowPyrLK(gray_, gray, points_, found, status, cv::noArray());
    return cv::countNonZero(status);
  }

 private:
  cv::Mat gray_;
  std::vector<cv::Point2f> points_;
};

struct Times {
  std::vector<double> first, track, whole, region, features, flow;  ///< [ms]; the first frame is separate
};

struct PassResult {
  std::uint32_t features = 0;  ///< in the tracker's map at the end
  bool found = true;           ///< the body, in every frame
  int tracked = 0;             ///< frames with the status TRACKING
};

/// The features alone, without depth and outline, and optical flow of the same ones.
void passOfFeatures(const Recording& recording, Times* times) {
  TrackerConfig config;
  config.depth_weight = 1e-6;
  config.outline_weight = 0.0;
  BodyTracker tracker(config);
  tracker.setTopologies(recording.volume, recording.surface);
  std::vector<TrackedFeature> features;
  for (int i = 0; i < kFrames; ++i) {
    const RgbdFrame& frame = recording.frames[i];
    if (i > 0) {
      const PlainFlow flow(recording.frames[i - 1], features);
      times->flow.push_back(millisecondsOf([&] { benchmark::DoNotOptimize(flow.follow(frame)); }));
    }
    StageTimer timer;
    const MeshState* before = recording.before[i] ? &*recording.before[i] : nullptr;
    const double track = millisecondsOf([&] { features = tracker.track(frame, before, &timer).features; });
    if (i > 0) times->features.push_back(track);
  }
}

/// One pass over the recording.
PassResult pass(const Recording& recording, Times* times) {
  BodyTracker tracker(TrackerConfig{});
  tracker.setTopologies(recording.volume, recording.surface);
  PlainMatching matching(recording.frames[0], recording.regions[0]);
  PassResult result;
  for (int i = 0; i < kFrames; ++i) {
    const RgbdFrame& frame = recording.frames[i];
    const MeshState* before = recording.before[i] ? &*recording.before[i] : nullptr;
    StageTimer timer;
    TrackingResult tracked;
    const double track = millisecondsOf([&] { tracked = tracker.track(frame, before, &timer); });
    result.features = tracked.status.features_total;
    result.found = result.found && tracked.has_targets;
    result.tracked += tracked.status.state == TrackingState::kTracking ? 1 : 0;
    if (i == 0) {
      times->first.push_back(track);
      continue;
    }
    times->track.push_back(track);
    const cv::Rect whole(cv::Point(), frame.color.size());
    times->whole.push_back(millisecondsOf([&] { benchmark::DoNotOptimize(matching.match(frame, whole)); }));
    times->region.push_back(
        millisecondsOf([&] { benchmark::DoNotOptimize(matching.match(frame, recording.regions[i])); }));
  }
  return result;
}

void trackFrames(benchmark::State& state) {
  const Recording& recording = recordingOf(state);
  Times times;
  PassResult result;
  for (auto _ : state) {
    result = pass(recording, &times);
    passOfFeatures(recording, &times);
    if (!result.found) {
      state.SkipWithError("the body is not found in every frame");
      return;
    }
    state.SetIterationTime(1e-3 * medianOf(times.track));
  }
  const bool doll = state.range(0) != 0;
  const std::string body = doll ? "doll" : "sponge";
  const double track = medianOf(times.track);
  state.counters["features"] = result.features;
  state.counters["frames TRACKING"] = result.tracked;
  state.counters["ORB and brute force, whole image [ms]"] = medianOf(times.whole);
  state.counters["ORB and brute force, region [ms]"] = medianOf(times.region);
  state.counters["optical flow of the features [ms]"] = medianOf(times.flow);
  state.counters["summary/tracking/" + body + "/features_ms"] = medianOf(times.features);
  state.counters["summary/tracking/" + body + "/optical_flow_ratio"] =
      medianOf(times.flow) / medianOf(times.features);
  state.counters["summary/tracking/" + body + "/first_frame_ms"] = medianOf(times.first);
  state.counters["summary/tracking/" + body + "/frame_ms"] = track;
  state.counters["summary/tracking/" + body + "/ratio_to_region"] = medianOf(times.region) / track;
  state.counters[doll ? "summary/tracking/doll/ratio" : "summary/tracking_ratio"] =
      medianOf(times.whole) / track;
}
BENCHMARK(trackFrames)
    ->ArgName("doll")
    ->Arg(0)
    ->Arg(1)
    ->UseManualTime()
    ->Iterations(5)
    ->Unit(benchmark::kMillisecond);

}  // namespace
