#include <benchmark/benchmark.h>

#include <opencv2/core/utility.hpp>

#include "softbody_virtual_camera/camera/camera_setup.h"

/// The parts of a frame of the virtual camera, on one thread. Arguments: 0 sponge or 1 doll; image width
/// [px].
namespace {

using namespace softbody::virtual_camera;

VirtualCamera cameraOf(const benchmark::State& state, const NoiseOptions& noise = {}) {
  CameraSetup setup;
  setup.scene = state.range(0) == 0 ? "bend" : "doll_bend";
  setup.config_folder = CONFIG_DIR;
  setup.width = static_cast<int>(state.range(1));
  setup.noise = noise;
  return makeCamera(setup);
}

double timeOf(int frame) { return 1.0 + frame % 90 / 30.0; }

void moveScene(benchmark::State& state) {
  const VirtualCamera camera = cameraOf(state);
  int frame = 0;
  for (auto _ : state) benchmark::DoNotOptimize(camera.scene().state(timeOf(frame++)));
}

void renderFrame(benchmark::State& state) {
  const VirtualCamera camera = cameraOf(state);
  Renderer renderer(camera.scene(), camera.pinhole());
  RenderedImage image;
  int frame = 0;
  for (auto _ : state) {
    state.PauseTiming();
    const SceneState scene = camera.scene().state(timeOf(frame++));
    state.ResumeTiming();
    renderer.render(scene, &image);
  }
}

void addColorNoise(benchmark::State& state) {
  const ColorNoise noise({}, 1);
  cv::Mat3b color(480, static_cast<int>(state.range(1)), cv::Vec3b(90, 120, 150));
  int frame = 0;
  for (auto _ : state) noise.apply(frame++, &color);
}

void addDepthNoise(benchmark::State& state) {
  const DepthNoise noise({}, 1);
  cv::Mat1f depth(480, static_cast<int>(state.range(1)));
  int frame = 0;
  for (auto _ : state) {
    depth.setTo(0.5f);
    noise.apply(frame++, 615.0, &depth);
  }
}

void captureFrame(benchmark::State& state) {
  VirtualCamera camera = cameraOf(state);
  int frame = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(camera.capture(frame, timeOf(frame)));
    ++frame;
  }
}

void sizes(benchmark::internal::Benchmark* benchmark) {
  benchmark->ArgsProduct({{0, 1}, {640, 848}})->ArgNames({"doll", "width"})->Unit(benchmark::kMillisecond);
}

BENCHMARK(moveScene)->Apply(sizes);
BENCHMARK(renderFrame)->Apply(sizes);
BENCHMARK(addColorNoise)->Apply(sizes);
BENCHMARK(addDepthNoise)->Apply(sizes);
BENCHMARK(captureFrame)->Apply(sizes);

}  // namespace
