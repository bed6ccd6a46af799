#include <benchmark/benchmark.h>

#include <opencv2/imgproc.hpp>

#include "bench/thread_time.h"
#include "softbody_common/statistics/median.h"
#include "softbody_recordings/pipeline/pipeline.h"
#include "softbody_tracking/camera/camera_ingest.h"
#include "softbody_virtual_camera/camera/camera_setup.h"

/// From the first image to the first mesh, with the object's rough pose, on one thread. All is counted but
/// reading the object's files: preparation of simulator, surface and tracker, ingest, the search, and the
/// step. Argument: 0 sponge, 1 doll.
namespace {

using namespace softbody;
using bench::millisecondsOf;

constexpr int kFrames = 30;  ///< at most
constexpr double kRate_hz = 30.0;

struct RawFrame {
  cv::Mat3b color;
  cv::Mat1w depth_mm;
  Pinhole camera;
  Nanoseconds stamp;
};

std::vector<RawFrame> record(bool doll) {
  virtual_camera::CameraSetup setup;
  setup.scene = doll ? "doll_bend" : "bend";
  setup.config_folder = CONFIG_DIR;
  virtual_camera::VirtualCamera camera = virtual_camera::makeCamera(setup);
  std::vector<RawFrame> frames;
  for (int i = 0; i < kFrames; ++i) {
    const virtual_camera::Capture capture = camera.capture(i, i / kRate_hz);
    frames.push_back({{},
                      capture.depth_mm.clone(),
                      camera.pinhole(),
                      static_cast<Nanoseconds>(1e9 * (1.0 + i / kRate_hz))});
    cv::cvtColor(capture.color, frames.back().color, cv::COLOR_RGB2BGR);
  }
  return frames;
}

void firstMesh(benchmark::State& state) {
  const bool doll = state.range(0) != 0;
  const std::string body = doll ? "doll" : "sponge";
  const ObjectModel model =
      buildObjectModel(loadObjectDescription(std::string(CONFIG_DIR) + "/" + body + ".yaml"));
  const std::vector<RawFrame> frames = record(doll);
  std::vector<double> preparations, totals;
  std::size_t used = 0;
  for (auto _ : state) {
    std::optional<Pipeline> pipeline;
    std::optional<CameraIngest> ingest;
    preparations.push_back(millisecondsOf([&] {
      ingest.emplace(CameraIngestConfig{});
      pipeline.emplace(model, PipelineConfig{});
    }));
    bool found = false;
    const double search = millisecondsOf([&] {
      for (used = 0; used < frames.size() && !found; ++used) {
        const RawFrame& raw = frames[used];
        found =
            pipeline->process(ingest->process({raw.color, raw.depth_mm, Distortion{}, raw.camera, raw.stamp}))
                .surface.has_value();
      }
    });
    if (!found) {
      state.SkipWithError("the body is not found");
      return;
    }
    totals.push_back(preparations.back() + search);
    state.SetIterationTime(1e-3 * totals.back());
  }
  state.counters["frames"] = static_cast<double>(used);
  state.counters["preparation [ms]"] = medianOf(preparations);
  state.counters["summary/start/" + body + "_ms"] = medianOf(totals);
}
BENCHMARK(firstMesh)->ArgName("doll")->Arg(0)->Arg(1)->UseManualTime()->Iterations(7)->Unit(
    benchmark::kMillisecond);

}  // namespace
