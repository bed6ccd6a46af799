#include <benchmark/benchmark.h>

#include <map>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>

#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

/// The stages of the graph on the shipped sponge and the virtual camera, on one thread.
namespace {

using namespace softbody;

constexpr int kFrames = 60;
constexpr double kRate_hz = 30.0;

const ObjectModel& sponge() {
  static const ObjectModel model = buildObjectModel(loadObjectDescription(CONFIG_DIR "/sponge.yaml"));
  return model;
}

struct RawFrame {
  cv::Mat3b color;
  cv::Mat1w depth_mm;
  Nanoseconds stamp;
};

struct Recording {
  Pinhole camera;
  std::vector<RawFrame> raw;
  std::vector<RgbdFrame> frames;
};

Recording record() {
  virtual_camera::CameraSetup setup;
  setup.body = CONFIG_DIR "/sponge.obj";
  virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
  CameraIngest ingest(CameraIngestConfig{});
  Recording recording{camera.pinhole(), {}, {}};
  for (int i = 0; i < kFrames; ++i) {
    const virtual_camera::Capture capture = camera.capture(i, i / kRate_hz);
    RawFrame raw{{}, capture.depth_mm.clone(), static_cast<Nanoseconds>(1e9 * (1.0 + i / kRate_hz))};
    cv::cvtColor(capture.color, raw.color, cv::COLOR_RGB2BGR);
    recording.frames.push_back(
        ingest.process({raw.color, raw.depth_mm, Distortion{}, recording.camera, raw.stamp}));
    recording.raw.push_back(raw);
  }
  return recording;
}

const Recording& recording() {
  static const Recording kept = record();
  return kept;
}

void ingestFrame(benchmark::State& state) {
  CameraIngest ingest(CameraIngestConfig{});
  const Recording& kept = recording();
  std::size_t i = 0;
  for (auto _ : state) {
    const RawFrame& raw = kept.raw[i++ % kFrames];
    benchmark::DoNotOptimize(ingest.process({raw.color, raw.depth_mm, Distortion{}, kept.camera, raw.stamp}));
  }
}
BENCHMARK(ingestFrame)->Unit(benchmark::kMillisecond);

void makeSurfaceWeights(benchmark::State& state) {
  for (auto _ : state) benchmark::DoNotOptimize(VisualSurface(sponge().visual, sponge().volume));
}
BENCHMARK(makeSurfaceWeights)->Unit(benchmark::kMillisecond);

/// One iteration is one pass over the recording. Counters: mean time per frame of each stage [ms], without
/// the first frame.
void trackRecording(benchmark::State& state) {
  std::map<std::string, double> total_ms;
  double frames = 0.0;
  for (auto _ : state) {
    Pipeline pipeline(sponge(), PipelineConfig{});
    for (const RgbdFrame& frame : recording().frames) {
      for (const StageTime& time : pipeline.process(frame).times) {
        if (!time.initialization) total_ms[time.stage] += time.milliseconds;
      }
      ++frames;
    }
  }
  for (const auto& [stage, milliseconds] : total_ms) state.counters[stage + " [ms]"] = milliseconds / frames;
}
BENCHMARK(trackRecording)->Unit(benchmark::kMillisecond);

}  // namespace
